"""The driver over its protocol: what it does, holds, stops and reports, and the same twice."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest
from host import Host, entity, fact, forgotten, pose, text
from motet_mujoco.driver import Driver, Error, Options, serve
from motet_mujoco.model import load

# A profile in which things stand elsewhere, and all else is as it should be.
SHIFTED = os.path.join(os.path.dirname(__file__), "shifted.toml")


@pytest.fixture
def drive(motet):
    """Starts drivers, and ends them."""
    hosts = []

    def start(robot, scene, *flags):
        hosts.append(Host(robot, scene, "--motet", motet, "--oracle", *flags))
        return hosts[-1]

    yield start
    for host in hosts:
        host.process.kill()


def test_fetching_a_mug(drive):
    host = drive("hsr", "kitchen")
    assert host.welcome["capabilities"]["clock"] == "driver"
    assert {"go", "pick", "wake_up"} <= set(host.welcome["capabilities"]["primitives"]["only"])
    assert host.carry_out("go", to=entity("kitchen_table")) == {"success": None}
    # Without a witness the driver plans by itself, and says so.
    said = [one["params"] for one in host.reports if one["method"] == "feedback"]
    assert [one["text"] for one in said] == ["go_to(kitchen_table), it has no witness"] and said[0]["own_motion"]
    assert host.holds("at", "robot", "kitchen_table") and not host.holds("at", "robot", "counter")
    assert host.carry_out("detect", what=text("the red mug")) == {"success": {"entity": "mug_1"}}
    assert host.carry_out("detect", what=text("purple elephant"))["failure"]["kind"] == "not_found"
    assert host.carry_out("pick", object=entity("mug_1")) == {"success": None}
    assert host.holds("holding", "mug_1") and host.holds("lifted", "mug_1")
    assert not host.holds("on", "mug_1", "kitchen_table") and not host.holds("free", "hand")
    assert host.carry_out("go", to=entity("user")) == {"success": None}
    assert host.carry_out("handover", object=entity("mug_1"), to=entity("user")) == {"success": None}
    assert host.holds("at", "mug_1", "user") and host.holds("free", "hand")
    moved = [report["params"] for report in host.reports if report["method"] == "moved"]
    times = [one["at"] for one in moved]
    assert times == sorted(times) and all(b - a > 0.019 for a, b in zip(times, times[1:]))
    assert {thing["id"] for thing in moved[0]["things"]} >= {"mug_1", "apple"}
    assert host.close() == 0


def test_a_drawer_opens_and_closes_by_contact(drive):
    host = drive("hsr", "kitchen")
    assert host.carry_out("go", to=entity("drawer_1")) == {"success": None}
    assert host.carry_out("open", what=entity("drawer_1")) == {"success": None}
    assert host.holds("open", "drawer_1")
    assert host.carry_out("close", what=entity("drawer_1")) == {"success": None}
    assert not host.holds("open", "drawer_1")


def test_the_robot_goes_on_after_it_opened_a_drawer(drive):
    """The arm has no room to fold where it opened the drawer: the base draws back first."""
    host = drive("hsr", "kitchen")
    host.carry_out("go", to=entity("drawer_1"))
    assert host.carry_out("open", what=entity("drawer_1")) == {"success": None}
    assert host.carry_out("go", to=entity("mug_1")) == {"success": None}
    assert host.holds("open", "drawer_1")


def test_holding_stopping_and_cancelling(drive):
    host = drive("hsr", "kitchen")
    goal, answer = host.start("go", to=entity("counter"))
    assert answer == {}
    assert host.call("start", goal=goal, command={"primitive": "go", "args": [], "uses": [], "deadline_secs": 1}) == {}

    def base():
        return next(one["params"]["base"] for one in reversed(host.reports) if one["method"] == "moved")

    host.advance(2.0)
    driving = base()
    assert abs(driving[0]) + abs(driving[1]) > 0.1
    host.call("hold", goal=goal)
    host.advance(0.5)
    still = base()
    host.advance(1.0)
    assert max(abs(a - b) for a, b in zip(base(), still)) < 0.002, "it keeps still"
    host.call("proceed", goal=goal)
    host.advance(1.0)
    assert max(abs(a - b) for a, b in zip(base(), still)) > 0.05, "it goes on"
    assert host.call("cancel", goal=goal) == {}
    assert host.call("status", goals=[goal])["goals"][0]["state"] == {"ended": "interrupted"}
    host.call("safe_stop", goal=77)
    host.call("ping")
    assert any(one["method"] == "stopped" and one["params"]["goal"] == 77 for one in host.reports)
    assert host.call("status", goals=[5, 77])["goals"] == [{"goal": 5, "state": "unknown"},
                                                          {"goal": 77, "state": "stopped"}]
    assert host.call("dance")["error"]["code"] == -32601
    assert host.call("start", goal=9)["error"]["code"] == -32602
    assert "error" in host.start("dance")[1]


def test_another_robot_or_scene_than_that_of_the_host_is_refused(drive):
    host = drive("hsr", "kitchen")
    greeting = {"protocol": 2, "run": "next", "policy": "test", "primitives": [{"name": "go", "fails": ["unreachable"]}]}
    error = host.call("hello", robot="anymal_z1", **greeting)["error"]
    assert error["message"] == "this driver has the robot `hsr`, not `anymal_z1`"
    assert "capabilities" in host.call("hello", robot="hsr", **greeting)
    failure = host.start("go", to=entity("workbench"))[1]["error"]["data"]["failure"]
    assert failure == {"kind": "unreachable", "text": "the scene of this driver has no `workbench`"}


def test_things_rest_before_the_first_step(drive):
    host = drive("hsr", "kitchen")
    query = {"fact": {"fluent": "on", "args": [{"is": entity(one)} for one in ("mug_1", "kitchen_table")]}}
    assert host.call("truth", query=query)["answer"] == host.call("observe", query=query)["answer"] == {"truth": True}


def test_a_thing_that_is_lost_is_told(drive):
    host = drive("hsr", "kitchen")
    query = {"fact": {"fluent": "holding", "args": [{"is": {"entity": "mug_1"}}]}}
    assert host.call("watch", query=query)["answer"] == {"truth": False}
    host.carry_out("go", to=entity("kitchen_table"))
    assert host.carry_out("pick", object=entity("mug_1")) == {"success": None}
    told = [one["params"]["answer"] for one in host.reports
            if one["method"] == "observed" and one["params"]["query"] == query]
    assert told and told[-1] == {"truth": True}


def test_a_person_in_the_way(drive):
    host = drive("hsr", "kitchen", "--walk", "user:1.0,0.3@1,2.0")
    failure = host.carry_out("go", to=entity("kitchen_table"))["failure"]
    assert failure["kind"] == "blocked" and "user" in failure["text"]


def test_words_and_sights_are_told(drive):
    host = drive("hsr", "kitchen", "--says", "user:bring the apple, too@0.5", "--profile", SHIFTED, "--seed", "3")
    host.carry_out("go", to=entity("kitchen_table"))
    heard = [one["params"] for one in host.reports if one["method"] == "heard"]
    assert heard == [{"text": "bring the apple, too", "from": "user"}]
    host.carry_out("inspect", what=entity("mug_1"))
    seen = [each for one in host.reports if one["method"] == "detected" for each in one["params"]["detections"]]
    assert any(one["id"] == "mug_1" for one in seen), "it stands on another surface or elsewhere"


@pytest.mark.parametrize("flags", [[], ["--oracle", "judge"], ["--oracle"]])
def test_telemetry_tells_what_the_robot_knows(motet, tmp_path, flags):
    """The mug stands elsewhere than the robot was told, and nobody told where the apple is."""
    scene = load("hsr", "kitchen", motet).scene
    real, told = tmp_path / "real.json", tmp_path / "told.json"
    told.write_text(json.dumps(forgotten(scene, "apple")))
    mug = next(one for one in scene["entities"] if one["id"] == "mug_1")
    believed = list(mug["pose"]["xyz"])
    mug["pose"]["xyz"][1] += 0.2
    real.write_text(json.dumps(scene))
    host = Host("hsr", str(real), "--told", str(told), *flags)
    try:
        host.advance(0.2)
        moved = [one["params"] for one in host.reports if one["method"] == "moved"][-1]
        places = {one["id"]: one["xyz"] for one in moved["things"]}
        is_oracle = flags == ["--oracle"]
        assert ("apple" in places) is is_oracle
        expected = np.array(believed) + [0.0, 0.2 * is_oracle, 0.0]
        assert np.abs(places["mug_1"] - expected).max() < 0.005
    finally:
        host.close()


def test_a_point_decides_a_grasp(drive):
    host = drive("hsr", "kitchen")
    host.carry_out("go", to=entity("kitchen_table"))
    moved = [one["params"] for one in host.reports if one["method"] == "moved"][-1]
    mug = next(one for one in moved["things"] if one["id"] == "mug_1")["xyz"]
    failure = host.carry_out("grasp", object=entity("mug_1"), at=pose([5.0, 0.0, 0.0]))["failure"]
    assert failure["kind"] == "unreachable" and "m away" in failure["text"]
    beside = [mug[0], mug[1], mug[2] + 0.2]
    failure = host.carry_out("grasp", object=entity("mug_1"), at=pose(beside))["failure"]
    assert failure["kind"] == "not_found" and "beside" in failure["text"]
    high = [mug[0], mug[1], mug[2] + 0.03]
    assert host.carry_out("grasp", object=entity("mug_1"), at=pose(high)) == {"success": None}
    assert host.holds("holding", "mug_1")


def test_the_same_calls_give_the_same_reports(drive):
    def run(seed):
        host = drive("hsr", "kitchen", "--profile", "typical", "--seed", seed)
        host.carry_out("go", to=entity("kitchen_table"))
        host.carry_out("pick", object=entity("mug_1"))
        return [json.dumps(report) for report in host.reports]

    first = run("3")
    assert first == run("3")
    assert first != run("4")


def test_the_driver_keeps_the_laws(motet):
    here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    driver = "'%s' -m motet_mujoco --robot panda --scene lab --motet '%s' --oracle" % (sys.executable, motet)
    checked = subprocess.run([motet, "run", "--check", "--driver", driver], text=True, capture_output=True, timeout=900,
                             env=dict(os.environ, PYTHONPATH=here), check=False)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_nothing_moves_before_the_host_has_greeted(motet, monkeypatch):
    """A machine that is slow to start must not change what happens: the world began to move by the wall clock."""
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(), oracle=True)
    reader, writer = os.pipe()
    os.write(writer, b"\n" + json.dumps({"jsonrpc": "2.0", "id": 1, "method": "hello", "params": {
        "protocol": 2, "run": "test", "primitives": []}}).encode() + b"\n")
    os.close(writer)
    hours = iter(range(0, 10**6, 3600))
    monkeypatch.setattr("motet_mujoco.driver.time.monotonic", lambda: float(next(hours)))
    before, said = driver.world.now, []
    serve(driver, reader, said.append)
    os.close(reader)
    assert driver.world.now == before and len(said) == 1


def test_looking(drive):
    host = drive("panda", "kitchen")
    seen = host.call("look")
    if "error" in seen:
        pytest.skip(seen["error"]["message"])
    assert seen["image"]["width"] == seen["depth"]["width"] == 640
    assert "error" in host.call("look", camera="nose")


@pytest.mark.parametrize("robot, scene, thing", [("hsr", "kitchen", "mug_1"), ("hsr", "living_room", "remote_1"),
                                                 ("anymal_z1", "lab", "sample")])
def test_a_state_begins_with_the_thing_upright_in_the_hand(motet, robot, scene, thing):
    driver = Driver(load(robot, scene, motet), motet, Options(), judged=True)
    driver.hello({"protocol": 2, "run": "test", "state": [fact("holding", thing)]})
    for _ in range(250):
        driver.tick()
    world = driver.world
    assert driver.observe({"query": fact("holding", thing)["query"]})["answer"] == {"truth": True}
    assert driver.truth({"query": fact("lifted", thing)["query"]})["answer"] == {"truth": True}
    # As `reach` grips it, the fingers do not point up at what stands upright.
    up = world.data.xmat[world.model.body_of[thing]].reshape(3, 3)[:, 2]
    assert up @ world.tip()[1][:, 2] < 0.2, "it is held upside down"


def test_a_state_puts_things_and_doors_where_it_says(motet):
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(), oracle=True)
    state = [fact("in", "apple", "fridge_1"), fact("open", "fridge_1"), fact("on", "coke", "kitchen_table"),
             fact("at", "robot", "counter"), fact("watered", "apple", holds=False)]
    driver.hello({"protocol": 2, "run": "test", "state": state})
    for _ in range(100):
        driver.tick()
    for one in state:
        assert driver.observe({"query": one["query"]})["answer"] == {"truth": one["holds"]}, one


def test_a_state_that_cannot_be_is_an_error(motet):
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(), oracle=True)
    with pytest.raises(Error, match="kitchen_table"):
        driver.hello({"protocol": 2, "run": "test", "state": [fact("on", "mug_1", "kitchen_table", holds=False)]})
