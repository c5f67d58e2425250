"""`python -m motet_mujoco`: a driver on standard input and output, whose robot is simulated by MuJoCo."""

import argparse
import shlex
import sys

from .begin import WrongStart, told_apart
from .chance import profile
from .driver import Driver, Options, stdio
from .faults import answers, read
from .model import ModelError, find_motet, load


def walk(text):
    """A walk of a person: ID:X,Y[@SECONDS[,SPEED]]."""
    person, _, rest = text.rpartition(":")
    place, _, when = rest.partition("@")
    x, y = (float(part) for part in place.split(","))
    start, _, speed = (when or "0").partition(",")
    return person, (x, y), float(start), float(speed or 0.8)


def says(text):
    """Words of a person: ID:TEXT@SECONDS."""
    person, _, rest = text.partition(":")
    words, _, when = rest.rpartition("@")
    return person, words, float(when)


def main(arguments=None):
    parser = argparse.ArgumentParser(prog="motet_mujoco", description=__doc__)
    parser.add_argument("--robot", required=True, help="a built-in name, or a folder with a robot.toml")
    parser.add_argument("--scene", required=True, help="a built-in name, or a JSON file")
    parser.add_argument("--told", metavar="SCENE",
                        help="the scene as the robot was told of it [default: the real one]")
    parser.add_argument("--motet", help="the command `motet` [default: from PATH]")
    parser.add_argument("--seed", type=int, default=0, help="seed of all that is drawn at random")
    parser.add_argument("--profile", default="ideal", metavar="ideal|typical|harsh|FILE",
                        help="how often and by how much things go wrong [default: ideal]")
    parser.add_argument("--answers", action="append", default=[], metavar="TEXT",
                        help="what people answer, in order; then `yes`")
    parser.add_argument("--answers-file", metavar="FILE", help="a JSON list of answers; null refuses")
    parser.add_argument("--faults", metavar="FILE", help="a JSON file of faults, as `motet schema faults` says")
    parser.add_argument("--walk", action="append", default=[], type=walk, metavar="ID:X,Y[@SECONDS[,SPEED]]",
                        help="a person walks to a place, at a time and with a speed in m/s")
    parser.add_argument("--says", action="append", default=[], type=says, metavar="ID:TEXT@SECONDS",
                        help="a person says something by themselves, at a time")
    parser.add_argument("--speed", type=float, default=1.0, help="for hosts with a wall clock: times real time")
    parser.add_argument("--oracle", nargs="?", const="robot", choices=("robot", "judge"),
                        help="perceive by the truth of the simulator; with `judge`, tell it to judges alone")
    parser.add_argument("--detector", metavar="CMD", type=shlex.split,
                        help="the command of a detector [default: one by colours and shapes]")
    args = parser.parse_args(arguments)
    try:
        command = find_motet(args.motet)
        rates, script = profile(args.profile), read(args.faults) if args.faults else None
        said = args.answers + (answers(args.answers_file) if args.answers_file else [])
        model = load(args.robot, args.scene, command)
        told = load(args.robot, args.told, command).scene if args.told else None
        real, told = told_apart(model, told, command)
        unknown = [one[0] for one in args.walk + args.says if one[0] not in model.people]
        if unknown:
            raise ModelError("the scene has no person `%s`" % unknown[0])
    except (ModelError, WrongStart) as error:
        print("error: %s" % error, file=sys.stderr)
        return 2
    driver = Driver(real, command, Options(rates, args.seed, said, script), args.oracle == "robot", args.walk,
                    args.says, told, args.detector, args.oracle is not None)
    stdio(driver, args.speed)
    return 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (KeyboardInterrupt, BrokenPipeError):
        sys.exit(1)
