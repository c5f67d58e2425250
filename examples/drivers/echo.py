#!/usr/bin/env python3
"""A driver for Motet that moves nothing: it takes its time over every goal and says that it did it (docs/drivers.md)."""

import argparse
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "python"))  # where the package is not installed
import motet  # noqa: E402

EXAMPLES = {None: None, "Text": "yes", "Bool": True, "Int": 1, "Pose": motet.Pose((0.0, 0.0, 0.0))}
NUMBERS = ("Number", "Length", "Angle", "Duration", "Mass", "Force", "Speed", "Ratio")


def example(kind):
    """A value of a type."""
    if kind is not None and kind.startswith("List<"):
        return [example(kind[5:-1])]
    return 1.0 if kind in NUMBERS else EXAMPLES.get(kind, "echo_1")


class Echo(motet.Driver):
    name, can_hold, can_update = "echo 2.0", "all", "all"

    def __init__(self, args):
        self.seconds, self.refuse, self.owns_clock = args.seconds, args.refuse, args.clock == "driver"
        self.places = {}  # by thing that a goal has moved: what it is on, in or at; None in the hand

    def begin_run(self, run):
        self.places = {}

    async def perform(self, goal, **args):
        if goal.primitive in self.refuse:
            raise motet.Refused("unreachable")
        await goal.sleep(self.seconds)
        self.report_moved(base=[0.0, 0.0, 0.0])
        if "object" in args:
            moves = {"pick": None, "grasp": None, "place": args.get("on"), "place_at": args.get("on"), "handover": args.get("to")}
            self.places.update({args["object"]: moves[name] for name in [goal.primitive] if name in moves})
        return example(goal.result_type)

    def observe(self, query):
        """Every fact holds but those of where things are not; all is 1 m away, and any other measure is 0.05."""
        if "fact" in query:
            return self.holds(query["fact"]["fluent"], query["fact"]["args"])
        return 1.0 if query.get("measure", {}).get("measure") == "distance" else 0.05

    def holds(self, fluent, args):
        """A thing is in one place: where the last goal put it, or else in none that is closed."""
        thing, place = ([*args, None, None])[:2]
        if fluent not in ("at", "on", "in") or thing == "any" or thing["is"] == {"entity": "robot"}:
            return True
        known = self.places.get(thing["is"].get("entity"), ...)
        if known is ...:
            return fluent != "in"
        return known is not None and (place == "any" or place == {"is": {"entity": known}})


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.2, help="how long every goal takes")
    parser.add_argument("--refuse", action="append", default=[], metavar="PRIMITIVE", help="a primitive to refuse")
    parser.add_argument("--clock", choices=["wall", "driver"], default="wall", help="whose time a run goes by")
    parser.add_argument("--port", type=int, help="a TCP port instead of standard input and output; 0 takes a free one")
    parser.add_argument("--grace", type=float, default=10.0, help="seconds that goals go on for without a host, with --port")
    arguments = parser.parse_args()
    motet.serve(Echo(arguments), arguments.port, arguments.grace)
