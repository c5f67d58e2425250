"""Answers to queries about the world: facts from contacts and poses, measures from poses and forces."""

import mujoco
import numpy as np

GRAVITY = 9.81
# Distances in m: near from the rim of the base, at a place, and as far as a person reaches out.
NEAR, AT_PLACE, PERSON_REACH = 1.5, 0.5, 0.5
UNKNOWN = "unknown"


class Observer:
    """What holds now. `visited` and the battery are kept here; all else is read from the world."""

    def __init__(self, world):
        self.world, self.model = world, world.model
        self.visited = set()
        self.standing = True
        self.posture = "home"
        self.driven, self.last = 0.0, world.base()
        self.start = world.base()[:2].copy()
        self.told = {}
        self.unmoved = True
        self.moved = set()

    def tick(self):
        """Counts the way that was driven."""
        base = self.world.base()
        self.driven += float(np.hypot(*(base[:2] - self.last[:2])))
        if np.abs(base - self.last).max() > 1e-4:
            self.unmoved = False
        self.last = base

    def answer(self, query):
        """The answer to a query of the driver protocol."""
        if "fact" in query:
            truth = self.some(query["fact"]["fluent"], query["fact"]["args"], [])
            return UNKNOWN if truth is None else {"truth": bool(truth)}
        if "measure" in query:
            value = self.measure(query["measure"]["measure"], query["measure"].get("args", []))
        else:
            value = self.field(query["field"]["entity"], query["field"]["field"])
        return UNKNOWN if value is None else {"value": {"number": float(value)}}

    def some(self, fluent, patterns, chosen):
        """True if a fluent holds of the arguments, or with `any` of some; None where it is not known."""
        if not patterns:
            return self.fact(fluent, chosen)
        first, rest = patterns[0], patterns[1:]
        if first != "any":
            return self.some(fluent, rest, [*chosen, named(first["is"])])
        found = [self.some(fluent, rest, [*chosen, one]) for one in [*self.model.entities, "robot", "hand"]]
        if any(found):
            return True
        return False if False in found else None

    def fact(self, fluent, args):
        """A fluent of entities."""
        world, model = self.world, self.model
        if len(args) == 2 and fluent in ("at", "on", "in") and args[0] in model.entities and args[1] not in model.entities:
            return self.is_beside(args[0]) if (fluent, args[1]) == ("at", "start") else False
        if any(one not in model.entities and one not in ("robot", "hand") for one in args):
            return None
        if len(args) == 2:
            return self.relation(fluent, *args)
        if len(args) != 1:
            return None
        [one] = args
        if fluent == "free":
            return not world.held() if one == "hand" else None
        if one == "robot":
            postures = {"arm_home": "home", "arm_ready": "ready", "arm_carry": "carry"}
            if fluent == "standing":
                return self.standing
            return self.posture == postures[fluent] if fluent in postures else None
        if one == "hand":
            return None
        thing = model.entities[one]
        if fluent == "holding":
            return world.holds(one)
        if fluent == "lifted":
            return world.is_lifted(one)
        if fluent in ("visible", "located"):
            return self.is_visible(one)
        if fluent == "near":
            gap = self.gap(one)
            return None if gap is None else gap - self.radius <= NEAR
        if fluent == "reachable":
            return self.serves(one)
        if fluent == "open":
            opened = world.is_open(one)
            return thing.get("open") if opened is None else opened
        if fluent == "locked":
            return self.is_locked(one)
        if fluent == "clear":
            return not any(one in world.bearers(other) and not world.is_in(other, one) for other in model.free)
        if fluent == "visited":
            return one in self.visited
        if fluent == "standing" and thing["kind"] == "Person":
            return True
        return None

    def relation(self, fluent, one, to):
        """A fluent of two entities."""
        world, model = self.world, self.model
        if one == "robot":
            return self.serves(to) if fluent == "at" else None
        if one == "hand":
            return None
        if one == to:
            return False if fluent in ("at", "on", "in") else None
        kind = model.entities[to]["kind"]
        if fluent == "on":
            return one in model.free and world.is_on(one, to)
        if fluent == "in":
            return one in model.free and world.is_in(one, to) and not world.is_lifted(one)
        if fluent == "at":
            if kind == "Person":
                return world.carried_by.get(one, (None,))[0] == to
            if kind in ("Place", "Zone"):
                place = model.entities[to].get("pose")
                return place is not None and self.is_beside(one, place["xyz"][:2])
            return one in model.free and (world.is_on(one, to) or self.relation("in", one, to))
        return None

    def is_beside(self, one, place=None):
        """True if an entity is at a point, or at the one from which the robot began; what is lifted is nowhere."""
        pose = self.world.pose(one)
        if pose is None or self.world.is_lifted(one):
            return False
        return bool(np.hypot(*(pose[0][:2] - np.array(self.start if place is None else place))) <= AT_PLACE)

    @property
    def radius(self):
        return self.model.card[0]

    def gap(self, one, outline=True):
        """Distance in the plane from the axis of the base to an entity, or to its outline."""
        entity, world = self.model.entities[one], self.world
        pose = world.pose(one)
        if pose is not None:
            position, quaternion = pose
        elif "pose" in entity:
            position, quaternion = np.array(entity["pose"]["xyz"]), None
        else:
            return None
        off = world.base()[:2] - position[:2]
        if not outline:
            return float(np.hypot(*off))
        shape = entity.get("shape", {})
        if "box" in shape and quaternion is not None:
            rotation = np.zeros(9)
            mujoco.mju_quat2Mat(rotation, quaternion)
            local = rotation.reshape(3, 3)[:2, :2].T @ off
            beyond = np.maximum(np.abs(local) - np.array(shape["box"][:2]) / 2.0, 0.0)
            return float(np.hypot(*beyond))
        round_ = next((part for part in shape.values() if isinstance(part, dict)), {})
        radius = round_.get("radius", 0.3 if entity["kind"] == "Person" else 0.0)
        return max(float(np.hypot(*off)) - radius, 0.0)

    def serves(self, one):
        """True if the robot serves an entity from where its base stands."""
        kind, reach = self.model.entities[one]["kind"], self.model.card[1]
        if kind in ("Place", "Zone"):
            gap, most = self.gap(one), AT_PLACE
        elif kind == "Person":
            gap, most = self.gap(one), reach + PERSON_REACH
        elif kind in ("Surface", "Container"):
            gap, most = self.gap(one), reach
        else:
            below = [other for other in self.world.bearers(one) if other in self.model.entities]
            inside = [other for other in self.model.doors if self.world.is_in(one, other)]
            if any(self.serves(other) for other in below + inside if other != one):
                return True
            gap, most = self.gap(one), reach
        return None if gap is None else gap <= most + 0.01

    def is_locked(self, one):
        """True if a lock keeps a drawer or door where it is."""
        at = mujoco.mj_name2id(self.model.mj, mujoco.mjtObj.mjOBJ_EQUALITY, escaped(one) + "/lock")
        return False if at < 0 else bool(self.world.data.eq_active[at])

    def is_visible(self, one):
        """True if a camera of the robot could see an entity from where the base is: in range, in view, not hidden.

        What the scene says counts until the base has moved or the thing has.
        """
        entity = self.model.entities[one]
        if self.unmoved and one not in self.moved and "visible" in entity:
            return bool(entity["visible"])
        return any(self.sees(camera, one) for camera in self.model.cameras)

    def sees(self, camera, one):
        """True if a camera could see an entity, turned to it as far as its card allows."""
        model, world = self.model, self.world
        pose = world.pose(one)
        if pose is None:
            return False
        eye = world.data.cam_xpos[model.mj.camera(camera).id].copy()
        far, view = model.sight[camera]
        if float(np.linalg.norm(pose[0] - eye)) > far + 0.3:
            return False
        x, y, yaw = world.base()
        bearing = np.arctan2(pose[0][1] - y, pose[0][0] - x) - yaw
        bearing = abs((bearing + np.pi) % (2.0 * np.pi) - np.pi)
        if bearing > view / 2.0:
            return False
        return any(self.ray(eye, point) == one for point in points_of(world, one, pose))

    def ray(self, eye, point):
        """What a ray from the eye to a point meets first, apart from the robot."""
        way = point - eye
        geom = np.zeros(1, dtype=np.int32)
        groups = np.array([1, 1, 0, 0, 1, 1], dtype=np.uint8)
        length = np.linalg.norm(way)
        args = (self.model.mj, self.world.data, eye, way / max(length, 1e-9), groups, 1, -1, geom)
        try:
            mujoco.mj_ray(*args)
        except TypeError:
            mujoco.mj_ray(*args, None)
        return self.model.geom_owner[geom[0]] if geom[0] >= 0 else None

    def measure(self, measure, args):
        """A reading."""
        world, model = self.world, self.model
        if measure == "distance" and args:
            one = named(args[0])
            gap = self.gap(one) if one in model.entities else None
            return None if gap is None else max(gap - self.radius, 0.0)
        if measure == "battery":
            return max(0.0, 1.0 - 1e-4 * world.now - 1e-3 * self.driven)
        if measure == "force":
            return sum(model.mass(thing) * GRAVITY for thing in world.held() if world.is_lifted(thing))
        return None

    def field(self, entity, field):
        """A field of an entity."""
        known = self.model.entities.get(entity)
        if known is None:
            return None
        if field == "mass":
            return self.model.mass(entity) if entity in self.model.free else known.get("mass")
        value = known.get(field, known.get("fields", {}).get(field))
        if field == "width" and value is None:
            value = width(known.get("shape", {}))
        return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def width(shape):
    """Opening in m that a hand needs for a shape: its smallest horizontal extent, or None."""
    if "box" in shape:
        return min(shape["box"][:2])
    round_ = next((part for part in shape.values() if isinstance(part, dict) and "radius" in part), None)
    return None if round_ is None else 2.0 * round_["radius"]


def points_of(world, one, pose):
    """Points of an entity at which a camera might see it: its middle, above and to the sides."""
    shape = world.model.entities[one].get("shape", {})
    up = 0.0
    if "box" in shape:
        up = shape["box"][2] / 2.0
    elif "cylinder" in shape:
        up = shape["cylinder"]["height"] / 2.0
    elif "sphere" in shape:
        up = shape["sphere"]["radius"]
    return [pose[0], pose[0] + np.array([0.0, 0.0, 0.7 * up]), pose[0] + np.array([0.0, 0.0, 0.95 * up])]


def named(value):
    """The name of an entity or a case."""
    return value.get("entity", value.get("case"))


def escaped(text):
    from .model import name

    return name(text)
