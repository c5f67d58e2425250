"""Motions that end on their way: the next command begins with the arm at rest, by the way that the robot came."""

import numpy as np
import pytest
from host import placed
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.model import load
from motet_mujoco.moving import Failed, Motion
from motet_mujoco.trail import SPACING, Trail


@pytest.fixture
def driver(motet):
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(profile("ideal")))
    driver.call = lambda method, **params: getattr(driver, method)(params)
    driver.call("hello", protocol=2, run="test")
    return driver


def begin(driver, primitive, **args):
    """Starts a goal; its number."""
    goal = len(driver.goals) + 1
    driver.call("start", goal=goal, command={"primitive": primitive, "args": list(args.items())})
    return goal


def carry_out(driver, primitive, patience=90.0, **args):
    """The outcome of a primitive."""
    goal, begun = begin(driver, primitive, **args), driver.world.now
    while driver.goals[goal].state == "running" and driver.world.now - begun < patience:
        driver.tick()
    return driver.goals[goal].state


def entity(one):
    return {"entity": one}


def at_thing(driver, near):
    """Lets a pick of the mug go on until the hand is near to it or has closed around it, and ends it there."""
    assert "success" in carry_out(driver, "go", to=entity("mug_1"))["ended"]
    goal = begin(driver, "pick", object=entity("mug_1"))
    while not near():
        assert driver.goals[goal].state == "running"
        driver.tick()
    driver.call("cancel", goal=goal)


def reaches(driver, far):
    return lambda: np.linalg.norm(driver.world.tip()[0] - driver.world.pose("mug_1")[0]) < far


def is_home(driver):
    arm = driver.world.model.arm
    return np.abs(driver.tasks.goal - driver.world.model.posture("home"))[arm].max() < 0.01


def test_the_arm_comes_back_before_the_base_drives(driver):
    at_thing(driver, reaches(driver, 0.15))
    assert not is_home(driver)
    assert "success" in carry_out(driver, "go", to=entity("counter"))["ended"]
    assert is_home(driver)


def test_a_hand_that_was_about_to_close_opens_and_goes_back(driver):
    grip = next(iter(driver.model.grips))
    opened, closed = driver.model.grips[grip]
    closes = 0.5 * abs(closed - opened)
    at_thing(driver, lambda: reaches(driver, 0.15)() and abs(driver.tasks.goal[grip] - opened) > closes)
    assert "success" in carry_out(driver, "go", to=entity("counter"))["ended"]
    assert is_home(driver)
    assert driver.world.is_on("mug_1", "kitchen_table")


def test_a_robot_that_touches_something_goes_back_the_way_it_came(driver):
    at_thing(driver, reaches(driver, 0.12))
    place = driver.world.tip()[0] - 0.05 * driver.world.tip()[1][:, 2]
    driver.beliefs.saw("glass_1", place)
    assert "at the start" in driver.tasks.planner.plan(driver.beliefs.now(), "posture(home)")[1][1]
    assert "success" in carry_out(driver, "home")["ended"]
    assert is_home(driver)


def touching(driver):
    """Opens a drawer unseen, and lets the base stand at its front."""
    world = driver.world
    joint, opened, _ = world.model.doors["drawer_1"]
    world.data.qpos[joint] = opened
    driver.tasks.goal[:] = placed(world, [2.58, -1.64, 0.0])
    world.step(driver.tasks.goal)
    assert driver.tasks.room.bumped() is not None


def test_a_base_that_touches_something_comes_off_it_first(driver):
    touching(driver)
    assert "success" in carry_out(driver, "go", to=entity("kitchen_table"))["ended"]
    assert driver.tasks.room.bumped() is None


def test_a_drive_does_not_count_the_contact_that_it_leaves(driver):
    touching(driver)
    target = driver.tasks.goal.copy()
    target[0] -= 0.5
    for _ in driver.tasks.drive(driver.tasks.path([driver.tasks.goal.copy(), target]), None):
        driver.world.step(driver.tasks.goal, driver.tasks.rate, driver.tasks.change)
    assert driver.tasks.room.bumped() is None
    driver.tasks.goal[:] = driver.world.target
    with pytest.raises(Failed, match="in the way"):
        target[0] += 1.1
        for _ in driver.tasks.drive(driver.tasks.path([driver.tasks.goal.copy(), target]), None):
            driver.world.step(driver.tasks.goal, driver.tasks.rate, driver.tasks.change)


def test_straight_stops_before_what_is_in_the_way(driver):
    at_thing(driver, reaches(driver, 0.15))
    before = driver.world.tip()[0][2]
    way = np.array([0.0, 0.0, -0.3])
    for _ in driver.tasks.straight(way, Motion(None)):
        driver.world.step(driver.tasks.goal, driver.tasks.rate, driver.tasks.change)
    assert not any(driver.world.bumps()) and not driver.world.feels_touch()
    assert before - 0.3 < driver.world.tip()[0][2] <= before


def test_a_thing_that_a_person_took_is_no_longer_where_it_was_carried(driver):
    at_thing(driver, lambda: driver.beliefs.in_hand() == ["mug_1"])
    assert "success" in carry_out(driver, "go", to=entity("user"))["ended"]
    goal = begin(driver, "handover", object=entity("mug_1"), to=entity("user"))
    while "mug_1" not in driver.world.carried_by:
        driver.tick()
    driver.call("cancel", goal=goal)
    believed = np.array(driver.beliefs.entities["mug_1"]["pose"]["xyz"])
    assert np.linalg.norm(believed - driver.world.pose("mug_1")[0]) < 0.03
    assert "success" in carry_out(driver, "go", to=entity("kitchen_table"))["ended"]


def test_what_a_cancelled_step_has_put_down_is_told(driver):
    """The host does not know how far the step came, and the thing may be out of view."""
    said = []
    driver.say = said.append
    at_thing(driver, lambda: driver.beliefs.in_hand() == ["mug_1"])
    assert "success" in carry_out(driver, "go", to=entity("counter"))["ended"]
    goal = begin(driver, "place", object=entity("mug_1"), on=entity("counter"))
    while driver.beliefs.hand or not driver.tasks.room.is_on("mug_1", "counter"):
        assert driver.goals[goal].state == "running"
        driver.tick()
    said.clear()
    driver.eyes.refresh = lambda: driver.eyes.sure.clear()
    driver.eyes.last = []
    driver.call("cancel", goal=goal)
    [seen] = [one["params"]["detections"] for one in said if one["method"] == "detected"]
    assert [one["id"] for one in seen] == ["mug_1"]
    assert np.linalg.norm(np.array(seen[0]["pose"]["xyz"]) - driver.world.pose("mug_1")[0]) < 0.05


def test_trail_leads_back_with_the_hand_as_it_is():
    trail = Trail([1])
    for step in range(11):
        trail.add(np.array([0.6 * SPACING * step, 1.0]))
    assert [round(point[0] / SPACING, 1) for point in trail.points] == [0.0, 1.2, 2.4, 3.6, 4.8, 6.0]
    ways = list(trail.back(np.array([0.6, 0.3])))
    assert [left for left, _ in ways][-1] == 0
    for left, way in ways:
        assert np.allclose(way[0], [0.6, 0.3]) and np.allclose(way[-1], [trail.points[left][0], 0.3])
