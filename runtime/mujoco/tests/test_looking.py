"""Looks for what may be anywhere: at places about the robot, from where they show."""

import numpy as np
import pytest
from host import entity, forgotten, placed, text
from motet_mujoco.begin import begun, model_of, told_apart
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.model import load


def driver_of(motet, facts, thing):
    """A driver of a kitchen in which facts hold, whose robot was not told where a thing is."""
    scene = begun(load("hsr", "kitchen", motet).scene, facts, None)
    real, told = told_apart(model_of("hsr", scene, motet), forgotten(scene, thing), motet)
    driver = Driver(real, motet, Options(profile("ideal")), told=told)
    driver.hello({"protocol": 2, "run": "test"})
    return driver


@pytest.mark.parametrize(("facts", "thing", "base"), [
    ([("open", ["fridge_1"], True), ("in", ["coke", "fridge_1"], True)], "coke", [0.355, -0.724, -2.356]),
    ([], "bottle", [0.55, -1.35, -0.7]),
])
@pytest.mark.parametrize("primitive", ["inspect", "detect"])
def test_a_thing_that_may_be_anywhere_is_looked_for_about_the_robot(motet, facts, thing, base, primitive):
    """The side of the refrigerator hides what is in it from there, and the counter is beside the robot."""
    driver = driver_of(motet, facts, thing)
    driver.tasks.goal[:] = driver.world.target = placed(driver.world, base, 0.0)
    driver.world.refresh()
    args = {"inspect": ("what", entity(thing)), "detect": ("what", text(thing))}[primitive]
    driver.start({"goal": 1, "command": {"primitive": primitive, "args": [args], "deadline_secs": 5.0}})
    while driver.goals[1].state == "running":
        driver.tick()
    assert "success" in driver.goals[1].state["ended"]
    assert driver.world.now < 5.0
    seen = np.array(driver.beliefs.entities[thing]["pose"]["xyz"])
    assert np.linalg.norm(seen - driver.world.pose(thing)[0]) < 0.02


def test_an_arm_that_hides_what_is_looked_at_folds_first(motet):
    """The hand has let go of the mug and is still before it."""
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(profile("ideal")))
    driver.hello({"protocol": 2, "run": "test"})

    def begin(goal, primitive, **args):
        command = {"primitive": primitive, "args": list(args.items()), "deadline_secs": 60.0}
        driver.start({"goal": goal, "command": command})

    def carry_out(goal, primitive, **args):
        begin(goal, primitive, **args)
        while driver.goals[goal].state == "running":
            driver.tick()
        return driver.goals[goal].state["ended"]

    carry_out(1, "go", to=entity("mug_1"))
    assert "success" in carry_out(2, "pick", object=entity("mug_1"))
    carry_out(3, "go", to=entity("counter"))
    begin(4, "place", object=entity("mug_1"), on=entity("counter"))
    while driver.beliefs.hand is not None or not driver.eyes.is_covered("mug_1"):
        assert driver.goals[4].state == "running", "the hand does not come before the mug"
        driver.tick()
    driver.cancel({"goal": 4})
    assert "success" in carry_out(5, "inspect", what=entity("mug_1"))
    assert driver.beliefs.entities["mug_1"]["on"] == "counter"


def test_a_drive_to_an_open_drawer_ends_where_what_lies_in_it_shows(motet):
    """The side of the drawer hides the apple from where its middle shows."""
    scene = begun(load("hsr", "kitchen", motet).scene, [("open", ["drawer_1"], True), ("in", ["apple", "drawer_1"], True)], None)
    apple = next(one for one in scene["entities"] if one["id"] == "apple")
    apple["pose"]["xyz"] = [3.09, -1.505, 0.598]
    driver = Driver(model_of("hsr", scene, motet), motet, Options(profile("ideal")))
    driver.hello({"protocol": 2, "run": "test"})
    driver.tasks.goal[:] = driver.world.target = placed(driver.world, [2.2, -1.21, -1.54], 0.0)
    driver.world.refresh()
    for goal, (primitive, *args) in enumerate([("go", "to", "drawer_1"), ("inspect", "what", "apple")]):
        command = {"primitive": primitive, "args": [[args[0], entity(args[1])]], "deadline_secs": 60.0 - 55.0 * goal}
        driver.start({"goal": goal, "command": command})
        while driver.goals[goal].state == "running":
            driver.tick()
        assert "success" in driver.goals[goal].state["ended"]
