"""Faults of a file, as the kinematic world has them: calls that fail, and changes of the room at their times."""

import json

import numpy as np

from .disorder import APART, lay
from .model import ModelError
from .sight import half_height

# Seconds that a call with a fault takes, and that somebody takes to open or close something.
TAKES, SWINGS = 2.0, 1.0
# Distance in m from the middle of a thing that slips to where it then is, along the fingers.
SLIPS_BY = 0.12
# Spots that are tried in a container along each side.
SPOTS = 7


def read(path):
    """A file of faults. The host knows its form (`motet schema faults`)."""
    try:
        with open(path, encoding="utf-8") as text:
            return json.load(text)
    except (OSError, ValueError) as error:
        raise ModelError("%s: %s" % (path, error)) from None


def answers(path):
    """A file of answers: texts, and None for a refusal."""
    listed = read(path)
    if not isinstance(listed, list) or any(not isinstance(one, (str, type(None))) for one in listed):
        raise ModelError("%s: a list of answers is expected, such as [\"the red one\", null]" % path)
    return listed


class Faults:
    """Faults that are still to come. Calls and answers count from 1."""

    def __init__(self, script=None):
        script = script or {}
        self.calls, self.counts, self.asked = script.get("calls", []), {}, 0
        changes = script.get("world", [])
        self.later = [one for one in changes if "after_answer" in one]
        timed = [(float(one.get("at", 0.0)), one["what"]) for one in changes if "after_answer" not in one]
        self.changes = sorted(timed, key=lambda one: one[0])
        self.swings = {}

    def of_call(self, primitive):
        """Counts a call, and gives what happens to it: the last failure or refusal, "hangs", and a factor of time."""
        count = self.counts[primitive] = self.counts.get(primitive, 0) + 1
        fate = {"slower": 1.0}
        for one in self.calls:
            if one["primitive"] == primitive and one.get("nth", count) == count:
                then = {"hangs": True} if one["then"] == "hangs" else dict(one["then"])
                fate.update(then, slower=fate["slower"] * float(then.get("slower", 1.0)))
        return fate

    def answered(self, now):
        """A person has answered: what follows from it is now due."""
        self.asked += 1
        due = [one for one in self.later if one["after_answer"] == self.asked]
        self.changes = sorted([*self.changes, *((now + float(one.get("at", 0.0)), one["what"]) for one in due)],
                              key=lambda one: one[0])

    def tick(self, world, people, own, chance, now):
        """Lets happen what is due at a time of the run."""
        while self.changes and self.changes[0][0] <= now:
            happen(self, world, people, own, chance, self.changes.pop(0)[1])
        for container, rate in list(self.swings.items()):
            at, travel, _ = world.model.doors[container]
            dof, before = world.model.mj.jnt_dofadr[joint_at(world, at)], world.data.qpos[at]
            share = np.clip(before / travel + rate * world.tick, 0.0, 1.0)
            world.data.qpos[at], world.data.qvel[dof] = share * travel, 0.0
            if share in (0.0, 1.0):
                del self.swings[container]


def joint_at(world, qpos):
    """Joint at a place of the positions."""
    return int(np.flatnonzero(world.model.mj.jnt_qposadr == qpos)[0])


def happen(faults, world, people, own, chance, what):
    """A change of the room. One of a thing that does not exist does not happen."""
    [(kind, of)] = what.items()
    if kind == "moves":
        move(world, of["object"], of["to"], chance)
    elif kind == "walks" and of["person"] in world.model.people:
        at = world.model.people[of["person"]]
        if of.get("from") is not None:
            world.data.mocap_pos[at, :2] = of["from"]
        people.walks = [walk for walk in people.walks if walk[0] != of["person"]]
        people.walks.append((of["person"], tuple(of["to"]), world.now, float(of["speed"])))
    elif kind == "slips" and world.holds(of):
        world.place(of, world.pose(of)[0] + SLIPS_BY * world.tip()[1][:, 2])
    elif kind in ("opens", "closes") and of in world.model.doors and not world.is_locked(of):
        faults.swings[of] = (1.0 if kind == "opens" else -1.0) / SWINGS
    elif kind in ("locks", "unlocks") and of in world.model.doors:
        world.lock(of, kind == "locks")
    elif kind == "battery":
        own.charge = float(of)


def move(world, thing, to, chance):
    """Somebody puts a thing on a surface, into a container or to a point."""
    if thing not in world.model.free:
        return
    [(kind, of)] = to.items()
    if kind == "point":
        world.place(thing, np.array(of, dtype=float))
    elif kind == "surface" and of in world.model.body_of:
        lay(world, thing, of, chance)
    elif kind == "container" and "box" in world.model.entities.get(of, {}).get("shape", {}):
        before, half = world.pose(thing)[0], half_height(world.model.entities[thing].get("shape", {}))
        at, sides = world.model.leaf_of(of), np.array(world.model.entities[of]["shape"]["box"])
        spans = [np.linspace(-1.0, 1.0, SPOTS) * max(side / 2.0 - half - 0.02, 0.0) for side in sides[:2]]
        spots = sorted(((x, y) for x in spans[0] for y in spans[1]), key=lambda spot: np.hypot(*spot))
        for x, y in spots:
            local = np.array([x, y, 0.02 + half - sides[2] / 2.0])
            world.place(thing, world.data.xpos[at] + world.data.xmat[at].reshape(3, 3) @ local)
            world.refresh()
            if not any(gap < APART for other, gap in world.gaps(thing, APART) if other != of):
                return
        world.place(thing, before)
