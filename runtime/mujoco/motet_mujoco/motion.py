"""Motion: paths with times, and inverse kinematics for short straight motions of the hand."""

import mujoco
import numpy as np

# Cosine above which a path goes on through a waypoint without a stop.
STRAIGHT = 0.97


class Path:
    """Targets of the actuators over time: straight between waypoints, from rest to rest."""

    def __init__(self, points, times):
        self.points = [np.asarray(point, dtype=float) for point in points]
        self.times = np.asarray(times, dtype=float)
        # The speed along the path at each waypoint, in legs per second: where it turns, it stops.
        count = len(self.points)
        self.rates = np.zeros(count)
        for at in range(1, count - 1):
            before, after = self.points[at] - self.points[at - 1], self.points[at + 1] - self.points[at]
            sizes = np.linalg.norm(before) * np.linalg.norm(after)
            if sizes > 1e-12 and before @ after / sizes > STRAIGHT:
                # In the units of the target, so that a leg of another length has the same speed.
                first = np.linalg.norm(before) / max(self.times[at] - self.times[at - 1], 1e-9)
                second = np.linalg.norm(after) / max(self.times[at + 1] - self.times[at], 1e-9)
                self.rates[at] = 2.0 * first * second / max(first + second, 1e-12)

    @property
    def end(self):
        """Time at which the path ends."""
        return float(self.times[-1])

    def at(self, time):
        """Targets and their rates at a time."""
        if time >= self.times[-1]:
            return self.points[-1], np.zeros_like(self.points[-1])
        leg = max(int(np.searchsorted(self.times, time, side="right")) - 1, 0)
        start, end = self.points[leg], self.points[leg + 1]
        span = self.times[leg + 1] - self.times[leg]
        size = np.linalg.norm(end - start)
        if span <= 1e-9 or size < 1e-12:
            return end, np.zeros_like(end)
        # A cubic from the speed before to the speed after.
        u = min(max((time - self.times[leg]) / span, 0.0), 1.0)
        a, b = self.rates[leg] * span / size, self.rates[leg + 1] * span / size
        share = u * (a + u * (3.0 - 2.0 * a - b + u * (a + b - 2.0)))
        rate = (a + u * (2.0 * (3.0 - 2.0 * a - b) + 3.0 * u * (a + b - 2.0))) / span
        return start + (end - start) * share, (end - start) * rate


def timed(points, speeds, share=1.0):
    """A path at a share of the greatest speeds, leg by leg: its slowest part half as fast again as on average."""
    times = [0.0]
    for before, after in zip(points, points[1:]):
        needed = np.max(np.abs(np.asarray(after) - before) / np.maximum(speeds * share, 1e-6))
        times.append(times[-1] + max(1.5 * float(needed), 0.0 if needed < 1e-9 else 0.1))
    return Path(points, times)


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
