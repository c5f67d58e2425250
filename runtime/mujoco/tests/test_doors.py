"""Drawers and doors: how far pixels show them to be open, and how the hand feels their handles."""

import numpy as np
import pytest
from host import entity, placed
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.camera import NoGraphics
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.eyes import Eyes
from motet_mujoco.judge import follow
from motet_mujoco.model import load
from motet_mujoco.motion import phases
from motet_mujoco.verdicts import verdicts
from motet_mujoco.world import World


@pytest.mark.parametrize("share", [0.0, 0.75, 0.97])
def test_a_door_is_seen_to_be_as_far_open_as_it_is(motet, share):
    """Else the rim of the leaf stands out beside its place, and is taken for a thing."""
    world = World(load("hsr", "kitchen", motet))
    joint, opened, _ = world.model.doors["fridge_1"]
    world.data.qpos[joint] = share * opened
    world.step(placed(world, [-0.3, -0.7, -np.pi / 2.0], -0.3))
    beliefs = Beliefs(world)
    eyes = Eyes(world, beliefs)
    try:
        found = eyes.detections()
        seen = eyes.opening("fridge_1")
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        eyes.close()
    assert abs(seen - world.opening("fridge_1")) < 0.01
    assert not [one for one in found if one["id"] is None], found
    assert beliefs.entities["fridge_1"]["open"] is (share > 0.6)


@pytest.mark.parametrize("robot", ["hsr", "anymal_z1"])
def test_a_hand_feels_a_thin_handle(motet, robot):
    """Fingers that give way come to their end around it."""
    [(_, witness)] = verdicts(motet, robot, "kitchen", "pull(fridge_1)")
    world = World(load(robot, "kitchen", motet))
    world.move_fingers(True, 1.0)
    assert not world.is_gripping(), "there is nothing between the fingers"
    world.reset()
    _, there = phases(world.targets(witness["path"]), world.model.grips)[0]
    follow(world, there, 1.0)
    world.move_fingers(True, 1.0)
    assert world.is_gripping()


def test_the_robot_does_not_shut_the_door_that_it_opened(motet):
    """Its way back leads past the open leaf."""
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(profile("ideal")))
    driver.hello({"protocol": 2, "run": "test"})
    stand = [-0.662, -1.3, -1.393]
    driver.tasks.goal[:] = driver.world.target = placed(driver.world, stand, 0.0)
    driver.world.refresh()
    command = {"primitive": "open", "args": [["what", entity("fridge_1")]], "leaves": {"base": stand}}
    driver.start({"goal": 1, "command": command})
    while driver.goals[1].state == "running":
        driver.tick()
        bumped = driver.world.bumped()
        assert bumped is None, "%s is touched" % bumped
    assert "success" in driver.goals[1].state["ended"]
    assert driver.world.is_open("fridge_1")
    assert driver.beliefs.entities["fridge_1"]["open"] and not driver.beliefs.entities["fridge_1"]["locked"]


def test_a_door_whose_motion_was_cancelled_is_neither_open_nor_closed(motet):
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(profile("ideal")))
    driver.hello({"protocol": 2, "run": "test"})
    driver.tasks.goal[:] = driver.world.target = placed(driver.world, [2.35, -1.6, -0.1], 0.0)
    driver.world.refresh()
    driver.eyes.news = lambda *_: []
    driver.start({"goal": 1, "command": {"primitive": "open", "args": [["what", entity("drawer_1")]]}})
    while driver.world.opening("drawer_1") < 0.3:
        assert driver.goals[1].state == "running"
        driver.tick()
    driver.cancel({"goal": 1})
    assert driver.tasks.room.is_open("drawer_1") is None
