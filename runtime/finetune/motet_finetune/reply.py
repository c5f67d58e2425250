"""Replies of a model, greedy, and held to a grammar where one is given."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import models, rows

__all__ = ["GrammarError", "Held", "Replier", "Reply", "lark", "opened", "schema"]


class GrammarError(ValueError):
    """A grammar that llguidance does not take."""


@dataclass(frozen=True)
class Reply:
    text: str
    is_whole: bool
    """True if the model ended the reply by itself within the number of tokens."""
    tokens: int


def lark(text: str) -> str:
    """A Lark grammar for llguidance, as `motet grammar --format lark` prints it."""
    from llguidance import LLMatcher

    return LLMatcher.grammar_from_lark(text)


def schema(value: dict[str, Any]) -> str:
    """A JSON Schema for llguidance, without white space between the values."""
    from llguidance import LLMatcher

    return LLMatcher.grammar_from_json_schema(json.dumps({**value, "x-guidance": {"whitespace_flexible": False}}))


class Held:
    """A logits processor that holds each row to its grammar; a row without one is free."""

    def __init__(self, tokens: Any, grammars: list[str | None], end: list[int]) -> None:
        from llguidance import LLMatcher

        self._matchers: list[Any] = [None if grammar is None else LLMatcher(tokens, grammar) for grammar in grammars]
        for matcher in self._matchers:
            if matcher and matcher.is_error():
                raise GrammarError(matcher.get_error())
        self._end = end
        self._prompt: int | None = None

    def __call__(self, written: Any, scores: Any) -> Any:
        import numpy
        import torch

        first = self._prompt is None
        self._prompt = written.shape[1] if first else self._prompt
        allowed = numpy.ones(tuple(scores.shape), dtype=bool)
        for row, matcher, tokens in zip(allowed, self._matchers, written, strict=True):
            if matcher is None:
                continue
            if not first and not matcher.is_stopped():
                matcher.consume_token(int(tokens[-1]))
            if matcher.is_error():
                raise GrammarError(matcher.get_error())
            if matcher.is_stopped():
                row[:] = False
                row[self._end] = True
                continue
            mask = numpy.frombuffer(matcher.compute_bitmask(), dtype=numpy.uint8)
            bits = numpy.unpackbits(mask, bitorder="little")
            # A model may have more logits than its tokenizer has tokens; those are never allowed.
            row[:] = False
            row[: len(bits)] = bits[: len(row)].astype(bool)
        return scores.masked_fill(~torch.from_numpy(allowed).to(scores.device), -torch.inf)


class Replier:
    """A model that answers prompts, several at once."""

    def __init__(self, model: Any, processor: Any, most_tokens: int = 512) -> None:
        import llguidance
        import torch

        self._device = "cuda" if torch.cuda.is_available() else "cpu"
        self._model = model.to(self._device).eval()
        self._processor = processor
        self._tokenizer = models.tokenizer_of(processor)
        self._most_tokens = most_tokens
        end = model.generation_config.eos_token_id
        self._end = [end] if isinstance(end, int) else list(end or [self._tokenizer.eos_token_id])
        self._tokens = llguidance.LLTokenizer(
            self._tokenizer.backend_tokenizer.to_str(), eos_token=self._end[0], n_vocab=_width(model, self._tokenizer)
        )

    def replies(self, asked: list[rows.Row], grammars: list[str | None]) -> list[Reply]:
        """A reply to each prompt. The policies of the rows are not looked at."""
        import torch

        given = self._inputs(asked).to(self._device)
        with torch.inference_mode():
            written = self._model.generate(
                **given,
                max_new_tokens=self._most_tokens,
                do_sample=False,
                # What the hub's configuration says about sampling does not matter here, and is warned of.
                temperature=None,
                top_p=None,
                top_k=None,
                pad_token_id=self._tokenizer.pad_token_id,
                logits_processor=[Held(self._tokens, grammars, self._end)],
            )
        return [self._reply(row) for row in written[:, given["input_ids"].shape[1] :].tolist()]

    def _inputs(self, asked: list[rows.Row]) -> Any:
        texts = []
        for row in asked:
            if isinstance(row.prompt, str):
                texts.append(row.prompt)
                continue
            talk: list[dict[str, Any]] = list(rows.conversation(self._tokenizer, row.prompt))
            if row.images:
                at = next(at for at, message in enumerate(talk) if message["role"] == "user")
                shown = [{"type": "image"} for _ in row.images]
                talk[at] = {"role": "user", "content": [*shown, {"type": "text", "text": talk[at]["content"]}]}
            template = self._processor if row.images else self._tokenizer
            texts.append(template.apply_chat_template(talk, tokenize=False, add_generation_prompt=True))
        given = {
            "text": texts,
            "padding": True,
            "padding_side": "left",
            "return_tensors": "pt",
            "add_special_tokens": False,
        }
        if any(row.images for row in asked):
            from PIL import Image

            given["images"] = [[Image.open(image).convert("RGB") for image in row.images] for row in asked]
            return self._processor(**given)
        return self._tokenizer(**given)

    def _reply(self, written: list[int]) -> Reply:
        at = next((at for at, token in enumerate(written) if token in self._end), None)
        text = self._tokenizer.decode(written[:at], skip_special_tokens=True, clean_up_tokenization_spaces=False)
        return Reply(text, at is not None, len(written) if at is None else at)


def opened(folder: Path | str, most_tokens: int = 512, precision: str = "fp32") -> Replier:
    """The model of a folder, or of adapters in a folder, ready to answer."""
    folder = Path(folder)
    if (folder / "adapter_config.json").is_file():
        from peft import PeftConfig, PeftModel

        name = str(PeftConfig.from_pretrained(str(folder)).base_model_name_or_path)
        model = PeftModel.from_pretrained(models.load(name, precision), str(folder)).merge_and_unload()
        # The processor beside the adapters has the limit of the pictures.
        return Replier(model, models.processor(str(folder), vision=models.has_vision(model.config)), most_tokens)
    return Replier(models.load(str(folder), precision), models.processor(str(folder)), most_tokens)


def _width(model: Any, tokenizer: Any) -> int:
    return max(len(tokenizer), model.get_output_embeddings().weight.shape[0])
