"""How a hand with a fixed jaw comes to a thing, and closes around one that stands a little elsewhere."""

import numpy as np
import pytest
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.jaw import LEAST, OFFSET, approach, aside, spared
from motet_mujoco.judge import carry_out
from motet_mujoco.model import load
from motet_mujoco.motion import frame_at
from motet_mujoco.verdicts import verdicts
from motet_mujoco.world import World


def reach(motet, robot, scene, query):
    """A world, the way of the hand in it, and the witness."""
    world = World(load(robot, scene, motet))
    witness = dict(verdicts(motet, robot, scene, query))[query]
    return world, world.targets(witness["path"]), witness


def ways(world, points):
    """Places of the hand at points of a way, in m."""
    return np.array([frame_at(world, point)[0] for point in points])


def test_a_fixed_jaw_comes_to_a_thing_with_room_on_its_side(motet):
    world, points, _ = reach(motet, "anymal_z1", "kitchen", "reach(coke)")
    moved, feels = spared(world, Beliefs(world), points, "coke")
    across = frame_at(world, points[-1])[1][:, 1]
    off = ways(world, moved) - ways(world, points)
    last = len(points) - approach(world, points)
    assert np.allclose(off[:-last], 0.0)
    assert LEAST < abs(off[-1] @ across) < OFFSET + 1e-3 and np.allclose(off[-last:], off[-1], atol=1e-3)
    assert np.allclose(feels[0], points[-1])
    assert (ways(world, feels)[1] - ways(world, feels)[0]) @ off[-1] < 0.0, "it feels on past the witness"


def test_jaws_that_both_move_come_to_a_thing_as_the_witness_says(motet):
    world, points, _ = reach(motet, "hsr", "kitchen", "reach(mug_1)")
    moved, feels = spared(world, Beliefs(world), points, "mug_1")
    assert moved is points and feels == []


def test_aside_leaves_the_rest_of_the_way(motet):
    """Else the base, which corrects the error of the hand, would wait for the arm to unfold."""
    world, points, _ = reach(motet, "hsr", "living_room", "reach(can)")
    moved = aside(world, points, np.array([0.005, 0.002, 0.0]))
    assert len(points) == 5 and all(np.array_equal(*pair) for pair in zip(points[:3], moved[:3]))


def test_aside_moves_all_points_that_are_near(motet):
    """A witness may have waypoints beside the thing: a way that leaves it at one of them has a corner there."""
    world, points, _ = reach(motet, "anymal_z1", "living_room", "reach(toy)")
    last = len(points) - approach(world, points)
    assert last > 2
    off = ways(world, aside(world, points, np.array([0.0, 0.01, 0.0]))) - ways(world, points)
    assert np.allclose(off[-last:], [0.0, 0.01, 0.0], atol=1e-3) and np.allclose(off[:-last], 0.0)


@pytest.mark.parametrize("scene, thing", [("lab", "pen"), ("kitchen", "mug_2"), ("living_room", "bottle_1")])
@pytest.mark.parametrize("off", [-0.012, 0.01])
def test_a_thing_that_stands_beside_its_place_is_grasped(motet, scene, thing, off):
    world, points, witness = reach(motet, "anymal_z1", scene, "reach(%s)" % thing)
    across = frame_at(world, points[-1])[1][:, 1]
    world.place(thing, world.pose(thing)[0] + off * across * [1.0, 1.0, 0.0])
    world.refresh()
    holds, why, _ = carry_out(world, "reach(%s)" % thing, witness)
    assert holds, why


def test_the_driver_feels_for_a_thing_before_it_closes(motet):
    driver = Driver(load("anymal_z1", "kitchen", motet), motet, Options(profile("ideal")))
    driver.hello({"protocol": 2, "run": "test"})
    for goal, (primitive, name, value) in enumerate([("go", "to", "coke"), ("pick", "object", "coke")]):
        if primitive == "pick":
            across = np.array([np.cos(driver.world.base()[2] + np.pi / 2), np.sin(driver.world.base()[2] + np.pi / 2), 0.0])
            driver.world.place("coke", driver.world.pose("coke")[0] + 0.01 * across)
            driver.world.refresh()
        driver.start({"goal": goal, "command": {"primitive": primitive, "args": [[name, {"entity": value}]]}})
        while driver.goals[goal].state == "running":
            driver.tick()
        assert "success" in driver.goals[goal].state["ended"], driver.goals[goal].state
    assert driver.world.held() == ["coke"]


def test_spared_does_not_recentre_jaws_with_room_on_both_sides(motet):
    """A place that was seen anew, a little beside the witness, costs no time."""
    world, points, _ = reach(motet, "hsr", "kitchen", "reach(mug_1)")
    beliefs, across = Beliefs(world), frame_at(world, points[-1])[1][:, 1]
    beliefs.saw("mug_1", world.pose("mug_1")[0] + 0.006 * across)
    assert spared(world, beliefs, points, "mug_1") == (points, [])
