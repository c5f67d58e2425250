#!/usr/bin/env python3
"""Judges the scenarios that URML can express with `urml-validator` and with Motet, in one run.

usage: compare.py SCENARIOS.jsonl EVAL

EVAL is the release build of `eval` (cargo build --release -p motet-eval). A scenario counts where every step
of its plan has a word in URML or is no word in either language. Prints one JSON object a tool.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time

from urml_validator import __version__, validate


class Inexpressible(Exception):
    """A step for which URML has no word."""


# Words of the contract without a counterpart in URML: containers, postures, monitors on plans.
WITHOUT_WORD = {"turn", "ground", "lift", "open", "close", "check", "home", "start_pose", "wake_up"}


def manifest(row):
    """The robot of a row, and its places."""
    scene = row["scene"]
    legged = row["robot"] == "anymal_z1"
    spots = set(scene.get("places", [])) | set(scene.get("surfaces", {})) | set(scene.get("containers", {}))
    spots |= {thing["at"] for thing in scene.get("objects", {}).values() if "at" in thing}
    kinds = {thing.get("kind", name) for name, thing in scene.get("objects", {}).items()}
    things = sorted(kinds | set(scene.get("objects", {})) | set(scene.get("persons", {})))
    return {
        "manifest_version": "0.1",
        "robot_id": row["robot"],
        "frames": [{"name": "map", "parent": None}, {"name": "base_link", "parent": "map"}],
        "declared_locations": [
            {"name": spot, "pose": {"x": float(index), "y": 0.0}, "frame": "map"}
            for index, spot in enumerate(sorted(spots))
        ],
        "declared_events": ["user_present"],
        "mobility": {
            "drive_type": "quadruped" if legged else "omnidirectional",
            "max_velocity": 0.5,
            "max_payload": 3.0 if legged else 1.2,
            "station_keeping": True,
        },
        "manipulation": {
            "arm_count": 1,
            "grippers": [
                {
                    "name": "hand",
                    "kind": "servo_electric",
                    "force_min_n": 0.5,
                    "force_max_n": 30.0,
                    "accepted_classes": things,
                    "movable": True,
                }
            ],
            "reachable_workspace_m": 0.74 if legged else 0.6,
        },
        "perception": {
            "cameras": [{"name": "camera", "movable": True, "supports_photo": True, "supports_video": False}],
            "sensors": [{"name": "microphone", "measurement_type": "speech"}],
            "object_vocabulary": things,
        },
        "outputs": {"named_endpoints": []},
    }


def envelope(row, robot):
    """The rules of the home that URML has a word for: where not to go."""
    zones = []
    for rule in row["scene"].get("rules", []):
        spot = next((spot for spot in robot["declared_locations"] if spot["name"] == rule.get("place")), None)
        if rule["rule"] == "no_go" and spot:
            x = spot["pose"]["x"]
            corners = [(x - 0.3, -0.3), (x + 0.3, -0.3), (x + 0.3, 0.3), (x - 0.3, 0.3)]
            zones.append({"name": spot["name"], "frame": "map", "vertices": corners})
    return {"envelope_version": "0.1", "people_occupancy_zones": zones}


def program(row):
    """A plan as a URML program."""
    writer = Writer(row)
    return {"profile": "home", "behavior": writer.block(row["plan"])}


class Writer:
    def __init__(self, row):
        self.row = row
        self.count = 0
        self.answers = set()

    def block(self, steps):
        written = [part for step in steps for part in self.step(step)]
        return {"type": "sequence", "steps": written or [{"wait": {"duration": 0.1}}]}

    def step(self, step):
        if "op" in step:
            return self.call(step)
        if "if" in step:
            arms = {"if_true": self.block(step.get("then") or []), "if_false": self.block(step.get("else") or [])}
            return [{"type": "branch", "condition": step["if"], **arms}]
        if "retry" in step and not step.get("on_fail"):
            return [{"type": "retry", "behavior": self.block(step["body"]), "max_attempts": step["retry"]}]
        if "parallel" in step:
            return [{"type": "parallel", "branches": [self.block(branch) for branch in step["parallel"]]}]
        raise Inexpressible(next(iter(step)))

    def call(self, step):
        op, args = step["op"], step.get("args", [])
        if op in WITHOUT_WORD:
            raise Inexpressible(op)
        first = args[0] if args else None
        bound = (step.get("as") or "").lstrip("$")
        store = {"store_as": bound} if bound else {}
        if op == "go":
            return [{"move_to": {"location": first} if args else {}}]
        if op in ("detect", "search"):
            return [{"detect": ({"object": first} if args else {}) | store}]
        if op == "pick":
            if args and first.lstrip("$") in self.answers:
                raise Inexpressible("a choice of a person as an object")
            if args and not first.startswith("$"):
                # A coarse `pick` localises by itself; in the fine profile that would mend the plan.
                if self.row["profile"] == "fine":
                    raise Inexpressible("a grasp of what was not perceived")
                self.count += 1
                name = f"found_{self.count}"
                return [{"detect": {"object": first, "store_as": name}}, {"grasp": {"target": f"${name}"}}]
            return [{"grasp": {"target": first} if args else {}}]
        if op == "place":
            return [{"release": {"mode": "place"} | ({"at": first} if args else {})}]
        if op == "handover":
            return [{"release": {"mode": "hand_to_user"} | ({"at": first} if args else {})}]
        if op == "ask":
            answers = step.get("answers")
            self.answers.add(bound)
            kind = {"expected": "choice", "choices": answers} if answers else {"expected": "free_form"}
            return [{"listen": {"prompt": first or "?"} | kind | store}]
        if op == "wait":
            return [{"wait": {"duration": first if args else 1.0}}]
        if op == "done":
            return []
        # No word of the contract: what a language makes of it is the question.
        return [{op: {"object": first}}]


def untold(row):
    """Whether the fault of a row lies in what a URML program and its manifest have no place for: goals, and the start."""
    start = {"swap_point", "awake", "posture", "holding"} & set(row["scene"])
    return bool(start) or row["class"] in ("goal_not_reached", "missing_close")


def judge(row):
    """Whether the validator refuses a row; the time in seconds without building the documents."""
    robot, plan = manifest(row), program(row)
    home = envelope(row, robot)
    begin = time.perf_counter()
    result = validate(plan, robot, home, profiles=("home",), policy=None)
    took = time.perf_counter() - begin
    return (not result.accepted), took, result


def main():
    scenarios, motet = sys.argv[1:3]
    rows = [json.loads(line) for line in open(scenarios, encoding="utf-8") if line.strip()]
    rows = [row for row in rows if row.get("needs", "static") == "static"]
    kept, tally, times, wrong = [], {"found": 0, "missed": 0, "missed_untold": 0, "false_alarms": 0}, [], []
    for row in rows:
        try:
            refused, took, result = judge(row)
        except Inexpressible:
            continue
        kept.append(row)
        times.append(took)
        faulty = row["verdict"] != "ok"
        name = {(True, True): "found", (True, False): "missed", (False, True): "false_alarms"}.get((faulty, refused))
        if name:
            tally[name] += 1
        if name == "missed" and untold(row):
            tally["missed_untold"] += 1
        if "--rows" in sys.argv and name:
            wrong.append((row["id"], row["class"], name, [str(error) for error in result.errors][:1]))
    for line in wrong:
        print(*line)
    with tempfile.NamedTemporaryFile("w", suffix=".jsonl", encoding="utf-8") as file:
        file.write("".join(json.dumps(row) + "\n" for row in kept))
        file.flush()
        answer = subprocess.run([motet, "scenarios", file.name, "--json"], capture_output=True, text=True, check=False)
    ours = json.loads(answer.stdout.strip().splitlines()[-1])
    faulty = sum(row["verdict"] != "ok" for row in kept)
    head = {"rows": len(kept), "of": len(rows), "faulty": faulty}
    print(json.dumps({"tool": f"urml-validator {__version__}", **head, **tally,
                      "median_us": round(statistics.median(times) * 1e6, 1)}))
    print(json.dumps({"tool": "motet", **head, "found": faulty - ours["missed"], "missed": ours["missed"],
                      "false_alarms": ours["false_alarms"], "median_us": round(ours["median_us"], 1)}))


if __name__ == "__main__":
    main()
