"""Verdicts that the judge carries out: what is asked of `motet feasible`, and the states in which motions begin."""

import copy
import json
import os
import sys
import tempfile

import numpy as np

from .begin import WrongStart, begun
from .model import Model, ModelError, motet, save
from .planner import quoted, stand_at
from .sight import half_height

# Scenes of a robot that the built-in ones are too large for, and those of all others.
SCENES = {"panda": [os.path.join(os.path.dirname(__file__), "scenes", "table.json")]}
DEFAULT = ["kitchen", "lab", "living_room"]
# States in which motions begin: that of the scene, one with each drawer and door open in turn, and one with a thing in
# the hand.
BEGINNINGS = ("start", "open", "holding")
# Kinds of motions about a thing in the hand, and those of which `--all` asks.
HELD, ALL = {"put", "offer"}, {"go_to", "reach", "pull", "push", "posture"}
# Distances in m between poses of the base that are asked for, and how far they reach beyond the middles of entities.
GRID, BEYOND = 1.5, 0.5


def verdicts(command, robot, scene, *motions):
    """Feasible verdicts with their witnesses, in order: of motions, or of all from the start."""
    asked = [part for motion in motions for part in ("--for", motion)] or ["--all"]
    text = motet(command, "feasible", "--robot", robot, "--scene", scene, *asked, "--format", "json", ok=(0, 1))
    lines = [json.loads(line) for line in text.splitlines()]
    return [(line["query"], line["witness"]) for line in lines if line.get("answer") == "feasible"]


def trials(command, robot, scene, kinds, beginnings=BEGINNINGS[:1]):
    """All feasible verdicts of a scene with the model in which they are carried out: (name of the scene and state, xml,
    query, witness)."""
    xml, name = motet(command, "robots", "mjcf", "--robot", robot, "--scene", scene), os.path.basename(scene)
    real = Model(xml).scene
    with tempfile.TemporaryDirectory() as folder:
        if "start" in beginnings:
            yield from found_in(command, robot, scene, kinds - HELD, name, xml)
            for at, (held, motions) in enumerate(holdings(command, robot, real, kinds & HELD)):
                yield from found_of(command, robot, held, motions, name, folder, "held%d" % at)
        for at, (what, state) in enumerate(states(command, robot, real, set(beginnings) - {"start"})):
            path = os.path.join(folder, "state%d.json" % at)
            save(path, state)
            yield from found_in(command, robot, path, kinds - HELD, "%s, %s" % (name, what))


def found_in(command, robot, scene, kinds, name, xml=None):
    """Trials in one scene as it is, of kinds that are not about a thing in the hand."""
    try:
        xml = xml or motet(command, "robots", "mjcf", "--robot", robot, "--scene", scene)
        motions = questions(Model(xml), kinds - ALL)
        found = verdicts(command, robot, scene) if kinds & ALL else []
        found += verdicts(command, robot, scene, *motions) if motions else []
    except ModelError as error:
        print("%s: %s" % (name, error), file=sys.stderr)
        return
    for query, witness in found:
        if query.partition("(")[0] in kinds:
            yield name, xml, query, witness


def found_of(command, robot, scene, motions, name, folder, called):
    """Trials of some motions in a scene that is no file."""
    path = os.path.join(folder, called + ".json")
    save(path, scene)
    try:
        found = verdicts(command, robot, path, *motions)
        xml = motet(command, "robots", "mjcf", "--robot", robot, "--scene", path) if found else None
    except ModelError as error:
        print("%s, holding %s: %s" % (name, scene["robot"]["holding"], error), file=sys.stderr)
        return
    for query, witness in found:
        yield name, xml, query, witness


def questions(model, kinds):
    """Queries of some kinds about the entities of a scene: a grasp of each thing above its middle, a look at each
    entity, and poses of the base on a grid over the room."""
    entities = [one for one in model.scene["entities"] if "pose" in one and "shape" in one]
    held, asked = model.scene["robot"].get("holding"), []
    if "reach_at" in kinds:
        for thing in entities:
            if thing["id"] in model.free and thing["id"] != held:
                x, y, z = np.array(thing["pose"]["xyz"]) + [0.0, 0.0, half_height(thing["shape"]) / 3.0]
                asked.append("reach_at(%s, pose(%.4f m, %.4f m, %.4f m, 0 rad))" % (quoted(thing["id"]), x, y, z))
    if "look" in kinds and model.cameras:
        asked.extend("look(%s)" % quoted(one["id"]) for one in entities if one["id"] != held)
    if "stand_at" in kinds and model.drives:
        places = np.array([one["pose"]["xyz"][:2] for one in entities])
        low, high = places.min(axis=0) - BEYOND, places.max(axis=0) + BEYOND
        turn = 0.0
        for x in np.arange(low[0], high[0] + 1e-6, GRID):
            for y in np.arange(low[1], high[1] + 1e-6, GRID):
                asked.append(stand_at(x, y, turn))
                # Another direction at each of them.
                turn = (turn + 2.0) % (2.0 * np.pi) - np.pi
    return asked


def holdings(command, robot, scene, kinds):
    """Scenes in which the hand holds a thing, with the motions about it: to put it down from the start, and to offer it
    to a person from where the robot serves that person."""
    things = [one for one in scene["entities"] if one["kind"] == "Object" and not one.get("fixed") and "shape" in one]
    supports = [one["id"] for one in scene["entities"] if one["kind"] in ("Surface", "Container")]
    people = [one["id"] for one in scene["entities"] if one["kind"] == "Person"]
    bases = {person: served(command, robot, scene, person) for person in people} if "offer" in kinds else {}
    grasped = graspable(command, robot, scene) if bases else []
    for thing in things if kinds else ():
        held = holding(scene, thing["id"])
        if "put" in kinds:
            yield held, ["put(%s, %s)" % (quoted(thing["id"]), quoted(support)) for support in supports]
        for person, base in bases.items():
            if base is not None and thing["id"] in grasped:
                there = copy.deepcopy(held)
                there["robot"]["base"] = base
                yield there, ["offer(%s, %s)" % (quoted(thing["id"]), quoted(person))]


def holding(scene, thing):
    """A scene in which the hand holds a thing, and nothing stands on it: that would fall."""
    held = begun(scene, [("holding", [thing], True)], None)
    held["entities"] = [one for one in held["entities"] if one.get("on") != thing]
    return held


def served(command, robot, scene, one):
    """Base from which the robot serves an entity; None without one."""
    found = asked_of(command, robot, scene, "go_to(%s)" % quoted(one))
    return found[0][1]["path"][-1]["base"] if found else None


def graspable(command, robot, scene):
    """Things that the hand can grasp from the start."""
    found = [query for query, _ in asked_of(command, robot, scene) if query.startswith("reach(")]
    return [query.removeprefix("reach(").removesuffix(")").replace("`", "") for query in found]


def asked_of(command, robot, scene, *motions):
    """Feasible verdicts of a scene that is no file, as `verdicts` gives them."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "scene.json")
        save(path, scene)
        return verdicts(command, robot, path, *motions)


def states(command, robot, scene, beginnings):
    """Other states in which motions begin, each with what holds in it: (words, scene)."""
    if "open" in beginnings:
        for one in scene["entities"]:
            if "travel" in one and not one.get("open") and not one.get("locked"):
                try:
                    yield "%s open" % one["id"], begun(scene, [("open", [one["id"]], True)], None)
                except WrongStart:
                    continue
    if "holding" in beginnings and scene["robot"].get("holding") is None:
        for thing in graspable(command, robot, scene)[:1]:
            yield "holding %s" % thing, holding(scene, thing)
