"""The manner of a step and the motion that was sent with it: every primitive keeps to both."""

import itertools

import numpy as np
import pytest
from host import entity, text
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.model import load
from motet_mujoco.motion import timed
from motet_mujoco.moving import Motion
from motet_mujoco.planner import Planner

SPEED, ACCELERATION = 0.3, 0.2
GOALS = itertools.count(1)


@pytest.fixture(scope="module")
def model(motet):
    return load("hsr", "kitchen", motet)


@pytest.fixture
def driver(motet, model):
    driver = Driver(model, motet, Options(profile("ideal")), oracle=True)
    driver.hello({"protocol": 2, "run": "test"})
    return driver


def carry_out(driver, primitive, more=(), **args):
    """Carries out a primitive slowly: its outcome, the greatest shares of speed and acceleration, the reports."""
    goal, reports, model, shares = next(GOALS), [], driver.model, np.zeros(2)
    arm = [at for at in range(model.mj.nu) if at not in model.grips]
    command = {"primitive": primitive, "args": list(args.items()), "deadline_secs": 240.0,
               "manner": {"speed": SPEED, "acceleration": ACCELERATION}, **dict(more)}
    driver.say = reports.append
    driver.start({"goal": goal, "command": command})
    while driver.goals[goal].state == "running":
        driver.tick()
        rate, change = (np.abs(part[arm]) for part in (driver.tasks.rate, driver.tasks.change))
        speeds = model.speeds[arm]
        shares = np.maximum(shares, [np.max(rate / speeds), np.max(change / (speeds / model.ramps[arm]))])
    return driver.goals[goal].state["ended"], shares, [one["params"] for one in reports if one["method"] == "feedback"]


@pytest.mark.parametrize("steps", [
    [("search", {"what": text("red mug"), "around": {"list": [entity("kitchen_table")]}}),
     ("pick", {"object": entity("mug_1")}), ("lift", {"by": {"number": 0.03}}), ("go", {"to": entity("user")}),
     ("handover", {"object": entity("mug_1"), "to": entity("user")})],
    [("go", {"to": entity("drawer_1")}), ("open", {"what": entity("drawer_1")}),
     ("inspect", {"what": entity("drawer_1")}), ("close", {"what": entity("drawer_1")}), ("home", {})],
    [("go", {"to": entity("kitchen_table")}), ("detect_all", {"what": text("drinkware")}),
     ("grasp", {"object": entity("mug_1")}), ("lift", {"by": {"number": 0.05}}), ("turn", {"by": {"number": 0.3}})],
])
def test_a_manner_is_kept_by_all_parts_of_a_step(driver, steps):
    for primitive, args in steps:
        outcome, (speed, acceleration), _ = carry_out(driver, primitive, **args)
        assert "success" in outcome, (primitive, outcome)
        assert speed <= 1.02 * SPEED and acceleration <= 1.05 * ACCELERATION, (primitive, speed, acceleration)


def sent(motet, driver, query, about, **leaves):
    """A command's motion as the compiler sends it, in full speed, with where it ends and where the robot is left."""
    witness, _ = Planner(motet, "hsr").plan(driver.beliefs.now(), query)
    motion = {"query": "go_to", "args": [entity(about)], "verdict": "proven", "witness": witness}
    return {"motions": [motion], "leaves": leaves, "manner": {"speed": 1.0, "acceleration": 1.0}}, witness["path"][-1]


def test_a_search_follows_the_motion_that_was_sent_and_ends_where_it_leaves_the_robot(motet, driver):
    leaves = [1.3, 0.28, 0.1]
    command, end = sent(motet, driver, "go_to(kitchen_table)", "kitchen_table", base=leaves, joints={})
    places = {"list": [entity("kitchen_table")]}
    outcome, _, told = carry_out(driver, "search", command.items(), what=text("red mug"), around=places)
    assert outcome == {"success": entity("mug_1")} and told == []
    assert np.allclose(driver.tasks.goal[:3], leaves, atol=1e-3)
    # The robot no longer stands where that motion begins: it plans one, and says so.
    driver.tasks.goal[:3] = driver.world.data.qpos[driver.model.control_qpos[:3]] = [0.0, 1.0, 0.0]
    driver.tick()
    _, _, told = carry_out(driver, "search", command.items(), what=text("red mug"), around=places)
    assert [one["own_motion"] for one in told] == [True] and "begins elsewhere" in told[0]["text"]
    # Without time it stays where it found the thing.
    driver.tasks.goal[:3] = driver.world.data.qpos[driver.model.control_qpos[:3]] = [0.0, 0.0, 0.0]
    driver.tick()
    command["deadline_secs"] = 7.5
    carry_out(driver, "search", command.items(), what=text("red mug"), around=places)
    assert np.allclose(driver.tasks.goal[:3], end["base"], atol=1e-3)


@pytest.mark.parametrize("primitive, args", [
    ("locate", {"object": entity("glass_1")}), ("detect", {"what": text("water glass")}),
    ("inspect", {"what": entity("glass_1")})])
def test_a_look_follows_the_motion_that_was_sent_and_turns_back(motet, driver, primitive, args):
    controls = driver.model.controls
    carry_out(driver, "go", to=entity("kitchen_table"))
    joints = {"head_pan_joint": 0.0, "head_tilt_joint": 0.0}
    command, end = sent(motet, driver, "look(glass_1)", "glass_1", joints=joints)
    turned, follow = [], driver.tasks.follow
    driver.tasks.follow = lambda path, *args, **more: turned.append(path.points[-1]) or follow(path, *args, **more)
    outcome, _, told = carry_out(driver, primitive, command.items(), **args)
    assert "success" in outcome and told == []
    pans = [one[controls["head_pan_joint"]] for one in turned]
    assert np.allclose(pans, [end["joints"]["head_pan_joint"], 0.0]) and pans[0] != 0.0


def test_a_way_back_in_parts_stops_nowhere_between_them(driver):
    """Where what the hand holds would touch something at first, the rest of the way goes by its corners all the same."""
    tasks, followed = driver.tasks, []
    points = [driver.world.target.copy() for _ in range(4)]
    points[1][0] += 0.5
    points[2][:2] += [0.5, 0.5]
    points[3][:2] += [1.0, 0.5]
    path = timed(points, driver.model)
    tasks.goal[:] = points[-1]
    tasks.is_way = lambda *ways, **_: len(ways) < 2
    tasks.home_again = lambda *_: iter(())
    tasks.follow = lambda path, **_: followed.append(path) or iter(())
    for _ in tasks.way_back(path, points[0], Motion(None), "mug_1"):
        pass
    assert [len(one.strokes) for one in followed] == [1, 3]
    assert all(stroke.span > 0.0 for stroke in followed[-1].strokes)
