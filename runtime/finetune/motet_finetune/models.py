"""Models and their processors, from a folder or by their names at the model hub."""

from __future__ import annotations

from pathlib import Path
from typing import Any

__all__ = ["has_vision", "load", "processor", "save", "tokenizer_of"]


def has_vision(config: Any) -> bool:
    return getattr(config, "vision_config", None) is not None


def load(name: str, precision: str = "bf16") -> Any:
    """The model in a precision, in the memory of the host."""
    import torch
    from transformers import AutoConfig, AutoModelForCausalLM, AutoModelForImageTextToText

    kind = AutoModelForImageTextToText if has_vision(AutoConfig.from_pretrained(name)) else AutoModelForCausalLM
    return kind.from_pretrained(name, dtype=torch.bfloat16 if precision == "bf16" else torch.float32)


def processor(name: str, most_pixels: int = 0, vision: bool | None = None) -> Any:
    """The tokenizer of a model, or the processor of a model that sees, with a limit for pictures.

    `vision` says if the model sees; without it the model's configuration does.
    """
    from transformers import AutoConfig, AutoProcessor, AutoTokenizer

    if not (has_vision(AutoConfig.from_pretrained(name)) if vision is None else vision):
        made = AutoTokenizer.from_pretrained(name)
    else:
        made = AutoProcessor.from_pretrained(name)
        if most_pixels:
            size = made.image_processor.size
            made.image_processor.size = {**dict(size), "longest_edge": most_pixels}
    tokenizer = tokenizer_of(made)
    if tokenizer.pad_token is None:
        tokenizer.pad_token = tokenizer.eos_token
    return made


def tokenizer_of(made: Any) -> Any:
    return getattr(made, "tokenizer", made)


def save(model: Any, made: Any, folder: Path) -> None:
    """Writes a model as servers load it."""
    model.save_pretrained(folder)
    made.save_pretrained(folder)
