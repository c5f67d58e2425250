"""A cancel, a restart of the driver, a swap and a goal of MoveGroup, in front of whatever robot speaks ROS 2: that of
`robot.py`, or one in a container. The robot is watched through the driver alone.

    scenarios.py BINDING ROBOT SCENE
"""

import sys
import time
from pathlib import Path

from host import Agent, Driver


class Subject:
    """A robot with two places that it can move between."""

    def __init__(self, binding, robot, scene):
        self.binding, self.robot, self.scene = str(binding), robot, str(scene)
        self.is_arm = "[move_group]" in Path(binding).read_text()

    def driver(self, **more):
        return Driver(self.binding, robot=self.robot, scene=self.scene, **more)

    def begin(self, driver, there):
        """Begins a motion without a path: the driver looks for one from where the robot stands."""
        if self.is_arm:
            return driver.move("posture", {"case": "start" if there else "home"})
        query = {"query": "go_to", "args": [{"entity": "goal"}], "verdict": "open"}
        return driver.start("go", [query], to={"entity": "goal"})[0]

    def policy(self, is_long):
        """A policy; a long one still moves when another one takes over."""
        steps = ("start_pose() home() " * 4 if is_long else "home()") if self.is_arm else "go(goal)"
        return "policy p for %s { %s done }" % (self.robot, steps)


def place(driver):
    driver.call("ping")
    return [*driver.moved.get("base", []), *driver.moved["joints"].values()]


def apart(one, other):
    return max((abs(a - b) for a, b in zip(one, other)), default=0.0)


def moves(driver, secs=30.0):
    """Waits until the robot moves."""
    begun, end = place(driver), time.monotonic() + secs
    while not begun or apart(begun, place(driver)) < 0.02:
        begun = begun or place(driver)
        assert time.monotonic() < end, "the robot does not move"
        time.sleep(0.02)


def stands(driver):
    """True if the robot stands still."""
    before = place(driver)
    time.sleep(0.5)
    return apart(before, place(driver)) < 0.01


def departs(subject, driver):
    """Begins a motion, and waits until the robot moves. An arm goes first to where it can leave from."""
    if subject.is_arm:
        assert driver.ended(subject.begin(driver, True), 60.0) == {"success": None}
    goal = subject.begin(driver, False)
    moves(driver)
    return goal


def cancel(subject):
    with subject.driver() as driver:
        goal = departs(subject, driver)
        driver.call("cancel", goal=goal)
        assert driver.ended(goal, 15.0) == "interrupted" and stands(driver)


def restart(subject):
    driver = subject.driver()
    goal = departs(subject, driver)
    driver.kill()
    with subject.driver() as again:
        assert again.call("status", goals=[goal])["goals"][0]["state"] == "unknown"
        time.sleep(1.0)
        again.call("safe_stop", goal=goal)
        assert again.report("stopped", goal, 30.0) is not None and stands(again)


def swap(subject):
    agent = Agent(subject.robot, subject.scene, "ros2:" + subject.binding)
    run = agent.begin("tools/call", name="run_policy", arguments={"policy": subject.policy(True)})
    time.sleep(2.0)
    swapped = agent.call("tools/call", name="swap_policy", arguments={"policy": subject.policy(False)})
    ended = run.get(timeout=120)
    agent.close()
    assert not swapped["result"].get("isError"), swapped
    assert not ended["result"].get("isError"), ended


def move_group(subject):
    """Without a command that plans, MoveIt does."""
    if not subject.is_arm:
        return
    with subject.driver(motet="/bin/false") as driver:
        goal = subject.begin(driver, False)
        assert driver.ended(goal, 60.0) == {"success": None}
        assert any("MoveGroup plans a way that nobody has certified" in text for text in driver.texts(goal))


SCENARIOS = [cancel, restart, swap, move_group]

if __name__ == "__main__":
    robot = Subject(*sys.argv[1:4])
    for scenario in SCENARIOS:
        scenario(robot)
        print("%s: passed" % scenario.__name__, flush=True)
