"""What an exported room says, as shapes of coal and models of pinocchio. Lengths in m, angles in rad."""

import math
import pathlib
import xml.etree.ElementTree as xml

import coal
import numpy as np
import pinocchio as pin

ROOT = pathlib.Path(__file__).resolve().parents[3]


def urdf(robot):
    return str(ROOT / "robots" / "models" / robot / "robot.urdf")


def pose(values):
    """A pose from `x y z` and a quaternion `x y z w`."""
    x, y, z, i, j, k, w = values
    return pin.SE3(pin.Quaternion(w, i, j, k).normalized().matrix(), np.array([x, y, z]))


def followers(robot):
    """Joints that follow another: its name, a factor, an offset. pinocchio takes one that follows a joint of a later branch
    for a mistake, so they are worked out by hand."""
    rules = [(it.get("name"), it.find("mimic")) for it in xml.parse(urdf(robot)).getroot().findall("joint")]
    return {
        name: (rule.get("joint"), float(rule.get("multiplier", 1)), float(rule.get("offset", 0)))
        for name, rule in rules if rule is not None
    }


def turn_joints(model, q, values, follows):
    """Writes joints into pinocchio's row of numbers, by name, with those that follow them."""
    values = values | {name: f * values[of] + more for name, (of, f, more) in follows.items()}
    for name, value in values.items():
        joint = model.joints[model.getJointId(name)]
        if joint.nq == 1:
            q[joint.idx_q] = value
        else:
            q[joint.idx_q], q[joint.idx_q + 1] = math.cos(value), math.sin(value)


def obstacle(it):
    """Entity, shape and pose in the map."""
    shape, at = it["shape"], pose(it["pose"])
    if "box" in shape:
        return it["entity"], coal.Box(*shape["box"]), at
    if "ball" in shape:
        return it["entity"], coal.Sphere(shape["ball"]), at
    radius, length = shape["cylinder_along_y"]
    # coal's cylinder lies along z.
    return it["entity"], coal.Cylinder(radius, length), at * pin.SE3(pin.utils.rotate("x", -math.pi / 2), np.zeros(3))
