"""The judge: carries out every motion that Motet calls feasible, and reports the share that physics bears out.

    python -m motet_mujoco.judge --robot hsr [--scene kitchen]…

`reach` holds if the hand still holds the thing 1.5 s after everything else that bore it is gone. `go_to` holds if
the base arrives without touching anything. `pull` and `push` hold if the drawer or door is then open or closed.
`put` holds if the thing comes to rest on or in what it was put on, upright.
"""

import argparse
import json
import os
import sys
import tempfile
import time

import numpy as np

from .model import Model, ModelError, find_motet, motet
from .motion import phases, timed
from .world import World

SCENES = {"panda": [os.path.join(os.path.dirname(__file__), "scenes", "table.json")]}
DEFAULT = ["kitchen", "lab", "living_room"]
# Aims: shares that physics shall bear out.
AIMS = {"reach": {"hsr": 0.95, "anymal_z1": 0.9, "panda": 0.95}, "go_to": 1.0, "pull": 0.9, "push": 0.9, "put": 0.9}
# Seconds for which a thing has to be held without support, and how far it may slip in the hand in m.
HOLDS, SLIPS = 1.5, 0.03


class Trial:
    """One verdict carried out."""

    def __init__(self, scene, query, holds, why, error):
        self.scene, self.query, self.holds, self.why, self.error = scene, query, holds, why, error

    def kind(self):
        """Kind of the query."""
        return self.query.partition("(")[0]


def carry_out(world, query, witness, share=1.0):
    """Carries a witness out from the start. Answers whether the world bears it out, and why not."""
    kind, _, rest = query.partition("(")
    arguments = [part.strip() for part in rest.rstrip(")").split(",")]
    points = world.targets(witness["path"])
    judge = {"reach": reach, "go_to": go_to, "pull": pull, "push": pull, "put": put}[kind]
    return judge(world, arguments, points, witness, share)


def follow(world, points, share):
    """Follows points, and measures the error of base and joints at the end of each leg."""
    greatest = np.zeros(2)
    path = timed(points, world.model.speeds, share)
    start = world.now
    while world.now - start < path.end:
        world.step(*path.at(world.now - start + world.tick / 2.0))
    for _ in range(30):
        world.step(points[-1])
    greatest = np.maximum(greatest, tip_error(world))
    return greatest


def tip_error(world):
    """Distance in m and angle in rad of the hand from where its targets put it."""
    from .motion import rotation_vector, set_targets

    reacher = world.reacher
    if world.model.tip < 0:
        return np.zeros(2)
    qpos = world.data.qpos.copy()
    set_targets(world.model, reacher.data, qpos, world.target)
    place, turn = reacher.pose(reacher.data.qpos.copy())
    tip = world.tip()
    return np.array([np.linalg.norm(place - tip[0]), np.linalg.norm(rotation_vector(turn @ tip[1].T))])


def close(world, seconds=1.0):
    """Closes the hand with all its force."""
    target = world.target.copy()
    start = {at: world.data.qpos[world.model.control_qpos[at]] for at in world.model.grips}
    ticks = int(0.5 / world.tick)
    for tick in range(ticks):
        for at, (_, closed) in world.model.grips.items():
            target[at] = start[at] + (closed - start[at]) * (tick + 1) / ticks
        world.step(target)
    world.wait(seconds - 0.5)


def open_hand(world, seconds=0.8):
    """Opens the hand from where its fingers are."""
    target = world.target.copy()
    start = {at: world.data.qpos[world.model.control_qpos[at]] for at in world.model.grips}
    ticks = int(seconds / world.tick)
    for tick in range(ticks):
        for at, (opened, _) in world.model.grips.items():
            target[at] = start[at] + (opened - start[at]) * min(2.0 * (tick + 1) / ticks, 1.0)
        world.step(target)


def draw_back(world, far=0.08, share=0.5):
    """Moves the hand against its fingers, as far as its arm goes."""
    place, rotation = world.tip()
    points, steps = [world.target.copy()], 4
    for step in range(1, steps + 1):
        back = place - rotation[:, 2] * far * step / steps
        target = world.reacher.solve(world.data.qpos, points[-1], back, rotation)
        if target is None:
            break
        points.append(target)
    if len(points) > 1:
        follow(world, points, share)


def reach(world, arguments, points, _witness, share):
    thing = arguments[0]
    before = world.pose(thing)[0]
    error = follow(world, points, share)
    moved = np.linalg.norm(world.pose(thing)[0] - before)
    close(world)
    if not world.holds(thing):
        return False, "no grip from two sides%s" % (", pushed %.0f mm" % (moved * 1e3) if moved > 0.005 else ""), error
    support_gone(world, thing)
    at = world.in_hand(thing)
    world.wait(HOLDS)
    slip = np.linalg.norm(world.in_hand(thing) - at)
    if not world.holds(thing):
        return False, "falls", error
    if slip > SLIPS:
        return False, "slips by %.0f mm" % (slip * 1e3), error
    return True, "slips by %.1f mm" % (slip * 1e3), error


def support_gone(world, thing):
    """Lets a thing touch nothing but the hand."""
    mj = world.model.mj
    for at in range(mj.ngeom):
        if at not in world.model.hand_geoms and world.model.geom_owner[at] != thing:
            mj.geom_contype[at] = mj.geom_conaffinity[at] = 0


def go_to(world, _arguments, points, _witness, share):
    path = timed(points, world.model.speeds, share)
    met = []
    start = world.now
    while world.now - start < path.end and not met:
        world.step(*path.at(world.now - start + world.tick / 2.0))
        met = [what for what in [world.bumped()] if what]
    if met:
        return False, "touches %s" % met[0], np.zeros(2)
    world.wait(0.2)
    off = np.abs(world.base() - points[-1][:3]).max() if world.model.drives else 0.0
    return bool(off < 0.005), "off by %.1f mm" % (off * 1e3), tip_error(world)


def pull(world, arguments, points, witness, share):
    container = arguments[0]
    begun = world.opening(container)
    if begun is None:
        return push_thing(world, container, points, share)
    error = np.zeros(2)
    for deed, points in phases(points, world.model.grips):
        if deed == "grip":
            close(world)
        elif deed == "release":
            open_hand(world)
        else:
            # A door is drawn slowly.
            found = follow(world, points, share * (0.5 if deed == "draw" else 1.0))
            error = np.maximum(error, found if deed == "move" else 0.0)
    wanted = 0.0 if begun > 0.5 else 1.0
    share_open = world.opening(container)
    return abs(share_open - wanted) < 0.2, "open by %.0f %%" % (share_open * 100.0), error


def push_thing(world, thing, points, share):
    if thing not in world.model.free:
        return False, "is fixed", np.zeros(2)
    before = world.pose(thing)[0]
    error = follow(world, points, share)
    moved = np.linalg.norm(world.pose(thing)[0] - before)
    return bool(moved > 0.02), "moved by %.0f mm" % (moved * 1e3), error


def put(world, arguments, points, witness, share):
    thing, support = arguments[0], arguments[1]
    world.settle_in_hand(thing)
    if not world.holds(thing):
        return False, "no grip at the start", np.zeros(2)
    error, parts = np.zeros(2), phases(points, world.model.grips, "draw")
    for deed, part in parts:
        if deed == "draw":
            error = follow(world, part, share)
        if deed == "release" or not any(other == "release" for other, _ in parts):
            if not world.holds(thing):
                return False, "lost on the way", error
            open_hand(world)
            if deed != "release":
                draw_back(world)
        if deed == "move":
            follow(world, part, share)
    world.wait(1.0)
    where = "in" if world.is_in(thing, support) else "on" if world.is_on(thing, support) else None
    if where is None:
        bearers = world.bearers(thing)
        return False, "rests on %s" % (bearers[0] if bearers else "nothing"), error
    if where == "on":
        up = world.data.xmat[world.model.body_of[thing]].reshape(3, 3)[2, 2]
        shape = world.model.entities[thing].get("shape", {})
        if up < 0.9 and "sphere" not in shape:
            return False, "falls over", error
    return True, where, error


def verdicts(command, robot, scene, *motions):
    """Feasible verdicts with their witnesses, in order: of motions, or of all from the start."""
    asked = [part for motion in motions for part in ("--for", motion)] or ["--all"]
    text = motet(command, "feasible", "--robot", robot, "--scene", scene, *asked, "--format", "json", ok=(0, 1))
    lines = [json.loads(line) for line in text.splitlines()]
    return [(line["query"], line["witness"]) for line in lines if line.get("answer") == "feasible"]


def puts(command, robot, scene, folder):
    """Scenes in which the hand holds a thing, with the motions that put it somewhere."""
    things = [e for e in scene["entities"] if e["kind"] == "Object" and not e.get("fixed") and "shape" in e]
    supports = [e["id"] for e in scene["entities"] if e["kind"] in ("Surface", "Container")]
    for thing in things:
        held = json.loads(json.dumps(scene))
        held["robot"]["holding"] = thing["id"]
        for entity in held["entities"]:
            if entity["id"] == thing["id"]:
                entity.pop("on", None)
                entity.pop("in", None)
        # What stands on it would fall.
        held["entities"] = [e for e in held["entities"] if e.get("on") != thing["id"]]
        path = os.path.join(folder, "%d.json" % things.index(thing))
        with open(path, "w", encoding="utf-8") as out:
            json.dump(held, out)
        yield path, ["put(%s, %s)" % (quoted(thing["id"]), quoted(support)) for support in supports]


def quoted(entity):
    """An id as the language writes it."""
    return entity if entity.isidentifier() else "`%s`" % entity


def trials(command, robot, scene, kinds, report):
    """Carries out all feasible verdicts of a scene."""
    xml = motet(command, "robots", "mjcf", "--robot", robot, "--scene", scene)
    model = Model(xml)
    if kinds - {"put"}:
        for query, witness in verdicts(command, robot, scene):
            if query.partition("(")[0] in kinds - {"put"}:
                yield from trial(scene, xml, query, witness, report)
    if "put" in kinds:
        with tempfile.TemporaryDirectory() as folder:
            for held, motions in puts(command, robot, model.scene, folder):
                try:
                    found = verdicts(command, robot, held, *motions)
                except ModelError as error:
                    print("%s: %s" % (held, error), file=sys.stderr)
                    continue
                if found:
                    held_xml = motet(command, "robots", "mjcf", "--robot", robot, "--scene", held)
                for query, witness in found:
                    yield from trial(scene, held_xml, query, witness, report)


def trial(scene, xml, query, witness, report):
    """Carries out one verdict in a fresh world."""
    world = World(Model(xml))
    # The verdict is about shapes; a lock is a fact.
    for at in range(world.model.mj.neq):
        if world.model.mj.eq(at).name.endswith("/lock"):
            world.data.eq_active[at] = 0
    holds, why, error = carry_out(world, query.replace("`", ""), witness)
    done = Trial(os.path.basename(scene), query, holds, why, error)
    report(done, world.now)
    yield done


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--robot", required=True, help="a built-in name, or a folder with a robot.toml")
    parser.add_argument("--scene", action="append", help="a built-in name, or a JSON file; repeatable")
    parser.add_argument("--motet", help="the command `motet` [default: from PATH]")
    parser.add_argument("--kind", action="append", choices=["reach", "go_to", "pull", "push", "put"],
                        help="kind of motion; repeatable [default: all]")
    parser.add_argument("--format", choices=["human", "json"], default="human")
    args = parser.parse_args(arguments)
    scenes = args.scene or SCENES.get(args.robot, DEFAULT)
    kinds = set(args.kind or ["reach", "go_to", "pull", "push", "put"])
    begun, simulated, all_trials = time.monotonic(), [0.0], []

    def report(done, seconds):
        simulated[0] += seconds
        if args.format == "json":
            print(json.dumps({"scene": done.scene, "query": done.query, "holds": bool(done.holds), "why": done.why,
                              "error": [round(float(part), 5) for part in done.error]}), flush=True)
        else:
            print("%-12s %-32s %-4s %s" % (done.scene, done.query, "yes" if done.holds else "NO", done.why), flush=True)

    try:
        command = find_motet(args.motet)
        for scene in scenes:
            all_trials.extend(trials(command, args.robot, scene, kinds, report))
    except ModelError as error:
        print("error: %s" % error, file=sys.stderr)
        return 2
    summary(args, all_trials, simulated[0], time.monotonic() - begun)
    return 0


def summary(args, done, simulated, taken):
    """Prints the shares."""
    shares = {}
    for one in done:
        shares.setdefault(one.kind(), []).append(one.holds)
    # Where nothing is held or pulled, so that nothing bends the arm.
    free = [one.error for one in done if one.kind() in ("reach", "go_to")]
    error = np.max(free, axis=0) if free else np.zeros(2)
    if args.format == "json":
        found = {kind: {"held": sum(map(bool, held)), "of": len(held)} for kind, held in shares.items()}
        print(json.dumps({"robot": args.robot, "shares": found, "error": [float(part) for part in error],
                          "simulated_secs": simulated, "wall_secs": taken}))
        return
    print()
    for kind, held in shares.items():
        aim = AIMS[kind]
        aim = aim.get(args.robot, 0.9) if isinstance(aim, dict) else aim
        print("%-6s %3d of %3d borne out, %5.1f %% (aim %.0f %%)"
              % (kind, sum(map(bool, held)), len(held), 100.0 * sum(map(bool, held)) / len(held), 100.0 * aim))
    print("the hand is off its witness by at most %.1f mm and %.1f mrad" % (error[0] * 1e3, error[1] * 1e3))
    print("%.0f s simulated in %.0f s" % (simulated, taken))


if __name__ == "__main__":
    sys.exit(main())
