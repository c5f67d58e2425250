"""Answers to queries: facts and measures of a room. The room is the world itself, for judges, or what the robot knows
of it (`senses.py`)."""

import math

import mujoco
import numpy as np

GRAVITY = 9.81
# Distances in m: near from the rim of the base, at a place, and as far as a person reaches out.
NEAR, AT_PLACE, PERSON_REACH = 1.5, 0.5, 0.5
UNKNOWN = "unknown"
# Fluents of which the eyes tell.
SEEN = ("visible", "located", "on", "in", "open", "clear")


class Own:
    """What the robot knows of itself: its posture, its way, and what it has moved or looked at."""

    def __init__(self, world):
        self.visited, self.moved = set(), set()
        self.standing, self.posture = True, "home"
        self.driven, self.last, self.unmoved = 0.0, world.base(), True
        self.start = world.base()[:2].copy()
        self.charge = None  # of the battery, where it is given

    def tick(self, world):
        """Counts the way that was driven."""
        base = world.base()
        x, y, yaw = (base - self.last).tolist()
        if x == y == yaw == 0.0:
            return
        self.driven += math.hypot(x, y)
        if max(abs(x), abs(y), abs(yaw)) > 1e-4:
            self.unmoved = False
        self.last = base


class Observer:
    """What holds now in a room: in the world without another one."""

    def __init__(self, world, room=None, own=None):
        self.world, self.model, self.room = world, world.model, room or world
        # What the robot knows of.
        self.entities = world.model.entities if room is None else room.beliefs.entities
        self.things = lambda: world.model.free if room is None else room.beliefs.things()
        self.own = own or Own(world)

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
        found = [self.some(fluent, rest, [*chosen, one]) for one in [*self.entities, "robot", "hand"]]
        if any(found):
            return True
        return False if False in found else None

    def fact(self, fluent, args):
        """A fluent of entities."""
        entities = self.entities
        if len(args) == 2 and fluent in ("at", "on", "in") and args[0] in entities and args[1] not in entities:
            is_start = (fluent, args[1]) == ("at", "start") and not self.room.is_lifted(args[0])
            return self.stands(args[0], self.own.start) if is_start else False
        if any(one not in entities and one not in ("robot", "hand") for one in args):
            return None
        if len(args) == 2:
            return self.relation(fluent, *args)
        if len(args) != 1:
            return None
        [one] = args
        if one == "hand":
            return not self.room.held() if fluent == "free" else None
        return self.of_robot(fluent) if one == "robot" else self.state(fluent, one)

    def of_robot(self, fluent):
        """A fluent of the robot."""
        postures = {"arm_home": "home", "arm_ready": "ready", "arm_carry": "carry"}
        if fluent == "standing":
            return self.own.standing
        return self.own.posture == postures[fluent] if fluent in postures else None

    def state(self, fluent, one):
        """A fluent of one entity."""
        room, thing = self.room, self.entities[one]
        if fluent == "holding":
            return room.holds(one)
        if fluent == "lifted":
            return room.is_lifted(one)
        if fluent == "visible":
            return self.is_visible(one)
        if fluent == "located":
            return room.is_located(one) if one in self.things() else self.is_visible(one)
        if fluent == "near":
            gap = self.gap(one)
            return None if gap is None else gap - self.radius <= NEAR
        if fluent == "reachable":
            return self.serves(one)
        if fluent == "open":
            opened = room.is_open(one)
            return thing.get("open") if opened is None and one not in self.model.doors else opened
        if fluent == "locked":
            return room.is_locked(one)
        if fluent == "clear":
            return not any(room.is_on(other, one) for other in self.things())
        if fluent == "visited":
            return one in self.own.visited
        return True if fluent == "standing" and thing["kind"] == "Person" else None

    def relation(self, fluent, one, to):
        """A fluent of two entities."""
        room, model = self.room, self.model
        if one == "robot":
            return self.serves(to) if fluent == "at" else None
        if one == "hand" or fluent not in ("on", "in", "at"):
            return None
        if one == to:
            return False
        kind = self.entities[to]["kind"]
        if one not in self.things():
            return self.stands(one, self.point(to)) if fluent == "at" and kind in ("Place", "Zone") else False
        if fluent == "on":
            return room.is_on(one, to)
        if fluent == "in":
            return False if room.is_lifted(one) else room.is_in(one, to)
        if kind == "Person":
            return room.is_given(one, to)
        if kind in ("Place", "Zone"):
            return False if room.is_lifted(one) else self.stands(one, self.point(to))
        is_on, is_in = room.is_on(one, to), self.relation("in", one, to)
        return True if is_on or is_in else None if None in (is_on, is_in) else False

    def point(self, place):
        """Where a place is in the plane; None if nobody says."""
        at = self.entities[place].get("pose")
        return None if at is None else np.array(at["xyz"][:2])

    def stands(self, one, point):
        """True if an entity stands about at a point; None where it is not known."""
        if self.room.pose(one) is None:
            return None if one in self.things() else False
        pose = self.room.pose(one)[0]
        return point is not None and bool(np.hypot(*(pose[:2] - point)) <= AT_PLACE)

    @property
    def radius(self):
        return self.model.card[0]

    def gap(self, one, outline=True, shift=0.0):
        """Distance in the plane from the axis of the base to an entity, or to its outline, where it stands or shifted."""
        entity = self.entities[one]
        pose = self.room.pose(one)
        if pose is not None:
            position, quaternion = pose
        elif "pose" in entity and one not in self.things():
            position, quaternion = np.array(entity["pose"]["xyz"]), None
        else:
            return None
        off = self.world.base()[:2] - (position + shift)[:2]
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
        kind, reach = self.entities[one]["kind"], self.model.card[1]
        if kind in ("Place", "Zone"):
            gap, most = self.gap(one), AT_PLACE
        elif kind == "Person":
            gap, most = self.gap(one), reach + PERSON_REACH
        elif kind in ("Surface", "Container"):
            gap, most, off = self.gap(one), reach, self.model.drawn(one)
            if gap is not None and off is not None and self.room.is_open(one):
                gap = min(gap, self.gap(one, shift=off))
        else:
            if any(self.serves(other) for other in self.room.supports(one) if other != one):
                return True
            gap, most = self.gap(one), reach
        return None if gap is None else gap <= most + 0.01

    def is_visible(self, one):
        """True if a camera of the robot could see an entity from where the base is: in range, in view, not hidden.

        What the scene says counts until the base has moved or the thing has.
        """
        entity = self.entities[one]
        if self.own.unmoved and one not in self.own.moved and "visible" in entity:
            return bool(entity["visible"])
        return self.room.is_visible(one)

    def measure(self, measure, args):
        """A reading."""
        world, model = self.world, self.model
        if measure == "distance" and args:
            one = named(args[0])
            gap = self.gap(one) if one in self.entities else None
            return None if gap is None else max(gap - self.radius, 0.0)
        if measure == "battery" and self.own.charge is not None:
            return self.own.charge
        if measure == "battery":
            return max(0.0, 1.0 - 1e-4 * world.now - 1e-3 * self.own.driven)
        if measure == "force":
            return sum(model.mass(thing) * GRAVITY for thing in world.held() if world.is_lifted(thing))
        return None

    def field(self, entity, field):
        """A field of an entity."""
        known = self.entities.get(entity)
        if known is None:
            return None
        if field == "mass":
            return self.model.mass(entity) if entity in self.model.free else known.get("mass")
        value = known.get(field, known.get("fields", {}).get(field))
        if field == "width" and value is None:
            value = width(known.get("shape", {}))
        return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None


def needs_eyes(query):
    """True if a look may tell something of a query."""
    fact = query.get("fact")
    if fact is None:
        return False
    return fact["fluent"] in SEEN or fact["fluent"] == "at" and fact["args"][0] != {"is": {"entity": "robot"}}


def width(shape):
    """Opening in m that a hand needs for a shape: its smallest horizontal extent, or None."""
    if "box" in shape:
        return min(shape["box"][:2])
    round_ = next((part for part in shape.values() if isinstance(part, dict) and "radius" in part), None)
    return None if round_ is None else 2.0 * round_["radius"]


def named(value):
    """The name of an entity or a case."""
    return value.get("entity", value.get("case"))
