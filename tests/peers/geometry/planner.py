"""A robot in an exported room as pinocchio and coal see it: states, collisions, inverse kinematics."""

import math
import time

import coal
import numpy as np
import pinocchio as pin

from room import followers, obstacle, pose, turn_joints, urdf

GAP = 0.002


class Planner:
    """A state is `x y yaw` of the base, where it drives, the joints that move the tip, and how far the hand is open, where that has to
    change on the way, as a row of numbers."""

    def __init__(self, case):
        name = case["robot"]
        self.model = pin.buildModelFromUrdf(urdf(name), pin.JointModelFreeFlyer())
        self.shapes = pin.buildGeomFromUrdf(self.model, urdf(name), pin.GeometryType.COLLISION)
        self.follows = followers(name)
        self.drives, self.height, self.reach = case["drives"], case["height"], case["reach"]
        self.moves = case["moves"]
        self.tip = self.model.getFrameId(case["tip"])
        data = self.model.createData()
        self.rest = pin.neutral(self.model)
        pin.framesForwardKinematics(self.model, data, self.rest)
        self.base_from_root = data.oMf[self.model.getFrameId(case["base_link"])].inverse()
        fixed, self.stand = dict(zip(case["variables"], case["start"]["joints"])), case["start"]["base"]
        # With the hand open, as it stays where there is room for that at the start.
        opened = self.rest.copy()
        turn_joints(self.model, opened, dict(zip(case["variables"], case["open"])), self.follows)
        turn_joints(self.model, self.rest, fixed, self.follows)
        self.start = np.array((self.stand if self.drives else []) + [fixed[it] for it in self.moves])
        # How a state's joints turn all joints of the robot, with those that follow them, after the base's six.
        self.turns = np.zeros((self.model.nv - 6, len(self.moves)))
        for at, name in enumerate(self.moves):
            for row, factor in self.column(name):
                self.turns[row - 6, at] = factor
        self.opens, closed, self.rest = False, self.rest, opened
        self.still = self.rest[7:] - self.turns @ self.joints(self.start)
        lower, upper = zip(*(self.limits(name) for name in self.moves))
        self.room = room_about([it["pose"][:2] for it in case["obstacles"]] + [self.stand[:2]], 1.5)
        base = ([*self.room[0], -math.pi], [*self.room[1], math.pi]) if self.drives else ([], [])
        self.lower, self.upper = np.array([*base[0], *lower]), np.array([*base[1], *upper])
        # Seconds in compiled collision checks.
        self.inside = 0.0
        self.furnish(case)
        if not self.is_free(self.start):
            self.close(closed)

    def close(self, closed):
        """How far the hand is open becomes one more number of a state, from 0 at the start to 1 at a grasp."""
        self.opens = True
        self.still = self.still + closed[7:] - self.rest[7:]
        self.turns = np.hstack([self.turns, (self.rest - closed)[7:, None]])
        self.start = np.append(self.start, 0.0)
        self.lower, self.upper = np.append(self.lower, 0.0), np.append(self.upper, 1.0)

    def limits(self, name):
        """Those of a joint, and of what follows it as they are for the joint."""
        low, high = -math.inf, math.inf
        for it, factor, more in [(name, 1.0, 0.0)] + [(it, f, o) for it, (of, f, o) in self.follows.items() if of == name]:
            joint = self.model.joints[self.model.getJointId(it)]
            ends = [(limit[joint.idx_q] - more) / factor for limit in (self.model.lowerPositionLimit, self.model.upperPositionLimit)]
            low, high = max(low, min(ends)), min(high, max(ends))
        return low, high

    def column(self, name):
        """The joints that turn with one, with their factors."""
        turned = [(name, 1.0)] + [(it, factor) for it, (of, factor, _) in self.follows.items() if of == name]
        joints = [(self.model.joints[self.model.getJointId(it)], factor) for it, factor in turned]
        assert all(joint.nq == 1 for joint, _ in joints), "a joint without limits"
        return [(joint.idx_v, factor) for joint, factor in joints]

    def joints(self, state):
        return state[3:] if self.drives else state

    def furnish(self, case):
        """Shapes of the room, and the pairs that may not touch: all, and all but the hand with the object."""
        robot = list(self.shapes.geometryObjects)
        link = [self.model.frames[it.parentFrame].name for it in robot]
        carried, members = set(case["carried"]), set(case["members"])
        things = [obstacle(it) for it in case["obstacles"]]
        floor = ("", coal.Halfspace(np.array([0.0, 0.0, 1.0]), 0.0), pin.SE3.Identity())
        indices = []
        for number, (_, solid, at) in enumerate([*things, floor]):
            indices.append(self.shapes.addGeometryObject(pin.GeometryObject(f"thing {number}", 0, 0, at, solid)))
        apart = {frozenset(pair) for pair in case["apart"]}
        pairs, held = [], []
        for i in range(len(robot)):
            pairs += [(i, j) for j in range(i + 1, len(robot)) if frozenset((link[i], link[j])) in apart]
            if self.drives or link[i] in carried:
                for (entity, _, _), j in zip(things, indices):
                    (held if entity == case["object"] and link[i] in members else pairs).append((i, j))
            if link[i] in carried:
                pairs.append((i, indices[-1]))
        self.exempt, self.whole = self.checked(pairs), self.checked(pairs + held)

    def checked(self, pairs):
        shapes = self.shapes.copy()
        shapes.removeAllCollisionPairs()
        for pair in pairs:
            shapes.addCollisionPair(pin.CollisionPair(*pair))
        placed = shapes.createData()
        for request in placed.collisionRequests:
            request.security_margin = GAP
        # With a tree of boxes it takes half as long.
        return self.model.createData(), shapes, placed, pin.BroadPhaseManager_DynamicAABBTreeCollisionManager(self.model, shapes, placed)

    def configuration(self, state):
        """pinocchio's row of numbers."""
        x, y, yaw = state[:3] if self.drives else self.stand
        q = np.empty(self.model.nq)
        root = pin.SE3(pin.utils.rotate("z", yaw), np.array([x, y, self.height])) * self.base_from_root
        q[:7] = pin.SE3ToXYZQUAT(root)
        q[7:] = self.still + self.turns @ self.joints(state)
        return q

    def is_free(self, state, exempt=False):
        data, shapes, placed, tree = self.exempt if exempt else self.whole
        q = self.configuration(state)
        begin = time.thread_time()
        pin.updateGeometryPlacements(self.model, data, shapes, placed, q)
        tree.update(False)
        touches = pin.computeCollisions(tree, True)
        self.inside += time.thread_time() - begin
        return not touches

    def is_way_free(self, one, two, exempt=False):
        """Samples at most 2 cm or 0.04 rad apart."""
        way = np.abs(two - one)
        steps = max(1, math.ceil(max(way[:2].max() / 0.02, way.max() / 0.04)))
        return all(self.is_free(one + (two - one) * (at / steps), exempt) for at in range(steps + 1))

    def scatter(self, chance, about):
        state = chance.uniform(self.lower, self.upper)
        if self.drives:
            angle, far = chance.uniform(-math.pi, math.pi), (self.reach + 0.6) * math.sqrt(chance.uniform())
            state[:2] = about[0] + far * math.cos(angle), about[1] + far * math.sin(angle)
        if self.opens:
            state[-1] = 1.0
        return state

    def forward(self, state):
        data = self.whole[0]
        pin.forwardKinematics(self.model, data, self.configuration(state))
        return pin.updateFramePlacement(self.model, data, self.tip)

    def tips(self):
        """Where the hand can be in the room: the least and the greatest of each coordinate."""
        chance = np.random.default_rng(0)
        middle = np.mean(self.room, axis=0)
        seen = np.array([self.forward(self.scatter(chance, middle)).translation for _ in range(400)])
        low, high = seen.min(axis=0), seen.max(axis=0)
        if self.drives:
            low[:2], high[:2] = self.room
        low[2] = max(low[2], 0.0)
        return low, high

    def columns(self, state):
        """The pose of the tip, and how it moves with each number of a state: velocity and angular velocity, along the map's axes."""
        data = self.whole[0]
        pin.computeJointJacobians(self.model, data, self.configuration(state))
        tip = pin.updateFramePlacement(self.model, data, self.tip)
        full = pin.getFrameJacobian(self.model, data, self.tip, pin.LOCAL_WORLD_ALIGNED)
        joints = full[:, 6:] @ self.turns
        if not self.drives:
            return tip, joints
        x, y = tip.translation[0] - state[0], tip.translation[1] - state[1]
        base = np.array([[1.0, 0, 0, 0, 0, 0], [0, 1.0, 0, 0, 0, 0], [-y, x, 0, 0, 0, 1.0]])
        return tip, np.hstack([base.T, joints])

    def solve(self, goal, state, turns=True):
        """A state with the tip at a pose, or at a point where `turns` is false, by damped least squares; none if not within 60 steps."""
        rows = 6 if turns else 3
        for _ in range(60):
            tip, columns = self.columns(state)
            turn = pin.log3(goal.rotation @ tip.rotation.T) if turns else np.zeros(3)
            error = np.concatenate([goal.translation - tip.translation, turn])[:rows]
            if np.linalg.norm(error) < 1e-6:
                return state
            jacobian = columns[:rows]
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-6 * np.eye(rows), error)
            state = np.clip(state + step * min(1.0, 0.7 / np.abs(step).max()), self.lower, self.upper)
        return None

    def check(self, chance):
        """That the columns are those of the kinematics, by differences, that the tree of boxes loses no touch, and that what follows a
        joint follows it."""
        state = self.scatter(chance, self.start[:2] if self.drives else [0.0, 0.0])
        small, (tip, columns) = 1e-6, self.columns(state)
        tip = tip.copy()
        for at in range(len(state)):
            moved = self.forward(state + small * (np.arange(len(state)) == at))
            turn = pin.log3(moved.rotation @ tip.rotation.T)
            found = np.concatenate([moved.translation - tip.translation, turn]) / small
            assert np.allclose(found, columns[:, at], atol=1e-4), (at, found, columns[:, at])
        data, shapes, placed, _ = self.whole
        for _ in range(200):
            other = self.scatter(chance, self.stand)
            touches = pin.computeCollisions(self.model, data, shapes, placed, self.configuration(other), True)
            assert self.is_free(other) != touches
        q = self.configuration(state)
        value = lambda name: q[self.model.joints[self.model.getJointId(name)].idx_q]
        for name, (of, factor, more) in self.follows.items():
            assert abs(value(name) - factor * value(of) - more) < 1e-12, name

    def grasps(self, case):
        """The pose of the tip at each grasp, and 10 cm back along the fingers."""
        for it in case["grasps"]:
            at = pose(it["map_from_tip"])
            yield at, pin.SE3(at.rotation, at.translation - 0.1 * np.array(it["approach"]))


def room_about(points, beyond):
    """The least and the greatest of each coordinate, and so much beyond."""
    return np.min(points, axis=0) - beyond, np.max(points, axis=0) + beyond
