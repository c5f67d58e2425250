"""Moving: what primitives have in common. A mover finds the motion of a command, follows it and brings it back.

Its parts are generators that aim the actuators once a tick; a task is made of them.
"""

import copy

import mujoco
import numpy as np

from .clearance import TOUCHES, Clearance
from .motion import Path, frame_at, gentle, limits, near_turn, timed, witnessed
from .planner import START, stand_at
from .trail import Trail

# Differences in m or rad up to which the robot stands at the beginning of a path.
BEGINS = 0.05
# Error in m or rad of a servo above which something is in the way.
BLOCKED = 0.12
# Seconds for which the robot pushes on against something, and after which a thing that the fingers do not feel is lost.
PUSHES, LOSES = 0.1, 0.05
# Distance in m by which the base moves away from what presses on the robot.
COMES_OFF = 0.08
# Distances in m that the base draws back where the arm has no room to fold.
RETREATS = (0.15, 0.3, 0.45)
# Heights in m from which the hand may let go of a thing.
LETS_GO = (0.01, 0.02)
# Heights in m by which the hand may go back above the way that it came.
RAISES = (0.06, 0.12, 0.18, 0.24)
# Way in m or rad between two checks of a straight way.
STEP = 0.05
# Seconds before its deadline by which a command is to be done.
SPARE = 1.0
# Queries of the postures of the arm.
POSTURES = {"home": "posture(home)", "ready": "posture(start)"}
# Seconds that pass for each place of which a plan is tried, so that no answer to the host takes long.
THINKS = 0.1


class Met(Exception):
    """Something presses on the robot."""


class Failed(Exception):
    """A failure of a primitive: its kind, and what happened, in words."""

    def __init__(self, kind, text):
        super().__init__(text)
        self.kind, self.text = kind, text


# Failure kinds by the reasons of geometry.
KINDS = {"blocked_path": "blocked", "no_free_pose": "unreachable", "out_of_reach": "unreachable",
         "too_heavy": "too_heavy", "not_in_view": "not_found"}


class Mover:
    """Moves the robot of a world along paths."""

    def __init__(self, world, observer, beliefs, planner, options):
        self.world, self.observer, self.beliefs = world, observer, beliefs
        # What the robot feels and knows: by its sensors, or with `--oracle` by the truth.
        self.room = observer.room
        self.planned = []  # motions of its own that nobody was told of
        self.planner, self.options = planner, options
        self.goal = world.target.copy()  # targets that the tasks aim at
        self.rate, self.change = np.zeros_like(self.goal), np.zeros_like(self.goal)
        self.lost = 0.0
        # The way that the robot came, and whether a motion ended on its way.
        self.trail, self.is_adrift = Trail(world.model.grips), False

    def aim(self, path, elapsed, mask):
        """Aims the actuators of a mask at a path."""
        target, rate, change = path.at(elapsed + self.world.tick / 2.0)
        self.goal[mask], self.rate[mask], self.change[mask] = target[mask], rate[mask], change[mask]

    def path(self, points, motion=None, share=1.0):
        """A path through points in the manner of a command, at a share of its speeds."""
        motion = motion or Motion(None)
        return timed(points, self.world.model, motion.speed * share, motion.acceleration * share)

    def follow(self, path, what=None, watch=None, keeps=None):
        """Follows a path. Fails with `blocked` where the robot meets something, or falls behind."""
        world, model = self.world, self.world.model
        path = self.smooth(path, keeps)
        points = path.points
        mask = np.any(np.abs(np.array(points) - points[0]) > 1e-9, axis=0)
        if not mask.any():
            return
        elapsed, behind = 0.0, 0.0
        led = np.array([at for at in np.flatnonzero(mask) if at not in model.grips], dtype=int)
        while elapsed < path.end:
            self.aim(path, elapsed, mask)
            elapsed += world.tick
            yield
            self.trail.add(self.goal)
            off = np.abs(world.data.qpos[model.control_qpos[led]] - self.goal[led])
            behind = behind + world.tick if off.max(initial=0.0) > BLOCKED else 0.0
            if behind > PUSHES:
                met = self.room.bumped() or what or "something"
                # What pushes on would push for ever.
                self.goal[mask] = world.data.qpos[model.control_qpos][mask]
                raise Failed("blocked", "%s is in the way" % met)
            if watch is not None:
                watch()
        self.goal[mask] = points[-1][mask]

    def smooth(self, path, keeps=None):
        """A path as it is followed from here: gently with a thing in the hand, and without stops that it does
        not need."""
        points = [self.goal.copy(), *(point.copy() for point in path.points[1:])]
        if self.room.held():
            for point in points:
                # A witness has the fingers as far apart as the thing is wide: so they would not press it.
                point[list(self.world.model.grips)] = self.goal[list(self.world.model.grips)]
        path = path.to(points)
        if self.room.held():
            path = Path([gentle(self.world, stroke) for stroke in path.strokes])
        if len(path.strokes) > 1:
            path = path.blended(self.world.model, Clearance(self.world, self.beliefs, keeps).is_free)
        return path

    def frame(self, target):
        """Position and rotation of the hand at targets of the actuators."""
        return frame_at(self.world, target)

    def grip(self, closed, seconds):
        """Closes or opens the hand over a time, from where its fingers are."""
        world, model = self.world, self.world.model
        start, elapsed = world.data.qpos[model.control_qpos], 0.0
        while elapsed < seconds - 1e-9:
            elapsed += world.tick
            for at, to in world.fingers(closed, start, 2.0 * elapsed / seconds).items():
                self.goal[at] = to
            yield

    def pause(self, seconds):
        """Waits."""
        elapsed = 0.0
        while elapsed < seconds - 1e-9:
            elapsed += self.world.tick
            yield

    def straight(self, way, motion, share=0.8):
        """Moves the hand along a short straight line in the map, as far as it goes, nothing is in the way and the robot
        does not touch itself."""
        world, clearance = self.world, Clearance(self.world, self.beliefs)
        room = Clearance(self.world, self.beliefs, TOUCHES)
        place, rotation = world.tip()
        target = self.goal
        for step in range(1, 5):
            further = self.reaching(target, place + way * step / 4.0, rotation, clearance)
            if further is None or not room.is_free(self.goal, target, [(target + further) / 2.0, further]):
                break
            target = further
        target = target.copy()
        for at in world.model.grips:
            target[at] = self.goal[at]
        yield from self.follow(self.path([self.goal.copy(), target], motion, share))

    def reaching(self, target, place, rotation, clearance):
        """Targets near to given ones with the hand at a pose at which the robot does not touch itself, or None. A joint
        that would bring its parts together stops before, and the others do the rest."""
        world = self.world
        found = world.reacher.solve(world.data.qpos, target, place, rotation)
        if found is None or not clearance.touches_itself(found):
            return found
        low, high = (end.copy() for end in limits(world.model))
        for at in np.flatnonzero(np.abs(found - target) > 1e-6):
            for share in (0.75, 0.5, 0.25, 0.0):
                shorter = found.copy()
                shorter[at] = target[at] + (found[at] - target[at]) * share
                if not clearance.touches_itself(shorter):
                    end = high if found[at] > target[at] else low
                    end[at] = shorter[at]
                    break
        found = world.reacher.solve(world.data.qpos, target, place, rotation, (low, high))
        return None if found is None or clearance.touches_itself(found) else found

    def motion(self, motion, query, fail="unreachable", scene=None, thing=None):
        """Path of the motion of a command, from where the robot stands; else of one of its own, in the room as it is
        believed to be unless another is given. A thing is one that it puts down."""
        path = self.sent(motion)
        if path is not None:
            return path
        follows = "its witness begins elsewhere" if motion.witness is not None else "it has no witness"
        scene = scene or self.beliefs.now()

        def plan():
            return self.planner.plan(scene, query) if thing is None else self.put_witness(
                scene, query, thing, self.planner.plan)

        (witness, why), is_posture = plan(), query.startswith("posture(")
        if witness is None and (is_posture or START in why[1]):
            # From here no motion begins.
            witness = yield from self.come_free(query if is_posture else POSTURES["home"], motion)
            if witness is not None and not is_posture:
                yield from self.follow(self.own(witness, motion))
                scene["robot"] = self.beliefs.now()["robot"]
                witness, why = plan()
        if witness is None:
            raise Failed(KINDS.get(why[0], fail), why[1])
        self.planned.append("%s, %s" % (query, follows))
        return self.own(witness, motion)

    def sent(self, motion):
        """Path of the witness of a command; None without one, or where the robot does not stand at its beginning."""
        points = None if motion.witness is None else self.points(motion.witness)
        if points is None or np.abs(points[0] - self.goal)[self.arm_and_base()].max() > BEGINS:
            return None
        return self.timed(points, motion.witness["path"], motion)

    def timed(self, points, path, motion):
        """A path at the times of a witness, or without them in the manner of a command."""
        times = [one.get("at") for one in path]
        has_times = None not in times and all(b >= a for a, b in zip(times, times[1:]))
        if not has_times:
            return self.path(points, motion)
        return witnessed(points, path, self.world.model, motion.speed, motion.acceleration)

    def own(self, witness, motion):
        """Path of a witness that was not made for the manner of the command."""
        path = self.timed(self.points(witness), witness["path"], Motion(None))
        return path.slower(motion.stretch)

    def points(self, witness):
        """Targets of the waypoints of a witness."""
        names = witness.get("joints")
        path = witness["path"]
        if names is not None:
            path = [{"base": one["base"], "joints": dict(zip(names, one["joints"]))} for one in path]
        saved, self.world.target = self.world.target, self.goal.copy()
        points = self.world.targets(path)
        self.world.target = saved
        return points

    def arm_and_base(self):
        """Actuators but for those of the hand."""
        return [at for at in range(len(self.goal)) if at not in self.world.model.grips]

    def way_back(self, path, begun, motion, thing):
        """Goes back the way it came with what it holds, and on to where the command leaves the robot."""
        start, strokes = self.goal.copy(), [stroke.reversed() for stroke in reversed(path.strokes)]
        for stroke in strokes:
            for point in stroke.points:
                point[list(self.world.model.grips)] = start[list(self.world.model.grips)]
        # The last approach again, higher: the thing still stands low, or in something with a rim.
        points = strokes[0].points
        points[0] = start
        after = points[2] if len(points) > 2 else strokes[1].points[1] if len(strokes) > 1 else None
        heights = (self.raised(points[1], height) for height in RAISES if after is not None)
        lifted = next((one for one in heights if one is not None and self.is_way(start, one, after)), None)
        if lifted is not None:
            first = self.path([start, lifted, after, *points[3:]], motion).strokes
            strokes[: 1 if len(points) > 2 else 2] = first
        watch = self.keeps(thing, "fell on the way back")
        points = Path(strokes).points
        free = len(points)
        while thing is not None and not self.is_way(*points[:free], keeps=TOUCHES):
            free -= 1
        if free < len(points):
            # From here on, what the hand holds would touch something on the way that the hand came.
            yield from self.follow(self.path(points[:free], motion), watch=watch)
            if (yield from self.home_again(begun, motion, watch)):
                return
            strokes = self.path(points[free - 1 :], motion).strokes
        while len(strokes) > 1 and self.world.now + self.smooth(Path(strokes)).end > motion.until - SPARE:
            # There is no time to go back all the way that the base came: only as far as the arm has room to fold.
            yield from self.follow(Path(strokes[:1]), watch=watch)
            if (yield from self.home_again(begun, motion, watch)):
                return
            strokes = strokes[1:]
        last, leaves = strokes[-1].points[-1], self.leaves(motion, begun)
        is_left, is_near = np.abs(leaves - last)[self.arm_and_base()].max() <= 1e-3, self.is_way(last, leaves)
        if not is_left and is_near:
            strokes.extend(self.path([last, leaves], motion).strokes)
        yield from self.follow(Path(strokes), watch=watch)
        if not is_left and not is_near:
            yield from self.stand(leaves, motion, watch)
        yield from self.pause(0.2)

    def draw_back(self, path, begun, motion):
        """Opens a hand that did not get what it reached for, and brings it back, to where the thing is not hidden by
        it."""
        yield from self.grip(False, 0.6)
        try:
            yield from self.straight(-0.08 * self.world.tip()[1][:, 2], motion)
            yield from self.way_back(path, begun, motion, None)
        except Failed:
            return

    def stand(self, leaves, motion, watch=None):
        """Drives to where a command leaves the robot, if there is a way and time for it, as far as nothing presses on
        the robot. Whoever stands behind an open door may have a long way back, and what comes next can begin here as
        well."""
        if motion.leaves is None or not self.world.model.drives or np.abs(leaves - self.goal)[:3].max() <= 1e-3:
            return
        witness, _ = self.planner.plan(self.beliefs.now(), stand_at(*leaves[:3]))
        path = None if witness is None else self.own(witness, motion)
        if path is None or self.world.now + path.end > motion.until - SPARE:
            return
        held = self.room.held()

        def meets():
            if watch is not None:
                watch()
            if self.room.bumped(held) is not None:
                raise Met

        try:
            yield from self.follow(path, watch=meets)
        except Met:
            self.goal[:3] = self.world.base()
            yield from self.come_off(motion)

    def is_way(self, *points, keeps=None):
        """True if nothing is too near on the straight ways between targets that is not so at the first of them."""
        clearance = Clearance(self.world, self.beliefs, keeps)
        ways = []
        for one, other in zip(points, points[1:]):
            steps = max(8, int(np.abs(other - one).max() / STEP))
            ways.extend(one + (other - one) * share for share in np.linspace(1.0 / steps, 1.0, steps))
        return clearance.is_free(points[0], points[0], ways)

    def keeps(self, thing, how="slipped out of the hand"):
        """A check that fails where a thing is lost from the hand; None without a thing."""
        if thing is None:
            return None
        self.lost = 0.0

        def watch():
            self.lost = 0.0 if self.room.holds(thing) else self.lost + self.world.tick
            if self.lost > LOSES:
                self.beliefs.forget(thing)
                raise Failed("slipped", "%s %s" % (thing, how))

        return watch

    def raised(self, point, height):
        """Targets near to others with the hand higher."""
        world = self.world
        place, rotation = self.frame(point)
        up = np.array([0.0, 0.0, height])
        raised = self.reaching(point, place + up, rotation, Clearance(world, self.beliefs))
        if raised is not None:
            for at in world.model.grips:
                raised[at] = point[at]
        return raised

    def leaves(self, motion, begun):
        """Targets where a command leaves the robot, as far as it says; else where it began."""
        if motion.leaves is None:
            return begun
        target = begun.copy()
        if self.world.model.drives and motion.leaves.get("base") is not None:
            x, y, yaw = motion.leaves["base"]
            target[:3] = [x, y, near_turn(yaw, self.goal[2])]
        joints = motion.leaves.get("joints") or {}
        for joint, value in (joints.items() if isinstance(joints, dict) else []):
            at = self.world.model.controls.get(joint)
            if at is not None:
                target[at] = value
        for at in self.world.model.grips:
            target[at] = self.goal[at]
        return target

    def home_again(self, begun, motion, watch=None):
        """Brings the robot to where the command leaves it, by a way of its own: the arm home, and the base to its
        place, if there is time for that. True if the arm is there or at home."""
        is_folded = yield from self.folded_again(begun, motion, watch)
        if is_folded:
            yield from self.stand(self.leaves(motion, begun), motion, watch)
        return is_folded

    def folded_again(self, begun, motion, watch=None):
        """Brings the arm home, unless it is where the command leaves it. The base draws back if the arm has no room to
        fold. True if the arm is there or at home."""
        leaves = self.leaves(motion, begun)
        if motion.leaves is not None and np.abs(self.goal - leaves)[self.arm_and_base()].max() <= 0.02:
            return True
        witness, _ = self.planner.plan(self.beliefs.now(), "posture(home)")
        if witness is None and self.world.model.drives:
            witness = yield from self.retreat("posture(home)", motion)
        if witness is None:
            return False
        yield from self.follow(self.own(witness, motion), watch=watch)
        self.observer.own.posture = "home"
        return True

    def put_witness(self, scene, query, thing, ask):
        """(witness, None), or (None, why), of a motion that puts a thing down in a room. Where the fingers
        would meet what is below it, the hand lets go from a little above."""
        witness, why = ask(scene, query)
        for height in LETS_GO:
            if witness is None and scene["robot"].get("grip"):
                _, rotation = self.world.tip_frame()
                up = np.zeros(3)
                mujoco.mju_rotVecQuat(up, np.array([0.0, 0.0, 1.0]), self.beliefs.held_pose(thing)[1])
                # As if the thing reached lower.
                lower = copy.deepcopy(scene)
                place = np.array(lower["robot"]["grip"]["xyz"]) - rotation.T @ up * height
                lower["robot"]["grip"]["xyz"] = [float(part) for part in place]
                witness, _ = ask(lower, query)
        return witness, None if witness is not None else why

    def from_rest(self, task, motion, anywhere=False):
        """A task that begins with the arm at rest, or anywhere: where a motion ended on its way, the arm comes back
        first."""
        if self.is_adrift and not anywhere:
            yield from self.fold(motion)
        begun, is_done = self.goal.copy(), False
        try:
            value = yield from task
            is_done = True
        finally:
            arm = self.world.model.arm
            self.is_adrift |= not is_done and bool(np.abs(self.goal - begun)[arm].max() > BEGINS)
        return value

    def come_off(self, motion):
        """Moves the base a little away from what presses on the robot, as its skin feels."""
        if not self.world.model.drives:
            return
        held, clearance = self.room.held(), Clearance(self.world, self.beliefs, TOUCHES)
        for turn in (0.0, 0.25, -0.25, 0.5, -0.5):
            if self.room.bumped(held) is None:
                return
            away = self.world.base()[:2] - np.mean(list(self.world.bumps()), axis=0)[:2]
            angle, target = float(np.arctan2(away[1], away[0])) + turn * np.pi, self.goal.copy()
            target[:2] += COMES_OFF * np.array([np.cos(angle), np.sin(angle)])
            if clearance.is_free(self.goal, self.goal, [(self.goal + target) / 2.0, target]):
                yield from self.follow(self.path([self.goal.copy(), target], motion))

    def fold(self, motion):
        """Brings the arm to where it was before a motion that ended on its way, if it finds a way there."""
        for query in (POSTURES[self.observer.own.posture], POSTURES["home"]):
            witness = yield from self.come_free(query, motion)
            if witness is not None:
                try:
                    yield from self.follow(self.own(witness, motion))
                except Failed:
                    return
                self.is_adrift = False
                return

    def come_free(self, query, motion):
        """Brings the robot to where a motion begins: opens a hand that holds nothing, and goes back the way that the
        robot came, or a little aside. Gives the witness of the motion from there, or None where there is none."""
        yield from self.let_go(motion)
        witness, _ = self.planner.plan(self.beliefs.now(), query)
        if witness is not None:
            return witness
        held = self.room.held()
        for left, way in self.trail.back(self.goal):
            if held and not self.is_way(*way, keeps=TOUCHES):
                # What the hand holds was not in it as it came.
                break
            yield from self.pause(THINKS)
            witness, _ = self.planner.plan(self.standing(way[-1]), query)
            if witness is not None:
                yield from self.follow(self.path(way, motion))
                del self.trail.points[left:]
                return witness
        return (yield from self.retreat(query, motion)) if self.world.model.drives else None

    def let_go(self, motion):
        """Opens a hand that is not open and holds nothing, as where it closed around something, and draws it back."""
        grips = self.world.model.grips.items()
        is_open = all(abs(self.goal[at] - opened) <= 0.1 * abs(closed - opened) for at, (opened, closed) in grips)
        if is_open or self.room.held():
            return
        yield from self.grip(False, 0.6)
        try:
            yield from self.straight(-0.08 * self.world.tip()[1][:, 2], motion)
        except Failed:
            return

    def standing(self, target):
        """The room as it is believed to be, with the robot at targets of the actuators."""
        scene, model = self.beliefs.now(), self.world.model
        robot = scene["robot"]
        robot["joints"] = {joint: float(target[model.controls[joint]]) for joint in robot["joints"]}
        if model.drives:
            robot["base"] = [float(part) for part in target[:3]]
        return scene

    def retreat(self, query, motion):
        """Moves the base a little to where it has room for a motion: against the way that the hand points, or to a
        side. Gives the witness of the motion from there, or None where there is no such place."""
        ahead, clearance = self.world.tip()[1][:2, 2], Clearance(self.world, self.beliefs)
        ahead = float(np.arctan2(ahead[1], ahead[0]))
        for far in RETREATS:
            for turn in (1.0, 0.75, -0.75, 0.5, -0.5, 0.25, -0.25):
                target = self.goal.copy()
                target[:2] += far * np.array([np.cos(ahead + turn * np.pi), np.sin(ahead + turn * np.pi)])
                between = [self.goal + (target - self.goal) * share for share in np.linspace(0.1, 1.0, 10)]
                if not clearance.is_free(self.goal, self.goal, between):
                    continue
                yield from self.pause(THINKS)
                witness, _ = self.planner.plan(self.standing(target), query)
                if witness is not None:
                    yield from self.follow(self.path([self.goal.copy(), target], motion))
                    return witness
        return None


class Motion:
    """What a command says about its motion: a witness with times, the manner, and where it leaves the robot."""

    def __init__(self, command, now=0.0):
        command = command or {}
        motions = command.get("motions") or ([command["motion"]] if command.get("motion") else [])
        self.witness = motions[0].get("witness") if motions else None
        # Values that the motion is about.
        self.about = motions[0].get("args", []) if motions else []
        self.leaves = command.get("leaves")
        # The time in s of the world by which it has to be done.
        self.until = now + float(command.get("deadline_secs") or np.inf)
        manner = command.get("manner") or {}
        self.speed = float(manner.get("speed", 1.0))
        self.acceleration = min(self.speed, float(manner.get("acceleration", 1.0)))
        # Times of a path as a multiple of the shortest.
        self.stretch = max(1.0 / self.speed, float(manner.get("acceleration", 1.0)) ** -0.5)

    def part(self):
        """A motion that is a part of this one: in the same manner, by the same time."""
        part = copy.copy(self)
        part.witness, part.about, part.leaves = None, [], None
        return part
