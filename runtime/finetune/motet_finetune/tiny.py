"""Tiny models with random weights, built here from configurations: nothing is downloaded.

They have the architectures of Qwen2, Qwen2-VL, Qwen2.5-VL and Mistral. Their tokenizer is trained on the rows.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from . import models

__all__ = ["KINDS", "make", "tokenizer"]

KINDS = ("qwen2", "qwen2-vl", "qwen2.5-vl", "mistral")
END, BEGIN, PAD = "<|im_end|>", "<|im_start|>", "<|endoftext|>"
VISION = ["<|vision_start|>", "<|vision_end|>", "<|image_pad|>", "<|video_pad|>"]
# How Qwen2's tokenizer splits texts before it merges bytes.
WORDS = (
    r"(?i:'s|'t|'re|'ve|'m|'ll|'d)|[^\r\n\p{L}\p{N}]?\p{L}+|\p{N}| ?[^\s\p{L}\p{N}]+[\r\n]*|\s*[\r\n]+|\s+(?!\S)|\s+"
)
# The length of a line and the number of texts from which it becomes a token.
LONG, OFTEN = 8, 5
TEMPLATE = """\
{%- for message in messages %}{{ '<|im_start|>' + message['role'] + '\\n' }}\
{%- if message['content'] is string %}{{ message['content'] }}{% else %}{% for part in message['content'] %}\
{%- if part['type'] == 'image' %}{{ '<|vision_start|><|image_pad|><|vision_end|>' }}\
{%- else %}{{ part['text'] }}{% endif %}{% endfor %}{% endif %}{{ '<|im_end|>\\n' }}{% endfor %}\
{%- if add_generation_prompt %}{{ '<|im_start|>assistant\\n' }}{% endif %}"""


def tokenizer(texts: Iterable[str], words: int, instructions: Iterable[str] = ()) -> Any:
    """A byte-level BPE as Qwen2 has it, of so many tokens.

    A line that is in several of the instructions becomes a token of its own, so that a tiny model sees few positions.
    """
    from tokenizers import AddedToken, Regex, Tokenizer, decoders, pre_tokenizers, trainers
    from tokenizers.models import BPE
    from transformers import PreTrainedTokenizerFast

    made = Tokenizer(BPE())
    made.pre_tokenizer = pre_tokenizers.Sequence(
        [
            pre_tokenizers.Split(Regex(WORDS), "isolated"),
            pre_tokenizers.ByteLevel(add_prefix_space=False, use_regex=False),
        ]
    )
    made.decoder = decoders.ByteLevel()
    trainer = trainers.BpeTrainer(
        vocab_size=words,
        special_tokens=[PAD, BEGIN, END, *VISION],
        initial_alphabet=pre_tokenizers.ByteLevel.alphabet(),
        show_progress=False,
    )
    lines = Counter(line for text in instructions for line in set(text.split("\n")) if len(line) > LONG)
    common = sorted(line for line, count in lines.items() if count >= OFTEN)
    made.train_from_iterator(texts, trainer)
    fast = PreTrainedTokenizerFast(tokenizer_object=made, eos_token=END, pad_token=PAD, model_max_length=32768)
    fast.add_tokens([AddedToken(line, normalized=False) for line in common])
    fast.chat_template = TEMPLATE
    return fast


def make(
    kind: str,
    folder: Path,
    texts: Iterable[str],
    instructions: Iterable[str] = (),
    *,
    seed: int = 0,
    words: int = 2048,
    width: int = 128,
    layers: int = 4,
) -> Any:
    """Writes a model of a kind with random weights, as trainers and servers load it."""
    import torch
    from transformers import MistralConfig, MistralForCausalLM, Qwen2Config, Qwen2ForCausalLM

    torch.manual_seed(seed)
    words_known = tokenizer(texts, words, instructions)
    text = {
        "vocab_size": len(words_known),
        "hidden_size": width,
        "intermediate_size": 3 * width,
        "num_hidden_layers": layers,
        "num_attention_heads": 4,
        "num_key_value_heads": 2,
        "max_position_embeddings": 32768,
        "initializer_range": 0.05,
        "tie_word_embeddings": True,
        "bos_token_id": None,
        "eos_token_id": words_known.eos_token_id,
        "pad_token_id": words_known.pad_token_id,
    }
    made: Any = words_known
    if kind == "qwen2":
        model: Any = Qwen2ForCausalLM(Qwen2Config(**text))
    elif kind == "mistral":
        model = MistralForCausalLM(MistralConfig(**{**text, "tie_word_embeddings": False}, sliding_window=None))
    else:
        model, made = _seeing(kind, text, words_known)
    model.generation_config.eos_token_id = words_known.eos_token_id
    model.generation_config.pad_token_id = words_known.pad_token_id
    models.save(model, made, folder)
    return model


def _seeing(kind: str, text: dict[str, Any], words: Any) -> tuple[Any, Any]:
    """A model that sees, with its processor."""
    import transformers as hub

    ids = {
        f"{name}_token_id": words.convert_tokens_to_ids(f"<|{token}|>")
        for name, token in (
            ("vision_start", "vision_start"),
            ("vision_end", "vision_end"),
            ("image", "image_pad"),
            ("video", "video_pad"),
        )
    }
    heads = text["hidden_size"] // text["num_attention_heads"]
    # Sections of the positions in time, height and width, together half a head.
    text = {
        **text,
        "rope_parameters": {
            "rope_type": "default",
            "rope_theta": 1e6,
            "type": "mrope",
            "mrope_section": [heads // 8, 3 * heads // 16, 3 * heads // 16],
        },
    }
    if kind == "qwen2-vl":
        eye = {"depth": 8, "embed_dim": 64, "hidden_size": text["hidden_size"], "num_heads": 4, "mlp_ratio": 2}
        config = hub.Qwen2VLConfig(text_config=text, vision_config=eye, tie_word_embeddings=True, **ids)
        model: Any = hub.Qwen2VLForConditionalGeneration(config)
        kind_of_processor: Any = hub.Qwen2VLProcessor
    elif kind == "qwen2.5-vl":
        eye = {
            "depth": 8,
            "hidden_size": 64,
            "out_hidden_size": text["hidden_size"],
            "num_heads": 4,
            "intermediate_size": 128,
            "fullatt_block_indexes": [3, 7],
        }
        config = hub.Qwen2_5_VLConfig(text_config=text, vision_config=eye, tie_word_embeddings=True, **ids)
        model = hub.Qwen2_5_VLForConditionalGeneration(config)
        kind_of_processor = hub.Qwen2_5_VLProcessor
    else:
        raise ValueError(f"there is no kind `{kind}`: {', '.join(KINDS)}")
    pictures = hub.Qwen2VLImageProcessor(size={"shortest_edge": 28 * 28, "longest_edge": 28 * 28 * 9})
    films = hub.Qwen2VLVideoProcessor()
    made = kind_of_processor(image_processor=pictures, tokenizer=words, video_processor=films, chat_template=TEMPLATE)
    return model, made
