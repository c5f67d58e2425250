"""Beliefs: what the robot holds to be where. They start as the scene, and follow what the robot sees and does.

The world itself is not asked here, except for what a robot feels: its joints, and what is in its hand.
"""

import copy
import re

import mujoco
import numpy as np

from .planner import rpy


# Where things are put of whose place nothing is known, in m.
AWAY = (0.0, 0.0, -50.0)


class Beliefs:
    """The scene as the robot knows it."""

    def __init__(self, world, told=None):
        self.world = world
        self.scene = copy.deepcopy(told or world.model.scene)
        self.entities = {entity["id"]: entity for entity in self.scene["entities"]}
        # Where the room that the robot was told of has each thing.
        self.first = {one: entity["pose"]["xyz"] for one, entity in self.entities.items() if "pose" in entity}

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
        if known is not None and entity in self.world.model.free:
            known.pop("pose", None)
            self.rests(entity, None, None)

    def told(self, entity, support, position=None):
        """Notes what the host says of a thing: what it is on, in or at, as {"in": ID}, and where it was seen."""
        known = self.entities.get(entity)
        if known is None or entity not in self.world.model.free:
            return
        for relation, on in (support or {}).items():
            self.forget(entity)
            if on in self.entities and relation in ("on", "in"):
                self.rests(entity, relation, on)
        if position is not None:
            self.saw(entity, np.array(position, dtype=float))

    def lay(self, data, held=None):
        """Puts things, people and doors of a world's data where they are believed to be. A thing whose place is not
        known is put far away, and one in the hand stays."""
        model = self.world.model
        for thing, (at, _) in model.free.items():
            pose = self.entities.get(thing, {}).get("pose")
            if thing == held:
                continue
            data.qpos[at : at + 3] = pose["xyz"] if pose else AWAY
            if pose:
                data.qpos[at + 3 : at + 7] = turned(pose)
        for person, at in model.people.items():
            known = self.entities.get(person, {})
            if "pose" in known:
                data.mocap_pos[at, :2] = known["pose"]["xyz"][:2]
        for container, (at, opened, _) in model.doors.items():
            data.qpos[at] = opened if self.entities.get(container, {}).get("open") else 0.0

    def opened(self, container, is_open):
        """Notes that a drawer or door is open or closed."""
        known = self.entities.get(container)
        if known is not None and "travel" in known:
            known["open"] = bool(is_open)

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
        held = world.held()
        if held:
            robot["holding"] = held[0]
            place, rotation = world.tip_frame()
            position, quaternion = world.pose(held[0])
            relative = rotation.T @ (position - place)
            turned = np.zeros(4)
            inverse = np.zeros(4)
            mujoco.mju_mat2Quat(inverse, np.ascontiguousarray(rotation.T).ravel())
            mujoco.mju_mulQuat(turned, inverse, quaternion)
            robot["grip"] = {"xyz": [float(part) for part in relative], "rpy": rpy(turned)}
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


def turned(pose):
    """Quaternion w, x, y, z of a pose of a scene."""
    quaternion = np.zeros(4)
    mujoco.mju_euler2Quat(quaternion, np.array(pose.get("rpy", (0.0, 0.0, 0.0)), dtype=float), "XYZ")
    return quaternion


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
