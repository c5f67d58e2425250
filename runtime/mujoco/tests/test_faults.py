"""A file of faults in physics: calls that fail, changes of the room, answers, and files that are not of this form."""

import json
import os
import subprocess
import sys

import pytest
from host import Host, entity, text
from motet_mujoco.faults import answers, read


@pytest.fixture
def drive(motet, tmp_path):
    """Starts drivers with a script of faults, and ends them."""
    hosts = []

    def start(script, *flags):
        path = tmp_path / "faults.json"
        path.write_text(json.dumps(script))
        hosts.append(Host("hsr", "kitchen", "--motet", motet, "--oracle", "--faults", str(path), *flags))
        return hosts[-1]

    yield start
    for host in hosts:
        host.process.kill()


def kind(outcome):
    """The failure kind of an outcome."""
    failure = outcome["failure"] if "failure" in outcome else outcome["error"]["data"]["failure"]
    return failure if isinstance(failure, str) else failure["kind"]


def test_calls_fail_are_refused_hang_and_are_slower(drive):
    wet = {"kind": "slipped", "text": "the mug is wet"}
    host = drive({"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": wet}},
                            {"primitive": "home", "nth": 1, "then": {"refuses": "blocked"}},
                            {"primitive": "go", "nth": 2, "then": {"slower": 2.0}},
                            {"primitive": "say", "then": "hangs"}]})
    assert host.carry_out("go", to=entity("kitchen_table")) == {"success": None}
    once = host.now
    assert host.carry_out("pick", object=entity("mug_1")) == {"failure": wet}
    assert host.holds("on", "mug_1", "kitchen_table") and not host.holds("holding", "mug_1")
    assert host.carry_out("pick", object=entity("mug_1")) == {"success": None}
    assert kind(host.carry_out("home")) == "blocked"
    begun = host.now
    # The way is not the same, but about as long.
    assert host.carry_out("go", to=entity("counter")) == {"success": None}
    assert host.now - begun > 1.3 * once, (host.now - begun, once)
    assert host.carry_out("say", patience=20.0, text=text("hello")) == "late"


def test_the_room_changes_at_its_times(drive):
    host = drive({"world": [
        {"at": 1.0, "what": {"moves": {"object": "mug_1", "to": {"surface": "counter"}}}},
        {"at": 1.0, "what": {"moves": {"object": "apple", "to": {"container": "drawer_1"}}}},
        {"at": 1.0, "what": {"moves": {"object": "coke", "to": {"point": [0.0, -0.8, 0.07]}}}},
        {"at": 2.0, "what": {"opens": "fridge_1"}}, {"at": 6.0, "what": {"closes": "fridge_1"}},
        {"at": 7.0, "what": {"locks": "fridge_1"}}, {"at": 9.0, "what": {"unlocks": "fridge_1"}},
        {"at": 2.0, "what": {"battery": 0.4}},
        {"at": 2.0, "what": {"walks": {"person": "user", "from": [0.0, 1.5], "to": [0.5, 1.5], "speed": 1.0}}},
        {"at": 2.0, "what": {"moves": {"object": "unicorn", "to": {"surface": "counter"}}}}]})
    host.advance(0.5)
    assert host.holds("on", "mug_1", "kitchen_table")
    host.advance(4.5)
    assert host.holds("on", "mug_1", "counter") and host.holds("in", "apple", "drawer_1")
    assert not any(host.holds(fluent, "coke", "any") for fluent in ("on", "in"))
    assert host.holds("open", "fridge_1")
    charge = host.call("observe", query={"measure": {"measure": "battery", "args": []}})["answer"]
    assert charge == {"value": {"number": 0.4}}
    moved = [one["params"] for one in host.reports if one["method"] == "moved"]
    assert moved[-1]["at"] > 4.0
    host.advance(3.0)
    assert not host.holds("open", "fridge_1") and host.holds("locked", "fridge_1")
    host.advance(2.0)
    assert not host.holds("locked", "fridge_1")


def test_a_thing_slips_out_of_the_hand(drive):
    host = drive({"world": [{"at": 25.0, "what": {"slips": "mug_1"}}]})
    host.carry_out("go", to=entity("kitchen_table"))
    assert host.carry_out("pick", object=entity("mug_1")) == {"success": None} and host.now < 24.0
    assert host.holds("holding", "mug_1")
    host.advance(28.0 - host.now)
    assert not host.holds("holding", "mug_1")


def test_people_answer_refuse_and_change_the_room(drive, tmp_path):
    said = tmp_path / "answers.json"
    said.write_text(json.dumps(["the red one", None]))
    host = drive({"answers": ["later"], "world": [{"after_answer": 2, "at": 1.0, "what": {"opens": "fridge_1"}}]},
                 "--answers-file", str(said))
    assert host.carry_out("ask", question=text("Which?")) == {"success": {"text": "the red one"}}
    assert kind(host.carry_out("ask", question=text("Which?"))) == "refused"
    host.advance(4.0)
    assert not host.holds("open", "fridge_1")
    assert host.carry_out("ask", question=text("When?")) == {"success": {"text": "later"}}
    host.advance(4.0)
    assert host.holds("open", "fridge_1")


@pytest.mark.parametrize("flag, content, why", [("--answers-file", "{}", "a list of answers is expected"),
                                                ("--faults", "{", "Expecting property name")])
def test_a_file_of_another_form_is_an_error(motet, tmp_path, flag, content, why):
    path = tmp_path / "wrong.json"
    path.write_text(content)
    words = [sys.executable, "-m", "motet_mujoco", "--robot", "hsr", "--scene", "kitchen", "--motet", motet, flag]
    done = subprocess.run([*words, str(path)], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and why in done.stderr and "wrong.json" in done.stderr


@pytest.mark.parametrize("read_file, content", [(read, {"calls": []}), (answers, ["the red one", None])])
def test_files_may_be_pipes(read_file, content):
    """As a shell makes them of `<(…)`: they can be read once."""
    reader, writer = os.pipe()
    os.write(writer, json.dumps(content).encode())
    os.close(writer)
    try:
        assert read_file("/dev/fd/%d" % reader) == content
    finally:
        os.close(reader)
