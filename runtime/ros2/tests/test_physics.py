"""The world of MuJoCo behind the topics of ROS 2: Motet, DDS, physics."""

import json
import math
import os
import subprocess
import sys
import time

import numpy as np
import pytest
from host import HERE, MOTET, Agent, Driver, RobotProcess, drive, pixels

EXAMPLES = HERE.parent.parent.parent / "examples"
DRIVER = "ros2:%s" % (HERE / "hsr.toml")


def run(driver, *flags):
    """Runs `fetch_mug`; the events of the run, and the exit code."""
    # The binding has no `ask`: whoever looks at the page would answer.
    page = ["--view"] if driver.startswith("ros2:") else []
    command = [MOTET, "run", str(EXAMPLES / "fetch_mug.motet"), *page, "--robot", "hsr", "--scene", "kitchen", "--driver", driver,
               "--format", "json", *flags]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    return [json.loads(line) for line in done.stdout.splitlines()], done


def endings(events):
    return [(event["step"], event["ending"]) for event in events if event["event"] == "ended"]


def test_fetch_mug_through_dds_ends_as_the_direct_run_does():
    # The detector says words for what it sees, and no ids of the scene.
    with RobotProcess("--physics", "--fault", "labels") as robot:
        events, done = run(DRIVER)
        assert done.returncode == 0, done.stdout[-2000:] + done.stderr
        gripped = robot.events("gripped")
        assert [event["held"] for event in gripped] == [[], ["mug_1"], []], gripped
        assert gripped[-1]["given"] == {"mug_1": "user"}
    direct, done = run("mujoco", "--speed", "max", "--profile", "ideal")
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    assert endings(events) == endings(direct)


def test_a_policy_is_swapped_in_mid_motion():
    with RobotProcess("--physics") as robot:
        agent = Agent("hsr", "kitchen", DRIVER)
        first = agent.begin("tools/call", name="run_policy", arguments={"policy": "policy a for hsr { go(kitchen_table) done }"})
        while not robot.events("trajectory"):
            time.sleep(0.05)
        time.sleep(2.0)
        swapped = agent.call("tools/call", name="swap_policy", arguments={"policy": "policy b for hsr { go(user) done }"})
        assert not swapped["result"].get("isError"), swapped
        ended = first.get(timeout=90)
        assert not ended["result"].get("isError"), ended
        agent.close()
        before, *_, after = robot.events("trajectory")
        assert before["id"] in [event["id"] for event in robot.events("cancel")]
        assert after["id"] in [event["id"] for event in robot.events("done")]
        # The second path begins where the first one was left: within 3 cm and 3 degrees, as `[start]` allows for a path,
        # and as much again for the way to standstill.
        [left] = [event["base"] for event in robot.events("cancel") if event["id"] == before["id"]]
        x, y, yaw = after["points"][0][1]
        assert math.dist([x, y], left[:2]) < 0.06 and abs(yaw - left[2]) < 0.1, (after["points"][0], left)
        assert math.dist(left[:2], before["points"][0][1][:2]) > 0.2, "it had moved before the swap"
        assert math.dist(left[:2], before["points"][-1][1][:2]) > 0.2, "it was in mid-motion at the swap"


def joint_at(driver, joint):
    driver.call("ping")
    return driver.moved["joints"][joint]


@pytest.mark.parametrize("fault", ["none", "ignore-cancel"])
def test_a_canceled_arm_stands_still_in_mid_motion(fault):
    with RobotProcess("--physics", "--fault", fault) as robot, Driver() as driver:
        assert driver.discovers("arm_lift_joint")
        goal = driver.lift(0.5, secs=6.0, begin=joint_at(driver, "arm_lift_joint"))
        assert robot.wait("trajectory")
        time.sleep(2.5)
        driver.call("cancel", goal=goal)
        assert driver.ended(goal, 15.0) == "interrupted"
        height = joint_at(driver, "arm_lift_joint")
        assert 0.03 < height < 0.45, height
        time.sleep(1.0)
        # It stood when its end was said, and stands.
        assert abs(joint_at(driver, "arm_lift_joint") - height) < 0.005
        begun, *others = robot.events("trajectory")
        assert bool(others) == (fault == "ignore-cancel"), "a trajectory that stands still takes its place"
        assert begun["id"] not in [event["id"] for event in robot.events("done")]


def test_a_navigation_in_front_of_physics():
    with RobotProcess("--physics", binding="nav.toml") as robot, Driver("nav.toml") as driver:
        goal = drive(driver, [0.6, 0.2, 0.5], [("arm_lift_joint", 0.2)])
        assert driver.ended(goal, 30.0) == {"success": None}
        [event], [lift] = robot.events("navigate"), robot.events("trajectory")
        assert event["goal"] == pytest.approx([0.6, 0.2, 0.5]) and lift["at"] > event["at"] + 1.0
        driver.call("ping")
        assert driver.moved["base"] == pytest.approx([0.6, 0.2, 0.5], abs=0.03)
        assert joint_at(driver, "arm_lift_joint") == pytest.approx(0.2, abs=0.02)
        goal = drive(driver, [-0.6, 0.2, 0.5], begin=[0.6, 0.2, 0.5])
        assert robot.wait("navigate", count=2)
        time.sleep(1.5)
        driver.call("cancel", goal=goal)
        assert driver.ended(goal, 15.0) == "interrupted"
        driver.call("ping")
        stands = driver.moved["base"]
        assert -0.4 < stands[0] < 0.55, stands
        time.sleep(1.0)
        driver.call("ping")
        assert driver.moved["base"] == pytest.approx(stands, abs=0.01)


@pytest.fixture
def boxed(tmp_path):
    """A binding with a detector that draws boxes in the pictures of a camera."""
    path = tmp_path / "boxed.toml"
    path.write_text((HERE / "hsr.toml").read_text().replace("[detections]", '[detections]\ncamera = "head"'))
    return path


def renders():
    """True if pictures can be rendered here."""
    program = "import mujoco; mujoco.Renderer(mujoco.MjModel.from_xml_string('<mujoco/>'), 8, 8)"
    return subprocess.run([sys.executable, "-c", program], capture_output=True, env={**os.environ, "MUJOCO_GL": os.environ.get("MUJOCO_GL", "egl")}).returncode == 0


needs_graphics = pytest.mark.skipif(not renders(), reason="no graphics library renders without a window")


@needs_graphics
def test_a_box_in_a_picture_is_where_its_depth_says(boxed):
    with RobotProcess("--physics", "--render", binding=boxed), Driver(boxed) as driver:
        assert driver.discovers("head_tilt_joint")
        goal, _ = driver.start("detect", what={"text": "red mug"})
        assert driver.ended(goal, 30.0) == {"success": {"entity": "mug_1"}}
        [mug] = [one for one in driver.call("detections")["detections"] if one["id"] == "mug_1"]
        assert math.dist(mug["pose"]["xyz"], [1.98, 0.3, 0.77]) < 0.04, mug
        assert mug["extent"] == pytest.approx([0.08, 0.08, 0.1], abs=0.04)


@needs_graphics
def test_a_picture_shows_the_room_at_its_depth():
    kitchen = json.loads((HERE.parent.parent.parent / "robots" / "scenes" / "kitchen.json").read_text())
    entities = {entity["id"]: entity for entity in kitchen["entities"]}
    with RobotProcess("--physics", "--render"), Driver() as driver:
        assert driver.discovers("head_tilt_joint")
        end = time.monotonic() + 20.0
        while "error" in (picture := driver.call("look")) and time.monotonic() < end:
            time.sleep(0.2)
        assert "error" not in picture, picture
        colour, depth = pixels(picture)
    camera = picture["camera"]
    x, y, z, w = camera["pose"]["quaternion"]
    rotation = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
                         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
    # Where a ray meets the top of the table, by the scene, is where its depth says.
    table = entities["kitchen_table"]
    (tx, ty, tz), (lx, ly, lz) = table["pose"]["xyz"], table["shape"]["box"]
    rows, columns = np.indices(depth.shape)
    rays = np.stack([(columns - camera["cx"]) / camera["fx"], (rows - camera["cy"]) / camera["fy"], np.ones_like(depth)], axis=-1) @ rotation.T
    eye = np.array(camera["pose"]["xyz"])
    with np.errstate(divide="ignore", invalid="ignore"):
        known = (tz + lz / 2.0 - eye[2]) / rays[..., 2]
    at = eye + rays * known[..., None]
    clear = [entity["pose"]["xyz"] for entity in entities.values() if entity.get("on") == "kitchen_table"]
    is_top = (known > 0.0) & (np.abs(at[..., 0] - tx) < lx / 2.0 - 0.05) & (np.abs(at[..., 1] - ty) < ly / 2.0 - 0.05)
    for thing in clear:
        # What stands on it is not its top.
        is_top &= np.hypot(at[..., 0] - thing[0], at[..., 1] - thing[1]) > 0.35
    assert is_top.sum() > 20, is_top.sum()
    off = depth[is_top] - known[is_top]
    # Before some of it is the robot's own hand; behind it is nothing.
    assert off.max() < 0.005 and np.median(np.abs(off)) < 0.002, off
    # The middle of the red mug is red, and its near side is there.
    local = rotation.T @ (np.array(entities["mug_1"]["pose"]["xyz"]) - eye)
    column, row = round(local[0] / local[2] * camera["fx"] + camera["cx"]), round(local[1] / local[2] * camera["fy"] + camera["cy"])
    red, green, blue = (int(part) for part in colour[row, column])
    assert red > green + 30 and red > blue + 30, (red, green, blue)
    assert abs(depth[row, column] - (local[2] - 0.04)) < 0.02, (depth[row, column], local)
