"""The judge: carries out every motion that Motet calls feasible, and reports the share that physics bears out.

    python -m motet_mujoco.judge --robot hsr [--scene kitchen]… [--profile typical --seeds 10]

`reach` holds if the hand still holds the thing 1.5 s after everything else that bore it is gone. `go_to` holds if
the base arrives without touching anything. `pull` and `push` hold if the drawer or door is then open or closed.
`put` holds if the thing comes to rest on or in what it was put on, upright.

With a profile, each verdict is carried out once for each seed: the friction is another one, and the thing is not quite
where it was seen and the hand not quite where it was sent.
"""

import argparse
import itertools
import json
import multiprocessing
import os
import sys
import tempfile
import time

import numpy as np

from .beliefs import Beliefs
from .chance import Chance, profile
from .jaw import FEELS_AT, spared
from .model import Model, ModelError, find_motet, motet, save
from .motion import Path, frame_at, gentle, phases, rotation_vector, timed
from .world import World

SCENES = {"panda": [os.path.join(os.path.dirname(__file__), "scenes", "table.json")]}
DEFAULT = ["kitchen", "lab", "living_room"]
# Aims: shares that physics shall bear out.
AIMS = {"reach": {"hsr": 0.95, "anymal_z1": 0.9, "panda": 0.95}, "go_to": 1.0, "pull": 0.9, "push": 0.9, "put": 0.9}
# Seconds for which a thing has to be held without support, and how far it may slip in the hand in m.
HOLDS, SLIPS = 1.5, 0.03
# Seconds in which the robot comes to rest at the end of a path.
RESTS = 0.12


# Distance in m from which a thing is seen before it is grasped.
SEEN_FROM = 1.0


class Trial:
    """One verdict carried out: `error` is how far the hand was off its witness, along the path and at its
    end, and `off` the error in m with which the hand came to the thing."""

    def __init__(self, scene, query, seed, found, off):
        self.scene, self.query, self.seed, self.off = scene, query, seed, off
        self.holds, self.why, self.error = found

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


def follow(world, points, share, until=lambda: False):
    """Follows points, and measures the error of the hand in m and rad, as rows: the greatest along the whole
    path, and the one at its end. With a thing in the hand it accelerates as little as the driver and the
    times of a witness do. Ends early where `until` says so."""
    path = timed(points, world.model, share)
    if world.held():
        path = Path([gentle(world, stroke) for stroke in path.strokes])
    start, along = world.now, np.zeros(2)
    while world.now - start < path.end:
        world.step(*path.at(world.now - start + world.tick / 2.0))
        # Poses are those of the beginning of the last step.
        then = world.now - start - world.model.mj.opt.timestep
        along = np.maximum(along, tip_error(world, path.at(then)[0]))
        if until():
            return np.stack([along, along])
    world.step(points[-1])
    world.wait(RESTS)
    end = tip_error(world, world.target)
    return np.stack([np.maximum(along, end), end])


def tip_error(world, target):
    """Distance in m and angle in rad of the hand from where targets put it."""
    if world.model.tip < 0:
        return np.zeros(2)
    place, turn = frame_at(world, target)
    tip = world.tip()
    return np.array([np.linalg.norm(place - tip[0]), np.linalg.norm(rotation_vector(turn @ tip[1].T))])


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
    points, feels = spared(world, Beliefs(world), points, thing)
    error = follow(world, points, share)
    moved = np.linalg.norm(world.pose(thing)[0] - before)
    if feels and not world.feels_touch():
        follow(world, [points[-1], *feels], share * FEELS_AT, until=world.feels_touch)
    world.move_fingers(True, 1.0)
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
    error = follow(world, points, share, until=lambda: world.bumped() is not None)
    met = world.bumped()
    if met is not None:
        return False, "touches %s" % met, error
    off = np.abs(world.base() - points[-1][:3]).max() if world.model.drives else 0.0
    return bool(off < 0.005), "off by %.1f mm" % (off * 1e3), error


def pull(world, arguments, points, witness, share):
    container = arguments[0]
    begun = world.opening(container)
    if begun is None:
        return push_thing(world, container, points, share)
    error = np.zeros((2, 2))
    for phase, points in phases(points, world.model.grips):
        if phase == "grip":
            world.move_fingers(True, 1.0)
        elif phase == "release":
            world.move_fingers(False, 0.8)
        else:
            # A door is drawn slowly.
            found = follow(world, points, share * (0.5 if phase == "draw" else 1.0))
            error = np.maximum(error, found if phase == "move" else 0.0)
    wanted = 0.0 if begun > 0.5 else 1.0
    share_open = world.opening(container)
    return abs(share_open - wanted) < 0.2, "open by %.0f %%" % (share_open * 100.0), error


def push_thing(world, thing, points, share):
    if thing not in world.model.free:
        return False, "is fixed", np.zeros((2, 2))
    before = world.pose(thing)[0]
    error = follow(world, points, share)
    moved = np.linalg.norm(world.pose(thing)[0] - before)
    return bool(moved > 0.02), "moved by %.0f mm" % (moved * 1e3), error


def put(world, arguments, points, witness, share):
    thing, support = arguments[0], arguments[1]
    world.settle_in_hand(thing)
    if not world.holds(thing):
        return False, "no grip at the start", np.zeros((2, 2))
    error, parts = np.zeros((2, 2)), phases(points, world.model.grips, "draw")
    for phase, part in parts:
        if phase == "draw":
            error = follow(world, part, share)
        if phase == "release" or not any(other == "release" for other, _ in parts):
            if not world.holds(thing):
                return False, "lost on the way", error
            world.move_fingers(False, 0.8)
            if phase != "release":
                draw_back(world)
        if phase == "move":
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
        save(path, held)
        yield path, ["put(%s, %s)" % (quoted(thing["id"]), quoted(support)) for support in supports]


def quoted(entity):
    """An id as the language writes it."""
    return entity if entity.isidentifier() else "`%s`" % entity


def trials(command, robot, scene, kinds):
    """All feasible verdicts of a scene, with the model in which they are carried out: (xml, query, witness)."""
    xml = motet(command, "robots", "mjcf", "--robot", robot, "--scene", scene)
    if kinds - {"put"}:
        for query, witness in verdicts(command, robot, scene):
            if query.partition("(")[0] in kinds - {"put"}:
                yield xml, query, witness
    if "put" in kinds:
        with tempfile.TemporaryDirectory() as folder:
            for held, motions in puts(command, robot, Model(xml).scene, folder):
                try:
                    found = verdicts(command, robot, held, *motions)
                except ModelError as error:
                    print("%s: %s" % (held, error), file=sys.stderr)
                    continue
                held_xml = motet(command, "robots", "mjcf", "--robot", robot, "--scene", held) if found else None
                for query, witness in found:
                    yield held_xml, query, witness


def disturbed(xml, query, rates, chance):
    """A fresh world, as a profile and a seed make it, and the error in m with which the hand comes to the thing."""
    model = Model(xml)
    friction = chance.error(rates["hand"]["friction"], "friction")[0]
    model.mj.geom_friction[:, 0] = 1.0 + max(float(friction), -0.9)
    world = World(model)
    # The verdict is about shapes; a lock is a fact.
    for at in range(model.mj.neq):
        if model.mj.eq(at).name.endswith("/lock"):
            world.data.eq_active[at] = 0
    kind, _, rest = query.replace("`", "").partition("(")
    thing = rest.rstrip(")").split(",")[0]
    if kind != "reach":
        return world, 0.0
    off = chance.error(rates["hand"]["error_m"], "hand", thing)
    off = off + chance.error(rates["camera"]["error_per_m"] * SEEN_FROM, "place", thing)
    if off.any():
        before = world.pose(thing)[0]
        world.place(thing, before + [*off, 0.0])
        world.refresh()
        # Nothing is within something else.
        if any(gap < -1e-3 for _, gap in world.gaps(thing, 1e-3)):
            world.place(thing, before)
            off = np.zeros(2)
        world.refresh()
    return world, float(np.linalg.norm(off))


def rows(command, args):
    """What is to be carried out, in order: the parameters of `trial`."""
    kinds, rates = set(args.kind or AIMS), profile(args.profile)
    for scene in args.scene or SCENES.get(args.robot, DEFAULT):
        for xml, query, witness in trials(command, args.robot, scene, kinds):
            for seed in range(args.seeds):
                yield scene, xml, query, witness, rates, seed


def carried(jobs, items):
    """Results of `trial` in the order of its parameters, of which so many are carried out at a time."""
    if jobs == 1:
        yield from map(trial_of, items)
        return
    # Nothing that the parent holds, such as a picture's context, is safe in a copy of it.
    with multiprocessing.get_context("spawn").Pool(jobs) as pool:
        yield from pool.imap(trial_of, items)


def trial_of(one):
    """A trial by its parameters."""
    return trial(*one)


def at_least_one(text):
    """A number of processes."""
    number = int(text)
    if not 1 <= number <= 1024:
        raise argparse.ArgumentTypeError("from 1 to 1024")
    return number


def shard(text):
    """A share K/N of the trials: the number, and how many there are."""
    number, _, of = text.partition("/")
    if not (number.isdecimal() and of.isdecimal() and int(number) < int(of)):
        raise argparse.ArgumentTypeError("write a number and how many there are, from 0/4 to 3/4 for four shards")
    return int(number), int(of)


def trial(scene, xml, query, witness, rates=None, seed=0):
    """Carries out one verdict in a fresh world. Answers the trial, and the seconds simulated and of the processor."""
    world, off = disturbed(xml, query, rates or profile("ideal"), Chance(seed))
    begun = time.process_time()
    found = carry_out(world, query.replace("`", ""), witness)
    return Trial(os.path.basename(scene), query, seed, found, off), world.now, time.process_time() - begun


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--robot", required=True, help="a built-in name, or a folder with a robot.toml")
    parser.add_argument("--scene", action="append", help="a built-in name, or a JSON file; repeatable")
    parser.add_argument("--motet", help="the command `motet` [default: from PATH]")
    parser.add_argument("--kind", action="append", choices=["reach", "go_to", "pull", "push", "put"],
                        help="kind of motion; repeatable [default: all]")
    parser.add_argument("--profile", default="ideal", metavar="ideal|typical|harsh|FILE",
                        help="errors and friction of the trials [default: ideal]")
    parser.add_argument("--seeds", type=int, default=1, help="trials of each verdict, with seeds from 0 on [default: 1]")
    parser.add_argument("-j", "--jobs", type=at_least_one, default=1,
                        help="trials at a time; the figures of times are of one [default: 1]")
    parser.add_argument("--shard", type=shard, default=(0, 1), metavar="K/N", help="each N-th trial from the K-th on")
    parser.add_argument("--format", choices=["human", "json"], default="human")
    args = parser.parse_args(arguments)
    simulated, taken, done = 0.0, 0.0, []
    try:
        items = itertools.islice(rows(find_motet(args.motet), args), args.shard[0], None, args.shard[1])
        for one, seconds, processor in carried(args.jobs, items):
            simulated, taken = simulated + seconds, taken + processor
            done.append(one)
            told(one, args.format)
    except ModelError as error:
        print("error: %s" % error, file=sys.stderr)
        return 2
    summary(args, done, simulated, taken)
    return 0


def told(done, form):
    """Prints a trial."""
    if form == "json":
        print(json.dumps({"scene": done.scene, "query": done.query, "seed": done.seed, "holds": bool(done.holds),
                          "why": done.why, "error": rounded(done.error[0]),
                          "end_error": rounded(done.error[1])}), flush=True)
    else:
        print("%-12s %-32s %3d %-4s %s" % (done.scene, done.query, done.seed, "yes" if done.holds else "NO", done.why),
              flush=True)


def rounded(error):
    """An error in m and rad, to 10 µm and 10 µrad."""
    return [round(float(part), 5) for part in error]


def interval(held, of):
    """Interval of a share at 95 %, after Wilson 1927."""
    if of == 0:
        return 0.0, 1.0
    z, share = 1.959964, held / of
    middle, spread = share + z * z / (2 * of), z * np.sqrt(share * (1 - share) / of + z * z / (4 * of * of))
    return max(0.0, (middle - spread) / (1 + z * z / of)), min(1.0, max(share, (middle + spread) / (1 + z * z / of)))


def aim_of(kind, robot):
    """Share of a kind that physics shall bear out."""
    aim = AIMS[kind]
    return aim.get(robot, 0.9) if isinstance(aim, dict) else aim


def summary(args, done, simulated, taken):
    """Prints the shares."""
    shares = {}
    for one in done:
        shares.setdefault(one.kind(), []).append(bool(one.holds))
    # Where nothing is held or touched, so that nothing bends the arm; `pull` counts the way to the handle and
    # back.
    free = [one.error for one in done if one.kind() in ("reach", "go_to", "pull")]
    error = np.max(free, axis=0) if free else np.zeros((2, 2))
    if args.format == "json":
        found = {kind: {"held": sum(held), "of": len(held), "interval": interval(sum(held), len(held)),
                        "aim": aim_of(kind, args.robot)} for kind, held in shares.items()}
        print(json.dumps({"robot": args.robot, "profile": args.profile, "seeds": args.seeds, "shares": found,
                          "error": rounded(error[0]), "end_error": rounded(error[1]),
                          "simulated_secs": simulated, "processor_secs": taken}))
        return
    print()
    for kind, held in shares.items():
        low, high = interval(sum(held), len(held))
        print("%-6s %3d of %3d borne out, %5.1f %% (%.1f to %.1f; aim %.0f %%)"
              % (kind, sum(held), len(held), 100.0 * sum(held) / len(held), 100.0 * low, 100.0 * high,
                 100.0 * aim_of(kind, args.robot)))
    print("the hand is off its witness by at most %.2f mm and %.2f mrad along a path,"
          " %.2f mm and %.2f mrad at its end" % tuple(error.ravel() * 1e3))
    print("%.0f s simulated in %.0f s of the processor: %.0f times real time" % (simulated, taken,
                                                                                 simulated / max(taken, 1e-9)))


if __name__ == "__main__":
    sys.exit(main())
