"""Where the adapters of a recipe go: the linear layers of the decoder, and of the last blocks of the vision encoder."""

from __future__ import annotations

import re
from typing import Any

from .recipe import Lora

__all__ = ["config", "places"]

DECODER = re.compile(r"(?:^|\.)layers\.\d+\.(?:self_attn|mlp)\.(?:[qkvo]|gate|up|down)_proj$")
VISION = re.compile(r"(?:^|\.)visual\.blocks\.(\d+)\.(?:attn|mlp)\.\w+$")


class AdapterError(ValueError):
    """A model that has no place for the adapters of a recipe."""


def places(model: Any, lora: Lora) -> tuple[list[str], list[str]]:
    """The names of the linear layers that get adapters, of the decoder and of the vision encoder."""
    import torch

    linear = [name for name, module in model.named_modules() if isinstance(module, torch.nn.Linear)]
    blocks = {name: int(found[1]) for name in linear if (found := VISION.search(name))}
    decoder = [name for name in linear if DECODER.search(name) and name not in blocks]
    if not decoder:
        raise AdapterError(
            "the model has no decoder with q_proj, k_proj, v_proj, o_proj, gate_proj, up_proj, down_proj"
        )
    count = max(blocks.values(), default=-1) + 1
    if lora.vision_layers > count:
        raise AdapterError(f"`vision_layers` is {lora.vision_layers}, and the vision encoder has {count} blocks")
    first = count - lora.vision_layers
    return decoder, [name for name, block in blocks.items() if block >= first]


def config(model: Any, lora: Lora) -> Any:
    """The configuration of PEFT for a model."""
    from peft import LoraConfig

    decoder, vision = places(model, lora)
    # PEFT takes patterns that match a whole name.
    ranks = {re.escape(name): lora.vision for name in vision}
    return LoraConfig(
        task_type="CAUSAL_LM",
        r=lora.decoder,
        lora_alpha=lora.decoder * lora.scale,
        rank_pattern=ranks,
        alpha_pattern={name: rank * lora.scale for name, rank in ranks.items()},
        lora_dropout=lora.dropout,
        target_modules=decoder + vision,
        modules_to_save=list(lora.whole) or None,
        # Embeddings that are the output's weights too stay so.
        ensure_weight_tying=bool(lora.whole),
    )
