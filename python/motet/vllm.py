"""A logits processor for vLLM from 0.10 on, which finds it by the entry point `vllm.logits_processors`.

It is one of the interface of vLLM's first model runner (`update_state`, `apply`). Where a server uses the second one, which takes
processors of another interface, start it with the first.

A request asks for a policy in its extra arguments; all others are left alone:

    client.chat.completions.create(..., extra_body={"vllm_xargs": {"motet": '{"robot": "hsr", "scene": "kitchen"}'}})

Each row of the batch has a decoder of its own, which follows the tokens of its output. The server runs without speculative decoding.
Where its asynchronous scheduling asks for a mask before the last token is known, an error asks for `--no-async-scheduling`.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .masks import follow, masked, row_of
from .request import decoder_for, read_request
from .vocabularies import Vocabulary, vocabulary

if TYPE_CHECKING:
    from .decoder import Decoder

    Base = object
else:
    try:
        from vllm.v1.sample.logits_processor import LogitsProcessor as Base
    except ImportError:
        Base = object

__all__ = ["MotetLogitsProcessor"]


@dataclass
class _Row:
    """A request in the batch. vLLM lengthens `output` as it goes."""

    decoder: Decoder
    output: list[int]

    def catch_up(self) -> Decoder:
        """The decoder after all tokens of the output. Raises `RuntimeError` if they are not known yet."""
        if any(token < 0 for token in self.output):
            raise RuntimeError("motet needs the tokens of the output: start vLLM with --no-async-scheduling")
        if self.output != self.decoder.tokens:
            self.decoder = follow([self.decoder], self.output)
        return self.decoder


class MotetLogitsProcessor(Base):
    """Constrains the requests of a batch that ask for a policy; each gets only policies that check."""

    def __init__(self, vllm_config: Any, device: Any = None, is_pin_memory: bool = False) -> None:
        self._model = vllm_config.model_config
        self._vocabulary: Vocabulary | None = None
        self._rows: dict[int, _Row] = {}

    @classmethod
    def validate_params(cls, sampling_params: Any) -> None:
        """Refuses a request whose arguments are wrong. Raises `ValueError`."""
        read_request(getattr(sampling_params, "extra_args", None))

    def is_argmax_invariant(self) -> bool:
        """False: the most probable token may be forbidden."""
        return False

    def update_state(self, batch_update: Any) -> None:
        """Takes requests out of the batch, in, and to other rows. `batch_update` is None where nothing has changed."""
        if batch_update is None:
            return
        for index in batch_update.removed:
            self._rows.pop(index, None)
        for index, params, _prompt, output in batch_update.added:
            self._rows.pop(index, None)
            asked = read_request(getattr(params, "extra_args", None))
            if asked is not None:
                self._rows[index] = _Row(decoder_for(asked, self._tokens()), output)
        for source, target, direction in batch_update.moved:
            moved, other = self._rows.pop(source, None), self._rows.pop(target, None)
            if moved is not None:
                self._rows[target] = moved
            if other is not None and getattr(direction, "name", direction) == "SWAP":
                self._rows[source] = other

    def apply(self, logits: Any) -> Any:
        """The logits, of shape (requests, tokens), with -inf for tokens that may not follow."""
        for index, row in self._rows.items():
            allowed = row_of(row.catch_up(), int(logits.shape[-1]))
            logits[index] = masked(logits[index], allowed)
        return logits

    def _tokens(self) -> Vocabulary:
        if self._vocabulary is None:
            self._vocabulary = _vocabulary(str(self._model.tokenizer))
        return self._vocabulary


def _vocabulary(name: str) -> Vocabulary:
    """The vocabulary of a tokenizer in a file, in a folder, or by its name in the cache of transformers."""
    path = Path(name)
    if path.is_dir() and (path / "tokenizer.json").is_file():
        path = path / "tokenizer.json"
    if path.is_file():
        return vocabulary(path)
    from transformers import AutoTokenizer

    return vocabulary(AutoTokenizer.from_pretrained(name))
