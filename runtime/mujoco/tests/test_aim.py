"""What hides a thing: its round side tells where it is, and a hand before the camera is turned aside."""

import itertools
import json
import types

import numpy as np
import pytest
from motet_mujoco import aim, judge
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.camera import NoGraphics, Picture
from motet_mujoco.detector import SMOOTH, fitted
from motet_mujoco.eyes import Eyes, centred
from motet_mujoco.model import Model, motet as command
from motet_mujoco.verdicts import verdicts
from motet_mujoco.world import World


def side(share, radius=0.033):
    """Points of the side of a can at (1, 2): a share of the half that faces the origin."""
    angles = np.arctan2(-2.0, -1.0) + np.linspace(-0.5, share - 0.5, 40) * np.pi
    across = radius * np.column_stack([np.cos(angles), np.sin(angles)]) + [1.0, 2.0]
    return np.array([[*place, z] for place in across for z in np.linspace(0.0, 0.1, 12)])


@pytest.mark.parametrize("share", [1.0, 0.6, 0.4])
def test_a_part_of_a_round_side_tells_its_middle(share):
    points = np.round(side(share), 3)  # as a depth picture has them, to the mm
    wide = np.ptp(points[:, :2], axis=0).max()
    place, radius, error = fitted(points, "cylinder", wide)
    assert np.linalg.norm(place - [1.0, 2.0]) < 0.002 and abs(radius - 0.033) < 0.002 and error < SMOOTH


def test_the_corner_of_a_box_is_not_round():
    line = np.linspace(0.0, 0.06, 30)
    corner = [(x, 0.0, z) for x in line for z in line[::3]] + [(0.0, y, z) for y in line for z in line[::3]]
    assert fitted(np.array(corner), "cylinder", 0.06)[2] > SMOOTH


def test_hidden_part_of_a_box_is_behind_its_visible_side():
    pose = {"xyz": [0.0, 2.0, 0.5], "rpy": [0.0, 0.0, 0.0]}
    book = {"id": "book", "shape": {"box": [0.14, 0.04, 0.21]}, "pose": pose}
    seen = {"pose": {"xyz": [0.0, 1.985, 0.5]}, "extent": [0.14, 0.01, 0.21]}
    assert np.allclose(centred(seen, book, np.zeros(3)), [0.0, 2.0, 0.5])
    # Of the side itself one half is hidden: nothing but the belief says which.
    half = {"pose": {"xyz": [0.035, 1.985, 0.5]}, "extent": [0.07, 0.01, 0.21]}
    assert np.allclose(centred(half, book, np.array([-0.1, 0.0, 0.5])), [0.0, 2.0, 0.5])


def picture():
    """A picture along x of the map, from the origin, with nothing in it."""
    rotation = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])
    colour, depth = np.zeros((480, 640, 3), dtype=np.uint8), np.ones((480, 640))
    return Picture("camera", colour, depth, np.zeros(3), rotation, 500.0)


def test_the_camera_turns_by_as_little_as_the_hand_hides():
    shown, mask = picture(), np.zeros((120, 160), dtype=bool)
    mask[80:] = True
    low = np.array([[2.0, 0.0, -0.35], [2.0, 0.05, -0.45]])
    turn = aim.turn(shown, mask, low)
    local = (low @ turn) @ shown.rotation  # the camera turns; the points stay
    rows = local[:, 1] / local[:, 2] * 500.0 + 239.5
    assert np.all(rows < 320.0) and rows.max() > 290.0
    assert aim.turn(shown, mask, np.array([[2.0, 0.0, 0.1]])) is None, "nothing hides it"
    mask[:] = True
    assert aim.turn(shown, mask, low) is None, "there is no room for it"


def test_the_hand_does_not_hide_what_the_robot_looks_at(motet, tmp_path):
    """From here the fingers of the ANYmal cover the whole glass when its camera is turned to it."""
    model = Model(command(motet, "robots", "mjcf", "--robot", "anymal_z1", "--scene", "kitchen"))
    scene = model.scene
    scene["robot"]["base"] = [0.47, 0.11, 0.22]
    path = tmp_path / "scene.json"
    path.write_text(json.dumps(scene), encoding="utf-8")
    [(_, witness)] = verdicts(motet, "anymal_z1", str(path), "look(glass_1)")
    world = World(Model(command(motet, "robots", "mjcf", "--robot", "anymal_z1", "--scene", str(path))))
    judge.follow(world, world.targets(witness["path"]), 1.0)
    beliefs = Beliefs(world)
    eyes = Eyes(world, beliefs)
    place = np.array(beliefs.entities["glass_1"]["pose"]["xyz"])
    corners = place + [0.035, 0.035, 0.06] * np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
    try:
        before = {one["id"] for one in eyes.detections()}
        eye, turn = eyes.aside(corners)
        tip, rotation = world.tip()
        target = world.reacher.solve(world.data.qpos, world.target, eye + turn @ (tip - eye), turn @ rotation)
        judge.follow(world, [world.target.copy(), target], 1.0)
        assert eyes.aside(corners) is None
        after = {one["id"]: np.array(one["pose"]["xyz"]) for one in eyes.detections()}
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        eyes.close()
    assert "glass_1" not in before
    assert np.linalg.norm(after["glass_1"] - world.pose("glass_1")[0]) < 0.003


def test_a_camera_on_the_head_is_not_turned(motet):
    world = World(Model(command(motet, "robots", "mjcf", "--robot", "hsr", "--scene", "kitchen")))
    eyes = Eyes(world, Beliefs(world))
    eyes.look = types.SimpleNamespace  # no picture is needed
    assert eyes.aside(np.zeros((1, 3))) is None
