"""Beliefs: what the robot holds to be where. They start as the scene, and follow what the robot sees and does.

The world itself is not asked here, except for what a robot feels: its joints, and what is in its hand.
"""

import copy
import re

import mujoco
import numpy as np

from .planner import rpy


class Beliefs:
    """The scene as the robot knows it."""

    def __init__(self, world):
        self.world = world
        self.scene = copy.deepcopy(world.model.scene)
        self.entities = {entity["id"]: entity for entity in self.scene["entities"]}

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
        known = self.entities.get(entity)
        if known is None or "pose" not in known:
            return None
        quaternion, rotation = np.zeros(4), np.zeros(9)
        mujoco.mju_euler2Quat(quaternion, np.array(known["pose"]["rpy"], dtype=float), "XYZ")
        mujoco.mju_quat2Mat(rotation, quaternion)
        local = rotation.reshape(3, 3).T @ (np.asarray(point) - np.array(known["pose"]["xyz"], dtype=float))
        shape = known.get("shape", {})
        if "box" in shape:
            beyond = np.abs(local) - np.array(shape["box"]) / 2.0
        elif "cylinder" in shape:
            beyond = np.array([np.hypot(*local[:2]) - shape["cylinder"]["radius"],
                               abs(local[2]) - shape["cylinder"]["height"] / 2.0])
        elif "capsule" in shape:
            line = max(abs(local[2]) - shape["capsule"]["height"] / 2.0, 0.0)
            beyond = np.array([np.hypot(np.hypot(*local[:2]), line) - shape["capsule"]["radius"]])
        else:
            radius = shape.get("sphere", {}).get("radius", 0.03)
            beyond = np.array([np.linalg.norm(local) - radius])
        return float(np.linalg.norm(np.maximum(beyond, 0.0)))

    def rests(self, entity, where, on):
        """Notes what something stands on or lies in; None for nothing."""
        known = self.entities.get(entity)
        if known is not None:
            for relation in ("on", "in"):
                known.pop(relation, None)
            if where is not None:
                known[where] = on

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
