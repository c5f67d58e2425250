"""Paths: times of witnesses, corners that are passed by, and what the hand bears."""

from types import SimpleNamespace

import numpy as np
import pytest
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.chance import Chance, profile
from motet_mujoco.clearance import Clearance
from motet_mujoco.driver import Driver, Options
from motet_mujoco.judge import tip_error
from motet_mujoco.model import load
from motet_mujoco.motion import HELD, Path, gentle, timed, witnessed
from motet_mujoco.moving import Failed, Motion, Mover
from motet_mujoco.observation import Observer
from motet_mujoco.planner import Planner
from motet_mujoco.verdicts import SCENES
from motet_mujoco.world import GRIPS, TICK, World

TABLE = SCENES["panda"][0]


@pytest.fixture(scope="module")
def hsr(motet):
    return World(load("hsr", "kitchen", motet))


@pytest.fixture
def mover(hsr):
    hsr.reset()
    options = Options(profile("ideal"), Chance(0).seed)
    return Mover(hsr, Observer(hsr), Beliefs(hsr), None, options)


def carry(mover, task):
    """Carries out a task in the world of a mover."""
    for _ in task:
        mover.world.step(mover.goal, mover.rate, mover.change)


def rates(path):
    """Greatest rates of the actuators on a path."""
    return np.max([np.abs(path.at(time)[1]) for time in np.arange(0.0, path.end, 0.01)], axis=0)


def test_a_path_has_the_times_of_its_witness():
    points = [np.array([0.0, 0.0]), np.array([1.0, 0.0]), np.array([1.0, 2.0])]
    path = witnessed(points, [{"at": 0.0}, {"at": 3.0, "ramp": 1.0}, {"at": 5.0, "ramp": 1.0}], None, 1.0)
    assert path.end == 5.0
    # Even speed of 1 / (3 - 1), after even acceleration for 1 s.
    assert np.allclose(path.at(1.5)[1], [0.5, 0.0]) and np.allclose(path.at(0.5)[1], [0.25, 0.0])
    assert np.allclose(path.at(3.0)[0], [1.0, 0.0]) and np.allclose(path.at(9.0)[0], points[-1])


def test_a_corner_is_passed_by_where_it_is_free(hsr):
    model = hsr.model
    start = hsr.target
    aside, up = start.copy(), start.copy()
    aside[0] += 0.5
    up[:] = aside
    up[model.controls["arm_lift_joint"]] = 0.3
    stopping = timed([start, aside, up], model)
    free = stopping.blended(model, lambda *_: True)
    assert free.end < stopping.end - 1.0, "base and arm move at once"
    assert stopping.blended(model, lambda *_: False).end == stopping.end
    for path in (stopping, free):
        assert np.all(rates(path) <= model.speeds * 1.001)
        assert np.allclose(path.at(path.end)[0], up)


def test_a_path_straight_on_does_not_stop(hsr):
    points = [hsr.target.copy() for _ in range(4)]
    for at, point in enumerate(points):
        point[0] += 0.3 * at
    path = timed(points, hsr.model)
    legs = [timed([one, other], hsr.model) for one, other in zip(points, points[1:])]
    assert path.end < sum(leg.end for leg in legs) - 1.5
    assert np.all(rates(path) <= hsr.model.speeds * 1.001)
    for point in points:
        assert min(np.abs(path.at(time)[0] - point).max() for time in np.arange(0.0, path.end + 0.01, 0.01)) < 3e-3


@pytest.mark.parametrize("robot, scene, joints", [
    ("hsr", "kitchen", {"base/x": 0.4, "base/yaw": 1.5, "arm_lift_joint": 0.3, "arm_flex_joint": -1.0}),
    ("anymal_z1", "lab", {"base/y": -0.3, "base/yaw": -1.0, "joint1": 1.0, "joint2": 1.2, "joint3": -1.0}),
    ("panda", TABLE, {"panda_joint1": 1.0, "panda_joint2": 0.5, "panda_joint4": 0.8, "panda_joint7": -1.5}),
])
def test_a_fast_path_is_followed_within_the_forces_of_the_servos(motet, robot, scene, joints):
    """At full speed and with all joints at once, the hand is off by less than 3 mm and 2 mrad at every
    moment."""
    world = World(load(robot, scene, motet))
    model, mj = world.model, world.model.mj
    there, back = world.target.copy(), world.target.copy()
    for joint, way in joints.items():
        there[model.controls[joint]] += way
    back[:3] += 0.3 * (there - back)[:3]
    path = timed([world.target, there, back], model)
    path = path.blended(model, lambda *_: True)
    start = world.now
    while world.now - start < path.end:
        world.step(*path.at(world.now - start + world.tick / 2.0))
        off = tip_error(world, path.at(world.now - start - mj.opt.timestep)[0])
        assert np.all(off < [0.003, 0.002]), (world.now - start, off)
        assert np.all(np.abs(world.data.actuator_force) < 0.9 * mj.actuator_forcerange[:, 1])


def test_a_path_turns_round_only_at_rest(hsr):
    there = hsr.target.copy()
    there[0] += 0.5
    path = timed([hsr.target, there, hsr.target], hsr.model)
    assert path.blended(hsr.model, lambda *_: True).end == path.end


def test_a_corner_into_furniture_is_not_cut(mover):
    world = mover.world
    before, corner, after = (world.target.copy() for _ in range(3))
    low, high = world.bounds("kitchen_table")
    before[:2] = [low[0] - 0.5, low[1] - 0.5]
    corner[:2] = [low[0] - 0.5, high[1]]
    after[:2] = [(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0]
    clearance = Clearance(world, mover.beliefs)
    assert clearance.is_free(before, corner, [(before + corner) / 2.0])
    assert not clearance.is_free(before, corner, [after])


def test_a_thing_in_the_hand_is_carried_gently(motet):
    world = World(load("anymal_z1", "lab", motet))
    mover = Mover(world, Observer(world), Beliefs(world), None, Options(profile("ideal")))
    start = world.target.copy()
    out = start.copy()
    out[world.model.controls["joint2"]] += 1.5
    out[world.model.controls["joint6"]] += 1.5
    quick = mover.path([start, out])
    slow = Path([gentle(mover.world, stroke) for stroke in quick.strokes])

    def strongest(path):
        places = np.array([mover.frame(path.at(time)[0])[0] for time in np.arange(0.0, path.end, 0.02)])
        return np.linalg.norm(np.diff(places, 2, axis=0), axis=1).max() / 0.02**2

    assert strongest(quick) > 2.0 * HELD[0]
    assert strongest(slow) < 1.5 * HELD[0]


def test_dropped_thing_has_no_known_place(mover):
    check = mover.keeps("mug_1")
    with pytest.raises(Failed) as failed:
        for _ in range(20):
            check()
    assert failed.value.kind == "slipped"
    assert "pose" not in mover.beliefs.entities["mug_1"] and "on" not in mover.beliefs.entities["mug_1"]


def test_a_search_for_a_place_lets_time_pass(motet):
    """The host waits 30 s for an answer to `advance`: a search of many plans in one step of the world took longer."""
    driver = Driver(load("anymal_z1", "kitchen", motet), motet, Options(profile("ideal")), oracle=True)
    times = []

    def ask(*_):
        times.append(driver.world.now)
        return None, ("unknown", "nothing is found")

    driver.tasks.planner.ask = ask
    here = driver.tasks.goal.copy()
    search = driver.tasks.offering(driver.tasks.path([here, here]), "mug_1", "user", Motion(None))
    for _ in search:
        driver.world.step(here)
    assert len(times) > 30
    assert all(after - before > 0.05 for before, after in zip(times, times[1:]))


def test_clearance_holds_near_obstacles_no_nearer(mover):
    """A robot that stands at the table may stay as near to it, and not drive through it."""
    from motet_mujoco.clearance import Clearance

    world = mover.world
    low, high = world.bounds("kitchen_table")
    start = world.target.copy()
    clearance = Clearance(world, mover.beliefs)
    start[:2] = [low[0] - 0.5, (low[1] + high[1]) / 2.0]
    while not clearance.near(start):
        start[0] += 0.01
    into, away = start.copy(), start.copy()
    into[0], away[0] = (low[0] + high[0]) / 2.0, start[0] - 0.2
    assert clearance.is_free(start, start, [start, away])
    assert not clearance.is_free(start, start, [into])


def test_a_way_back_that_takes_too_long_is_left_out(mover):
    x, y, yaw = mover.world.base()
    here, base = [float(x), float(y), float(yaw)], [float(x) - 0.5, float(y), float(yaw)]
    witness = {"path": [{"base": here, "joints": {}}, {"base": base, "joints": {}}]}
    mover.planner = SimpleNamespace(plan=lambda *_: (witness, None))

    def seconds(deadline):
        motion = Motion({"leaves": {"base": base}, "deadline_secs": deadline}, mover.world.now)
        before = mover.world.now
        for _ in mover.stand(mover.leaves(motion, mover.goal), motion):
            mover.world.step(mover.goal, mover.rate, mover.change)
        return mover.world.now - before

    assert seconds(1.5) == 0.0
    assert seconds(30.0) > 1.0


def test_a_witness_does_not_open_the_hand_that_holds_a_thing(mover, monkeypatch):
    """It has the fingers as far apart as the thing is wide, where they would not press it."""
    monkeypatch.setattr(mover.room, "held", lambda: ["mug_1"])
    grips, there = list(mover.world.model.grips), mover.goal.copy()
    there[0] += 0.5
    there[grips] += 0.3
    path = mover.smooth(mover.path([mover.goal.copy(), there]))
    assert np.allclose(path.at(path.end)[0][grips], mover.goal[grips])
    assert abs(path.at(path.end)[0][0] - there[0]) < 1e-6


def test_the_hand_rises_without_a_touch_of_the_robot_itself(motet, mover):
    """The lift of the arm of the HSR goes on up to the head. No motion begins where the robot touches itself; so the
    other joints do the rest."""
    controls, planner = mover.world.model.controls, Planner(motet, "hsr")
    for joint, value in {"arm_lift_joint": 0.6, "arm_flex_joint": -1.31, "wrist_flex_joint": -1.31}.items():
        mover.goal[controls[joint]] = value
    mover.world.data.qpos[mover.world.model.control_qpos] = mover.goal
    mover.world.refresh()
    before = mover.frame(mover.goal)[0][2]
    carry(mover, mover.straight(np.array([0.0, 0.0, 0.08]), Motion(None)))
    assert 0.6 <= mover.goal[controls["arm_lift_joint"]] < 0.64
    assert mover.frame(mover.goal)[0][2] > before + 0.079
    assert planner.plan(mover.beliefs.now(), "posture(home)")[1] is None


def test_a_corner_on_which_the_robot_touches_itself_is_not_cut(mover):
    start = mover.world.target.copy()
    raised = start.copy()
    raised[mover.world.model.controls["arm_lift_joint"]] = 0.68
    assert Clearance(mover.world, mover.beliefs).is_free(start, start, [start])
    assert not Clearance(mover.world, mover.beliefs).is_free(start, start, [raised])


@pytest.mark.parametrize("folds_at", [1, 2])
def test_without_time_for_the_way_back_it_goes_to_where_the_arm_has_room_to_fold(mover, monkeypatch, folds_at):
    ways, begun = [np.array([0.0, -0.5]), np.array([-0.5, -0.5]), np.array([-0.5, 0.0])], mover.goal.copy()
    points = [begun]
    for way in ways:
        points.append(points[-1].copy())
        points[-1][:2] = begun[:2] + way
    path, tries = mover.path(points), []
    mover.goal[:] = points[-1]
    mover.world.data.qpos[mover.world.model.control_qpos] = points[-1]

    def home_again(*_):
        yield
        tries.append(mover.goal[:2] - begun[:2])
        return len(tries) == folds_at

    monkeypatch.setattr(mover, "home_again", home_again)
    carry(mover, mover.way_back(path, begun, Motion({"deadline_secs": 4.0}, mover.world.now), None))
    assert np.allclose(tries, ways[1::-1][:folds_at], atol=1e-6)


def test_a_base_that_holds_something_out_turns_before_it_comes_nearer(motet):
    """A policy that keeps 0.5 m from people would stop it: a drive to a person ends at 0.6 m."""
    driver = Driver(load("anymal_z1", "lab", motet), motet, Options(profile("ideal")), oracle=True)
    tasks, stands = driver.tasks, []
    witness, _ = tasks.planner.plan(tasks.beliefs.now(), "go_to(user)")

    def ask(scene, _query):
        stands.append(scene["robot"]["base"])
        # The hand comes far enough where the base is turned to one side.
        turn = np.arctan2(3.6 - stands[-1][1], 1.4 - stands[-1][0]) - stands[-1][2]
        return ("way", None) if 0.5 < turn < 0.7 else (None, ("unknown", "nothing is found"))

    tasks.planner.ask, tasks.planner.plan = ask, lambda *_: (witness, None)
    for _ in tasks.offering(tasks.own(witness, Motion(None)), "screwdriver", "user", Motion(None)):
        pass
    far = [float(np.hypot(x - 1.4, y - 3.6)) for x, y, _ in stands]
    assert len(far) > 1 and min(far) > far[0] - 1e-3


@pytest.mark.parametrize("turn", [0.3, 0.7, 1.2])
def test_the_base_stays_near_its_way_in_a_corner(hsr, turn):
    points = [hsr.target.copy() for _ in range(3)]
    points[1][0] += 1.0
    points[2][:2] = points[1][:2] + [np.cos(turn), np.sin(turn)]
    stopping = timed(points, hsr.model)
    path = stopping.blended(hsr.model, lambda *_: True)
    legs = [np.linspace(one[:2], other[:2], 2001) for one, other in zip(points, points[1:])]
    way = np.concatenate(legs)
    off = [np.linalg.norm(way - path.at(time)[0][:2], axis=1).min() for time in np.arange(0.0, path.end, 0.02)]
    assert path.end < stopping.end and max(off) <= 0.0035


def test_steps_are_long_while_nothing_happens(motet):
    """Where a thing falls they are short, and while fingers move targets are set more often."""
    world = World(load("hsr", "kitchen", motet))
    world.wait(0.5)
    assert world.is_free() and world.tick == TICK
    world.place("mug_1", world.pose("mug_1")[0] + [0.0, 0.0, 0.05])
    world.step()
    world.step()
    assert not world.is_free()
    world.wait(1.0)
    assert world.is_free(), "it sleeps"
    target, ticks = world.target.copy(), set()
    for at, ends in world.model.grips.items():
        target[at] = sum(ends) / 2.0
    for _ in range(20):
        world.step(target)
        ticks.add(world.tick)
    assert GRIPS in ticks
