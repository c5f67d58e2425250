"""The judge: carries out every motion that Motet calls feasible, and reports the share that physics bears out.

    python -m motet_mujoco.judge --robot hsr [--scene kitchen]… [--profile typical --seeds 10]

`reach` holds if the hand still holds the thing 1.5 s after everything else that bore it is gone, and `reach_at` if it
also closed at its point. `go_to` and `stand_at` hold if the base arrives without touching anything, and `posture` if the
arm does. `look` holds if the camera then sees the entity. `pull` and `push` hold if the drawer or door is then open or
closed. `put` holds if the thing comes to rest on or in what it was put on, upright, and `offer` if the hand still holds it
before the person. What the hand holds at the start, it holds at the end.

With a profile, each verdict is carried out once for each seed: the friction is another one, and the thing is not quite
where it was seen and the hand not quite where it was sent.
"""

import argparse
import itertools
import json
import multiprocessing
import sys
import time

import numpy as np

from .beliefs import Beliefs
from .camera import HEIGHT, WIDTH
from .chance import Chance, profile
from .eyes import extent
from .jaw import FEELS_AT, spared
from .model import Model, ModelError, find_motet
from .motion import Path, frame_at, gentle, phases, rotation_vector, timed
from .sight import first
from .verdicts import BEGINNINGS, DEFAULT, SCENES, trials
from .world import World

# Aims: shares that physics shall bear out.
AIMS = {"reach": {"hsr": 0.95, "anymal_z1": 0.9, "panda": 0.95}, "reach_at": 0.9, "go_to": 1.0, "stand_at": 1.0,
        "posture": 1.0, "look": 0.95, "pull": 0.9, "push": 0.9, "put": 0.9, "offer": 0.9}
# Distance in m and angle in rad of the hand from its witness along a path on which it holds nothing, and of the base at
# its end.
WITHIN = (0.003, 0.002)
# Distance in m of the point of a grasp from the plane across the fingers in which they close.
AT_POINT = 0.02
# Distance of points from the middle of an entity, as a share of its half extents: those of `look`.
OUT = 0.8
# Distances in m from the middle of a person at which they take a thing, heights of it as shares of their stature, and the
# cosine of its greatest tilt: those of `offer`, with 3 cm and 5° more.
TAKES, AT_HEIGHTS, UPRIGHT = (0.27, 0.78), (0.4, 0.82), 0.82
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
    arguments, held = [part.strip() for part in rest.rstrip(")").split(",")], world.model.scene["robot"].get("holding")
    if held is not None:
        world.settle_in_hand(held)
        if not world.holds(held):
            return False, "no grip at the start", np.zeros((2, 2))
    judge = {"reach": reach, "reach_at": reach_at, "go_to": go_to, "stand_at": go_to, "posture": posture, "look": look,
             "pull": pull, "push": pull, "put": put, "offer": offer}[kind]
    points = world.targets(witness["path"])
    if held is not None and kind != "put":
        # A witness has the fingers as far apart as what they hold is wide: so they would not press it.
        for point in points:
            point[list(world.model.grips)] = world.target[list(world.model.grips)]
    holds, why, error = judge(world, arguments, points, witness, share)
    if holds and held is not None and kind != "put" and not world.holds(held):
        return False, "loses %s" % held, error
    return holds, why, error


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


def reach(world, arguments, points, _witness, share, point=None):
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
    off = 0.0 if point is None else abs(float((world.tip()[1].T @ (point - world.tip()[0]))[0]))
    if off > AT_POINT:
        return False, "closes %.0f mm beside the point" % (off * 1e3), error
    support_gone(world, thing)
    at = world.in_hand(thing)
    world.wait(HOLDS)
    slip = np.linalg.norm(world.in_hand(thing) - at)
    if not world.holds(thing):
        return False, "falls", error
    if slip > SLIPS:
        return False, "slips by %.0f mm" % (slip * 1e3), error
    return True, "slips by %.1f mm" % (slip * 1e3), error


def reach_at(world, arguments, points, witness, share):
    place = np.array([float(part.removeprefix("pose(").removesuffix(" m")) for part in arguments[1:4]])
    return reach(world, arguments, points, witness, share, place)


def support_gone(world, thing):
    """Lets a thing touch nothing but the hand."""
    mj = world.model.mj
    for at in range(mj.ngeom):
        if at not in world.model.hand_geoms and world.model.geom_owner[at] != thing:
            mj.geom_contype[at] = mj.geom_conaffinity[at] = 0


def go_to(world, _arguments, points, _witness, share):
    error, met = arrived(world, points, share)
    if met is not None:
        return False, "touches %s" % met, error
    off = np.abs(world.base() - points[-1][:3]) if world.model.drives else np.zeros(3)
    is_there = np.hypot(*off[:2]) <= WITHIN[0] and off[2] <= WITHIN[1]
    return bool(is_there), "off by %.1f mm, %.1f mrad" % (np.hypot(*off[:2]) * 1e3, off[2] * 1e3), error


def arrived(world, points, share):
    """Error of the hand along points and at their end, and what the robot touches on the way."""
    held = world.held()
    error = follow(world, points, share, until=lambda: world.bumped(held) is not None)
    return error, world.bumped(held)


def posture(world, _arguments, points, _witness, share):
    error, met = arrived(world, points, share)
    if met is not None:
        return False, "touches %s" % met, error
    is_free = not world.held()
    off = "off by %.1f mm, %.1f mrad" % tuple(error[0] * 1e3)
    return bool(np.all(error[0] <= WITHIN) or not is_free), off, error


def look(world, arguments, points, _witness, share):
    error, met = arrived(world, points, share)
    if met is not None:
        return False, "touches %s" % met, error
    camera = next((one for one in world.model.cameras if shows(world, one, arguments[0])), None)
    return camera is not None, "out of view" if camera is None else "in view of %s" % camera, error


def shows(world, camera, one):
    """True if a camera as it is turned has in its picture, and in its range, a point of an entity that no furniture,
    thing or person hides: its middle, or one of each of its parts."""
    model, data = world.model, world.data
    at = model.mj.camera(camera).id
    eye, axes, high = data.cam_xpos[at], data.cam_xmat[at].reshape(3, 3), np.tan(np.radians(model.mj.cam_fovy[at]) / 2.0)
    for point in points_of(world, one):
        x, y, z = axes.T @ (point - eye)
        is_framed = z < 0.0 and abs(y) <= -z * high and abs(x) <= -z * high * WIDTH / HEIGHT
        if is_framed and np.linalg.norm(point - eye) <= model.sight[camera][0] and first(model, data, eye, point) == one:
            return True
    return False


def points_of(world, one):
    """Points of an entity: its middle, and those on the axes of its shape and of its parts, such as its drawer."""
    model, data, body = world.model, world.data, world.model.body_of[one]
    steps = OUT * np.vstack([np.zeros(3), np.eye(3), -np.eye(3)])
    yield from data.xpos[body] + steps * extent(model.entities[one]) / 2.0 @ data.xmat[body].reshape(3, 3).T
    for geom in world.geoms(one):
        rotation, box = data.geom_xmat[geom].reshape(3, 3), model.mj.geom_aabb[geom]
        yield from data.geom_xpos[geom] + (box[:3] + steps * box[3:]) @ rotation.T


def offer(world, arguments, points, _witness, share):
    thing, person = arguments[:2]
    error, met = follow(world, points, share), world.bumped([thing])
    if met is not None:
        return False, "touches %s" % met, error
    place, stature = world.pose(thing)[0], world.model.entities[person]["shape"]["cylinder"]["height"]
    far, up = float(np.hypot(*(place - world.pose(person)[0])[:2])), world.data.xmat[world.model.body_of[thing]][8]
    is_near = TAKES[0] <= far <= TAKES[1] and AT_HEIGHTS[0] <= place[2] / stature <= AT_HEIGHTS[1] and up >= UPRIGHT
    return bool(is_near), "%.2f m from %s at a height of %.2f m, tilted by %.0f°" % (
        far, person, place[2], np.degrees(np.arccos(np.clip(up, -1.0, 1.0)))), error


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
    if kind not in ("reach", "reach_at"):
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
        for name, xml, query, witness in trials(command, args.robot, scene, kinds, args.begin or BEGINNINGS[:1]):
            for seed in range(args.seeds):
                yield name, xml, query, witness, rates, seed


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
    return Trial(scene, query, seed, found, off), world.now, time.process_time() - begun


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--robot", required=True, help="a built-in name, or a folder with a robot.toml")
    parser.add_argument("--scene", action="append", help="a built-in name, or a JSON file; repeatable")
    parser.add_argument("--motet", help="the command `motet` [default: from PATH]")
    parser.add_argument("--kind", action="append", choices=list(AIMS), help="kind of motion; repeatable [default: all]")
    parser.add_argument("--begin", action="append", choices=BEGINNINGS,
                        help="state that motions begin in: the start of the scene, each time with another drawer or door"
                             " open, or with a thing in the hand; repeatable [default: start]")
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
        print("%-24s %-36s %3d %-4s %s" % (done.scene, done.query, done.seed, "yes" if done.holds else "NO", done.why),
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
    free = [one.error for one in done if one.kind() not in ("put", "offer") and "holding" not in one.scene]
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
        print("%-8s %3d of %3d borne out, %5.1f %% (%.1f to %.1f; aim %.0f %%)"
              % (kind, sum(held), len(held), 100.0 * sum(held) / len(held), 100.0 * low, 100.0 * high,
                 100.0 * aim_of(kind, args.robot)))
    print("the hand is off its witness by at most %.2f mm and %.2f mrad along a path,"
          " %.2f mm and %.2f mrad at its end" % tuple(error.ravel() * 1e3))
    print("%.0f s simulated in %.0f s of the processor: %.0f times real time" % (simulated, taken,
                                                                                 simulated / max(taken, 1e-9)))


if __name__ == "__main__":
    sys.exit(main())
