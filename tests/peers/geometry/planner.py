"""A robot in an exported room as pinocchio and coal see it: states, collisions, inverse kinematics."""

import math

import coal
import numpy as np
import pinocchio as pin

from room import followers, obstacle, pose, turn_joints, urdf

GAP = 0.002


class Planner:
    """A state is `x y yaw` of the base, where it drives, and the joints that move the tip, as a row of numbers."""

    def __init__(self, case):
        name = case["robot"]
        self.model = pin.buildModelFromUrdf(urdf(name), pin.JointModelFreeFlyer())
        self.shapes = pin.buildGeomFromUrdf(self.model, urdf(name), pin.GeometryType.COLLISION)
        self.follows = followers(name)
        self.drives, self.height, self.reach = case["drives"], case["height"], case["reach"]
        self.fixed = dict(zip(case["variables"], case["start"]["joints"]))
        self.moves = case["moves"]
        self.tip = self.model.getFrameId(case["tip"])
        start = pin.neutral(self.model)
        data = self.model.createData()
        pin.framesForwardKinematics(self.model, data, start)
        self.base_from_root = data.oMf[self.model.getFrameId(case["base_link"])].inverse()
        self.start = np.array((case["start"]["base"] if self.drives else []) + [self.fixed[it] for it in self.moves])
        self.stand = case["start"]["base"]
        self.columns = [self.column(name) for name in self.moves]
        lower, upper = zip(*(self.limits(name) for name in self.moves))
        centre = [it["pose"][:2] for it in case["obstacles"]] + [self.stand[:2]]
        low, high = np.min(centre, axis=0) - 1.5, np.max(centre, axis=0) + 1.5
        base = ([*low, -math.pi], [*high, math.pi]) if self.drives else ([], [])
        self.lower, self.upper = np.array([*base[0], *lower]), np.array([*base[1], *upper])
        self.furnish(case)

    def limits(self, name):
        joint = self.model.joints[self.model.getJointId(name)]
        if joint.nq == 2:
            return -math.pi, math.pi
        return self.model.lowerPositionLimit[joint.idx_q], self.model.upperPositionLimit[joint.idx_q]

    def column(self, name):
        """The joints that turn with one, with their factors."""
        turned = [(name, 1.0)] + [(it, factor) for it, (of, factor, _) in self.follows.items() if of == name]
        return [(self.model.joints[self.model.getJointId(it)].idx_v, factor) for it, factor in turned]

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
        return self.model.createData(), shapes, placed

    def configuration(self, state):
        """pinocchio's row of numbers."""
        q = pin.neutral(self.model)
        base, joints = (state[:3], state[3:]) if self.drives else (self.stand, state)
        x, y, yaw = base
        root = pin.SE3(pin.utils.rotate("z", yaw), np.array([x, y, self.height])) * self.base_from_root
        q[:7] = pin.SE3ToXYZQUAT(root)
        turn_joints(self.model, q, self.fixed | dict(zip(self.moves, joints)), self.follows)
        return q

    def is_free(self, state, exempt=False):
        data, shapes, placed = self.exempt if exempt else self.whole
        return not pin.computeCollisions(self.model, data, shapes, placed, self.configuration(state), True)

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
        return state

    def forward(self, state):
        data = self.whole[0]
        pin.framesForwardKinematics(self.model, data, self.configuration(state))
        return data.oMf[self.tip]

    def solve(self, goal, state, turns=True):
        """A state with the tip at a pose, or at a point where `turns` is false, by damped least squares; none if not within 60 steps."""
        rows = 6 if turns else 3
        data = self.whole[0]
        for _ in range(60):
            full = pin.computeFrameJacobian(
                self.model, data, self.configuration(state), self.tip, pin.LOCAL_WORLD_ALIGNED
            )
            tip = pin.updateFramePlacement(self.model, data, self.tip)
            turn = pin.log3(goal.rotation @ tip.rotation.T) if turns else np.zeros(3)
            error = np.concatenate([goal.translation - tip.translation, turn])[:rows]
            if np.linalg.norm(error) < 1e-6:
                return state
            columns = [sum(factor * full[:, at] for at, factor in column) for column in self.columns]
            if self.drives:
                arm = tip.translation - np.array([state[0], state[1], 0.0])
                columns = [
                    np.array([1.0, 0, 0, 0, 0, 0]), np.array([0, 1.0, 0, 0, 0, 0]),
                    np.array([-arm[1], arm[0], 0, 0, 0, 1.0]), *columns,
                ]
            jacobian = np.stack(columns, axis=1)[:rows]
            step = jacobian.T @ np.linalg.solve(jacobian @ jacobian.T + 1e-6 * np.eye(rows), error)
            state = np.clip(state + step * min(1.0, 0.7 / np.abs(step).max()), self.lower, self.upper)
        return None

    def grasps(self, case):
        """The pose of the tip at each grasp, and 10 cm back along the fingers."""
        for it in case["grasps"]:
            at = pose(it["map_from_tip"])
            yield at, pin.SE3(at.rotation, at.translation - 0.1 * np.array(it["approach"]))
