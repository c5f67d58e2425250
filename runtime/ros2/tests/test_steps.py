"""Steps that the built-in bindings have beside those of `hsr.toml`: handles, searches, detections and choices."""

import subprocess
import threading
import time

import pytest
from cyclone import Node, Types, stamp
from host import DRIVER, HERE, MOTET, Driver, RobotProcess

BASE = "/omni_base_controller/follow_joint_trajectory"
MORE = """
[primitives.open]
steps = [
    { gripper = "open" }, { motion = "there", fails = "unreachable" }, { gripper = "open" }, { posture = "start", fails = "blocked" },
]

[primitives.search]
steps = [{ search = true, fails = "unreachable" }]

[primitives.detect_all]
steps = [{ detect = true }]

[primitives.locate]
steps = [{ detect = true }]

[primitives.choose]
steps = [{ answer = "/answer", type = "std_msgs/String", value = "data", fails = "refused" }]
"""
TABLE, COUNTER = {"entity": "kitchen_table"}, {"entity": "counter"}


@pytest.fixture
def binding(tmp_path):
    own = tmp_path / "own.toml"
    text = (HERE / "hsr.toml").read_text().replace('topic = "/detections"', 'topic = "/detections"\ntimeout_secs = 1.0')
    own.write_text(text + MORE)
    return own


class Detector:
    """A detector that sees a mug as soon as it is told to."""

    def __init__(self):
        self.types = Types()
        self.node = Node(self.types, 0)
        self.writer = self.node.publisher("/detections", "vision_msgs/Detection3DArray")
        self.answers = self.node.publisher("/answer", "std_msgs/String")
        self.sees, self.is_over = [], False
        self.thread = threading.Thread(target=self.run, daemon=True)
        self.thread.start()

    def run(self):
        while not self.is_over:
            found = [{"results": [{"hypothesis": {"class_id": thing, "score": 0.9}}], "id": thing, "bbox": {
                "center": {"position": {"x": 1.9, "y": 0.4, "z": 0.8}, "orientation": {"w": 1.0}}, "size": {"x": 0.1, "y": 0.1, "z": 0.1}}}
                for thing in self.sees]
            self.writer.write(self.types.zero("vision_msgs/Detection3DArray", header={"stamp": stamp(), "frame_id": "map"}, detections=found))
            time.sleep(0.1)

    def answer(self, text):
        self.answers.write(self.types.zero("std_msgs/String", data=text))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.is_over = True
        self.thread.join()


def test_the_hand_closes_around_a_handle_where_the_path_does(binding, tmp_path):
    policy = tmp_path / "open.motet"
    policy.write_text("policy open_it for hsr { go(drawer_1) open(drawer_1) done }\n")
    with RobotProcess(binding=binding) as robot:
        flags = ["--robot", "hsr", "--scene", "kitchen", "--driver", "ros2:%s" % binding, "--format", "json"]
        done = subprocess.run([MOTET, "run", str(policy), *flags], capture_output=True, text=True, timeout=150)
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr
        hands = robot.events("gripper")
        assert [event["closed"] for event in hands] == [False, True, False]
        grip, release = hands[1]["at"], hands[2]["at"]
        follows = [event for event in robot.events("trajectory") if grip < event["at"] < release]
        assert [event["action"] for event in follows] == [BASE], "the base follows the handle with the hand closed"
        after = [event for event in robot.events("trajectory") if event["at"] > release]
        places = {name: value for event in after for name, value in zip(event["joints"], event["points"][-1][1])}
        assert abs(places["wrist_flex_joint"] + 1.57) < 1e-6 and abs(places["arm_roll_joint"]) < 1e-6, places


def test_a_search_goes_on_until_it_sees_what_it_looks_for(binding):
    with RobotProcess(binding=binding) as robot, Driver(binding) as driver, Detector() as detector:
        goal, answer = driver.start("search", what={"text": "mug_1"}, around={"list": [TABLE, COUNTER]})
        assert "error" not in answer, answer
        bases = lambda: [event for event in robot.events("done") if event["action"] == BASE]  # noqa: E731
        end = time.monotonic() + 60.0
        while len(bases()) < 2 and time.monotonic() < end:
            driver.call("ping")
            time.sleep(0.1)
        detector.sees = ["mug_1"]
        assert driver.ended(goal, 20.0) == {"success": {"entity": "mug_1"}}
        at = lambda place: driver.call("observe", query={"fact": {"fluent": "at", "args": [  # noqa: E731
            {"is": {"entity": "robot"}}, {"is": place}]}})["answer"]
        assert at(COUNTER) == {"truth": True} and at(TABLE) == {"truth": False}


def test_a_search_that_sees_nothing_ends_behind_its_last_place(binding):
    with RobotProcess(binding=binding), Driver(binding) as driver:
        goal, _ = driver.start("search", what={"text": "mug_1"}, around={"list": [TABLE]})
        assert driver.ended(goal, 60.0)["failure"]["kind"] == "not_found"
        goal, _ = driver.start("search", what={"text": "mug_1"})
        assert "no argument `around`" in driver.ended(goal)["failure"]["text"]


def test_detections_give_what_the_primitive_declares(binding):
    with RobotProcess(binding=binding), Driver(binding) as driver, Detector() as detector:
        goal, _ = driver.start("detect_all", what={"text": "mug"})
        assert driver.ended(goal) == {"success": {"list": []}}
        detector.sees = ["mug_1", "mug_2", "apple"]
        time.sleep(0.5)
        goal, _ = driver.start("detect_all", what={"text": "mug"})
        assert driver.ended(goal) == {"success": {"list": [{"entity": "mug_1"}, {"entity": "mug_2"}]}}
        goal, _ = driver.start("locate", object={"entity": "mug_1"})
        assert driver.ended(goal)["success"]["pose"]["xyz"] == pytest.approx([1.9, 0.4, 0.8])


def test_an_answer_that_names_a_thing_is_that_thing(binding):
    among = {"list": [{"entity": "mug_1"}, {"entity": "apple"}]}
    with RobotProcess(binding=binding), Driver(binding) as driver, Detector() as detector:
        for said, wanted in (("apple", {"success": {"entity": "apple"}}), ("plate", "names 0 of the things")):
            goal, _ = driver.start("choose", question={"text": "Which?"}, among=among)
            time.sleep(0.3)
            detector.answer(said)
            ended = driver.ended(goal)
            assert ended == wanted or wanted in ended["failure"]["text"], ended


def test_primitive_without_a_binding_is_refused_before_anything_moves(tmp_path):
    policy = tmp_path / "lacks.motet"
    policy.write_text("policy lacks for hsr {\n    go(kitchen_table)\n    turn(90 deg)\n    done\n}\n")
    with RobotProcess() as robot:
        flags = ["--robot", "hsr", "--scene", "kitchen", "--driver", "ros2:%s" % (HERE / "hsr.toml")]
        done = subprocess.run([MOTET, "run", str(policy), *flags], capture_output=True, text=True, timeout=60)
        assert done.returncode == 1 and "does not have `turn` (" in done.stderr and "lacks.motet:3)" in done.stderr, done.stderr
        assert not robot.events("trajectory")


def test_a_wrong_argument_is_found_without_a_robot(tmp_path):
    own = tmp_path / "own.toml"
    own.write_text((HERE / "hsr.toml").read_text().replace("{text}", "{txt}"))
    done = subprocess.run([DRIVER, "check", str(own)], capture_output=True, text=True, timeout=60)
    assert done.returncode == 1 and "`{txt}` is no argument of `say`: did you mean `text`?" in done.stdout, done.stdout
    assert "1 problem" in done.stdout
