"""Adapters put into the weights of their model, for servers that load whole models."""

from __future__ import annotations

import json
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
    _add_old_names(out / "config.json")
    return whole


def _add_old_names(path: Path) -> None:
    """Adds `rope_theta`, which servers that read older configurations look for, where only `rope_parameters` has it."""
    config = json.loads(path.read_text(encoding="utf-8"))
    for part in (config, config.get("text_config") or {}):
        theta = (part.get("rope_parameters") or {}).get("rope_theta")
        if theta is not None:
            part.setdefault("rope_theta", theta)
    path.write_text(json.dumps(config, indent=2) + "\n", encoding="utf-8")
