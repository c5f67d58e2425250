"""Values of the language as Python sees them, and their tagged form in messages."""

from __future__ import annotations

import keyword
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["ANY", "Case", "Entity", "Pose", "Text", "decode", "encode", "example", "python_name"]

PLAIN = ("Length", "Angle", "Duration", "Mass", "Force", "Speed", "Ratio", "Number")


class Text(str):
    """A text that is a result. A plain string is a text only where the type of the result says so."""


class Case(str):
    """The case of an enumeration, such as `left`."""


class Entity(str):
    """The id of a thing, a place, a person or a surface."""


@dataclass(frozen=True)
class Pose:
    """A position in m and a rotation as a quaternion (x, y, z, w), in the frame `map`."""

    xyz: tuple[float, float, float]
    quaternion: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 1.0)


class _Any:
    """Stands for some entity in a question: does the robot hold anything?"""

    def __repr__(self) -> str:
        return "motet.ANY"


ANY = _Any()


def example(kind: str | None) -> Any:
    """Some value of a type, by the name of the type; None without one.

    >>> example("List<Length>"), example("Text")
    ([1.0], 'yes')
    """
    if kind is not None and kind.startswith("List<"):
        return [example(kind[5:-1])]
    plain = {None: None, "Text": "yes", "Bool": True, "Int": 1, "Pose": Pose((0.0, 0.0, 0.0))}
    return 1.0 if kind in PLAIN else plain.get(kind, "example_1")


def python_name(name: str) -> str:
    """The name of an argument or an observation in Python: a keyword of Python, such as `from`, gets an underscore.

    >>> python_name("from"), python_name("to")
    ('from_', 'to')
    """
    return name + "_" if keyword.iskeyword(name) else name


def decode(value: Any) -> Any:
    """The Python value of a tagged value.

    >>> decode({"entity": "mug_1"}), decode({"list": [{"number": 0.5}]}), decode("any")
    ('mug_1', [0.5], motet.ANY)
    """
    if value == "any":
        return ANY
    (tag, content), = value.items()
    if tag == "is":
        return decode(content)
    if tag == "list":
        return [decode(item) for item in content]
    if tag == "pose":
        return Pose(tuple(content["xyz"]), tuple(content["quaternion"]))
    kind = {"entity": Entity, "case": Case, "text": Text}.get(tag)
    return content if kind is None else kind(content)


def encode(value: Any, kind: str | None) -> Any:
    """The tagged form of a result of this type; a mapping is tagged already. Raises `TypeError` for any other value.

    >>> encode("yes", "Text"), encode("mug_1", "Object"), encode(3, "Length"), encode(None, None)
    ({'text': 'yes'}, {'entity': 'mug_1'}, {'number': 3.0}, None)
    """
    if value is None or isinstance(value, Mapping):
        return value
    if isinstance(value, Pose):
        return {"pose": {"xyz": list(value.xyz), "quaternion": list(value.quaternion)}}
    if isinstance(value, bool):
        return {"bool": value}
    if isinstance(value, int) and kind not in PLAIN:
        return {"int": value}
    if isinstance(value, (int, float)):
        return {"number": float(value)}
    if isinstance(value, str):
        tag = "case" if isinstance(value, Case) else "text" if isinstance(value, Text) or kind == "Text" else "entity"
        return {tag: str(value)}
    if isinstance(value, (list, tuple)):
        inner = kind[5:-1] if kind is not None and kind.startswith("List<") else None
        return {"list": [encode(item, inner) for item in value]}
    raise TypeError(f"`{value!r}` is no value of the language")
