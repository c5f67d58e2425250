"""How fast physics runs: `python -m motet_mujoco.speed [--robot hsr --scene kitchen]`, in times real time on one core.

The robot drives to a thing, grasps it and stands with it: the motion of `reach`, carried out again and again. The time
is that of the processor, so that other programs change it less; the median of the rounds counts.
"""

import argparse
import statistics
import sys
import time

from .judge import carry_out
from .model import ModelError, find_motet, load
from .verdicts import verdicts
from .world import World

# Times real time that the HSR reaches in the kitchen at least.
AIM = 20.0


def rounds(world_of, query, witness, count):
    """Times real time of each round."""
    for _ in range(count):
        world, began = world_of(), time.process_time()
        carry_out(world, query, witness)
        yield world.now / (time.process_time() - began)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--robot", default="hsr")
    parser.add_argument("--scene", default="kitchen")
    parser.add_argument("--motion", default="reach(mug_1)", help="[default: reach(mug_1)]")
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--motet", help="the command `motet` [default: from PATH]")
    args = parser.parse_args(arguments)
    try:
        command = find_motet(args.motet)
        found = verdicts(command, args.robot, args.scene, args.motion)
        if not found:
            raise ModelError("`%s` is not feasible there" % args.motion)
        query, witness = found[0]
        times = sorted(rounds(lambda: World(load(args.robot, args.scene, command)), query, witness, max(args.rounds, 1)))
    except ModelError as error:
        print("error: %s" % error, file=sys.stderr)
        return 2
    middle = statistics.median(times)
    print("%s in %s, %s: %.0f times real time (%.0f to %.0f); the aim is %.0f"
          % (args.robot, args.scene, query, middle, times[0], times[-1], AIM))
    return 0 if middle >= AIM else 1


if __name__ == "__main__":
    sys.exit(main())
