#!/usr/bin/env python3
"""A driver for Motet that moves nothing: it takes its time over every goal and says that it did it (docs/drivers.md)."""

import argparse
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "python"))  # where the package is not installed
import motet  # noqa: E402


class Echo(motet.Driver):
    name, can_hold, can_update = "echo 2.0", "all", "all"

    def __init__(self, args):
        self.seconds, self.refuse, self.owns_clock = args.seconds, args.refuse, args.clock == "driver"

    def begin_run(self, run):
        self.places = {}  # by thing that a goal has moved: what it is on, in or at; None in the hand

    async def perform(self, goal, **args):
        if goal.primitive in self.refuse:
            raise motet.Refused("unreachable")
        await goal.sleep(self.seconds)
        self.report_moved(base=[0.0, 0.0, 0.0])
        if goal.primitive in ("pick", "grasp", "place", "place_at", "handover"):
            self.places[args["object"]] = args.get("on", args.get("to"))
        return goal.example_result()

    def at(self, thing, place):
        return thing not in self.places or self.places[thing] is not None and place in (self.places[thing], motet.ANY)

    on = at

    def in_(self, thing, place):
        return thing in self.places and self.at(thing, place)

    def observe(self, query):
        """Every other fact holds; all is 1 m away, and any other measure is 0.05."""
        return "fact" in query or (1.0 if query.get("measure", {}).get("measure") == "distance" else 0.05)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seconds", type=float, default=0.2, help="how long every goal takes")
    parser.add_argument("--refuse", action="append", default=[], metavar="PRIMITIVE", help="a primitive to refuse")
    parser.add_argument("--clock", choices=["wall", "driver"], default="wall", help="whose time a run goes by")
    parser.add_argument("--port", type=int, help="a TCP port instead of standard input and output; 0 takes a free one")
    parser.add_argument("--grace", type=float, default=10.0, help="seconds that goals go on for without a host, with --port")
    arguments = parser.parse_args()
    motet.serve(Echo(arguments), arguments.port, arguments.grace)
