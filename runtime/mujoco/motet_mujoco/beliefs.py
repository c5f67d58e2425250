"""Beliefs: what the robot holds to be where. They start as the scene, and follow what the robot sees and does.

The world itself is not asked here, except for what a robot feels: its joints, and what its laser scanner meets. An
oracle knows what is in its hand, too.
"""

import copy
import re

import mujoco
import numpy as np

from . import sight
from .model import turned
from .planner import rpy
from .world import inside

# Where things are put of whose place nothing is known, in m.
AWAY = (0.0, 0.0, -50.0)
# Distance in m from which a thing counts as being elsewhere.
ELSEWHERE = 0.08
# Error in m of a seen height up to which a thing stands on what is below it.
SLACK = 0.04
# Thickness in m of the bottom of a container.
BOTTOM = 0.01
# Length in m of a surface above which a view of its middle does not show its ends.
WIDE = 1.0
# Heights in m between two looks into a container.
LAYER = 0.5


class Beliefs:
    """The scene as the robot knows it."""

    def __init__(self, world, told=None, oracle=False):
        self.world, self.oracle = world, oracle
        self.scene = copy.deepcopy(told or world.model.scene)
        self.entities = {entity["id"]: entity for entity in self.scene["entities"]}
        # Where the room that the robot was told of has each thing.
        self.first = {one: entity["pose"]["xyz"] for one, entity in self.entities.items() if "pose" in entity}
        # The thing in the hand, and the height of the hand in m as it closed around it; None if it was there before.
        self.hand, self.grasped_at = None, None
        # Where that thing is in the frame of the link of the tip: position and rotation (w, x, y, z).
        self.grip = None
        # Things by the people who took them; things that were seen or felt where they are; and where lost things are not.
        self.given, self.seen, self.gone = {}, set(), {}
        # Where things were believed to be that are not there.
        self.lost = {}
        # Things in drawers that nobody knows to be open or closed: (drawer, place when it is closed, pose).
        self.drawn = {}
        # How far drawers and doors were seen to be open, as shares of their travel.
        self.openings = {}
        # Things of which the host told and the room that was told has none.
        self.new = set()
        self.data = mujoco.MjData(world.model.mj)

    def holds(self, thing, height=None):
        """Notes that the hand has closed around a thing, at a height in m, where it is believed to be. The fingers
        have it in their middle."""
        self.hand, self.grasped_at = thing, height
        known = self.entities.get(thing, {}).get("pose")
        if known is None or height is None:
            # The scene says how the hand holds what it holds at the start.
            position, quaternion = self.world.pose(thing)
        else:
            position, quaternion = np.array(known["xyz"], dtype=float), turned(known)
            axis, rotation = self.world.tip()[1][:, 1], np.zeros(9)
            mujoco.mju_quat2Mat(rotation, quaternion)
            width = sight.width(self.entities[thing].get("shape", {}), rotation.reshape(3, 3).T @ axis)
            position += axis * self.world.between(position, width)
        self.grip = relative(self.world.tip_frame(), position, quaternion)
        self.gone.pop(thing, None)
        self.given.pop(thing, None)

    def in_hand(self):
        """The thing that the hand holds, as a list: by the fingers, that meet something."""
        if self.oracle:
            return self.world.held()
        return [self.hand] if self.hand is not None and self.world.is_gripping() else []

    def held_pose(self, thing):
        """Position and rotation of the thing in the hand: it has moved with the hand since that closed around it."""
        if self.oracle or thing != self.hand:
            return self.world.pose(thing)
        place, rotation = self.world.tip_frame()
        turn, whole = np.zeros(4), np.zeros(4)
        mujoco.mju_mat2Quat(turn, np.ascontiguousarray(rotation).ravel())
        mujoco.mju_mulQuat(whole, turn, self.grip[1])
        return place + rotation @ self.grip[0], whole

    def scan(self, person):
        """Notes where a person is, if the laser scanner meets them."""
        world = self.world
        if sight.scans(world.model, world.data, world.base(), person):
            self.saw(person, world.pose(person)[0])

    def things(self):
        """Ids of what can be moved: the things of the room that was told, and those of which the host told later."""
        return [one for one in self.entities if one in self.world.model.free or one in self.new]

    def room(self):
        """The room as it is believed to be, with the robot as it stands and what it holds."""
        world, data = self.world, self.data
        data.qpos[:], data.mocap_pos[:] = world.data.qpos, world.data.mocap_pos
        data.mocap_quat[:] = world.data.mocap_quat
        self.lay(data, self.hand)
        mujoco.mj_kinematics(world.model.mj, data)
        mujoco.mj_camlight(world.model.mj, data)
        return data

    def looked(self, entity, position, quaternion=None):
        """Notes where something was seen, and what it stands on or lies in there."""
        known = self.entities.get(entity)
        if known is None:
            return
        before = known.get("pose")
        far = float(np.linalg.norm(np.array(before["xyz"]) - position)) if before else np.inf
        self.saw(entity, position, quaternion)
        if entity not in self.things() or entity == self.hand:
            return
        self.seen.add(entity)
        self.gone.pop(entity, None)
        self.drawn.pop(entity, None)
        where, on = self.support_at(entity)
        if where is not None:
            self.given.pop(entity, None)
            self.rests(entity, where, on)
        elif far > ELSEWHERE and entity not in self.given:
            self.rests(entity, None, None)

    def support_at(self, thing):
        """What a thing stands on or lies in where it is believed to be, by shapes: ("on", ID), ("in", ID), or (None,
        None)."""
        model, data, known = self.world.model, self.room(), self.entities[thing]
        place, half, found = np.array(known["pose"]["xyz"]), sight.halves(known.get("shape", {})), []
        for one, entity in model.entities.items():
            shape, at = entity.get("shape", {}), model.body_of.get(one)
            if one == thing or at is None or entity["kind"] == "Person" or not shape or self.hand == one:
                continue
            if entity["kind"] == "Container":
                at = model.leaf_of(one)
                if inside(shape, data.xmat[at].reshape(3, 3).T @ (place - data.xpos[at])):
                    return "in", one
                at = model.body_of[one]
            local = data.xmat[at].reshape(3, 3).T @ (place - data.xpos[at])
            top = sight.half_height(shape)
            is_over = inside(shape, np.array([local[0], local[1], 0.0]))
            if is_over and half[0] - SLACK <= local[2] - top <= half[-1] + SLACK:
                found.append((abs(local[2] - top - half[-1]), one))
        return ("on", min(found)[1]) if found else (None, None)

    def falls(self, thing, container, position, quaternion):
        """Where a thing lies that the hand lets go over a container: on its bottom. Elsewhere it stays."""
        shape, own = (self.entities[one].get("shape", {}) for one in (container, thing))
        if self.entities[container]["kind"] == "Container" and shape:
            at, data = self.world.model.leaf_of(container), self.room()
            local = data.xmat[at].reshape(3, 3).T @ (position - data.xpos[at])
            bottom = data.xpos[at][2] - sight.half_height(shape) + BOTTOM + sight.halves(own)[0]
            if inside(shape, np.array([local[0], local[1], 0.0])) and position[2] > bottom:
                return np.array([*position[:2], bottom]), quaternion
        return position, quaternion

    def supposed(self, thing):
        """Places to look for a thing that is known to be in or on something, but not where there."""
        known = self.entities.get(thing, {})
        support, up = known.get("in") or known.get("on"), sight.half_height(known.get("shape", {}))
        is_sought = "pose" not in known and support in self.world.model.body_of
        return self.places(support, "in" in known, up) if is_sought else []

    def places(self, support, is_inside, up=0.0):
        """Places of a thing of half a height in or on something: near the bottom of the inside and higher up, or on the
        top."""
        model, half = self.world.model, sight.half_height(self.entities[support].get("shape", {}))
        at, heights = (model.leaf_of(support), np.arange(BOTTOM - half, half - up, LAYER)) if is_inside else (
            model.body_of[support], [half])
        data = self.room()
        return [data.xpos[at] + data.xmat[at].reshape(3, 3) @ np.array([0.0, 0.0, z + up]) for z in heights]

    def spread(self, support, is_inside, up=0.0):
        """Places in or on something from which a camera sees all of it: its middle, and those towards the ends of what
        is wider than a view from near."""
        first, shape = self.places(support, is_inside, up)[0], self.entities[support].get("shape", {})
        sides = np.array(shape.get("box", (0.0, 0.0, 0.0)), dtype=float) * (1.0, 1.0, 0.0)
        along = np.where(sides == sides.max(), sides / 3.0, 0.0)
        if is_inside or sides.max() <= WIDE:
            return [first]
        along = self.room().xmat[self.world.model.body_of[support]].reshape(3, 3) @ along
        return [first, first + along, first - along]

    def saw(self, entity, position, quaternion=None):
        """Notes where something is."""
        known = self.entities.get(entity)
        if known is None:
            return
        pose = known.setdefault("pose", {"xyz": [0.0] * 3, "rpy": [0.0] * 3})
        shape = known.get("shape", {})
        lift = shape.get("cylinder", {}).get("height", 0.0) / 2.0 if known["kind"] == "Person" else 0.0
        pose["xyz"] = [round(float(part), 5) for part in position - np.array([0.0, 0.0, lift])]
        if quaternion is not None:
            pose["rpy"] = [round(part, 5) for part in rpy(quaternion)]

    def gap(self, entity, point):
        """Distance in m of a point from where something is believed to be, 0 within it; None if it is not known."""
        found = self.gaps(entity, np.asarray(point, dtype=float)[None])
        return None if found is None else float(found[0])

    def gaps(self, entity, points):
        """Distances in m of points, as rows, from where something is believed to be; None if it is not known."""
        known = self.entities.get(entity)
        if known is None or "pose" not in known:
            return None
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, turned(known["pose"]))
        shape, middle = known.get("shape", {}), np.array(known["pose"]["xyz"], dtype=float)
        if known["kind"] == "Person":
            middle[2] += shape.get("cylinder", {}).get("height", 0.0) / 2.0
        local = (points - middle) @ rotation.reshape(3, 3)
        across = np.hypot(local[:, 0], local[:, 1])
        if "box" in shape:
            beyond = np.abs(local) - np.array(shape["box"]) / 2.0
        elif "cylinder" in shape:
            beyond = np.stack([across - shape["cylinder"]["radius"],
                               np.abs(local[:, 2]) - shape["cylinder"]["height"] / 2.0], axis=1)
        elif "capsule" in shape:
            line = np.maximum(np.abs(local[:, 2]) - shape["capsule"]["height"] / 2.0, 0.0)
            beyond = (np.hypot(across, line) - shape["capsule"]["radius"])[:, None]
        else:
            radius = shape.get("sphere", {}).get("radius", 0.03)
            beyond = (np.linalg.norm(local, axis=1) - radius)[:, None]
        return np.linalg.norm(np.maximum(beyond, 0.0), axis=1)

    def rests(self, entity, where, on):
        """Notes what something stands on or lies in; None for nothing."""
        known = self.entities.get(entity)
        if known is not None:
            for relation in ("on", "in"):
                known.pop(relation, None)
            if where is not None:
                known[where] = on

    def forget(self, entity):
        """Notes that something is no longer where it was, and that its place is not known."""
        known = self.entities.get(entity)
        if known is not None and entity in self.things():
            self.gone.setdefault(entity, set()).update(known[one] for one in ("on", "in") if one in known)
            if "pose" in known:
                self.lost[entity] = np.array(known.pop("pose")["xyz"])
            self.drawn.pop(entity, None)
            self.rests(entity, None, None)
            self.given.pop(entity, None)
            self.seen.discard(entity)
            if self.hand == entity:
                self.hand = None

    def told(self, entity, support, position=None, label=None, size=None):
        """Notes what the host says of a thing: what it is on, in or at, as {"in": ID}, and where it was seen. What has
        no such id yet is a new thing, with a label and a size in m if they are known."""
        if entity not in self.entities:
            self.new.add(entity)
            self.entities[entity] = {"id": entity, "kind": "Object", "names": [label] if label else []}
            if size is not None:
                self.entities[entity]["shape"] = {"box": [round(max(float(part), 0.005), 4) for part in size]}
            self.scene["entities"].append(self.entities[entity])
        if entity not in self.things():
            return
        for relation, on in (support or {}).items():
            self.forget(entity)
            self.gone.pop(entity, None)
            if on in self.entities and relation in ("on", "in"):
                self.rests(entity, relation, on)
            elif on in self.world.model.people:
                self.given[entity] = on
        if position is not None:
            self.saw(entity, np.array(position, dtype=float))
            if entity in self.new:
                self.rests(entity, *self.support_at(entity))

    def lay(self, data, held=None):
        """Puts things, people and doors of a world's data where they are believed to be. A thing whose place is not
        known is put far away, and one in the hand stays."""
        model = self.world.model
        for thing, (at, _) in model.free.items():
            pose = self.entities.get(thing, {}).get("pose")
            if thing == held:
                if not self.oracle and self.grip is not None:
                    data.qpos[at : at + 3], data.qpos[at + 3 : at + 7] = self.held_pose(thing)
                continue
            data.qpos[at : at + 3] = pose["xyz"] if pose else AWAY
            if pose:
                data.qpos[at + 3 : at + 7] = turned(pose)
        for person, at in model.people.items():
            known = self.entities.get(person, {})
            if "pose" in known:
                data.mocap_pos[at, :2] = known["pose"]["xyz"][:2]
        for container, (at, opened, _) in model.doors.items():
            is_open = bool(self.entities.get(container, {}).get("open"))
            data.qpos[at] = opened * self.openings.get(container, float(is_open))

    def opened(self, container, is_open, share=None):
        """Notes that a drawer or door is open or closed; None for what nobody knows. A share of its travel is
        how far it is open, where it was seen."""
        self.openings.pop(container, None)
        if share is not None:
            self.openings[container] = share
        known = self.entities.get(container)
        if known is not None and "travel" in known:
            before = known.pop("open", None)
            if is_open is not None:
                known["open"] = bool(is_open)
            self.carried(container, before, known.get("open"))

    def carried(self, drawer, before, is_open):
        """Moves what lies in a drawer along with it. After a motion that failed, it is somewhere in there
        until the drawer is seen."""
        way = self.world.model.drawn(drawer)
        if way is None or before is is_open:
            return
        for thing, known in self.entities.items():
            if known.get("in") != drawer:
                continue
            if before is not None and "pose" in known:
                # Where it is while the drawer is closed.
                pose = known.pop("pose")
                self.drawn[thing] = drawer, np.array(pose["xyz"]) - (way if before else 0.0), pose
            where, closed, pose = self.drawn.get(thing, (None, None, None))
            if is_open is not None and where == drawer and "pose" not in known:
                place = closed + (way if is_open else 0.0)
                known["pose"] = {**pose, "xyz": [round(float(part), 5) for part in place]}

    def locked(self, container):
        """Notes that a drawer or a door does not open."""
        known = self.entities.get(container)
        if known is not None:
            known["locked"] = True

    def now(self):
        """The scene, with the robot as it stands and what it holds."""
        world, model = self.world, self.world.model
        scene = copy.deepcopy(self.scene)
        robot = {"base": [float(part) for part in world.base()], "joints": {}, "holding": None}
        base = ("base/x", "base/y", "base/yaw")
        low, high = limits_of(model)
        for joint, at in model.controls.items():
            if joint not in base and at not in model.grips:
                robot["joints"][joint] = float(np.clip(world.target[at], low[at], high[at]))
        held = self.in_hand()
        if held:
            robot["holding"] = held[0]
            place, turn = relative(world.tip_frame(), *self.held_pose(held[0]))
            robot["grip"] = {"xyz": [float(part) for part in place], "rpy": rpy(turn)}
            for entity in scene["entities"]:
                if entity["id"] == held[0]:
                    entity.pop("on", None)
                    entity.pop("in", None)
        scene["robot"] = robot
        return scene

    # Descriptions, as the language matches them.

    def matches(self, description):
        """Entities that a description fits, in the order of the scene."""
        wanted = normal(description)
        found = [one for one in self.entities.values() if wanted in names(one)]
        if not found:
            found = [one for one in self.entities.values() if singular(wanted) in names(one)]
        if not found and singular(wanted) in ("object", "thing", "item", "anything", "everything"):
            found = list(self.entities.values())
        return [one["id"] for one in found]


def relative(frame, position, quaternion):
    """A pose in a frame, which is a position and a rotation."""
    place, rotation = frame
    inverse, turn = np.zeros(4), np.zeros(4)
    mujoco.mju_mat2Quat(inverse, np.ascontiguousarray(rotation.T).ravel())
    mujoco.mju_mulQuat(turn, inverse, quaternion)
    return rotation.T @ (position - place), turn


def limits_of(model):
    """Least and greatest targets of the actuators."""
    from .motion import limits

    return limits(model)


def names(entity):
    """Everything that an entity is called."""
    listed = [entity["id"], entity.get("class", ""), *entity.get("names", []), *entity.get("categories", [])]
    return {normal(one) for one in listed if one}


def normal(text):
    """A description in lower case with single spaces and no articles before it."""
    words = [word for word in re.split(r"[\s_-]+", text.lower()) if word]
    while words and words[0] in ("a", "an", "the"):
        words.pop(0)
    return " ".join(words)


def singular(text):
    """The singular of a description whose last word may be a plural, by its letters."""
    if text.endswith("es") and (text[:-2].endswith(("s", "x", "z", "ch", "sh"))):
        return text[:-2]
    return text[:-1] if text.endswith("s") and not text.endswith("ss") else text
