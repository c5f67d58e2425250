"""The order of the motions of a primitive: each is noted in place of being carried out."""

import numpy as np
import pytest
from motet_mujoco.chance import profile
from motet_mujoco.driver import Driver, Options
from motet_mujoco.model import load
from motet_mujoco.moving import Failed, Motion

DRAWER = {"what": {"entity": "drawer_1"}}
# The way to a handle, the grip, the way that it is drawn, the release, the way off, and a look once the arm is folded.
SWING = ["pull(drawer_1)", "follow", "close hand", "follow", "open hand", "follow", "fold", "look"]
# The way back of the base, once it is known how far the drawer stands open.
BACK = ["back", "look"]


@pytest.fixture(scope="module")
def driver(motet):
    return Driver(load("hsr", "kitchen", motet), motet, Options(profile("ideal")))


@pytest.fixture
def tasks(driver, monkeypatch):
    """Tasks that note their motions in `done`, and see a drawer open that they have drawn by `drawn` m."""
    tasks, world = driver.tasks, driver.world
    tasks.done, tasks.drawn, tasks.sees = [], 0.35, True
    driver.beliefs.opened("drawer_1", False)
    points = [world.target.copy() for _ in range(5)]
    for point, place, is_closed in zip(points, (0.0, 0.1, 0.1, 0.3, 0.3), (False, False, True, True, False)):
        point[0] += place
        for at, ends in world.model.grips.items():
            point[at] = ends[int(is_closed)]

    def noted(name, result=None):
        def motion(*_args, **_flags):
            tasks.done.append(name)
            return result
            yield

        return motion

    def motion(_motion, query, *_args, **_flags):
        tasks.done.append(query)
        return tasks.path(points)
        yield

    def grip(closed, _seconds):
        tasks.done.append("close hand" if closed else "open hand")
        return
        yield

    def glance():
        tasks.done.append("look")
        if tasks.sees:
            driver.beliefs.opened("drawer_1", True, 1.0)

    monkeypatch.setattr(tasks, "motion", motion)
    monkeypatch.setattr(tasks, "grip", grip)
    monkeypatch.setattr(tasks, "glance", glance)
    monkeypatch.setattr(tasks, "drawing", lambda _part: ((tasks.drawn, 0.35, True), None))
    for name, says in {"follow": "follow", "straight": "straight", "folded_again": "fold", "stand": "back", "way_back": "way back",
                       "face": "face"}.items():
        monkeypatch.setattr(tasks, name, noted(says, True))
    yield tasks
    driver.beliefs.opened("drawer_1", False)
    driver.beliefs.entities["drawer_1"].pop("locked", None)


def carry_out(task):
    for _ in task:
        pass


def test_a_drawer_is_drawn_and_left_before_it_is_looked_at(tasks):
    """Where the command does not say where to end, the robot then drives to where the inside shows."""
    carry_out(tasks.do_open(DRAWER, Motion(None)))
    assert tasks.done == [*SWING, *BACK, "face"]
    assert tasks.room.is_open("drawer_1") is True
    tasks.done.clear()
    carry_out(tasks.do_open(DRAWER, Motion(None)))
    assert tasks.done == [], "it is open"


def test_a_command_that_says_where_it_ends_leads_to_no_other_place(tasks):
    carry_out(tasks.do_open(DRAWER, Motion({"leaves": {"base": [0.0, 0.0, 0.0]}})))
    assert tasks.done == [*SWING, *BACK]


@pytest.mark.parametrize("drawn, kind, is_locked", [(0.01, "blocked", True), (0.15, "slipped", False)])
def test_a_handle_that_does_not_come_is_told_after_the_way_back(tasks, drawn, kind, is_locked):
    tasks.drawn, tasks.sees = drawn, False
    with pytest.raises(Failed) as failed:
        carry_out(tasks.do_open(DRAWER, Motion(None)))
    assert tasks.done == SWING and failed.value.kind == kind
    assert tasks.room.is_locked("drawer_1") is is_locked


def test_what_is_put_down_is_looked_for_after_the_way_back(tasks, driver, monkeypatch):
    monkeypatch.setattr(tasks.room, "holds", lambda thing: thing == driver.beliefs.hand)
    monkeypatch.setattr(tasks, "keeps", lambda thing: None)
    driver.beliefs.hand, driver.beliefs.grip = "mug_1", (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))
    counter = {"object": {"entity": "mug_1"}, "on": {"entity": "counter"}}
    carry_out(tasks.do_place(counter, Motion(None)))
    assert tasks.done == ["put(mug_1, counter)", "follow", "open hand", "straight", "way back", "look"]
    assert driver.beliefs.entities["mug_1"]["on"] == "counter" and driver.beliefs.hand is None
