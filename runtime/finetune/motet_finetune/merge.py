"""Adapters put into the weights of their model, for servers that load whole models."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from . import models

__all__ = ["merge"]


def merge(adapters: Path, out: Path, model: str | None = None, precision: str = "bf16") -> Any:
    """Writes the model of adapters with the adapters in its weights. `model` overrides the name that the adapters note."""
    from peft import PeftConfig, PeftModel

    name = model or PeftConfig.from_pretrained(str(adapters)).base_model_name_or_path
    whole = PeftModel.from_pretrained(models.load(name, precision), str(adapters)).merge_and_unload(safe_merge=True)
    models.save(whole, models.processor(str(name)), out)
    return whole
