"""Things of which a scene does not say where in a container they are."""

import json

import numpy as np
from motet_mujoco.begin import begun, model_of, told_apart, whole
from motet_mujoco.model import load
from motet_mujoco.world import World


def hidden(motet, tmp_path, container, **state):
    """The kitchen with the coke in a container, nobody says where, and the real model of it."""
    model = load("hsr", "kitchen", motet)
    coke = model.entities["coke"]
    for key in ("on", "pose", "visible"):
        coke.pop(key, None)
    coke["in"] = container
    model.entities[container].update(state)
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(model.scene), encoding="utf-8")
    told = load("hsr", str(path), motet)
    return told, whole(told, motet)


def test_a_thing_without_a_place_is_somewhere_in_its_container(motet, tmp_path):
    model, real = hidden(motet, tmp_path, "cupboard_1")
    _, told = told_apart(model, None, motet)
    assert "pose" not in next(one for one in told["entities"] if one["id"] == "coke"), "the robot knows no more"
    world = World(real)
    world.wait(1.0)
    assert world.is_in("coke", "cupboard_1")


def test_a_thing_in_an_open_drawer_is_in_the_drawer(motet, tmp_path):
    _, real = hidden(motet, tmp_path, "drawer_1", open=True)
    world = World(real)
    world.wait(1.0)
    assert world.is_in("coke", "drawer_1"), world.pose("coke")


def test_a_drawer_that_is_open_at_the_start_has_taken_its_things_along(motet, tmp_path):
    _, real = hidden(motet, tmp_path, "drawer_1")
    scene = begun(real.scene, [("open", ["drawer_1"], True)], None)
    world = World(model_of(real.source, scene, motet))
    world.wait(1.0)
    assert world.is_in("coke", "drawer_1"), world.pose("coke")


def test_a_robot_that_is_told_what_a_thing_is_in_does_not_know_where(motet, tmp_path):
    model, _ = hidden(motet, tmp_path, "cupboard_1")
    scene = begun(model.scene, [("in", ["coke", "drawer_1"], True)], None, is_told=True)
    coke = next(one for one in scene["entities"] if one["id"] == "coke")
    assert coke["in"] == "drawer_1" and "pose" not in coke


def test_a_scene_that_says_all_is_as_it_is(motet):
    model = load("hsr", "kitchen", motet)
    assert whole(model, motet) is model
    assert np.allclose(World(model).pose("coke")[0], model.entities["coke"]["pose"]["xyz"])
