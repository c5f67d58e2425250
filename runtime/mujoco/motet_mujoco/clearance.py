"""Collision check of configurations in the room as the robot believes it to be.

A witness is free of collisions along its legs. The robot may cut the corner between two legs only if nothing in it is
nearer than the clearance that the witness keeps, and no two parts of the robot touch.
"""

import functools

import mujoco
import numpy as np

from .motion import set_targets

# Clearance in m of base and arm where the witness gives none.
KEEPS = {"base": 0.04, "arm": 0.01}
# Clearance in m on a way that only has to be free of contact.
TOUCHES = {"base": 0.0, "arm": 0.0}
# Distance in m by which bodies may come nearer that have less than their clearance before the corner or in it.
NEARER = 0.001
# Distance in m below which parts of the robot count as touching: a little more than what the planner keeps.
OWN = 0.006


class Clearance:
    """Checks configurations on data of its own, with things where they are believed to be."""

    def __init__(self, world, beliefs, keeps=None):
        self.world, self.model = world, world.model
        self.data = mujoco.MjData(self.model.mj)
        self.data.qpos[:] = world.data.qpos
        self.data.mocap_pos[:], self.data.mocap_quat[:] = world.data.mocap_pos, world.data.mocap_quat
        held = beliefs.in_hand()
        self.held = world.called.get(held[0], held[0]) if held else None
        beliefs.lay(self.data, self.held)
        self.start = self.data.qpos.copy()
        if self.held:
            # How the hand holds it.
            place, rotation = world.tip_frame()
            position, quaternion = beliefs.held_pose(held[0])
            self.grip = rotation.T @ (position - place), rotation.T @ matrix(quaternion)
        self.margins = np.maximum(self.model.mj.geom_margin, self.margins_of({**KEEPS, **(keeps or {})}))
        # Geoms of the robot and of what it holds.
        mine = {"robot", self.held} - {None}
        self.mine = np.array([owner in mine for owner in self.model.geom_owner])

    def margins_of(self, keeps):
        """Margin of each geom: that of the base or of the arm, and none of things."""
        mj, margins = self.model.mj, np.zeros(self.model.mj.ngeom)
        for at in range(mj.ngeom):
            owner = self.model.geom_owner[at]
            if owner == "robot":
                is_base = mj.body(mj.geom_bodyid[at]).name == "robot"
                margins[at] = keeps["base" if is_base else "arm"]
            elif owner is not None and owner == self.held:
                margins[at] = keeps["arm"]
        return margins

    def near(self, target):
        """Pairs of bodies with less than their clearance at targets of the actuators, with their distances in m."""
        mj, data = self.model.mj, self.data
        set_targets(self.model, data, self.start, target)
        if self.held:
            mujoco.mj_kinematics(mj, data)
            at, body = self.model.free[self.held][0], mj.site_bodyid[self.model.tip]
            place, rotation = data.xpos[body], data.xmat[body].reshape(3, 3)
            turned = np.zeros(4)
            mujoco.mju_mat2Quat(turned, np.ascontiguousarray(rotation @ self.grip[1]).ravel())
            data.qpos[at : at + 3], data.qpos[at + 3 : at + 7] = place + rotation @ self.grip[0], turned
        find_contacts(self.model, data, self.margins)
        found = {bodies: gap for bodies, gap in own_contacts(self.model, data) if bodies not in together(self.model)}
        one, other = data.contact.geom.T
        is_met = (self.mine[one] != self.mine[other]) & (one != self.model.floor) & (other != self.model.floor)
        for bodies, gap in zip(mj.geom_bodyid[data.contact.geom[is_met]].tolist(), data.contact.dist[is_met].tolist()):
            bodies = tuple(bodies)
            found[bodies] = min(found.get(bodies, np.inf), gap)
        return found

    def touches_itself(self, target):
        """True if parts of the robot touch at targets that do not at the start."""
        before = self.own(self.start[self.model.control_qpos])
        return any(gap < before.get(bodies, OWN) - 1e-4 for bodies, gap in self.own(target).items())

    def own(self, target):
        """Pairs of bodies of the robot that touch at targets, with their distances in m."""
        owner = self.model.owner
        return {bodies: gap for bodies, gap in self.near(target).items() if all(owner[one] == "robot" for one in bodies)}

    def is_free(self, start, corner, targets):
        """True if all bodies keep their clearance at all targets. Those that have less at the start or at the corner may
        be as near as there."""
        permitted = self.near(start)
        for bodies, gap in self.near(corner).items():
            permitted[bodies] = min(permitted.get(bodies, np.inf), gap)
        return all(gap >= permitted.get(bodies, np.inf) - NEARER
                   for target in targets for bodies, gap in self.near(target).items())


def find_contacts(model, data, margins):
    """Finds the contacts of a configuration within margins: also those between parts of the robot, which the world leaves
    out."""
    mj, (own, bodies), flags = model.mj, parts(model), model.mj.opt.enableflags
    fields = mj.geom_margin, mj.geom_conaffinity, mj.body_conaffinity
    before = [field.copy() for field in fields]
    mj.geom_margin[:], mj.opt.enableflags = margins, 0
    mj.geom_conaffinity[own] |= mj.geom_contype[own]
    mj.body_conaffinity[bodies] |= mj.body_contype[bodies]
    mujoco.mj_kinematics(mj, data)
    mujoco.mj_collision(mj, data)
    for field, was in zip(fields, before):
        field[:] = was
    mj.opt.enableflags = flags


def own_contacts(model, data):
    """Pairs of bodies of the robot that touch, with their distances in m. Fingers may close."""
    one, other = data.contact.geom.T
    own, hand = masks(model)
    is_own = own[one] & own[other] & ~(hand[one] & hand[other]) & (data.contact.dist < OWN)
    for bodies, gap in zip(model.mj.geom_bodyid[data.contact.geom[is_own]].tolist(), data.contact.dist[is_own].tolist()):
        yield tuple(sorted(bodies)), gap


@functools.lru_cache(maxsize=4)
def parts(model):
    """Geoms of the robot, and their bodies."""
    own = [at for at, owner in enumerate(model.geom_owner) if owner == "robot"]
    return own, sorted({int(body) for body in model.mj.geom_bodyid[own]})


@functools.lru_cache(maxsize=4)
def masks(model):
    """Masks of the geoms of the robot, and of its hand."""
    geoms = np.arange(model.mj.ngeom)
    return np.isin(geoms, parts(model)[0]), np.isin(geoms, list(model.hand_geoms))


@functools.lru_cache(maxsize=4)
def together(model):
    """Pairs of bodies of the robot whose shapes overlap at the start or at home, where the real parts do not touch."""
    data, found = mujoco.MjData(model.mj), set()
    for target in (model.mj.key_ctrl[model.mj.key("start").id], model.posture("home"), model.posture("start")):
        if target is not None:
            mujoco.mj_resetDataKeyframe(model.mj, data, model.mj.key("start").id)
            set_targets(model, data, data.qpos.copy(), target)
            find_contacts(model, data, model.mj.geom_margin.copy())
            found.update(bodies for bodies, _ in own_contacts(model, data))
    return found


def matrix(quaternion):
    """Rotation of a quaternion w, x, y, z."""
    rotation = np.zeros(9)
    mujoco.mju_quat2Mat(rotation, quaternion)
    return rotation.reshape(3, 3)
