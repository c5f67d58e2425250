"""How many replies to held-out rows can run: the model's policies take the places of the rows' own, and `motet dataset lint`
judges them as it judges rows. It checks each policy with its motions and runs it in simulation.
"""

from __future__ import annotations

import json
import subprocess
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from . import rows
from .reply import Replier, Reply, lark

__all__ = ["Judgement", "grammar", "judge"]


class JudgeError(RuntimeError):
    """The command `motet` cannot be used."""


@dataclass(frozen=True)
class Judgement:
    """Numbers of replies."""

    rows: int
    whole: int
    """Replies that came to an end."""
    can_run: int
    """Policies that pass the check, whose motions are not refuted, and whose simulated run ends in `done`."""
    same_goal: int
    """Policies that can run and have the goal of the row in `achieves`, which the check holds them to."""
    same: int
    """Policies that are those of the rows, but for their names."""
    reasons: dict[str, int]
    """Why the others cannot run, the most frequent first."""


def grammar(motet: str, robot: str, scene: Path, depth: int = 4) -> str:
    """The exported Lark grammar of a robot in a scene."""
    flags = ["--robot", robot, "--scene", str(scene), "--depth", str(depth), "--format", "lark", "--llguidance"]
    return lark(_run([motet, "grammar", *flags]).stdout)


def judge(
    motet: str, replier: Replier, data: Path, out: Path, *, most: int = 0, batch: int = 8, held: bool = True
) -> Judgement:
    """Has a model answer the rows of `test.jsonl` in a folder, evenly spread if only `most` are asked, and judges the replies.

    `out` gets the replies as rows in `replies.jsonl`, and `scenes.jsonl` beside it. Greedy: the same model gives the same replies.
    """
    known = rows.read(data / "test.jsonl")
    lines = [line for line in (data / "test.jsonl").read_text(encoding="utf-8").splitlines() if line.strip()]
    chosen = _spread(len(known), most)
    out.mkdir(parents=True, exist_ok=True)
    scenes = (data / "scenes.jsonl").read_text(encoding="utf-8")
    (out / "scenes.jsonl").write_text(scenes, encoding="utf-8")
    grammars = _grammars(motet, [known[at] for at in chosen], scenes, out) if held else {}
    replied: list[Reply] = []
    for start in range(0, len(chosen), batch):
        part = chosen[start : start + batch]
        of_rows = [known[at] for at in part]
        replied += replier.replies(of_rows, [grammars.get(_world(row)) for row in of_rows])
    judged = [_with_reply(lines[at], reply.text) for at, reply in zip(chosen, replied, strict=True)]
    path = out / "replies.jsonl"
    path.write_text("".join(line + "\n" for line in judged), encoding="utf-8")
    found = _lint(motet, path)
    # A reply that did not come to its end is no policy, whatever it begins with.
    whys = [found.get(number) if reply.is_whole else "it came to no end" for number, reply in enumerate(replied, 1)]
    wanted = [known[at].policy for at in chosen]
    fine = [(reply.text, policy) for reply, policy, why in zip(replied, wanted, whys, strict=True) if why is None]
    return Judgement(
        rows=len(replied),
        whole=sum(reply.is_whole for reply in replied),
        can_run=len(fine),
        same_goal=sum(_goal(policy) is not None and _goal(text) == _goal(policy) for text, policy in fine),
        same=sum(_steps(text) == _steps(policy) for text, policy in fine),
        reasons=dict(Counter(why for why in whys if why is not None).most_common(12)),
    )


def _world(row: rows.Row) -> tuple[str, str]:
    try:
        return row.about["robot"], row.about["scene"]
    except KeyError as why:
        raise JudgeError("a row does not say its robot and scene in `motet`") from why


def _spread(count: int, most: int) -> list[int]:
    """So many numbers below a count, at even distances."""
    most = min(most or count, count)
    return [at * count // most for at in range(most)]


def _grammars(motet: str, asked: list[rows.Row], scenes: str, out: Path) -> dict[tuple[str, str], str]:
    by_name = {one["name"]: one["scene"] for one in map(json.loads, scenes.splitlines())}
    made = {}
    path = out / "scene.json"
    # Lists of actions have no grammar.
    for world in sorted({_world(row) for row in asked if not isinstance(row.prompt, str)}):
        if world[1] not in by_name:
            raise JudgeError(f"scenes.jsonl has no scene `{world[1]}`")
        path.write_text(json.dumps(by_name[world[1]]), encoding="utf-8")
        made[world] = grammar(motet, world[0], path)
    path.unlink(missing_ok=True)
    return made


def _with_reply(line: str, text: str) -> str:
    """A row with a reply in place of its policy, and without its pictures, which the judge does not need."""
    row = json.loads(line)
    row.pop("images", None)
    row.pop("image", None)
    said = text or " "
    if "messages" in row:
        row["messages"] = [{"role": one["role"], "content": rows.text(one["content"])} for one in row["messages"]]
        row["messages"][-1]["content"] = said
    elif "conversations" in row:
        row["conversations"][0]["value"] = row["conversations"][0]["value"].replace("<image>", "")
        row["conversations"][-1]["value"] = said
    else:
        before, marker, _ = row["text"].rpartition(rows.ROBOT)
        row["text"] = f"{before}{marker} {said.strip()}"
    return json.dumps(row, ensure_ascii=False)


def _lint(motet: str, path: Path) -> dict[int, str]:
    """Why the rows of a file cannot run, by line."""
    found: dict[int, str] = {}
    for line in _run([motet, "dataset", "lint", str(path), "--format", "json"]).stdout.splitlines():
        if not line.startswith("{"):
            continue
        finding = json.loads(line)
        if finding.get("fault") in ("unreadable", "no_world", "cannot_run"):
            found.setdefault(finding["row"], finding["message"])
    return found


def _goal(policy: str) -> Any:
    """The goal that a policy declares; none if it declares none."""
    try:
        return json.loads(policy).get("achieves")
    except (ValueError, AttributeError):
        return None


def _steps(policy: str) -> Any:
    """A policy without its name, which is free."""
    try:
        value = json.loads(policy)
    except ValueError:
        return policy.strip()
    if isinstance(value, dict):
        value.pop("policy", None)
    return value


def _run(command: list[str]) -> subprocess.CompletedProcess[str]:
    try:
        ran = subprocess.run(command, capture_output=True, text=True, check=False)
    except OSError as why:
        raise JudgeError(f"{command[0]}: {why}; give the command with --motet") from why
    # 1: there are findings.
    if ran.returncode not in (0, 1):
        raise JudgeError(f"{' '.join(command[:3])}: {ran.stderr.strip()}")
    return ran
