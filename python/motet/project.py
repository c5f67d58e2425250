"""Projects: a robot in a scene, against which policies are checked, compiled, planned and run."""

from __future__ import annotations

import json
import sys
import threading
import warnings
from collections import OrderedDict
from collections.abc import Callable, Iterable
from difflib import get_close_matches
from math import inf
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, Union

from . import _motet
from .driver import Driver
from .errors import InputError, PolicyError
from .graph import Graph
from .inputs import (
    Clearance,
    Inputs,
    PolicyLike,
    RobotLike,
    SceneLike,
    StateLike,
    document,
    factor,
    fingerprint,
    metres,
    name_or_json,
)
from .report import AppliedFix, Report
from .run import Run
from .serving import ServedStream

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping, Sequence
    from types import FrameType

    from typing_extensions import TypeAlias, Unpack

__all__ = ["Plan", "Project", "check", "compile", "drive", "fix", "fmt", "plan", "simulate"]

#: JSON of a file as values of Python, or its path.
JsonLike: TypeAlias = Union["Mapping[str, Any]", "Sequence[Any]", "os.PathLike[str]", str]


class Plan(NamedTuple):
    """A policy that the planner wrote: its text, remarks for the person who asked, and the compiled graph."""

    text: str
    notes: tuple[str, ...]
    graph: Graph


class Project:
    """A robot in a scene, opened once for any number of policies and threads.

    The arguments are those of `motet.Inputs`. The functions of the package, such as `motet.check`, keep the last few projects
    by themselves; files that change are opened again. Raises `motet.InputError`.

    >>> import motet
    >>> kitchen = motet.Project(robot="hsr", scene="kitchen")
    >>> kitchen.check('policy greet { say("Hello!") done }').ok
    True
    """

    def __init__(
        self,
        *,
        robot: RobotLike | None = None,
        scene: SceneLike | None = None,
        state: StateLike | None = None,
        domains: Iterable[str | os.PathLike[str]] = (),
        max_duration: float | None = None,
        geometry: bool = True,
        effort: int = 1,
        clearance: Clearance | None = None,
    ) -> None:
        base_m, arm_m = metres(clearance)
        if max_duration is not None and not 0.0 < max_duration < inf:
            raise InputError(f"the duration of a policy is above 0 s, not {max_duration!r}")
        domains = [domains] if isinstance(domains, str) else domains
        self._native = _motet.Project(
            robot=None if robot is None else name_or_json(robot),
            scene=None if scene is None else name_or_json(scene),
            state=None if state is None else name_or_json(state),
            domains=[name_or_json(path) for path in domains],
            max_duration=max_duration,
            effort=factor(effort) if geometry else None,
            base_m=base_m,
            arm_m=arm_m,
        )

    def check(self, policy: PolicyLike, *, name: str = "policy") -> Report:
        """The report on a policy. `name` stands for a file in its diagnostics."""
        return Report(self._native.check(*document(policy, name)))

    def fix(self, policy: PolicyLike, *, unsafe: bool = False, name: str = "policy") -> Report:
        """The report on a policy after its fixes, with the new text in `fixed`.

        With `unsafe` also those that take steps away, or undo what the policy ends with. A reply with prose around its policy
        stays as it is: `fixed` is None.
        """
        text, applied, findings = self._native.fix(*document(policy, name), unsafe)
        return Report(findings, text, [AppliedFix(*fix) for fix in applied])

    def fmt(
        self, policy: PolicyLike, *, to: Literal["json", "text"] | None = None, name: str = "policy"
    ) -> str:
        """The policy in the canonical layout, or in another syntax. Raises `motet.PolicyError` with errors of syntax."""
        text, findings = self._native.fmt(*document(policy, name), to)
        if text is None:
            report = Report(findings)
            report.raise_if_errors()
            raise PolicyError("there is prose around the policy", report.diagnostics)
        return text

    def compile(self, policy: PolicyLike, *, choose: str | None = None, name: str = "policy") -> Graph:
        """The execution graph of a policy; of several, `choose` names one. Raises `motet.PolicyError`."""
        native, findings = self._native.compile(*document(policy, name), choose)
        return Graph(_compiled(native, report := Report(findings)), report)

    def plan(self, request: str | None = None, *, goals: str | Iterable[str] = ()) -> Plan:
        """A policy for a request in English, or for conditions that hold one after the other. Raises `motet.PlanError`."""
        goals = [goals] if isinstance(goals, str) else list(goals)
        if (request is None) == (not goals):
            raise TypeError("give either a request or goals")
        text, notes, native, findings = self._native.plan(request, goals)
        return Plan(text, tuple(notes), Graph(native, Report(findings)))

    def simulate(
        self,
        policy: PolicyLike,
        *,
        seed: int = 0,
        faults: JsonLike | None = None,
        answers: JsonLike | None = None,
        profile: str | os.PathLike[str] = "typical",
        world: SceneLike | None = None,
        record: str | os.PathLike[str] | None = None,
        choose: str | None = None,
        name: str = "policy",
    ) -> Run:
        """Checks a policy and runs it in the simulator, as fast as possible; the same seed gives the same run.

        `faults` are those to inject and `answers` those of the simulated person, as `motet schema` describes them; `profile` is
        `ideal`, `typical`, `harsh` or a TOML file; `world` is the scene as it is, where the robot knows another one. `record` is
        the folder of a journal. Raises `motet.PolicyError` if the check refuses the policy, and `motet.InputError`.
        """
        done, findings = self._native.simulate(
            *document(policy, name),
            choose,
            seed=seed,
            faults=None if faults is None else name_or_json(faults),
            answers=None if answers is None else name_or_json(answers),
            profile=name_or_json(profile),
            world=None if world is None else name_or_json(world),
            record=None if record is None else name_or_json(record),
        )
        return _run(done, Report(findings))

    def drive(
        self,
        policy: PolicyLike,
        driver: Driver,
        *,
        record: str | os.PathLike[str] | None = None,
        say: Callable[[str], object] | None = None,
        choose: str | None = None,
        name: str = "policy",
    ) -> Run:
        """Checks a policy and runs it on a driver in this process, to its end.

        The driver has a thread of its own; an interrupt stops the run. `say` gets its feedback for people. `record` is the
        folder of a journal, which must be empty or not be there. Warns of facts that the policy asks for and the driver does not
        observe: they are unknown, and a step that needs one fails.

        Raises `motet.PolicyError` if the check refuses the policy, and `motet.InputError`, before anything moves, if the driver
        has no coroutine for a primitive of the policy, or one that does not take its parameters.
        """
        if not isinstance(driver, Driver):
            raise TypeError(f"a driver is an instance of a subclass of `motet.Driver`, not {driver!r}")
        graph = self.compile(policy, choose=choose, name=name)
        unfit = driver._unfit(graph.calls)
        if unfit:
            raise InputError("; ".join(unfit))
        for fact in sorted(driver._unobserved(graph.asks)):
            text = f"the policy asks for `{fact}`, and the driver has no method of that name: it is unknown"
            warnings.warn(text, stacklevel=_caller())
        stream = ServedStream(driver)
        try:
            run = graph._native.drive(
                serve=stream.serve,
                say=say if say is not None else _nobody,
                record=None if record is None else name_or_json(record),
            )
        finally:
            stream.join()
        return Run(run, graph, graph.report)


def _caller() -> int:
    """The level of the stack, from the function that calls this one, at which the code outside of this package stands."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and frame.f_globals.get("__package__") == __package__:
        level, frame = level + 1, frame.f_back
    return level


def _nobody(text: str) -> None:
    """Hears feedback and says nothing."""


def _run(done: tuple[_motet.Run, _motet.Graph] | None, report: Report) -> Run:
    run, graph = _compiled(done, report)
    return Run(run, Graph(graph, report), report)


def _compiled(native: Any, report: Report) -> Any:
    """The result of the native part. Raises `motet.PolicyError` where there is none."""
    if native is None:
        report.raise_if_errors()
        raise PolicyError("the document has no policy to compile", report.diagnostics)
    return native


def _keywords(frame: FrameType) -> tuple[str, ...]:
    """Names of the parameters of the function that runs in a frame."""
    code = frame.f_code
    return code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]


_OPEN: OrderedDict[str, Project] = OrderedDict()
_LOCK = threading.Lock()
#: Number of projects that stay open.
MOST_OPEN = 8


def _project(inputs: Inputs) -> Project:
    """A project with these inputs: one that is open, if its files are still the same."""
    for name in inputs:
        if name not in Inputs.__annotations__:
            near = get_close_matches(name, [*Inputs.__annotations__, *_keywords(sys._getframe(1))], 1)
            hint = f"; did you mean `{near[0]}`?" if near else f": it takes {', '.join(Inputs.__annotations__)}"
            raise TypeError(f"{sys._getframe(1).f_code.co_name}() has no argument `{name}`{hint}")
    domains = inputs.get("domains", ())
    paths = [inputs.get(name) for name in ("robot", "scene", "state")]
    paths += [domains] if isinstance(domains, str) else list(domains)
    files = [None if path is None else fingerprint(path) for path in paths]
    rest = {name: value for name, value in inputs.items() if name not in ("robot", "scene", "state", "domains")}
    key = json.dumps([files, sorted(rest.items())], default=repr)
    with _LOCK:
        if key in _OPEN:
            _OPEN.move_to_end(key)
            return _OPEN[key]
    project = Project(**inputs)
    with _LOCK:
        _OPEN[key] = project
        while len(_OPEN) > MOST_OPEN:
            _OPEN.popitem(last=False)
    return project


def check(policy: PolicyLike, *, name: str = "policy", **inputs: Unpack[Inputs]) -> Report:
    """Checks a policy as `motet check` does: see `Project.check`, and `Inputs` for the arguments.

    >>> import motet
    >>> motet.check({"motet": 1, "policy": "p", "robot": "hsr", "steps": [{"end": "done"}]}).ok
    True
    """
    return _project(inputs).check(policy, name=name)


def fix(policy: PolicyLike, *, unsafe: bool = False, name: str = "policy", **inputs: Unpack[Inputs]) -> Report:
    """Applies the fixes of a policy as `motet check --fix` does: see `Project.fix`.

    >>> import motet
    >>> motet.fix('policy greet { sya("hello") done }').fixed
    'policy greet { say("hello") done }'
    """
    return _project(inputs).fix(policy, unsafe=unsafe, name=name)


def fmt(
    policy: PolicyLike, *, to: Literal["json", "text"] | None = None, name: str = "policy", **inputs: Unpack[Inputs]
) -> str:
    """Formats a policy as `motet fmt` does: see `Project.fmt`.

    >>> import motet
    >>> print(motet.fmt('policy greet{say("hi") done}'), end="")
    policy greet {
        say("hi")
        done
    }
    """
    return _project(inputs).fmt(policy, to=to, name=name)


def compile(
    policy: PolicyLike, *, choose: str | None = None, name: str = "policy", **inputs: Unpack[Inputs]
) -> Graph:
    """Compiles a policy as `motet compile` does: see `Project.compile`."""
    return _project(inputs).compile(policy, choose=choose, name=name)


def plan(request: str | None = None, *, goals: str | Iterable[str] = (), **inputs: Unpack[Inputs]) -> Plan:
    """Plans a policy as `motet plan` does: see `Project.plan`.

    >>> import motet
    >>> motet.plan(goals="on(mug_1, shelf)", robot="hsr", scene="kitchen").graph.policy
    'plan'
    """
    return _project(inputs).plan(request, goals=goals)


def simulate(
    policy: PolicyLike,
    *,
    seed: int = 0,
    faults: JsonLike | None = None,
    answers: JsonLike | None = None,
    profile: str | os.PathLike[str] = "typical",
    world: SceneLike | None = None,
    record: str | os.PathLike[str] | None = None,
    choose: str | None = None,
    name: str = "policy",
    **inputs: Unpack[Inputs],
) -> Run:
    """Runs a policy in the simulator as `motet run` does: see `Project.simulate`."""
    project = _project(inputs)
    return project.simulate(
        policy,
        seed=seed,
        faults=faults,
        answers=answers,
        profile=profile,
        world=world,
        record=record,
        choose=choose,
        name=name,
    )


def drive(
    policy: PolicyLike,
    driver: Driver,
    *,
    record: str | os.PathLike[str] | None = None,
    say: Callable[[str], object] | None = None,
    choose: str | None = None,
    name: str = "policy",
    **inputs: Unpack[Inputs],
) -> Run:
    """Runs a policy on a driver in this process: see `Project.drive`."""
    return _project(inputs).drive(policy, driver, record=record, say=say, choose=choose, name=name)
