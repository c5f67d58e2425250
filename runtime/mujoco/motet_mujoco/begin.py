"""Facts at the start, as `hello` lists them: the scene is changed so that the world begins in them."""

import copy
import os
import tempfile

import numpy as np

from .model import ModelError, drawn, load, save
from .planner import quoted, rpy
from .sight import half_height

# Distance in m of a thing from the rim of what it is put on, and of things from each other; height above its bottom.
RIM, APART, BOTTOM = 0.05, 0.12, 0.01


class WrongStart(Exception):
    """The world cannot begin in a fact; the text is for people."""


def model_of(robot, scene, command):
    """The model of a robot in a scene that is no file."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.json")
        save(path, scene)
        try:
            return load(robot, path, command)
        except ModelError as error:
            raise WrongStart(str(error)) from None


def whole(model, command):
    """A model in which all things have a place that its scene puts in or on something without saying where. A
    world without them could never show them. What the scene says nothing of, or what has no room, stays
    nowhere."""
    scene = copy.deepcopy(model.scene)
    entities = {entity["id"]: entity for entity in scene["entities"]}
    lost = [thing for thing in entities.values() if thing["kind"] == "Object" and "shape" in thing
            and "pose" not in thing and scene["robot"].get("holding") != thing["id"]]
    is_changed, left = False, None
    # What one of them stands on may be another one.
    while left != len(lost):
        left = len(lost)
        for thing in list(lost):
            relation = next((one for one in ("on", "in") if thing.get(one) in entities), None)
            try:
                if relation is not None:
                    lay(scene, thing, relation, entities[thing[relation]])
                    lost.remove(thing)
                    is_changed = True
            except WrongStart:
                continue
    return model_of(model.source, scene, command) if is_changed else model


def told_apart(model, told, command):
    """The real model, and the scene that the robot is told of, if it is another one: the robot knows no more than
    the scene says."""
    real = whole(model, command)
    return real, model.scene if told is None and real is not model else told


def begun(scene, facts, planner, grips=None, is_told=False):
    """A scene in which facts hold: (fluent, arguments, truth) each. Others than those of hand, doors and places are
    left to the caller. `grips` are poses of held things in the frame of the tip, with a quaternion x, y, z, w. In a
    scene that the robot was told of, things without a pose get none: it does not know where they lie."""
    scene = copy.deepcopy(scene)
    entities = {entity["id"]: entity for entity in scene["entities"]}
    for fluent, args, holds in facts:
        known = [entities.get(one) for one in args]
        if fluent == "open" and known[0] is not None and "travel" in known[0]:
            slide(known[0], holds, entities.values())
        elif fluent == "holding" and known[0] is not None:
            hold(scene, known[0], holds)
        elif fluent in ("on", "in") and None not in known and holds and is_told and "pose" not in known[0]:
            relate(known[0], fluent, known[1])
        elif fluent in ("on", "in") and None not in known and holds:
            lay(scene, known[0], fluent, known[1])
    grip = (grips or {}).get(scene["robot"].get("holding"))
    if grip is not None:
        x, y, z, w = grip["quaternion"]
        scene["robot"]["grip"] = {"xyz": grip["xyz"], "rpy": rpy((w, x, y, z))}
    # Where it stands depends on all of these.
    for fluent, args, holds in facts:
        if fluent == "at" and args[0] == "robot" and holds and planner is not None:
            witness, why = planner.plan(scene, "go_to(%s)" % quoted(args[1]))
            if witness is None:
                raise WrongStart("the robot cannot begin at `%s`: %s" % (args[1], why[1]))
            scene["robot"]["base"] = witness["path"][-1]["base"]
    return scene


def hold(scene, thing, holds):
    """Puts a thing into the hand, as `reach` grips it, or says that the hand does not hold it."""
    robot, held = scene["robot"], scene["robot"].get("holding")
    if holds and held != thing["id"]:
        robot["holding"] = thing["id"]
        robot.pop("grip", None)
        for relation in ("on", "in"):
            thing.pop(relation, None)
    elif not holds and held == thing["id"]:
        robot["holding"] = None
        robot.pop("grip", None)


def slid(container):
    """Offset in m in the map by which an open drawer is off its place now."""
    way = drawn(container) if container.get("open") else None
    return np.zeros(3) if way is None else way


def slide(container, is_open, things):
    """Opens or shuts a container, and takes along what lies in a drawer."""
    before = slid(container)
    container["open"] = is_open
    way = slid(container) - before
    for thing in things:
        if thing.get("in") == container["id"] and "pose" in thing:
            thing["pose"]["xyz"] = [float(at) for at in np.array(thing["pose"]["xyz"]) + way]


def relate(thing, relation, support):
    """Says what a thing is on or in, and nothing of where."""
    for other in ("on", "in", "visible"):
        thing.pop(other, None)
    thing[relation] = support["id"]


def lay(scene, thing, relation, support):
    """Puts a thing on or into another, at the free place that is nearest to its middle."""
    if thing.get(relation) == support["id"] and "pose" in thing:
        return
    if "pose" not in support or "shape" not in support:
        raise WrongStart("nobody knows where `%s` is, so `%s` cannot begin there" % (support["id"], thing["id"]))
    relate(thing, relation, support)
    others = [np.array(one["pose"]["xyz"][:2]) for one in scene["entities"] if "pose" in one and one is not thing
              and support["id"] in (one.get("on"), one.get("in"))]
    shape, (x, y, z) = support["shape"], np.array(support["pose"]["xyz"]) + slid(support)
    yaw = support["pose"].get("rpy", (0.0, 0.0, 0.0))[2]
    sides = shape.get("box") or [1.4 * next(iter(shape.values())).get("radius", 0.2)] * 2
    spans = [np.linspace(-1.0, 1.0, 9) * max(side / 2.0 - RIM, 0.0) for side in sides[:2]]
    turn = np.array([[np.cos(yaw), -np.sin(yaw)], [np.sin(yaw), np.cos(yaw)]])
    spots = sorted(((a, b) for a in spans[0] for b in spans[1]), key=lambda spot: np.hypot(*spot))
    places = [np.array([x, y]) + turn @ np.array(spot) for spot in spots]
    free = [place for place in places if all(np.linalg.norm(place - other) >= APART for other in others)]
    if not free:
        raise WrongStart("`%s` has no room for `%s`" % (support["id"], thing["id"]))
    up = half_height(shape) if relation == "on" else BOTTOM - half_height(shape)
    high = z + up + half_height(thing.get("shape", {}))
    thing["pose"] = {"xyz": [float(free[0][0]), float(free[0][1]), float(high)], "rpy": [0.0, 0.0, 0.0]}
