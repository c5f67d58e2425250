"""Calibration: rates of the profile `typical`, measured by trials in physics.

    python -m motet_mujoco.calibrate --robot hsr --trials 20

| rate | trials |
|---|---|
| `hand.slip` | grasps of all feasible `reach`, of which the error is within the room between the fingers |
| `hand.drop` | drives of 1 m and back, with a turn, with what a grasp has held |
| `hand.short` | all feasible `put` |
| `hand.stick` | all feasible `pull` and `push` |
| `camera.miss` | looks by pixels at the things on a surface from where `go_to` leaves the robot, and from behind |
| `camera.confuse` | those of them with something of the same class, category or colour in the picture: is it taken for the thing? |

The errors of hand and camera, of the room and of friction are those of the profile. Each rate has its interval at 95 %.
"""

import argparse
import copy
import os
import sys
import tempfile

import numpy as np

from .beliefs import Beliefs
from .camera import NoGraphics
from .chance import Chance, profile
from .detector import COLOURS
from .disorder import displace
from .eyes import Eyes, extent
from .judge import SLIPS, carry_out, disturbed, follow, interval
from .model import Model, ModelError, find_motet, motet, save
from .verdicts import DEFAULT, SCENES, quoted, trials, verdicts
from .world import World


class Count:
    """Events among trials, with measured sizes."""

    def __init__(self):
        self.events, self.of, self.sizes = 0, 0, []
        self.looks = 0.0  # trials, each counted as often as it would be harder than the usual one

    def add(self, comes, size=None):
        """Adds a trial."""
        self.events, self.of = self.events + bool(comes), self.of + 1
        if size is not None:
            self.sizes.append(size)

    def as_looks(self, name):
        """The rate of the usual trial, from harder ones, with its interval."""
        scale = self.of / max(self.looks, 1e-9)
        low, high = interval(self.events, self.of)
        return "%s: %.4f (%.4f to %.4f)" % (name, self.events / max(self.looks, 1e-9), low * scale, high * scale)

    def line(self, name):
        """Line of a table."""
        low, high = interval(self.events, self.of)
        share = self.events / self.of if self.of else 0.0
        return "| `%s` | %d of %d | %.3f | %.3f to %.3f |" % (name, self.events, self.of, share, low, high)


# Rates by the part of a calibration, and the motions of the trials.
PARTS = {"grasp": ["hand.slip", "hand.drop"], "put": ["hand.short"], "door": ["hand.stick"], "camera": ["camera.miss", "camera.confuse"]}
KINDS = {"grasp": {"reach"}, "put": {"put"}, "door": {"pull", "push"}}
# Distances in m behind the place from which a thing is taken, where it is looked at.
BACK = (0.0, 0.6, 1.2)


def hands(command, robot, scene, kinds, rates, seeds, found):
    """Counts what slips, drops, falls short and sticks."""
    for _, xml, query, witness in trials(command, robot, scene, kinds):
        kind, thing = query.partition("(")[0], query.partition("(")[2].rstrip(")").replace("`", "")
        for seed in seeds:
            world, off = disturbed(xml, query, rates, Chance(seed))
            holds, _, _ = carry_out(world, query.replace("`", ""), witness)
            if kind == "put":
                found["hand.short"].add(not holds)
            elif kind != "reach":
                found["hand.stick"].add(not holds)
            elif off <= (world.model.card[3] - witness["grasp"]["width"]) / 2.0:
                found["hand.slip"].add(not holds)
                if holds and world.model.drives:
                    found["hand.drop"].add(not carried(world, thing))


def carried(world, thing):
    """Drives 1 m on and back with a turn. True if the hand still holds what it held, where it held it."""
    at, start = world.in_hand(thing), world.target.copy()
    x, y, yaw = start[:3]
    points = [start.copy() for _ in range(4)]
    points[1][:3] = [x + np.cos(yaw), y + np.sin(yaw), yaw]
    points[2][:3] = [*points[1][:2], yaw + 1.5]
    follow(world, points, 1.0)
    return world.holds(thing) and np.linalg.norm(world.in_hand(thing) - at) <= SLIPS


def looks(command, robot, scene, rates, seeds, found):
    """Counts the things that pixels do not tell, and measures the errors of the others."""
    model = Model(motet(command, "robots", "mjcf", "--robot", robot, "--scene", scene))
    on = {}
    for entity in model.scene["entities"]:
        if entity.get("on") in model.entities and entity["id"] in model.free:
            on.setdefault(entity["on"], []).append(entity["id"])
    places = ((support, back) for support in on for back in (BACK if model.drives else BACK[:1]))
    for support, back in places:
        things, stood = on[support], copy.deepcopy(model.scene)
        if model.drives:
            way = verdicts(command, robot, scene, "go_to(%s)" % quoted(support))
            if not way:
                continue
            last = way[0][1]["path"][-1]
            x, y, yaw = last["base"]
            base = [x - back * np.cos(yaw), y - back * np.sin(yaw), yaw]
            stood["robot"].update(base=base, joints=last["joints"], holding=None)
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "stood.json")
            save(path, stood)
            views = verdicts(command, robot, path, *("look(%s)" % quoted(thing) for thing in things))
            xml = motet(command, "robots", "mjcf", "--robot", robot, "--scene", path)
        for query, witness in views:
            thing = query.partition("(")[2].rstrip(")").replace("`", "")
            for seed in seeds:
                look(World(Model(xml)), thing, witness, rates, Chance(seed), found)


def look(world, thing, witness, rates, chance, found):
    """Looks at a thing by pixels, and counts whether it is found."""
    beliefs = Beliefs(world)
    displace(world, rates["room"], chance)
    follow(world, world.targets(witness["path"]), 1.0)
    eyes = Eyes(world, beliefs)
    try:
        seen = [one for one in eyes.detections() if one["id"] == thing]
        far = float(np.linalg.norm(world.pose(thing)[0] - eyes.eye()))
        off = np.linalg.norm(np.array(seen[0]["pose"]["xyz"]) - world.pose(thing)[0]) if seen else None
        found["camera.miss"].add(not seen, off / far if seen else None)
        # As a look at 10 cm from 1 m would be, which the rate of a profile is of.
        found["camera.miss"].looks += far * 0.1 / float(np.max(extent(world.model.entities[thing])))
        if any(alike(world.model.entities, thing, one["id"]) for one in eyes.last):
            taken = seen and min(world.model.free, key=lambda one: np.linalg.norm(
                world.pose(one)[0] - seen[0]["pose"]["xyz"]))
            found["camera.confuse"].add(bool(seen) and taken != thing)
    finally:
        eyes.close()


def alike(entities, thing, other):
    """True if another known thing is of the class, of a category or of the colour of a thing."""
    if other is None or other == thing:
        return False
    one, other = entities[thing], entities.get(other, {})
    sorts = [{part.get("class"), *part.get("categories", [])} - {None} for part in (one, other)]
    words = [set(" ".join([*part.get("names", []), part.get("id", "")]).lower().replace("_", " ").split()) & set(COLOURS)
             for part in (one, other)]
    return bool(sorts[0] & sorts[1] or words[0] & words[1])


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--robot", required=True, help="a built-in name, or a folder with a robot.toml")
    parser.add_argument("--scene", action="append", help="a built-in name, or a JSON file; repeatable")
    parser.add_argument("--profile", default="typical", metavar="ideal|typical|harsh|FILE", help="errors of the trials")
    parser.add_argument("--trials", type=int, default=10, help="trials of each motion, with seeds from 0 on")
    parser.add_argument("--part", action="append", choices=list(PARTS), help="what is measured; repeatable [default: all]")
    parser.add_argument("--motet", help="the command `motet` [default: from PATH]")
    args = parser.parse_args(arguments)
    parts = args.part or list(PARTS)
    found = {name: Count() for part in parts for name in PARTS[part]}
    kinds = set().union(*(KINDS[part] for part in parts if part in KINDS))
    try:
        command, rates = find_motet(args.motet), profile(args.profile)
        for scene in args.scene or SCENES.get(args.robot, DEFAULT):
            if kinds:
                hands(command, args.robot, scene, kinds, rates, range(args.trials), found)
            if "camera" in parts:
                looks(command, args.robot, scene, rates, range(args.trials), found)
    except (ModelError, NoGraphics) as error:
        print("error: %s" % error, file=sys.stderr)
        return 2
    print("| rate | events | rate | interval at 95 % |\n|---|---|---|---|")
    for name, count in found.items():
        print(count.line(name))
    sizes = found["camera.miss"].sizes if "camera.miss" in found else []
    if sizes:
        print("\n" + found["camera.miss"].as_looks("camera.miss, of a thing of 10 cm at 1 m"))
        print("\nseen places are off by %.4f m for each metre at the median, %.4f m in one of ten"
              % (np.median(sizes), np.percentile(sizes, 90)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
