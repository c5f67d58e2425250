"""Recipes: which model is trained, on which rows, and with which numbers. A recipe is a TOML file."""

from __future__ import annotations

import tomllib
from dataclasses import MISSING, dataclass, fields
from importlib import resources
from pathlib import Path
from typing import Any, get_type_hints

__all__ = ["Lora", "Recipe", "RecipeError", "builtin", "find", "read"]

PRECISIONS = ("bf16", "fp32")
LARGEST = 1_000_000


class RecipeError(ValueError):
    """A mistake in a recipe, with its file and key."""


@dataclass(frozen=True)
class Lora:
    """Adapters of low rank. The update of a weight is scaled by `scale`, which is alpha / r."""

    decoder: int
    """Rank on each linear layer of the decoder."""
    vision: int = 0
    """Rank on the last `vision_layers` blocks of the vision encoder; 0 leaves the encoder as it is."""
    vision_layers: int = 0
    scale: float = 2.0
    dropout: float = 0.05
    whole: tuple[str, ...] = ()
    """Modules that are trained whole and saved with the adapters, such as `embed_tokens`."""


@dataclass(frozen=True)
class Recipe:
    """One way to train one model."""

    model: str
    """Name at the model hub, or a folder. Relative folders are relative to the current folder."""
    lora: Lora
    learning_rate: float
    epochs: float
    batch: int
    """Rows of one update of the weights."""
    micro_batch: int = 1
    """Rows that are on the device at once."""
    precision: str = "bf16"
    longest: int = 8192
    """Longest row in tokens of text. A longer row is left out, so that no policy is cut."""
    most_pixels: int = 0
    """Pictures are scaled down to so many pixels; 0 leaves it to the model."""
    warmup: float = 0.03
    """Share of the updates over which the learning rate rises. Then it falls along a cosine."""
    weight_decay: float = 0.0
    recompute: bool = True
    """Computes activations again on the way back, which needs less memory and more time."""
    seed: int = 0
    save_every: int = 50
    """Updates between checkpoints."""
    keep: int = 2
    """Number of checkpoints that are kept."""


def read(path: Path) -> Recipe:
    """Reads a recipe from a file."""
    try:
        table = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as why:
        raise RecipeError(f"{path}: {why}") from why
    recipe: Recipe = _record(Recipe, table, f"{path}: ")
    _check(recipe, f"{path}: ")
    return recipe


def builtin() -> dict[str, Path]:
    """The recipes of this package by name."""
    folder = Path(str(resources.files(__package__))) / "recipes"
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def find(name: str) -> Recipe:
    """Reads a recipe that is given by the name of a built-in one or by its file."""
    known = builtin()
    path = known.get(name, Path(name))
    if not path.is_file():
        raise RecipeError(f"there is no recipe `{name}`; built in: {', '.join(known)}")
    return read(path)


def _record(kind: Any, table: object, at: str) -> Any:
    """A record of a kind from a table, each value of the type that the kind declares."""
    if not isinstance(table, dict):
        raise RecipeError(f"{at}expected a table")
    types = get_type_hints(kind)
    unknown = [key for key in table if key not in types]
    if unknown:
        raise RecipeError(f"{at}unknown key `{unknown[0]}`; known: {', '.join(types)}")
    values = {}
    for one in fields(kind):
        if one.name in table:
            values[one.name] = _value(types[one.name], table[one.name], f"{at}{one.name}: ")
        elif one.default is MISSING:
            raise RecipeError(f"{at}`{one.name}` is missing")
    return kind(**values)


def _value(kind: Any, value: object, at: str) -> object:
    if kind is Lora:
        return _record(Lora, value, at)
    if kind == tuple[str, ...]:
        if not isinstance(value, list) or not all(isinstance(one, str) for one in value):
            raise RecipeError(f"{at}expected a list of texts")
        return tuple(value)
    if kind is float and isinstance(value, int) and not isinstance(value, bool):
        return float(value)
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        raise RecipeError(f"{at}expected {kind.__name__}, not {value!r}")
    return value


def _check(recipe: Recipe, at: str) -> None:
    lora = recipe.lora
    # Written so that NaN fails, too.
    rules = {
        "model": (bool(recipe.model), "a name or a folder"),
        "learning_rate": (0 < recipe.learning_rate <= 1, "above 0, at most 1"),
        "epochs": (0 < recipe.epochs <= 1000, "above 0, at most 1000"),
        "batch": (0 < recipe.batch <= LARGEST, "above 0"),
        "micro_batch": (
            0 < recipe.micro_batch <= recipe.batch and recipe.batch % recipe.micro_batch == 0,
            "a divisor of `batch`",
        ),
        "precision": (recipe.precision in PRECISIONS, f"one of {', '.join(PRECISIONS)}"),
        "longest": (0 < recipe.longest <= LARGEST, "above 0"),
        "most_pixels": (0 <= recipe.most_pixels <= 100 * LARGEST, "0 or more"),
        "warmup": (0 <= recipe.warmup < 1, "a share below 1"),
        "weight_decay": (0 <= recipe.weight_decay <= 1, "from 0 to 1"),
        "save_every": (recipe.save_every > 0, "above 0"),
        "keep": (recipe.keep > 0, "above 0"),
        "lora.decoder": (0 < lora.decoder <= 1024, "above 0, at most 1024"),
        "lora.vision": (0 <= lora.vision <= 1024, "from 0 to 1024"),
        "lora.vision_layers": (
            lora.vision_layers >= 0 and (lora.vision > 0) == (lora.vision_layers > 0),
            "above 0 with `vision`, and 0 without",
        ),
        "lora.scale": (0 < lora.scale <= 1000, "above 0"),
        "lora.dropout": (0 <= lora.dropout < 1, "a share below 1"),
    }
    for key, (holds, rule) in rules.items():
        if not holds:
            raise RecipeError(f"{at}`{key}` must be {rule}")
