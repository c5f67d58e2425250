"""Checks exported witnesses with pinocchio and coal: `verify.py WITNESSES [--most N]`.

Kinematics, shapes and distances are those of the two libraries, read from the robot's URDF; from the file come the obstacles, which
links may touch, and the path. A witness holds where every joint stays within its limits, nothing that may not touch comes nearer than
1 mm at samples no farther than 1 cm and 0.02 rad apart, and the hand ends at the grasp.
"""

import argparse
import json
import math
import sys

import coal
import numpy as np
import pinocchio as pin

from room import followers, obstacle, pose, turn_joints, urdf

GAP = 0.001


class Robot:
    def __init__(self, name, case):
        path = urdf(name)
        self.model = pin.buildModelFromUrdf(path)
        self.data = self.model.createData()
        self.geometry = pin.buildGeomFromUrdf(self.model, path, pin.GeometryType.COLLISION)
        self.placed = self.geometry.createData()
        self.variables = case["variables"]
        self.follows = followers(name)
        self.base = self.model.getFrameId(case["base_link"])
        self.tip = self.model.getFrameId(case["tip"])
        self.links = [self.model.frames[it.parentFrame].name for it in self.geometry.geometryObjects]
        apart = {frozenset(pair) for pair in case["apart"]}
        count = len(self.links)
        self.pairs = [
            (a, b) for a in range(count) for b in range(a + 1, count)
            if frozenset((self.links[a], self.links[b])) in apart
        ]
        self.carried, self.members = set(case["carried"]), set(case["members"])
        self.drives, self.height = case["drives"], case["height"]
        self.radii = np.array([ball(it.geometry) for it in self.geometry.geometryObjects])
        self.one, self.two = np.array(self.pairs, dtype=int).reshape(-1, 2).T
        self.moves = np.array([self.drives or link in self.carried for link in self.links])

    def place(self, base, joints):
        """Poses of the shapes and of the tip in the map, and whether every joint is within its limits."""
        q = pin.neutral(self.model)
        turn_joints(self.model, q, dict(zip(self.variables, joints)), self.follows)
        ok = all(
            self.model.lowerPositionLimit[j.idx_q] - 1e-9 <= q[j.idx_q] <= self.model.upperPositionLimit[j.idx_q] + 1e-9
            for name, j in zip(self.model.names, self.model.joints) if j.nq == 1 and name not in self.follows
        )
        pin.framesForwardKinematics(self.model, self.data, q)
        pin.updateGeometryPlacements(self.model, self.data, self.geometry, self.placed)
        x, y, yaw = base
        turn = pin.utils.rotate("z", yaw)
        root = pin.SE3(turn, np.array([x, y, self.height])) * self.data.oMf[self.base].inverse()
        return [root * it for it in self.placed.oMg], root * self.data.oMf[self.tip], ok


def ball(shape):
    """The radius of the ball about a shape's own origin that holds it."""
    shape.computeLocalAABB()
    return float(np.linalg.norm(shape.aabb_center)) + shape.aabb_radius


def touch(one, one_at, two, two_at):
    place = lambda at: coal.Transform3s(at.rotation, at.translation)
    return coal.distance(one, place(one_at), two, place(two_at), coal.DistanceRequest(), coal.DistanceResult()) <= GAP


class Things:
    """What stands in the room, and the balls about it."""

    def __init__(self, case):
        self.all = [obstacle(it) for it in case["obstacles"]]
        self.centres = np.array([at.translation for _, _, at in self.all]).reshape(-1, 3)
        self.radii = np.array([ball(solid) for _, solid, _ in self.all])


def fault(robot, case):
    things = Things(case)
    goal = pose(case["map_from_tip"])
    path = case["path"]
    tips = [robot.place(it["base"], it["joints"])[1] for it in path]
    may = next(i for i, tip in enumerate(tips) if np.linalg.norm(tip.translation - goal.translation) < 0.11)
    for leg, (one, two) in enumerate(zip(path, path[1:])):
        a, b = np.array(one["base"] + one["joints"]), np.array(two["base"] + two["joints"])
        way = np.abs(b - a)
        steps = max(1, math.ceil(max(np.hypot(way[0], way[1]) / 0.01, way[2:].max() / 0.02)))
        for step in range(steps + 1):
            at = a + (b - a) * (step / steps)
            placed, _, ok = robot.place(at[:3], at[3:])
            found = "beyond the limits" if not ok else hit(robot, things, placed, case["object"] if leg >= may else None)
            if found:
                return f"leg {leg}, {step} of {steps}: {found}"
    off = tips[-1].inverse() * goal
    if np.linalg.norm(off.translation) > 1e-6 or np.linalg.norm(pin.log3(off.rotation)) > 1e-6:
        return "the hand does not end at the grasp"
    return None


def hit(robot, things, placed, grasped):
    """What touches what may not be touched, of the shapes whose balls touch."""
    shapes = [it.geometry for it in robot.geometry.geometryObjects]
    centres = np.array([at.translation for at in placed])
    gaps = np.linalg.norm(centres[:, None] - things.centres, axis=2) - robot.radii[:, None] - things.radii
    for i, k in np.argwhere((gaps <= GAP) & robot.moves[:, None]):
        entity, solid, where = things.all[k]
        if entity == grasped and robot.links[i] in robot.members:
            continue
        if touch(shapes[i], placed[i], solid, where):
            return f"{robot.links[i]} and {entity}"
    floor = coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0)
    for i in np.flatnonzero(centres[:, 2] < robot.radii + GAP):
        if robot.links[i] in robot.carried and touch(shapes[i], placed[i], floor, pin.SE3.Identity()):
            return f"{robot.links[i]} and the floor"
    gaps = np.linalg.norm(centres[robot.one] - centres[robot.two], axis=1) - robot.radii[robot.one] - robot.radii[robot.two]
    for n in np.flatnonzero(gaps <= GAP):
        i, j = robot.pairs[n]
        if touch(shapes[i], placed[i], shapes[j], placed[j]):
            return f"{robot.links[i]} and {robot.links[j]}"
    return None


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("witnesses")
    arguments.add_argument("--most", type=int, default=1000, help="witnesses of each robot")
    settings = arguments.parse_args()
    robots, counts, wrong = {}, {}, 0
    for line in open(settings.witnesses, encoding="utf-8"):
        case = json.loads(line)
        name = case["robot"]
        if counts.get(name, 0) >= settings.most:
            continue
        counts[name] = counts.get(name, 0) + 1
        if name not in robots:
            robots[name] = Robot(name, case)
        found = fault(robots[name], case)
        if found:
            wrong += 1
            print(f"{case['name']}: {found}")
    print(f"{json.dumps(counts)}: {wrong} do not hold")
    sys.exit(1 if wrong else 0)


main()
