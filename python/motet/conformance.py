"""The laws of drivers, checked on a driver in this process."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import _motet
from .driver import Driver
from .errors import PolicyError
from .inputs import PolicyLike, document
from .project import _project
from .report import Report
from .serving import ServedStream

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .inputs import Inputs

__all__ = ["BrokenLaw", "Conformance", "check_driver"]

#: Robot whose `say` a check uses where neither a robot nor a policy is given.
ROBOT = "hsr"


@dataclass(frozen=True)
class BrokenLaw:
    """A law that a driver broke in a scene of the suite: `told` is what happened, `messages` the last ones of the scene."""

    scene: str
    law: str
    told: str
    messages: tuple[str, ...]

    def __str__(self) -> str:
        lines = [f"{self.scene}: {self.law}: {self.told}", *(f"    {line}" for line in self.messages)]
        return "\n".join(lines)


@dataclass(frozen=True)
class Conformance:
    """The result of a check: the names of the scenes, in order, and the broken laws."""

    scenes: tuple[str, ...]
    broken: tuple[BrokenLaw, ...]

    @property
    def ok(self) -> bool:
        """True if the driver keeps the laws."""
        return not self.broken

    def __str__(self) -> str:
        return "\n".join(map(str, self.broken)) or f"the driver keeps the laws in {len(self.scenes)} scenes"


def check_driver(
    make: Callable[[], Driver],
    policy: PolicyLike | None = None,
    *,
    patience: float | None = None,
    choose: str | None = None,
    **inputs: Unpack[Inputs],
) -> Conformance:
    """Leads drivers through the scenes of the conformance suite, as `motet run --check` does.

    `make` makes a driver that has done nothing, such as its class; each scene gets another one. Each scene starts the first call
    of the policy: without one, a `say`. A call may take `patience` s; the default is 5 s, or its deadline on a driver that owns
    the clock. Raises `motet.PolicyError` if the check refuses the policy, and `motet.InputError` if the driver does not answer.
    """
    if not callable(make):
        raise TypeError(f"give the class of the driver or a function that makes one, not {make!r}: each scene needs a fresh driver")
    if policy is None:
        named = "" if inputs.get("robot") is not None else f" for {ROBOT}"
        policy = f"policy conformance{named} {_motet.harmless_steps()}"
    streams: list[ServedStream] = []

    def serve(file: int) -> None:
        driver = make()
        if not isinstance(driver, Driver):
            raise TypeError(f"`make` has to return a `motet.Driver`, not {driver!r}")
        streams.append(ServedStream(driver))
        streams[-1].serve(file)

    native = _project(inputs)._native
    try:
        scenes, findings = native.check_driver(*document(policy, "conformance"), choose, serve=serve, patience=patience)
    finally:
        for stream in streams:
            stream.join()
    if scenes is None:
        report = Report(findings).raise_if_errors()
        raise PolicyError("the document has no policy to run", report.diagnostics)
    broken = [BrokenLaw(scene, law, told, tuple(lines)) for scene, laws, lines in scenes for law, told in laws]
    return Conformance(tuple(scene for scene, _, _ in scenes), tuple(broken))
