"""The whole path on one processor with a tiny model: rows, training, judging before and after, merging, GGUF, and `motet do`.

The model has random weights, so it shows that the path works, and no more: it learns the rows of one robot in rooms of one kind.
"""

from __future__ import annotations

import json
import subprocess
import time
from collections import Counter
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from . import export, merge, recipe, reply, rows, serve, tiny
from .judge import judge
from .train import train

__all__ = ["demo"]

REQUESTS = ["open the fridge", "go to the counter", "throw the coke away", "bring me the red mug"]


def demo(
    motet: str,
    kind: str,
    out: Path,
    *,
    data: Path | None = None,
    scenes: int = 60,
    updates: int = 300,
    asked: int = 48,
    say: Callable[[str], None] = print,
) -> dict[str, Any]:
    """Trains a tiny model of a kind and reports losses and judgements. `data` has rows already; otherwise they are made."""
    import torch

    torch.manual_seed(0)
    sees = kind != "qwen2"
    began = time.perf_counter()
    if data is None:
        data = out / "data"
        flags = ["--form", "trl", "--robot", "hsr", "--room", "kitchen", "--scenes", str(scenes), "--cases", "20"]
        say(f"rows of {scenes} kitchens")
        subprocess.run([motet, "dataset", "--out", str(data), *flags, *(["--images"] if sees else [])], check=True)
    plan = recipe.find("tiny-vision" if sees else "tiny")
    known = rows.read(data / "train.jsonl")
    base = out / "base"
    model = tiny.make(kind, base, *_texts(known))
    say(f"{kind}: {sum(one.numel() for one in model.parameters())} parameters")
    report: dict[str, Any] = {"kind": kind, "rows": len(known)}

    def judged(folder: Path, name: str) -> None:
        began = time.perf_counter()
        replier = reply.opened(folder, most_tokens=320)
        for is_held in (True, False):
            how = "held" if is_held else "free"
            found = judge(motet, replier, data, out / f"{name}_{how}", most=asked, held=is_held)
            say(
                f"{name}, {'under the grammar' if is_held else 'free'}: of {found.rows} replies {found.whole} ended, "
                f"{found.can_run} can run, {found.same_goal} with the row's goal, {found.same} are the row's"
            )
            report[f"{name}_{how}"] = asdict(found)
        say(f"{name}: judged in {time.perf_counter() - began:.0f} s")

    judged(base, "before")
    adapters = out / "adapters"
    trained = train(plan, str(base), data, adapters, evaluate_every=max(updates // 4, 1), most_steps=updates)
    say(f"loss on held-out rooms: {trained['loss_before']:.3f} before, {trained['loss_after']:.3f} after")
    report["training"] = trained
    judged(adapters, "after")
    merged = out / "merged"
    merge.merge(adapters, merged, precision="fp32")
    if not sees:
        export.export(merged, out / "model.gguf")
        report["gguf"] = export.compare(merged, out / "model.gguf")
        say(f"GGUF: {report['gguf']}")
    report["do"] = _do(motet, merged, out, ["--camera"] if sees else [], say)
    report["seconds"] = round(time.perf_counter() - began)
    (out / "report.json").write_text(json.dumps(report, indent=1) + "\n", encoding="utf-8")
    return report


def _texts(known: list[rows.Row]) -> tuple[list[str], list[str]]:
    """What the rows say, and the instructions that stand before it."""
    talks = [[one for one in row.prompt if isinstance(one, dict)] for row in known]
    said = [one["content"] for talk in talks for one in talk if one["role"] != "system"]
    instructions = [one["content"] for talk in talks for one in talk if one["role"] == "system"]
    return said + [row.policy for row in known] + instructions[:20], instructions


def _do(motet: str, folder: Path, out: Path, sight: list[str], say: Callable[[str], None]) -> dict[str, dict[str, int]]:
    """How `motet do` ended for each request, with the model behind a server."""
    ended: dict[str, dict[str, int]] = {}
    with serve.served(reply.opened(folder, most_tokens=320), "tiny") as url:
        for number, request in enumerate(REQUESTS):
            flags = [
                "--robot",
                "hsr",
                "--scene",
                "kitchen",
                "--planner",
                url,
                "--model",
                "tiny",
                "--dialect",
                "vllm",
                *sight,
            ]
            talk = out / f"do_{number}"
            flags += ["--ask", "never", "--speed", "max", "--profile", "ideal", "--repair", "1", "--record", str(talk)]
            ran = subprocess.run([motet, "do", request, *flags], capture_output=True, text=True, check=False)
            if ran.returncode not in (0, 3):
                raise RuntimeError(f"motet do ended with {ran.returncode}: {ran.stderr}")
            lines = (talk / "talk.jsonl").read_text(encoding="utf-8").splitlines()
            whats = Counter(json.loads(line)["what"] for line in lines)
            ended[request] = {"exit": ran.returncode, **{what: whats[what] for what in ("taken", "refused", "failed")}}
            say(f"motet do '{request}': {ended[request]}")
    return ended
