"""Motion: paths with times, and inverse kinematics for short straight motions of the hand."""

import mujoco
import numpy as np

# Cosine above which a path goes on through a waypoint without a stop.
STRAIGHT = 0.97
# Shares of the longest overlap of two legs that are tried.
SHARES = (1.0, 0.75, 0.5, 0.25)


class Path:
    """Targets of the actuators over time: straight legs, each from rest to rest with an even acceleration.

    `legs` has the duration and the ramp of each leg in s. A leg begins before the one ahead of it has ended by its
    overlap: without one the path stops at each waypoint, and with one it goes by it.
    """

    def __init__(self, points, legs, overlaps=None):
        self.points = [np.asarray(point, dtype=float) for point in points]
        self.legs = [(float(span), min(float(ramp), float(span) / 2.0)) for span, ramp in legs]
        self.ways = [after - before for before, after in zip(self.points, self.points[1:])]
        self.overlaps = list(overlaps) if overlaps is not None else [0.0] * max(len(self.legs) - 1, 0)
        self.starts, now = [], 0.0
        for (span, _), overlap in zip(self.legs, [*self.overlaps, 0.0]):
            self.starts.append(now)
            now += span - overlap
        self.end = now  # time at which the path ends, in s

    def at(self, time):
        """Targets and their rates at a time."""
        target, rate = self.points[0].copy(), np.zeros_like(self.points[0])
        for start, (span, ramp), way in zip(self.starts, self.legs, self.ways):
            if time >= start + span:
                target += way
            elif time > start:
                share, speed = trapezoid(time - start, span, ramp)
                target += way * share
                rate += way * speed
        return target, rate

    def blended(self, model, is_free=None):
        """The path with overlaps within the accelerations of a model, where a leg goes on in the direction of the one
        before, and where `is_free` says that targets may be passed: (start of the first leg, corner, targets) → bool."""
        overlaps, before = [], 0.0
        for at in range(len(self.legs) - 1):
            most = self.longest(at, before, model)
            found = 0.0
            for share in SHARES if most > 0.02 else ():
                trial = Path(self.points, self.legs, [*overlaps, most * share, *[0.0] * (len(self.legs) - 2 - at)])
                start = trial.starts[at + 1]
                times = np.linspace(start, start + most * share, max(int(most * share / 0.1), 3))
                targets = [trial.at(time)[0] for time in times]
                if self.goes_on(at) or is_free is not None and is_free(self.points[at], self.points[at + 1], targets):
                    found = most * share
                    break
            overlaps.append(found)
            before = found
        return Path(self.points, self.legs, overlaps)

    def goes_on(self, at):
        """True if a leg goes on in the direction of the one before: the path between them is not left."""
        before, after = self.ways[at], self.ways[at + 1]
        sizes = np.linalg.norm(before) * np.linalg.norm(after)
        return bool(sizes > 1e-12 and before @ after / sizes > STRAIGHT)

    def longest(self, at, taken, model):
        """Longest overlap in s of a leg with the next that exceeds no speed and no acceleration."""
        (span, ramp), (span_after, ramp_after) = self.legs[at], self.legs[at + 1]
        before, after = self.ways[at], self.ways[at + 1]
        shared = (np.abs(before) > 1e-6) & (np.abs(after) > 1e-6)
        if not shared.any():
            return max(min(span - taken, span_after), 0.0)
        # It brakes for the one and accelerates for the other at once.
        braking, rising = before / max(ramp * (span - ramp), 1e-9), after / max(ramp_after * (span_after - ramp_after), 1e-9)
        most = np.maximum(model.speeds / model.ramps, np.maximum(np.abs(braking), np.abs(rising)))
        if np.any(np.abs(rising - braking)[shared] > 1.01 * most[shared]):
            return 0.0
        return max(min(ramp, ramp_after, span - taken, span_after), 0.0)

    def slower(self, factor):
        """The path in a multiple of its time."""
        legs = [(span * factor, ramp * factor) for span, ramp in self.legs]
        return Path(self.points, legs, [overlap * factor for overlap in self.overlaps])


def trapezoid(time, span, ramp):
    """Share of a leg that is done at a time, and its rate: even acceleration, even speed, even braking."""
    fastest = 1.0 / max(span - ramp, 1e-9)
    left = span - time
    if time < ramp:
        return fastest * time * time / (2.0 * ramp), fastest * time / ramp
    if left < ramp:
        return 1.0 - fastest * left * left / (2.0 * ramp), fastest * left / ramp
    return fastest * (time - ramp / 2.0), fastest


def timed(points, model, share=1.0):
    """A path at a share of the greatest speeds and accelerations of a model, which stops at its waypoints."""
    speeds, legs = np.maximum(model.speeds * share, 1e-6), []
    for before, after in zip(points, points[1:]):
        far = np.abs(np.asarray(after) - before)
        moves = far > 1e-9
        if not moves.any():
            legs.append((0.0, 0.0))
            continue
        fastest = np.min(speeds[moves] / far[moves])
        strongest = np.min(speeds[moves] / model.ramps[moves] / far[moves])
        cruise = max(1.0 / fastest, 1.0 / np.sqrt(strongest))
        ramp = min(1.0 / (strongest * cruise), cruise)
        legs.append((cruise + ramp, ramp))
    return Path(points, legs)


def witnessed(points, path):
    """A path at the times of a witness, whose waypoints have `at` and `ramp`."""
    ats = [one["at"] for one in path]
    legs = [(after - before, one.get("ramp", 0.0)) for before, after, one in zip(ats, ats[1:], path[1:])]
    return Path(points, legs)


def near_turn(angle, to):
    """The angle nearest to another of those that differ by full turns."""
    return angle + 2.0 * np.pi * round((to - angle) / (2.0 * np.pi))


def phases(points, grips, deed="move"):
    """The parts of a path between what its hand does: `move`, `grip`, `draw` with closed fingers, `release`."""
    parts = [(deed, [points[0]])]
    for before, after in zip(points, points[1:]):
        point = np.array(after)
        further = sum(abs(after[at] - opened) - abs(before[at] - opened) for at, (opened, _) in grips.items())
        if deed == "move" and further > 1e-6 and not any(part == "release" for part, _ in parts):
            parts.append(("grip", []))
            deed = "draw"
        elif deed == "draw" and further < -1e-6:
            parts.append(("release", []))
            deed = "move"
        if deed == "draw":
            for at, (_, closed) in grips.items():
                point[at] = closed
        if parts[-1][0] in ("grip", "release"):
            start = parts[-2][1][-1].copy()
            start[list(grips)] = point[list(grips)]
            parts.append((deed, [start]))
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

    def solve(self, qpos, target, place, rotation, rounds=60):
        """Targets near to given ones with the hand at a pose, or None. `qpos` holds everything else."""
        model, data = self.model, self.data
        mj = model.mj
        target = np.array(target, dtype=float)
        low, high = limits(model)
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
            jacobian = np.vstack([jac_p, jac_r])[:, model.control_qvel] * self.weights
            error = np.concatenate([off, turn])
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-4 * np.eye(6), error)
            target = np.clip(target + self.weights * np.clip(step, -0.2, 0.2), low, high)
        return None


def set_targets(model, data, qpos, target):
    """Puts the joints of the actuators at targets, and those that follow them where they belong."""
    mj = model.mj
    data.qpos[:] = qpos
    data.qpos[model.control_qpos] = target
    for at in range(mj.neq):
        if mj.eq_type[at] == mujoco.mjtEq.mjEQ_JOINT and mj.eq_obj2id[at] >= 0:
            leader = data.qpos[mj.jnt_qposadr[mj.eq_obj2id[at]]]
            factors = mj.eq_data[at, :2]
            data.qpos[mj.jnt_qposadr[mj.eq_obj1id[at]]] = factors[0] + factors[1] * leader


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
