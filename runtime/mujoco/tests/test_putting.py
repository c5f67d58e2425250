"""Putting things into drawers: how the hand holds a thing, what lies there, and from where it is put in."""

import numpy as np
import pytest
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.judge import carry_out
from motet_mujoco.looking import DETOUR
from motet_mujoco.model import load
from motet_mujoco.motion import CHECKED, timed
from motet_mujoco.moving import Motion
from motet_mujoco.verdicts import SCENES, verdicts
from motet_mujoco.world import World


@pytest.mark.parametrize("robot", ["hsr", "anymal_z1", "panda"])
def test_the_middle_between_the_fingers_is_felt(motet, robot):
    """One jaw of a hand may be fixed, so that its tip is at one side of what it holds."""
    scene = SCENES.get(robot, ["living_room"])[0]
    queries = [one for one in verdicts(motet, robot, scene) if one[0].startswith("reach(")]
    for query, witness in queries[:3]:
        thing = query[6:-1].replace("`", "")
        world = World(load(robot, scene, motet))
        beliefs = Beliefs(world)
        assert carry_out(world, query.replace("`", ""), witness)[0], query
        place, across = world.pose(thing)[0], world.tip()[1][:, 1]
        # The thing was seen a little beside its place.
        beliefs.saw(thing, place + 0.008 * across)
        beliefs.holds(thing, 0.0)
        off = beliefs.held_pose(thing)[0] - place
        assert abs(float(off @ across)) < 0.006, (query, off)


@pytest.fixture
def driver(motet):
    return Driver(load("hsr", "kitchen", motet), motet, Options(profile("ideal")))


def test_beliefs_move_drawer_contents_once_the_drawer_is_seen(driver):
    """A hand that lost the handle says nothing about how far the drawer came; the next look does."""
    beliefs, way = driver.beliefs, driver.world.model.drawn("drawer_1")
    at = np.array([3.4, -1.7, 0.6])
    beliefs.rests("mug_1", "in", "drawer_1")
    beliefs.saw("mug_1", at)
    beliefs.opened("drawer_1", None)
    assert "pose" not in beliefs.entities["mug_1"]
    beliefs.opened("drawer_1", True, 1.0)
    assert np.allclose(beliefs.entities["mug_1"]["pose"]["xyz"], at + way, atol=1e-4)
    beliefs.opened("drawer_1", None)
    beliefs.opened("drawer_1", False)
    assert np.allclose(beliefs.entities["mug_1"]["pose"]["xyz"], at, atol=1e-4)


def test_a_thing_that_was_taken_out_does_not_come_back(driver):
    beliefs = driver.beliefs
    beliefs.rests("mug_1", "in", "drawer_1")
    beliefs.opened("drawer_1", None)
    beliefs.forget("mug_1")
    beliefs.opened("drawer_1", True, 1.0)
    assert "pose" not in beliefs.entities["mug_1"]


def drives(detour):
    """A planner of drives that lead aside by a way in m first."""

    def plan(_scene, query):
        x, y, yaw = (float(part.split()[0]) for part in query.partition("pose(")[2].split(","))
        way = [[0.0, 0.0, 0.0], [0.0, detour / 2.0, 0.0], [x, y, yaw]]
        return {"path": [{"base": base, "joints": {}} for base in way]}, None

    return plan


def test_a_place_with_a_short_way_comes_first(driver):
    """Of the places from which the inside shows, the base drives to one with a short way left."""
    tasks = driver.tasks
    tasks.planner.ask, tasks.planner.plan = (lambda *_: ("shows", None)), drives(0.0)
    costs = iter([np.inf, 3.0, 5.0, 0.5 * DETOUR, 0.0])
    tried = []

    def way(stand):
        tried.append((stand, next(costs)))
        return tried[-1][1]

    spot = driver.beliefs.places("drawer_1", True)[0]
    tasks.follow = lambda _path: iter(())
    search = tasks.around("look(inside)", "inside", spot, spot, Motion(None), np.inf, way)
    for _ in search:
        pass
    assert [cost for _, cost in tried] == [np.inf, 3.0, 5.0, 0.5 * DETOUR], "it is near enough"


@pytest.mark.parametrize("detour, stands", [(0.0, 1), (20.0, 51)])
def test_a_place_to_which_the_drive_is_long_is_compared_with_others(driver, detour, stands):
    """A place with a short way left may be on the far side of what stands open."""
    tasks, tried = driver.tasks, []
    tasks.planner.ask, tasks.planner.plan = (lambda *_: ("shows", None)), drives(detour)
    spot = driver.beliefs.places("drawer_1", True)[0]

    def way(stand):
        tried.append(stand)
        return 0.0

    tasks.follow = lambda _path: iter(())
    for _ in tasks.around("look(inside)", "inside", spot, spot, Motion(None), np.inf, way):
        pass
    assert len(tried) == stands


def test_a_corner_is_checked_all_along(driver):
    """A thing in the hand passes the rim of a drawer in less than a tenth of a second."""
    world = driver.world
    points = [world.target.copy() for _ in range(3)]
    points[1][0] += 1.0
    points[2][:2] += [1.0, 1.0]
    path, seen = timed(points, world.model), []
    path.blended(world.model, lambda _start, _corner, targets: seen.append(targets) or True)
    apart = [np.linalg.norm(np.diff(np.array(targets)[:, :2], axis=0), axis=1).max() for targets in seen]
    assert max(apart) <= 2.0 * CHECKED * world.model.speeds[0]


def test_a_hand_lets_go_from_a_little_above_where_its_fingers_have_no_room(driver):
    tasks, world = driver.tasks, driver.world
    grip = np.array([0.0, 0.0, 0.05]), np.array([1.0, 0.0, 0.0, 0.0])
    tasks.beliefs.hand, tasks.beliefs.grip = "mug_1", grip
    scene = {"robot": {"grip": {"xyz": [0.0, 0.0, 0.05], "rpy": [0.0, 0.0, 0.0]}}}
    up = tasks.beliefs.held_pose("mug_1")[1]
    assert np.isfinite(up).all() and world.now == 0.0
    asked = []

    def ask(room, _query):
        asked.append(np.array(room["robot"]["grip"]["xyz"]))
        return ("way", None) if len(asked) == 3 else (None, ("unknown", "the search ran out of its budget"))

    assert tasks.put_witness(scene, "put(mug_1, counter)", "mug_1", ask) == ("way", None)
    assert np.allclose([np.linalg.norm(one - asked[0]) for one in asked], [0.0, 0.01, 0.02])
    assert scene["robot"]["grip"]["xyz"] == [0.0, 0.0, 0.05]
