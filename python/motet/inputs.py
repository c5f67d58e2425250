"""Inputs of checks and runs: policies, robots, scenes and facts as names, paths or values."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict, Union

from .errors import InputError

if TYPE_CHECKING:
    from typing_extensions import TypeAlias

__all__ = ["Clearance", "Inputs", "PolicyLike", "RobotLike", "SceneLike", "StateLike"]

#: A policy: its text in either syntax, its JSON as a mapping, or the path of a file.
PolicyLike: TypeAlias = Union[str, Mapping[str, Any], "os.PathLike[str]"]
#: A robot: a built-in name, a folder with a robot.toml, or the content of a robot.toml as a mapping, whose files (URDF, meshes,
#: primitives.motet) are in its `folder`, or else in the present one.
RobotLike: TypeAlias = Union[str, Mapping[str, Any], "os.PathLike[str]"]
#: A scene: a built-in name, a file, or its JSON as a mapping.
SceneLike: TypeAlias = Union[str, Mapping[str, Any], "os.PathLike[str]"]
#: Facts at the start, by their text: True, False, or None for unknown; or a file of them.
StateLike: TypeAlias = Union[Mapping[str, Union[bool, None]], "os.PathLike[str]", str]


class Clearance(TypedDict, total=False):
    """Distances that motions keep from obstacles, in m, from 0 to 0.5."""

    base: float
    arm: float


class Inputs(TypedDict, total=False):
    """Robot, scene and limits of a check.

    Without a `robot`, the policy's `for NAME` names a built-in one. `domains` are files of further declarations,
    `max_duration` the longest duration of a policy in s. `geometry=False` leaves every motion to the run, `effort` multiplies
    the search budget of motions.
    """

    robot: RobotLike
    scene: SceneLike
    state: StateLike
    domains: Sequence[str | os.PathLike[str]]
    max_duration: float
    geometry: bool
    effort: int
    clearance: Clearance


def name_or_json(given: Any) -> str:
    """The name or path itself, or the JSON of a value. Raises `motet.InputError` for values that JSON does not have."""
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given)
    try:
        return json.dumps(given, ensure_ascii=False, allow_nan=False, default=_path)
    except (TypeError, ValueError, RecursionError) as error:
        raise InputError(f"the input is no JSON: {error}") from None


def _path(given: Any) -> str:
    """The text of a path inside of a mapping."""
    if isinstance(given, os.PathLike):
        return os.fspath(given)  # type: ignore[no-any-return]
    raise TypeError(f"{type(given).__name__} is not JSON serializable")


def document(policy: PolicyLike, name: str) -> tuple[str, bytes | None]:
    """The name of a document and its bytes; None for those of the file of this name."""
    if isinstance(policy, os.PathLike):
        return os.fspath(policy), None
    if isinstance(policy, str):
        if "\n" not in policy and policy.endswith((".motet", ".json")):
            raise InputError(f"`{policy}` is the name of a file", "give a path: pathlib.Path(…)")
        return name, policy.encode("utf-8", "surrogatepass")
    return name, name_or_json(policy).encode("utf-8", "surrogatepass")


def metres(clearance: Clearance | None) -> tuple[float | None, float | None]:
    """The distances of base and arm, in m. Raises `motet.InputError` for a distance out of range."""
    given = dict(clearance or {})
    base, arm = given.pop("base", None), given.pop("arm", None)
    for distance in (base, arm):
        if distance is not None and not (isinstance(distance, (int, float)) and 0.0 <= distance <= 0.5):
            raise InputError(f"a clearance is 0 to 0.5 m, not {distance!r}")
    if given:
        raise InputError(f"a clearance has `base` and `arm`, not `{next(iter(given))}`")
    return base, arm  # type: ignore[return-value]


def factor(effort: int) -> int:
    """The factor of a search budget, from 1 to 1000. Raises `motet.InputError`."""
    if not (isinstance(effort, int) and 1 <= effort <= 1000):
        raise InputError(f"the effort is a whole number from 1 to 1000, not {effort!r}")
    return effort


def fingerprint(given: Any) -> object:
    """Something that changes with the input, or with the files behind its path."""
    if isinstance(given, Mapping) and isinstance(given.get("folder"), (str, os.PathLike)):
        return name_or_json(given), fingerprint(os.fspath(given["folder"]))
    text = name_or_json(given)
    path = Path(text) if len(text) < 4096 and "\0" not in text else None
    try:
        if path is None or not path.exists():
            return text
        is_robot = path.is_dir() and (path / "robot.toml").is_file()
        # No robot has more files; any other folder is refused anyway.
        files: Iterable[Path] = sorted(islice(path.rglob("*"), 5000)) if is_robot else [path]
        stats = [(str(file), file.stat()) for file in files if file.is_file()]
    except OSError:
        return text
    return text, tuple((name, stat.st_mtime_ns, stat.st_size) for name, stat in stats)
