"""Lines of sight in a room: what a camera could see, turned as far as its card allows."""

import mujoco
import numpy as np

# Distance in m beyond the range of a camera at which the middle of a thing in view may be.
BEYOND = 0.3
# Groups of geoms that a ray meets: all but the robot.
GROUPS = np.array([1, 1, 0, 0, 1, 1], dtype=np.uint8)
# The group of the robot.
ROBOT = 1 - GROUPS
# Height in m of the scanner that notices people, and its range.
SCANNER, SCANS = 0.25, 8.0


def is_visible(model, data, base, one):
    """True if a camera could see an entity in a room."""
    return any(sees(model, data, base, camera, one) for camera in model.cameras)


def sees(model, data, base, camera, one):
    """True if a camera could see an entity in a room: in range, in view, not hidden."""
    at = model.body_of.get(one)
    if at is None:
        return False
    middle, eye = data.xpos[at], data.cam_xpos[model.mj.camera(camera).id].copy()
    far, view = model.sight[camera]
    if float(np.linalg.norm(middle - eye)) > far + BEYOND:
        return False
    bearing = np.arctan2(middle[1] - base[1], middle[0] - base[0]) - base[2]
    bearing = abs((bearing + np.pi) % (2.0 * np.pi) - np.pi)
    if bearing > view / 2.0:
        return False
    return any(first(model, data, eye, point) == one for point in points(model, one, middle))


def scans(model, data, base, person):
    """True if a laser scanner on the base, which looks on all sides, meets a person first."""
    middle = data.mocap_pos[model.people[person]]
    eye = np.array([base[0], base[1], SCANNER])
    is_near = float(np.hypot(*(middle[:2] - base[:2]))) <= SCANS
    return is_near and first(model, data, eye, np.array([middle[0], middle[1], SCANNER])) == person


def first(model, data, eye, point):
    """Entity that a ray from the eye to a point and beyond meets first, apart from the robot."""
    _, geom = ray(model, data, eye, point)
    return model.geom_owner[geom] if geom >= 0 else None


def shows(model, data, eye, point, near):
    """True if a ray from the eye meets nothing farther from a point than so many m before it, apart from the robot."""
    far, geom = ray(model, data, eye, point)
    return geom < 0 or far > np.linalg.norm(point - eye) - near


def ray(model, data, eye, point, groups=GROUPS):
    """Distance in m at which a ray from the eye to a point and beyond meets a geom, of all but the robot unless other
    groups are given, and that geom; -1 without one."""
    way, geom = point - eye, np.zeros(1, dtype=np.int32)
    args = (model.mj, data, eye, way / max(np.linalg.norm(way), 1e-9), groups, 1, -1, geom)
    try:
        far = mujoco.mj_ray(*args)
    except TypeError:
        far = mujoco.mj_ray(*args, None)
    return far, int(geom[0])


def points(model, one, middle):
    """Points of an entity at which a camera might see it: its middle, and above."""
    up = half_height(model.entities[one].get("shape", {}))
    return [middle, middle + np.array([0.0, 0.0, 0.7 * up]), middle + np.array([0.0, 0.0, 0.95 * up])]


def half_height(shape):
    """Half of the height in m of an upright shape; 0 without one."""
    if "box" in shape:
        return shape["box"][2] / 2.0
    if "cylinder" in shape:
        return shape["cylinder"]["height"] / 2.0
    if "capsule" in shape:
        return shape["capsule"]["height"] / 2.0 + shape["capsule"]["radius"]
    return shape["sphere"]["radius"] if "sphere" in shape else 0.0


def halves(shape):
    """Least and greatest half of an extent in m of a shape, as it may lie."""
    if "box" in shape:
        return min(shape["box"]) / 2.0, max(shape["box"]) / 2.0
    round_ = next((part for part in shape.values() if isinstance(part, dict) and "radius" in part), {"radius": 0.03})
    radius = round_["radius"]
    half = half_height(shape) or radius
    return min(radius, half), max(radius, half)


def width(shape, axis):
    """Extent in m of a shape along a unit vector in its frame."""
    if "box" in shape:
        return float(np.abs(axis) @ np.array(shape["box"]))
    rounds = (part for part in shape.values() if isinstance(part, dict) and "radius" in part)
    round_ = next(rounds, {"radius": 0.03})
    across = 1.0 if "height" not in round_ or "capsule" in shape else float(np.hypot(*axis[:2]))
    return 2.0 * round_["radius"] * across + round_.get("height", 0.0) * abs(float(axis[2]))
