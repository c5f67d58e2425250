"""Models load, stand still, and say what the scene says."""

import json

import numpy as np
import pytest
from motet_mujoco import speed
from motet_mujoco.model import Model, ModelError, load, motet as call, name, save
from motet_mujoco.world import World

ODD = {"motet_scene": 1, "entities": [
    {"id": "world", "kind": "Object", "pose": {"xyz": [1, 0, 0.05], "rpy": [0, 0, 0]}, "shape": {"box": [0.1, 0.1, 0.1]}},
    {"id": "a/b %<\"&", "kind": "Object", "pose": {"xyz": [1, 1, 0.05], "rpy": [0, 0, 0]},
     "shape": {"capsule": {"radius": 0.03, "height": 0.1}}},
    {"id": "pot", "kind": "Container", "mass": 1.0, "pose": {"xyz": [2, 1, 0.1], "rpy": [0, 0, 0]},
     "shape": {"cylinder": {"radius": 0.1, "height": 0.2}}},
    {"id": "anna", "kind": "Person", "pose": {"xyz": [-1, 0, 0], "rpy": [0, 0, 0]}}]}


@pytest.mark.parametrize("robot", ["hsr", "anymal_z1", "panda"])
@pytest.mark.parametrize("scene", ["kitchen", "lab", "living_room"])
def test_models_stand_still(motet, robot, scene):
    world = World(load(robot, scene, motet))
    before = {thing: world.pose(thing)[0] for thing in world.model.free}
    world.wait(1.0)
    moved = {thing: float(np.linalg.norm(world.pose(thing)[0] - at)) for thing, at in before.items()}
    # Some things of the scenes stand a little above what bears them; none goes anywhere.
    assert max(moved.values()) < 0.03, moved
    assert not any(warning.number for warning in world.data.warning)
    for one, entity in world.model.entities.items():
        if "on" in entity and one in world.model.free and entity["on"] in world.model.body_of:
            assert world.is_on(one, entity["on"]), (one, world.bearers(one))
        if "in" in entity and one in world.model.free:
            assert world.is_in(one, entity["in"]), one


def test_names_come_back(motet, tmp_path):
    path = tmp_path / "odd.json"
    path.write_text(json.dumps(ODD))
    model = load("hsr", str(path), motet)
    assert list(model.free) == ["world", "a/b %<\"&", "pot"]
    assert list(model.people) == ["anna"]
    assert name("world") in call(motet, "robots", "mjcf", "--robot", "hsr", "--scene", str(path))


def test_a_wrong_model_is_an_error(motet):
    with pytest.raises(ModelError):
        Model("<mujoco/>")
    with pytest.raises(ModelError):
        Model("no xml")
    with pytest.raises(ModelError, match="no_such"):
        load("no_such", "kitchen", motet)


def test_the_measure_of_speed_carries_a_motion_out(motet, capsys):
    """Its figure is for people and `docs/physics.md`: no test goes by the time that something takes."""
    speed.main(["--rounds", "1", "--motet", motet])
    assert "hsr in kitchen, reach(mug_1): " in capsys.readouterr().out
    assert speed.main(["--motion", "reach(plate)", "--motet", motet]) == 2


def test_save_writes_a_whole_file_or_none(tmp_path):
    path = tmp_path / "scene.json"
    save(str(path), {"entities": []})
    with pytest.raises(TypeError):
        save(str(path), {"entities": [], "robot": {1}})
    assert json.loads(path.read_text()) == {"entities": []}
