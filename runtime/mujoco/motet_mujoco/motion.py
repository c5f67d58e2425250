"""Motion: paths with times, and inverse kinematics for short straight motions of the hand."""

from bisect import bisect_right
from itertools import accumulate

import mujoco
import numpy as np

# Cosine above which a path goes on through a waypoint without a stop.
STRAIGHT = 0.97
# Shares of the longest overlap of two legs that are tried.
SHARES = (1.0, 0.75, 0.5, 0.25)
# Seconds between two checks of a corner that is cut.
CHECKED = 0.03
# Distance in m up to which the middle of the base leaves its way in a corner.
BASE_OFF = 0.003
# Greatest acceleration of the hand while it holds something, in m/s² and rad/s².
HELD = (1.0, 3.0)


class Path:
    """Targets of the actuators over time, in strokes: polylines from rest to rest, with an even acceleration.

    A stroke begins before the one ahead of it has ended by its overlap: without one the path stops where two strokes
    meet, and with one it goes by that corner.
    """

    def __init__(self, strokes, overlaps=None):
        self.strokes = strokes
        self.overlaps = list(overlaps) if overlaps is not None else [0.0] * max(len(strokes) - 1, 0)
        self.starts, now = [], 0.0
        for stroke, overlap in zip(strokes, [*self.overlaps, 0.0]):
            self.starts.append(now)
            now += stroke.span - overlap
        self.end = now  # time at which the path ends, in s
        # Targets after the first strokes, each of which ends before the next does.
        self.reached = [strokes[0].points[0]]
        for stroke in strokes:
            self.reached.append(self.reached[-1] + (stroke.points[-1] - stroke.points[0]))
        ends = [start + stroke.span for start, stroke in zip(self.starts, strokes)]
        self.ends = np.maximum.accumulate(ends).tolist()

    @property
    def points(self):
        """All waypoints."""
        return [self.strokes[0].points[0], *[point for stroke in self.strokes for point in stroke.points[1:]]]

    def at(self, time):
        """Targets, their rates and their accelerations at a time."""
        first = bisect_right(self.ends, time)
        target = self.reached[first].copy()
        rate, change = np.zeros((2, len(target)))
        for start, stroke in zip(self.starts[first:], self.strokes[first:]):
            if time >= start + stroke.span:
                target += stroke.points[-1] - stroke.points[0]
            elif time > start:
                moved, moves, changes = stroke.at(time - start)
                target += moved
                rate += moves
                change += changes
        return target, rate, change

    def blended(self, model, is_free):
        """The path with overlaps within the accelerations of a model, where `is_free` says that the targets on the way
        may be passed: (start of the first stroke, corner, targets) → bool."""
        overlaps, before, rest = [], 0.0, len(self.strokes) - 2
        for at, (one, other) in enumerate(zip(self.strokes, self.strokes[1:])):
            most, found = least_off(one, other, longest(one, other, before, model), model), 0.0
            for share in SHARES if most > 0.02 else ():
                trial = Path(self.strokes, [*overlaps, most * share, *[0.0] * (rest - at)])
                start = trial.starts[at + 1]
                times = np.linspace(start, start + most * share, max(int(most * share / CHECKED), 3))
                if is_free(one.points[0], one.points[-1], [trial.at(time)[0] for time in times]):
                    found = most * share
                    break
            overlaps.append(found)
            before = found
        return Path(self.strokes, overlaps)

    def slower(self, factor):
        """The path in a multiple of its time."""
        strokes = [one.slower(factor, one.share / factor**2) for one in self.strokes]
        return Path(strokes, [overlap * factor for overlap in self.overlaps])

    def to(self, points):
        """A path through other points, as many, at the same times."""
        strokes, first = [], 0
        for one in self.strokes:
            last = first + len(one.points) - 1
            strokes.append(Stroke(points[first : last + 1], one.cruise, one.span, one.ramp, one.share))
            first = last
        return Path(strokes)

    def until(self, points):
        """A path through the first of other points, at the same times."""
        return self.to([*points, *self.points[len(points) :]]).cut(len(points))

    def cut(self, count):
        """The path up to a number of waypoints. The last stroke takes the time that it would take as a whole."""
        strokes, left = [], count - 1
        for one in self.strokes:
            legs = min(left, len(one.cruise))
            if legs > 0:
                strokes.append(Stroke(one.points[: legs + 1], one.cruise[:legs], one.span, one.ramp, one.share))
            left -= legs
        return Path(strokes)


class Stroke:
    """A polyline from rest to rest: even acceleration for the time `ramp`, even speed, even braking.

    `cruise` has the seconds that each leg would take at the greatest speed of all its actuators, and `share` is the
    part of the greatest acceleration that may be used beside it.
    """

    def __init__(self, points, cruise, span, ramp, share=1.0):
        self.points = [np.array(point, dtype=float) for point in points]
        self.cruise, self.span, self.share = [float(one) for one in cruise], float(span), share
        self.ramp = min(float(ramp), self.span / 2.0)
        self.passed = list(accumulate(self.cruise, initial=0.0))

    def at(self, time):
        """How far the targets have moved since the start, their rates and their accelerations."""
        if time >= self.span or self.passed[-1] < 1e-9:
            return self.points[-1] - self.points[0], *np.zeros((2, len(self.points[0])))
        share, speed, change = trapezoid(time, self.span, self.ramp)
        whole = self.passed[-1]
        leg = min(bisect_right(self.passed, share * whole) - 1, len(self.cruise) - 1)
        way = (self.points[leg + 1] - self.points[leg]) / max(self.cruise[leg], 1e-9)
        done = way * (share * whole - self.passed[leg])
        if leg > 0:
            done += self.points[leg] - self.points[0]
        return done, way * (speed * whole), way * (change * whole)

    def reversed(self):
        """The same stroke from its end to its start."""
        return Stroke(self.points[::-1], self.cruise[::-1], self.span, self.ramp, self.share)

    def slower(self, factor, share):
        """The same stroke in a multiple of its time, with a share of the greatest acceleration."""
        return Stroke(self.points, self.cruise, self.span * factor, self.ramp * factor, share)


def longest(one, other, taken, model):
    """Longest overlap in s of a stroke with the next that exceeds no speed and no acceleration of a model."""
    if min(one.span, other.span) < 1e-6:
        return 0.0
    moves = [np.ptp(np.array(stroke.points), axis=0) > 1e-6 for stroke in (one, other)]
    shared = moves[0] & moves[1]
    if not shared.any():
        return max(min(one.span - taken, other.span), 0.0)
    # It brakes for the one and accelerates for the other at once.
    braking = one.at(one.span - one.ramp - 1e-6)[1] / max(one.ramp, 1e-9)
    rising = other.at(other.ramp + 1e-6)[1] / max(other.ramp, 1e-9)
    usual = min(one.share, other.share) * model.speeds / model.ramps
    most = np.maximum(usual, np.maximum(np.abs(braking), np.abs(rising)))
    if np.any(np.abs(rising - braking)[shared] > 1.01 * most[shared]):
        return 0.0
    return max(min(one.ramp, other.ramp, one.span - taken, other.span), 0.0)


def least_off(one, other, overlap, model):
    """An overlap in s of a stroke with the next, or the shorter one with which the base stays near its way."""
    if not model.drives or overlap <= 0.0:
        return overlap
    corner = one.points[-1][:2]
    ways = [part for part in (corner - one.points[-2][:2], other.points[1][:2] - corner) if np.linalg.norm(part) > 1e-9]
    if len(ways) < 2:
        return overlap

    def off(overlap):
        # How far the base is from the lines of both legs.
        path = Path([one, other], [overlap])
        rest = np.array([path.at(time)[0][:2] for time in np.linspace(path.starts[1], one.span, 9)]) - corner
        units = [way / np.linalg.norm(way) for way in ways]
        return np.min([np.abs(rest[:, 0] * unit[1] - rest[:, 1] * unit[0]) for unit in units], axis=0).max()

    while off(overlap) > BASE_OFF and overlap > CHECKED:
        # The way off grows with the square of the overlap.
        overlap *= min(0.98 * np.sqrt(BASE_OFF / off(overlap)), 0.9)
    return overlap


def trapezoid(time, span, ramp):
    """Share of a leg that is done at a time, its rate and its acceleration: even acceleration, even speed,
    even braking."""
    fastest = 1.0 / max(span - ramp, 1e-9)
    left = span - time
    if time < ramp:
        return fastest * time * time / (2.0 * ramp), fastest * time / ramp, fastest / ramp
    if left < ramp:
        return 1.0 - fastest * left * left / (2.0 * ramp), fastest * left / ramp, -fastest / ramp
    return fastest * (time - ramp / 2.0), fastest, 0.0


def timed(points, model, share=1.0, acceleration=None):
    """A path at shares of the greatest speeds and accelerations of a model; without a second one they are the same. It
    stops where its direction changes."""
    return Path([stroke(part, model, share, acceleration) for part in straight_parts(points)])


def straight_parts(points):
    """Parts of a polyline that go on in about a direction. Two parts have the point in common where they meet."""
    points = [np.asarray(point, dtype=float) for point in points]
    parts = [points[:2]]
    for point in points[2:]:
        before, after = parts[-1][-1] - parts[-1][-2], point - parts[-1][-1]
        sizes = np.linalg.norm(before) * np.linalg.norm(after)
        if sizes > 1e-12 and before @ after / sizes > STRAIGHT:
            parts[-1].append(point)
        else:
            parts.append([parts[-1][-1], point])
    return parts


def stroke(points, model, share, acceleration=None):
    """A stroke at shares of the greatest speeds and accelerations of a model."""
    speeds, cruise, hardest = np.maximum(model.speeds * share, 1e-6), [], 1e-6
    acceleration = share if acceleration is None else acceleration
    # Seconds from rest to these speeds.
    ramps = model.ramps * share / acceleration
    for before, after in zip(points, points[1:]):
        far = np.abs(np.asarray(after) - before)
        if model.drives:
            far[:2] = np.hypot(far[0], far[1])
        needed = far / speeds
        cruise.append(float(np.max(needed)))
        if cruise[-1] > 1e-9:
            # Time to the speed at which the leg takes so long.
            hardest = max(hardest, float(np.max(needed / cruise[-1] * ramps)))
    length = sum(cruise)
    if length < 1e-9:
        return Stroke(points, cruise, 0.0, 0.0, acceleration)
    fast = max(length, np.sqrt(length * hardest))
    ramp = min(length * hardest / fast, fast)
    return Stroke(points, cruise, fast + ramp, ramp, acceleration)


def witnessed(points, path, model, share, acceleration=None):
    """A path at the times of a witness, whose waypoints have `at` and `ramp`. Parts that go on in a direction take the
    time of the model instead: a witness stops at each of its waypoints."""
    strokes, first = [], 0
    for part in straight_parts(points):
        last = first + len(part) - 1
        if len(part) == 2:
            span = path[last]["at"] - path[first]["at"]
            cruise, ramp = [1.0 if span > 0.0 else 0.0], path[last].get("ramp", 0.0)
            strokes.append(Stroke(part, cruise, span, ramp, share if acceleration is None else acceleration))
        else:
            strokes.append(stroke(part, model, share, acceleration))
        first = last
    return Path(strokes)


def near_turn(angle, to):
    """The angle nearest to another of those that differ by full turns."""
    return angle + 2.0 * np.pi * round((to - angle) / (2.0 * np.pi))


def gentle(world, stroke):
    """A stroke on which the hand accelerates no more than a thing in it bears."""
    if stroke.span < 1e-6:
        return stroke
    middles = [(before + after) / 2.0 for before, after in zip(stroke.points, stroke.points[1:])]
    between = [point for pair in zip(stroke.points, middles) for point in pair]
    frames = [frame_at(world, point) for point in [*between, stroke.points[-1]]]
    far = sum(np.linalg.norm(one[0] - other[0]) for one, other in zip(frames, frames[1:]))
    turn = sum(np.linalg.norm(rotation_vector(other[1] @ one[1].T)) for one, other in zip(frames, frames[1:]))
    pace = max(far / HELD[0], turn / HELD[1]) / (stroke.ramp * (stroke.span - stroke.ramp))
    factor = max(1.0, np.sqrt(pace))
    return stroke.slower(factor, stroke.share)


def frame_at(world, target):
    """Position and rotation of the hand at targets of the actuators."""
    set_targets(world.model, world.reacher.data, world.data.qpos.copy(), target)
    return world.reacher.pose(world.reacher.data.qpos.copy())


def phases(points, grips, phase="move"):
    """The parts of a path between what its hand does: `move`, `grip`, `draw` with closed fingers, `release`."""

    def pressed(point):
        point = np.array(point)
        if phase == "draw":
            # A witness has the fingers as far apart as what they hold is wide.
            for at, (_, closed) in grips.items():
                point[at] = closed
        return point

    parts = [(phase, [pressed(points[0])])]
    for before, after in zip(points, points[1:]):
        further = sum(abs(after[at] - opened) - abs(before[at] - opened) for at, (opened, _) in grips.items())
        if phase == "move" and further > 1e-6 and not any(part == "release" for part, _ in parts):
            parts.append(("grip", []))
            phase = "draw"
        elif phase == "draw" and further < -1e-6:
            parts.append(("release", []))
            phase = "move"
        point = pressed(after)
        if parts[-1][0] in ("grip", "release"):
            start = parts[-2][1][-1].copy()
            start[list(grips)] = point[list(grips)]
            parts.append((phase, [start]))
        parts[-1][1].append(point)
    return parts


class Reacher:
    """Inverse kinematics of the hand by damped least squares, on data of its own."""

    def __init__(self, model):
        self.model = model
        self.data = mujoco.MjData(model.mj)
        # The base helps, but moves less.
        weights = np.ones(model.mj.nu)
        for at in model.grips:
            weights[at] = 0.0
        if model.drives:
            weights[:3] = [0.3, 0.3, 0.05]
        self.weights = weights

    def pose(self, qpos):
        """Position and rotation of the hand at positions of all joints."""
        data = self.data
        data.qpos[:] = qpos
        mujoco.mj_kinematics(self.model.mj, data)
        return data.site_xpos[self.model.tip].copy(), data.site_xmat[self.model.tip].reshape(3, 3).copy()

    def solve(self, qpos, target, place, rotation, ends=None, rounds=60):
        """Targets near to given ones with the hand at a pose, or None. `qpos` holds everything else. The base moves
        only where the arm alone does not get there. Ends are the least and greatest targets, where they are not those
        of the robot."""
        if self.model.drives:
            still = self.weights.copy()
            still[:3] = 0.0
            found = self.solved(still, qpos, target, place, rotation, ends, rounds)
            if found is not None:
                return found
        return self.solved(self.weights, qpos, target, place, rotation, ends, rounds)

    def solved(self, weights, qpos, target, place, rotation, ends, rounds):
        """Targets as `solve` gives them, with a weight for the motion of each actuator."""
        model, data = self.model, self.data
        mj = model.mj
        target = np.array(target, dtype=float)
        low, high = ends or limits(model)
        jac_p, jac_r = np.zeros((3, mj.nv)), np.zeros((3, mj.nv))
        for _ in range(rounds):
            set_targets(model, data, qpos, target)
            mujoco.mj_kinematics(mj, data)
            mujoco.mj_comPos(mj, data)
            off = place - data.site_xpos[model.tip]
            turn = rotation_vector(rotation @ data.site_xmat[model.tip].reshape(3, 3).T)
            if np.linalg.norm(off) < 1e-4 and np.linalg.norm(turn) < 1e-3:
                return target
            mujoco.mj_jacSite(mj, data, jac_p, jac_r, model.tip)
            jacobian, error, free = np.vstack([jac_p, jac_r])[:, model.control_qvel], np.concatenate([off, turn]), weights
            for _ in range(2):
                moves = jacobian * free
                step = moves.T @ np.linalg.solve(moves @ moves.T + 1e-4 * np.eye(6), error)
                # What is at its end leaves the rest of the way to the others.
                free = np.where((target <= low) & (step < 0.0) | (target >= high) & (step > 0.0), 0.0, free)
            target = np.clip(target + free * np.clip(step, -0.2, 0.2), low, high)
        return None


def set_targets(model, data, qpos, target):
    """Puts the joints of the actuators at targets, and those that follow them where they belong."""
    placed = qpos.copy()
    placed[model.control_qpos] = target
    for follower, leader, offset, factor in model.followers:
        placed[follower] = offset + factor * placed[leader]
    data.qpos[:] = placed


def limits(model):
    """Least and greatest targets of the actuators."""
    mj = model.mj
    joints = mj.actuator_trnid[:, 0]
    limited = mj.jnt_limited[joints].astype(bool)
    ranges = mj.jnt_range[joints]
    return np.where(limited, ranges[:, 0], -np.inf), np.where(limited, ranges[:, 1], np.inf)


def rotation_vector(rotation):
    """The axis of a rotation times its angle."""
    quaternion = np.zeros(4)
    mujoco.mju_mat2Quat(quaternion, np.ascontiguousarray(rotation).ravel())
    vector = np.zeros(3)
    mujoco.mju_quat2Vel(vector, quaternion, 1.0)
    return vector
