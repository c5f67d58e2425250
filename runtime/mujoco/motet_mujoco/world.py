"""The world: a simulated robot in its scene, moved step by step, and what holds in it.

Facts follow from contacts and poses. Nothing here knows what a command was for, or what the robot believes.
"""

import mujoco
import numpy as np

from . import sight
from .model import name
from .motion import Reacher, near_turn

# Time in s between two targets of the actuators, and while the fingers move, faster than so many m/s or rad/s.
TICK, GRIPS, STILL = 0.008, 0.004, 0.01
# Length in s of a step of the simulation where something touches something or falls, and elsewhere.
FINE, COARSE = 0.002, 0.004
# Force in N from which a part presses.
PRESSES = 0.2
# Share of the travel from which a drawer or a door is open.
OPENED = 0.6
# Distance in m up to which a thing at rest may sink into what bears it.
SINKS = 0.02
# Distance in m from a thing within which a name that the host gives is of it.
ABOUT = 0.15
# Share of its travel from its end, or where it gives way from its rest, to which a finger that is told to close has
# closed on nothing.
CLOSED = 0.02
# Distances in m from the tip along the fingers at which the gap between them is measured, and its greatest
# difference from the width of what they hold.
FINGERS, WIDER = np.arange(-0.06, 0.1201, 0.005), 0.015
# Groups of geoms that a ray meets: the robot alone.
ROBOT = np.array([0, 0, 1, 0, 0, 0], dtype=np.uint8)


class World:
    """A robot in a scene over time."""

    def __init__(self, model):
        self.model = model
        self.data = mujoco.MjData(model.mj)
        self.tick = TICK  # seconds to the next target
        self.grips, self.still = list(model.grips), np.zeros(model.mj.nu)
        self.fingers_qvel = model.control_qvel[self.grips]
        self.reacher = Reacher(model)
        self.integral, self.force = np.zeros(model.mj.nu), np.zeros(model.mj.nv)
        # Things in the hands of people, and things by the names that the host gave them.
        self.carried_by, self.called = {}, {}
        # Contacts of what sleeps too, found when asked for.
        self.scratch, self.near_at, self.nearby = mujoco.MjData(model.mj), -1.0, []
        self.error = np.zeros(2)  # greatest error of the tip since `measure`, in m and rad
        self.reset()

    def reset(self):
        """Back to the start of the scene."""
        mujoco.mj_resetDataKeyframe(self.model.mj, self.data, self.model.mj.key("start").id)
        self.target = np.array(self.data.ctrl)
        self.integral[:], self.tick = 0.0, TICK
        mujoco.mj_forward(self.model.mj, self.data)

    @property
    def now(self):
        """Time in s since the start."""
        return self.data.time

    def step(self, target=None, rate=None, change=None):
        """Goes on by a tick, with the actuators at a target that moves at a rate with an acceleration: those
        of the middle of the tick."""
        model, data = self.model, self.data
        if target is not None:
            self.target = np.array(target, dtype=float)
        rate = self.still if rate is None else rate
        # A slow integral holds against weight. It compares the target with the joints at the same time.
        off = self.target - rate * self.tick / 2.0 - data.qpos[model.control_qpos]
        self.integral = np.minimum(np.maximum(self.integral + 4.0 * self.tick * off, -0.02), 0.02)
        self.integral[self.grips] = 0.0
        # The damping of a position servo brakes: led by as much as that, it follows a moving target without a
        # lag. A step finds the joints half a step before its middle.
        step = COARSE if self.is_free() else FINE
        control = self.target + self.integral + (model.lag - step / 2.0) * rate
        if change is not None:
            control += self.feedforward(change) / model.stiffness
            rate = rate + model.lag * change
        for thing, (person, offset) in self.carried_by.items():
            self.place(thing, data.mocap_pos[model.people[person]] + offset)
        model.mj.opt.timestep = step
        control += (step - self.tick) / 2.0 * rate
        for _ in range(round(self.tick / step)):
            data.ctrl[:] = control
            mujoco.mj_step(model.mj, data)
            control += step * rate
        self.tick = TICK if np.abs(data.qvel[self.fingers_qvel]).max(initial=0.0) < STILL else GRIPS

    def is_free(self):
        """True if nothing but the robot and what people carry is awake, and the robot touches nothing and does not move
        its fingers."""
        return self.data.ncon == 0 and self.tick == TICK and self.data.ntree_awake <= 1 + len(self.carried_by)

    def feedforward(self, change):
        """Forces with which the actuators accelerate as they should: by the dynamics of the robot itself,
        without what it touches or holds. Its weight is compensated."""
        model, data = self.model, self.data
        force = self.force
        mujoco.mj_mulM(model.mj, data, force, model.transmission @ change)
        return model.transmission.T @ (force + data.qfrc_bias - data.qfrc_gravcomp)

    def run(self, path, until=lambda: False):
        """Follows a path; ends early where `until` says so. Answers whether it came to the end."""
        start = self.now
        while self.now - start < path.end:
            self.step(*path.at(self.now - start + self.tick / 2.0))
            if until():
                return False
        self.step(path.points[-1])
        return True

    def fingers(self, closed, start, share):
        """Targets of the fingers at a share of their way from a start to the closed hand, or to the open one."""
        return {at: start[at] + (ends[int(closed)] - start[at]) * min(share, 1.0) for at, ends in self.model.grips.items()}

    def move_fingers(self, closed, seconds):
        """Closes or opens the hand over the first half of a time."""
        target, begun = self.target.copy(), self.now
        start = self.data.qpos[self.model.control_qpos]
        while self.now - begun < seconds - 1e-9:
            for at, to in self.fingers(closed, start, 2.0 * (self.now + self.tick - begun) / seconds).items():
                target[at] = to
            self.step(target)

    def wait(self, seconds):
        """Holds still for a time."""
        start = self.now
        while self.now - start < seconds:
            self.step()

    def settle(self, seconds):
        """Lets things come to rest before the time of the world begins."""
        self.wait(seconds)
        self.data.time, self.near_at = 0.0, -1.0

    # Poses.

    def base(self):
        """Pose of the base: x, y, yaw."""
        if self.model.drives:
            return self.data.qpos[self.model.control_qpos[:3]].copy()
        return np.array(self.model.scene["robot"]["base"], dtype=float)

    def tip(self):
        """Position and rotation of the hand: z along the fingers, y along their closing."""
        at = self.model.tip
        return self.data.site_xpos[at].copy(), self.data.site_xmat[at].reshape(3, 3).copy()

    def tip_frame(self):
        """Position and rotation of the link of the tip, in which grips are given."""
        at = self.model.mj.site_bodyid[self.model.tip]
        return self.data.xpos[at].copy(), self.data.xmat[at].reshape(3, 3).copy()

    def between(self, place, width):
        """How far the middle between the closed fingers is from a place within them, in m along their
        closing, where they are as far apart as the thing there is wide. 0 if they are so nowhere."""
        tip, rotation = self.tip()
        across = float(rotation[:, 1] @ (place - tip))
        found, geom = [], np.zeros(1, dtype=np.int32)
        for along in FINGERS:
            eye = tip + rotation @ np.array([0.0, across, along])
            gaps = []
            for way in (rotation[:, 1], -rotation[:, 1]):
                args = (self.model.mj, self.data, eye, np.ascontiguousarray(way), ROBOT, 1, -1, geom)
                try:
                    gaps.append(mujoco.mj_ray(*args))
                except TypeError:
                    gaps.append(mujoco.mj_ray(*args, None))
            if 0.0 <= min(gaps) and abs(sum(gaps) - width) <= WIDER:
                found.append((abs(sum(gaps) - width), (gaps[0] - gaps[1]) / 2.0))
        return min(found)[1] if found else 0.0

    def pose(self, entity):
        """Position and rotation (w, x, y, z) of an entity; None without a body."""
        at = self.model.body_of.get(self.called.get(entity, entity))
        if at is None:
            return None
        return self.data.xpos[at].copy(), self.data.xquat[at].copy()

    def in_hand(self, thing):
        """Position of a thing in the frame of the hand."""
        place, rotation = self.tip()
        return rotation.T @ (self.pose(thing)[0] - place)

    def call(self, name, position):
        """Notes what the host calls the thing that is at about a position."""
        far = {thing: float(np.linalg.norm(self.pose(thing)[0] - position)) for thing in self.model.free}
        nearest = min(far, key=far.get, default=None)
        if nearest is not None and far[nearest] < ABOUT:
            self.called[name] = nearest

    def settle_in_hand(self, thing):
        """Closes the fingers around a thing that has no weight meanwhile."""
        weightless, body = self.model.mj.body_gravcomp, self.model.body_of[thing]
        before, weightless[body] = float(weightless[body]), 1.0
        self.move_fingers(True, 1.0)
        weightless[body] = before
        self.wait(0.3)

    def place(self, thing, position, quaternion=None):
        """Puts a thing somewhere, at rest."""
        at, dof = self.model.free[self.called.get(thing, thing)]
        self.data.qpos[at : at + 3] = position
        if quaternion is not None:
            self.data.qpos[at + 3 : at + 7] = quaternion
        self.data.qvel[dof : dof + 6] = 0.0

    def refresh(self):
        """Brings positions up to date after something was put elsewhere."""
        mujoco.mj_kinematics(self.model.mj, self.data)
        self.near_at = -1.0

    def geoms(self, entity):
        """Geoms of an entity that something can touch."""
        mj = self.model.mj
        return [at for at in range(mj.ngeom) if self.model.geom_owner[at] == entity and mj.geom_contype[at]]

    def bounds(self, entity):
        """Least and greatest corner of the box around an entity as it is."""
        mj, data = self.model.mj, self.data
        low, high = np.full(3, np.inf), np.full(3, -np.inf)
        for at in self.geoms(entity):
            rotation, box = data.geom_xmat[at].reshape(3, 3), mj.geom_aabb[at]
            middle, half = data.geom_xpos[at] + rotation @ box[:3], np.abs(rotation) @ box[3:]
            low, high = np.minimum(low, middle - half), np.maximum(high, middle + half)
        return low, high

    def gaps(self, entity, most):
        """Distances of an entity from others, up to a greatest one: (other, distance in m)."""
        mj, own = self.model.mj, set(self.geoms(entity))
        for other in range(mj.ngeom):
            if other in own or not mj.geom_contype[other] or self.model.geom_owner[other] == entity:
                continue
            gap = min(mujoco.mj_geomDistance(mj, self.data, at, other, most, None) for at in own)
            if gap < most:
                yield ("floor" if other == self.model.floor else self.model.geom_owner[other]), gap

    def opening(self, container):
        """Share of the travel of a drawer or a door: 0 closed, 1 open; None without one."""
        door = self.model.doors.get(container)
        return None if door is None else float(self.data.qpos[door[0]] / door[1])

    def targets(self, path):
        """Targets of the actuators for waypoints: bases, and joints by name. Others stay as they are."""
        points = []
        for waypoint in path:
            target = self.target.copy()
            if self.model.drives:
                # Along a path the yaw goes on beyond half a turn.
                x, y, yaw = waypoint["base"]
                first = path[0]["base"][2]
                target[:3] = [x, y, near_turn(first, self.target[2]) + yaw - first]
            for joint, value in waypoint["joints"].items():
                at = self.model.controls.get(joint)
                if at is not None:
                    target[at] = value
            points.append(target)
        return points

    # Contacts.

    def contacts(self):
        """Contacts as (geom, geom, normal from the first to the second, force in N)."""
        data, mj = self.data, self.model.mj
        force = np.zeros(6)
        for at in range(data.ncon):
            contact = data.contact[at]
            mujoco.mj_contactForce(mj, data, at, force)
            yield contact.geom[0], contact.geom[1], contact.frame[:3].copy(), float(force[0])

    def touching(self, entity):
        """Contacts of an entity: (other geom, normal towards the entity, force)."""
        owner, entity = self.model.geom_owner, self.called.get(entity, entity)
        for one, other, normal, force in self.contacts():
            if owner[other] == entity:
                yield one, normal, force
            elif owner[one] == entity:
                yield other, -normal, force

    def held(self):
        """Things that two parts of the hand press from two sides, in the order of the scene."""
        model = self.model
        sides = {}
        for one, other, normal, force in self.contacts():
            if force < PRESSES:
                continue
            for part, thing, way in ((one, other, normal), (other, one, -normal)):
                owner = model.geom_owner[thing]
                if part in model.hand_geoms and owner in model.free:
                    sides.setdefault(owner, []).append(way)
        found = [thing for thing, ways in sides.items() if opposed(ways)]
        return [thing for thing in model.entities if thing in found]

    def holds(self, thing):
        """True if the hand holds a thing."""
        return self.called.get(thing, thing) in self.held()

    def is_gripping(self):
        """True if the fingers, told to close, meet something before their end, or all give way: by the joints of the
        hand alone. Around something thin, fingers that give way come to their end as if nothing were between them."""
        grips, qpos = self.model.grips, self.data.qpos
        spans = {at: abs(closed - opened) for at, (opened, closed) in grips.items()}
        told = [at for at, (_, closed) in grips.items() if abs(self.target[at] - closed) < CLOSED * spans[at]]
        if not told:
            return False
        met = (abs(qpos[self.model.control_qpos[at]] - grips[at][1]) > CLOSED * spans[at] for at in told)
        springs = self.model.springs
        return any(met) or bool(springs) and all(abs(qpos[at] - rest) > CLOSED * travel for at, rest, travel in springs)

    def is_touched(self, thing):
        """True if a part of the hand touches a thing."""
        return any(geom in self.model.hand_geoms and force > 0.0 for geom, _, force in self.touching(thing))

    def grasps(self, thing):
        """True if the hand has closed around a thing."""
        return self.holds(thing)

    def feels_touch(self):
        """True if something presses on a finger: by force sensors, which do not say what it is."""
        hand = self.model.hand_geoms
        return any((one in hand) != (other in hand) and force > 0.0 for one, other, _, force in self.contacts())

    def bumps(self):
        """Places where something presses on a part of the robot other than the hand: by sensors in its skin, which do
        not say what it is."""
        data, owner, hand, force = self.data, self.model.geom_owner, self.model.hand_geoms, np.zeros(6)
        for at in range(data.ncon):
            own = [owner[geom] == "robot" and geom not in hand for geom in data.contact[at].geom]
            mujoco.mj_contactForce(self.model.mj, data, at, force)
            if any(own) and not all(own) and force[0] > PRESSES:
                yield data.contact[at].pos.copy()

    def bearers(self, thing):
        """What a thing rests on, apart from the hand: ids, or `floor`."""
        model, found, thing = self.model, [], self.called.get(thing, thing)
        for one, other, normal in self.near():
            for geom, borne, up in ((one, other, normal[2]), (other, one, -normal[2])):
                if model.geom_owner[borne] == thing and up > 0.5 and geom not in model.hand_geoms:
                    name = "floor" if geom == model.floor else model.geom_owner[geom]
                    if name not in found:
                        found.append(name)
        return found

    def supports(self, thing):
        """Entities that a thing rests on or lies in."""
        below = [other for other in self.bearers(thing) if other in self.model.entities]
        return below + [other for other in self.model.doors if self.is_in(thing, other)]

    def near(self):
        """Pairs of geoms that touch, with the normal from the first to the second: of things asleep too."""
        if self.near_at != self.now:
            mj, data = self.model.mj, self.scratch
            data.qpos[:], data.mocap_pos[:] = self.data.qpos, self.data.mocap_pos
            data.mocap_quat[:] = self.data.mocap_quat
            flags = mj.opt.enableflags
            mj.opt.enableflags = 0
            mujoco.mj_fwdPosition(mj, data)
            mj.opt.enableflags = flags
            contacts = [data.contact[at] for at in range(data.ncon)]
            self.nearby = [(one.geom[0], one.geom[1], one.frame[:3].copy()) for one in contacts if one.dist < 1e-3]
            self.near_at = self.now
        return self.nearby

    def is_lifted(self, thing):
        """True if the hand bears a thing alone."""
        others = [geom for geom, _, force in self.touching(thing)
                  if geom not in self.model.hand_geoms and force > 0.0]
        return self.holds(thing) and not others

    def is_in(self, thing, container):
        """True if the middle of a thing is within a container, as its drawer now is."""
        pose, entity = self.pose(thing), self.model.entities.get(container)
        if pose is None or entity is None or entity.get("kind") != "Container" or "shape" not in entity:
            return False
        at = self.model.leaf_of(container)
        rotation = self.data.xmat[at].reshape(3, 3)
        local = rotation.T @ (pose[0] - self.data.xpos[at])
        return inside(entity["shape"], local)

    def is_on(self, thing, support):
        """True if a thing stands on another one, and not in it."""
        return support in self.bearers(thing) and not self.is_in(thing, support)

    def is_open(self, container):
        """True if a drawer or a door is open; None without one."""
        share = self.opening(container)
        return None if share is None else share > OPENED

    def is_locked(self, container):
        """True if a lock keeps a drawer or a door where it is."""
        at = mujoco.mj_name2id(self.model.mj, mujoco.mjtObj.mjOBJ_EQUALITY, name(container) + "/lock")
        return False if at < 0 else bool(self.data.eq_active[at])

    def lock(self, container, is_locked):
        """Lets a lock keep a drawer or a door where it is, or lets it go."""
        at = mujoco.mj_name2id(self.model.mj, mujoco.mjtObj.mjOBJ_EQUALITY, name(container) + "/lock")
        if at >= 0:
            self.model.mj.eq_data[at, 0] = self.data.qpos[self.model.doors[container][0]]
            self.data.eq_active[at] = is_locked

    def is_given(self, thing, person):
        """True if a person has a thing in the hand."""
        return self.carried_by.get(thing, (None,))[0] == person

    def is_visible(self, one):
        """True if a camera of the robot could see an entity from where the base is."""
        return sight.is_visible(self.model, self.data, self.base(), one)

    def is_located(self, one):
        """True if a camera of the robot could see an entity, and so where it is."""
        return self.is_visible(one)

    def bumped(self, allowed=()):
        """What a part of the robot other than the hand touches, apart from those allowed; None if nothing."""
        owner = self.model.geom_owner
        for one, other, _, force in self.contacts():
            for part, thing in ((one, other), (other, one)):
                is_robot = owner[part] == "robot" and part not in self.model.hand_geoms
                if is_robot and force > PRESSES and owner[thing] not in allowed:
                    return "floor" if thing == self.model.floor else owner[thing]
        return None


def opposed(ways):
    """True if two of the directions point against each other."""
    ways = np.array(ways)
    return bool(np.min(ways @ ways.T) < -0.25)


def inside(shape, local):
    """True if a point is within a shape in its own frame, or as much below as things sink."""
    x, y, z = local
    if "box" in shape:
        a, b, c = (side / 2.0 for side in shape["box"])
        return abs(x) <= a and abs(y) <= b and -c - SINKS <= z <= c
    if "cylinder" in shape:
        radius, half = shape["cylinder"]["radius"], shape["cylinder"]["height"] / 2.0
        return np.hypot(x, y) <= radius and -half - SINKS <= z <= half
    return False
