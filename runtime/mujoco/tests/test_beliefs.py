"""What the robot holds to be true: the room that it was told of, words of the host, and pixels."""

import json
import sys

import numpy as np
import pytest
from host import Host, entity, fact, placed, text
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.camera import NoGraphics
from motet_mujoco.driver import Driver, Options
from motet_mujoco.judge import carry_out, follow
from motet_mujoco.model import load
from motet_mujoco.verdicts import SCENES, verdicts
from motet_mujoco.world import World


@pytest.fixture
def room(motet, tmp_path):
    """Writes the kitchen with changes of its things; the path of the file."""

    def write(**changes):
        model = load("hsr", "kitchen", motet)
        for thing, change in changes.items():
            model.entities[thing].update(change)
        path = tmp_path / ("room-%d.json" % len(list(tmp_path.iterdir())))
        scene = {key: value for key, value in model.scene.items() if key != "robot"}
        path.write_text(json.dumps({**scene, "robot": model.scene["robot"]}))
        return str(path)

    return write


@pytest.fixture
def drive(motet):
    """Starts drivers that see by pixels, and ends them."""
    hosts = []

    def start(robot, scene, *flags):
        hosts.append(Host(robot, scene, "--motet", motet, *flags))
        if "error" in hosts[-1].call("look"):
            pytest.skip("no picture can be rendered")
        return hosts[-1]

    yield start
    for host in hosts:
        host.process.kill()


def test_inspect_does_not_find_a_thing_that_pixels_do_not_show(drive, room):
    # In the picture the mug is red.
    host = drive("hsr", "kitchen", "--told", room(mug_1={"names": ["blue mug"]}))
    host.carry_out("go", to=entity("kitchen_table"))
    assert host.carry_out("inspect", what=entity("mug_1"))["failure"]["kind"] == "not_found"
    assert host.carry_out("inspect", what=entity("apple")) == {"success": None}
    assert host.carry_out("inspect", what=entity("kitchen_table")) == {"success": None}
    assert host.carry_out("inspect", what=entity("fridge_1"))["failure"]["kind"] == "not_found", "it is behind the robot"


def test_a_thing_elsewhere_than_told_is_found_once_the_host_says_where(drive, room):
    told = room(mug_1={"pose": {"xyz": [0.9, -2.0, 0.955], "rpy": [0.0, 0.0, 0.0]}, "on": "counter"})
    host = drive("hsr", "kitchen", "--told", told)
    assert host.welcome["capabilities"]["told"] is True
    assert host.call("told", thing={"id": "mug_1", "support": {"on": "kitchen_table"}}) == {}
    host.carry_out("go", to=entity("kitchen_table"))
    assert host.carry_out("detect", what=text("red mug")) == {"success": {"entity": "mug_1"}}
    assert host.carry_out("pick", object=entity("mug_1")) == {"success": None}
    assert host.holds("holding", "mug_1")


@pytest.mark.parametrize("thing, container, height",
                         [("mug_1", "fridge_1", 0.06), ("coke", "cupboard_1", 0.071), ("mug_1", "drawer_1", 0.61)])
def test_a_thing_that_the_host_tells_to_be_in_a_container_is_found_in_it(drive, room, motet, thing, container, height):
    """The opened door hides it from where the robot stands then, and must not be taken for a closed one from nearby.
    On the way out of the drawer it must not meet the rim."""
    x, y, _ = load("hsr", "kitchen", motet).entities[container]["pose"]["xyz"]
    real = room(**{thing: {"pose": {"xyz": [x, y, height], "rpy": [0.0, 0.0, 0.0]}, "on": None, "in": container}})
    host = drive("hsr", real, "--told", room())
    host.call("told", thing={"id": thing, "support": {"in": container}})
    host.carry_out("go", to=entity(container))
    assert host.carry_out("open", what=entity(container)) == {"success": None}
    assert host.holds("at", "robot", container), "it stands before it again"
    assert host.carry_out("inspect", what=entity(thing)) == {"success": None}
    assert host.holds("open", container)
    assert host.carry_out("pick", object=entity(thing)) == {"success": None}


def test_a_drive_to_a_thing_that_is_missed_leads_to_where_it_was(drive, room):
    real = room(mug_1={"pose": {"xyz": [-0.5, -2.2, 0.06], "rpy": [0.0, 0.0, 0.0]}, "on": None, "in": "fridge_1"})
    host = drive("hsr", real, "--told", room())
    host.carry_out("go", to=entity("kitchen_table"))
    assert host.carry_out("inspect", what=entity("mug_1"))["failure"]["kind"] == "not_found"
    host.carry_out("go", to=entity("user"))
    assert host.carry_out("go", to=entity("mug_1")) == {"success": None}
    assert host.holds("at", "robot", "kitchen_table")


def test_any_program_can_be_the_detector(drive, tmp_path):
    program = tmp_path / "detector.py"
    program.write_text('''
import json, sys
for line in sys.stdin:
    pose = {"xyz": [1.8, 0.3, 0.8], "quaternion": [0.0, 0.0, 0.0, 1.0]}
    one = {"label": "teapot", "id": None, "pose": pose, "extent": [0.1, 0.1, 0.1], "confidence": 0.8}
    print(json.dumps({"detections": [one]}), flush=True)
''')
    host = drive("hsr", "kitchen", "--detector", "'%s' '%s'" % (sys.executable, program))
    assert [one["label"] for one in host.call("detections")["detections"]] == ["teapot"]


def test_a_hand_over_leaves_nothing_unknown(drive):
    host = drive("hsr", "kitchen")
    host.carry_out("go", to=entity("kitchen_table"))
    assert host.carry_out("pick", object=entity("mug_1")) == {"success": None}
    host.carry_out("go", to=entity("user"))
    assert host.carry_out("handover", object=entity("mug_1"), to=entity("user")) == {"success": None}
    seen = [each for one in host.reports if one["method"] == "detected" for each in one["params"]["detections"]]
    assert not [one for one in seen if one["id"] is None and one["label"].startswith("red")]


def test_a_drawer_is_seen_to_be_open(drive):
    host = drive("hsr", "kitchen")
    host.carry_out("go", to=entity("drawer_1"))
    assert host.carry_out("inspect", what=entity("drawer_1")) == {"success": None}
    assert host.carry_out("open", what=entity("drawer_1")) == {"success": None}
    assert host.carry_out("inspect", what=entity("drawer_1")) == {"success": None}


def test_an_open_drawer_is_seen_by_its_leaf(drive):
    """The camera at the wrist is so near that it sees no more than the drawer that stands open."""
    host = drive("anymal_z1", "lab")
    host.carry_out("wake_up")
    host.carry_out("go", to=entity("drawer_1"))
    host.carry_out("start_pose")
    assert host.carry_out("inspect", what=entity("drawer_1")) == {"success": None}


def test_words_about_a_thing_replace_what_was_known(motet):
    beliefs = Beliefs(World(load("hsr", "kitchen", motet)))
    beliefs.told("mug_1", {"in": "fridge_1"})
    known = beliefs.entities["mug_1"]
    assert known["in"] == "fridge_1" and "on" not in known and "pose" not in known
    beliefs.told("mug_1", None, [1.0, 2.0, 0.5])
    assert known["pose"]["xyz"] == [1.0, 2.0, 0.5]
    beliefs.told("no_such_thing", {"on": "counter"})
    beliefs.told("kitchen_table", {"on": "counter"})
    assert "pose" in beliefs.entities["kitchen_table"]


def test_a_field_that_the_scene_leaves_out_follows_from_the_shape(motet):
    from motet_mujoco.observation import Observer

    observer = Observer(World(load("hsr", "kitchen", motet)))
    query = {"field": {"entity": "mug_1", "field": "width"}}
    assert observer.answer(query) == {"value": {"number": pytest.approx(0.08)}}


@pytest.fixture
def behind(motet):
    """A driver in the same process whose robot sees by pixels, before the kitchen table."""
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(), judged=True)
    try:
        driver.eyes.look()
    except NoGraphics as error:
        pytest.skip(str(error))
    yield driver
    driver.eyes.close()


def start(driver, goal, primitive, **args):
    """Starts a primitive of a driver in the same process."""
    args = [(key, {"entity": one}) for key, one in args.items()]
    driver.start({"goal": goal, "command": {"primitive": primitive, "args": args}})


def carry_out_by(driver, goal, primitive, **args):
    """Carries a primitive out."""
    start(driver, goal, primitive, **args)
    while driver.goals[goal].state == "running":
        driver.tick()
    assert driver.goals[goal].state == {"ended": {"success": None}}, driver.goals[goal].state


def truths(driver, fluent, *args):
    """A fact as the robot knows it, and by the truth of the world."""
    query = {"fact": {"fluent": fluent, "args": [{"is": {"entity": one}} for one in args]}}
    return driver.observe({"query": query})["answer"], driver.truth({"query": query})["answer"]


def stand(driver, x, y, yaw=0.0, tilt=-0.5):
    """Puts the robot somewhere, its head bent."""
    driver.tasks.goal[:] = placed(driver.world, [x, y, yaw], tilt)
    for _ in range(5):
        driver.tick()


def test_beliefs_do_not_change_behind_the_robot(behind):
    world = behind.world
    stand(behind, 0.9, 0.4, np.pi)
    yes, no = {"truth": True}, {"truth": False}
    world.place("mug_1", np.array([1.6, -2.2, 0.96]))
    world.wait(0.5)
    assert truths(behind, "on", "mug_1", "kitchen_table") == (yes, no)
    assert truths(behind, "on", "mug_1", "counter") == (no, yes)
    # It turns round, and sees that the mug is gone: nobody knows where it is.
    stand(behind, 0.9, 0.4)
    assert truths(behind, "on", "mug_1", "kitchen_table") == (no, no)
    assert truths(behind, "on", "mug_1", "counter") == ("unknown", yes)
    assert truths(behind, "visible", "mug_1")[0] == no
    # From before the counter it sees the mug.
    stand(behind, 1.5, -1.2, -np.pi / 2.0)
    assert truths(behind, "on", "mug_1", "counter") == (yes, yes)


def test_a_drawer_that_is_opened_behind_the_robot_is_closed_until_it_looks(behind):
    world, yes, no = behind.world, {"truth": True}, {"truth": False}
    stand(behind, 0.9, 0.4)
    joint, opened, _ = world.model.doors["drawer_1"]
    world.data.qpos[joint] = opened
    world.wait(0.2)
    assert truths(behind, "open", "drawer_1") == (no, yes)
    stand(behind, 2.0, -1.7)
    assert truths(behind, "open", "drawer_1") == (yes, yes)


def test_finger_joints_notice_a_lost_thing(behind, motet):
    """The hand is told nothing of contacts: its fingers close on nothing."""
    world, yes, no = behind.world, {"truth": True}, {"truth": False}
    [(_, witness)] = verdicts(motet, "hsr", "kitchen", "reach(mug_1)")
    follow(world, world.targets(witness["path"]), 1.0)
    world.move_fingers(True, 1.0)
    behind.tasks.goal[:] = world.target
    behind.beliefs.holds("mug_1")
    assert truths(behind, "holding", "mug_1") == (yes, yes)
    query = {"fact": {"fluent": "free", "args": [{"is": {"case": "hand"}}]}}
    assert behind.observe({"query": query})["answer"] == no
    world.place("mug_1", np.array([1.6, -2.2, 0.96]))
    for _ in range(250):
        behind.tick()
    assert truths(behind, "holding", "mug_1") == (no, no)
    assert truths(behind, "on", "mug_1", "counter")[0] == "unknown"


def place_and_let_go(behind, ticks):
    """Places the mug on the table, as goal 3, until so many ticks after the hand has let it go."""
    carry_out_by(behind, 1, "go", to="kitchen_table")
    carry_out_by(behind, 2, "pick", object="mug_1")
    start(behind, 3, "place", object="mug_1", on="kitchen_table")
    while behind.beliefs.hand == "mug_1":
        behind.tick()
    for _ in range(ticks):
        behind.tick()


def test_a_placement_that_is_interrupted_after_the_release_is_known(behind):
    """The robot felt where it let the mug go, whatever becomes of its way back."""

    place_and_let_go(behind, 250)
    assert behind.goals[3].state == "running"
    behind.cancel({"goal": 3})
    assert truths(behind, "on", "mug_1", "kitchen_table") == ({"truth": True}, {"truth": True})
    assert truths(behind, "holding", "mug_1") == ({"truth": False}, {"truth": False})
    off = np.array(behind.beliefs.entities["mug_1"]["pose"]["xyz"]) - behind.world.pose("mug_1")[0]
    assert np.linalg.norm(off) < 0.03


def test_the_truth_is_for_judges_alone(behind):
    query = fact("holding", "mug_1")["query"]
    assert behind.truth({"query": query})["answer"] == {"truth": False}
    behind.judged = False
    said = []
    behind.say = said.append
    behind.take(json.dumps({"id": 1, "method": "truth", "params": {"query": query}}))
    assert "--oracle" in said[0]["error"]["message"]


def test_beliefs_are_not_read_off_the_world(behind, monkeypatch):
    """What is in its hand it knows by its fingers and by where it closed them, and doors by pixels."""
    carry_out_by(behind, 1, "go", to="kitchen_table")
    carry_out_by(behind, 2, "pick", object="mug_1")
    world = behind.world
    place = world.pose("mug_1")[0]

    def truth(*_):
        raise AssertionError("the robot cannot know this")

    for name in ("held", "holds", "is_open", "is_on", "is_in", "bearers", "supports", "opening"):
        monkeypatch.setattr(world, name, truth)
    behind.eyes.at = behind.looked_at = -1.0
    behind.eyes.refresh()
    assert behind.observe({"query": fact("holding", "mug_1")["query"]})["answer"] == {"truth": True}
    assert behind.observe({"query": fact("open", "drawer_1")["query"]})["answer"] == {"truth": False}
    scene = behind.beliefs.now()
    assert scene["robot"]["holding"] == "mug_1"
    assert np.linalg.norm(behind.beliefs.held_pose("mug_1")[0] - place) < 0.03
    # What slips within the fingers is not felt.
    at = world.model.free["mug_1"][0]
    world.data.qpos[at + 2] -= 0.02
    world.refresh()
    assert np.allclose(behind.beliefs.now()["robot"]["grip"]["xyz"], scene["robot"]["grip"]["xyz"])


def test_primitives_succeed_by_what_the_robot_feels_and_sees(behind, monkeypatch):
    """No primitive is decided by the truth of the simulator, which a robot does not have."""

    def truth(*_):
        raise AssertionError("the robot cannot know this")

    for name in ("held", "holds", "is_touched", "bumped", "is_open", "is_locked", "is_on", "is_in", "bearers",
                 "supports", "opening", "is_lifted", "is_visible"):
        monkeypatch.setattr(behind.world, name, truth)
    place = behind.world.pose("mug_1")[0]
    carry_out_by(behind, 1, "go", to="kitchen_table")
    carry_out_by(behind, 2, "pick", object="mug_1")
    carry_out_by(behind, 3, "place", object="mug_1", on="kitchen_table")
    assert np.linalg.norm(behind.world.pose("mug_1")[0][2] - place[2]) < 0.01
    carry_out_by(behind, 4, "go", to="drawer_1")
    carry_out_by(behind, 5, "open", what="drawer_1")
    carry_out_by(behind, 6, "close", what="drawer_1")
    monkeypatch.undo()
    assert behind.world.is_on("mug_1", "kitchen_table") and behind.world.is_open("drawer_1") is False


def test_a_thing_that_falls_as_it_is_placed_is_seen_to_have(behind):
    place_and_let_go(behind, 100)
    behind.world.place("mug_1", np.array([0.0, -1.0, 0.06]))
    while behind.goals[3].state == "running":
        behind.tick()
    failure = behind.goals[3].state["ended"]["failure"]
    assert failure["kind"] == "slipped" and "does not rest on" in failure["text"]


@pytest.mark.parametrize("flags", [(), ("--oracle",)])
def test_a_lock_is_felt_as_a_handle_that_does_not_give_way(drive, room, flags):
    host = drive("hsr", room(drawer_1={"locked": True}), "--told", room(), *flags)
    host.carry_out("go", to=entity("drawer_1"))
    failure = host.carry_out("open", what=entity("drawer_1"))["failure"]
    assert failure == {"kind": "blocked", "text": "drawer_1 does not give way: it is locked"}
    assert host.holds("locked", "drawer_1") is True and host.holds("open", "drawer_1") is not True


def test_a_grip_is_told_and_a_run_begins_with_it(drive):
    host = drive("hsr", "kitchen")
    query = {"field": {"entity": "mug_1", "field": "grip"}}
    held = fact("holding", "mug_1")
    host.call("hello", protocol=2, run="first", resumed=False, robot="hsr", policy="test", primitives=[], state=[held])
    host.carry_out("start_pose")

    def told():
        answers = [one["params"]["answer"] for one in host.reports
                   if one["method"] == "observed" and one["params"]["query"] == query]
        return answers[-1]["value"]["pose"]

    usual = told()
    # Three centimetres higher in the hand.
    grip = {**usual, "xyz": [usual["xyz"][0] + 0.03, *usual["xyz"][1:]]}
    given = {"query": query, "holds": True, "value": {"pose": grip}}
    host.call("hello", protocol=2, run="second", resumed=False, robot="hsr", policy="test", primitives=[],
              state=[held, given])
    host.carry_out("start_pose")
    assert np.allclose(told()["xyz"], grip["xyz"], atol=0.012) and not np.allclose(told()["xyz"], usual["xyz"], atol=0.012)


def test_a_thing_that_the_host_names_appears_under_its_id(motet, room):
    model = load("hsr", "kitchen", motet)
    told = {**model.scene, "entities": [one for one in model.scene["entities"] if one["id"] != "mug_1"]}
    driver = Driver(model, motet, Options(), told=told)
    place = [float(part) for part in driver.world.pose("mug_1")[0]]
    query = fact("at", "red_cylinder_1", "kitchen_table")["query"]
    assert driver.observe({"query": query})["answer"] == "unknown", "it has never heard of it"
    driver.eyes.last = [{"id": None, "label": "red cylinder", "extent": [0.08, 0.08, 0.1], "confidence": 0.9,
                         "pose": {"xyz": place, "quaternion": [0.0, 0.0, 0.0, 1.0]}}]
    driver.told({"thing": {"id": "red_cylinder_1", "label": "red cylinder", "pose": {"xyz": place}}})
    assert driver.observe({"query": query})["answer"] == {"truth": True}
    carry_out_by(driver, 1, "go", to="kitchen_table")
    carry_out_by(driver, 2, "pick", object="red_cylinder_1")
    assert driver.observe({"query": fact("holding", "red_cylinder_1")["query"]})["answer"] == {"truth": True}
    assert driver.world.held() == ["mug_1"]
    driver.eyes.close()


def test_an_oracle_knows_what_is_behind_it(motet):
    driver = Driver(load("hsr", "kitchen", motet), motet, Options(), oracle=True)
    stand(driver, 0.9, 0.4, np.pi)
    driver.world.place("mug_1", np.array([1.6, -2.2, 0.96]))
    driver.world.wait(0.5)
    assert truths(driver, "on", "mug_1", "counter") == ({"truth": True}, {"truth": True})


@pytest.mark.parametrize("robot", ["hsr", "anymal_z1", "panda"])
def test_fingers_feel_thin_things(motet, robot):
    """What every hand of the scenes holds, the joints of its fingers feel; and nothing, where there is nothing."""
    scene = SCENES.get(robot, ["living_room"])[0]
    for query, witness in verdicts(motet, robot, scene):
        if not query.startswith("reach("):
            continue
        thing = query[6:-1].replace("`", "")
        world = World(load(robot, scene, motet))
        assert carry_out(world, query.replace("`", ""), witness)[0], query
        assert world.is_gripping(), query
        world.place(thing, np.array([0.0, 0.0, -5.0]))
        world.wait(0.5)
        assert not world.is_gripping(), query


def test_thing_dropped_into_a_bin_lies_in_it(motet):
    """The hand lets it go above the rim, and the camera does not show the bottom."""
    driver = Driver(load("hsr", "living_room", motet), motet, Options(), judged=True)
    try:
        driver.eyes.look()
        carry_out_by(driver, 1, "go", to="coffee_table")
        carry_out_by(driver, 2, "pick", object="remote_1")
        carry_out_by(driver, 3, "go", to="trash_bin")
        carry_out_by(driver, 4, "place", object="remote_1", on="trash_bin")
        assert truths(driver, "in", "remote_1", "trash_bin") == ({"truth": True}, {"truth": True})
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        driver.eyes.close()
