"""What the robot holds to be true: the room that it was told of, words of the host, and pixels."""

import json

import numpy as np
import pytest
from host import Host, entity, text
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.camera import NoGraphics
from motet_mujoco.driver import Driver, Options
from motet_mujoco.judge import SCENES, carry_out, close, follow, verdicts
from motet_mujoco.model import load
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


def test_what_pixels_do_not_find_is_not_found(drive, room):
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
    driver = Driver(load("hsr", "kitchen", motet), motet, Options())
    try:
        driver.eyes.look()
    except NoGraphics as error:
        pytest.skip(str(error))
    yield driver
    driver.eyes.close()


def truths(driver, fluent, *args):
    """A fact as the robot knows it, and by the truth of the world."""
    query = {"fact": {"fluent": fluent, "args": [{"is": {"entity": one}} for one in args]}}
    return driver.observe({"query": query})["answer"], driver.truth({"query": query})["answer"]


def stand(driver, x, y, yaw=0.0, tilt=-0.5):
    """Puts the robot somewhere, its head bent."""
    world = driver.world
    target = world.target.copy()
    target[:3] = [x, y, yaw]
    target[world.model.controls["head_tilt_joint"]] = tilt
    world.data.qpos[world.model.control_qpos] = target
    driver.tasks.goal[:] = target
    for _ in range(5):
        driver.tick()


def test_what_is_moved_behind_the_robot_is_not_known(behind):
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


def test_what_the_fingers_lose_is_noticed_by_their_joints(behind, motet):
    """The hand is told nothing of contacts: its fingers close on nothing."""
    world, yes, no = behind.world, {"truth": True}, {"truth": False}
    [(_, witness)] = verdicts(motet, "hsr", "kitchen", "reach(mug_1)")
    follow(world, world.targets(witness["path"]), 1.0)
    close(world)
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


def test_a_placement_that_is_interrupted_after_the_release_is_known(behind):
    """The robot felt where it let the mug go, whatever becomes of its way back."""

    def start(goal, primitive, **args):
        args = [(key, {"entity": one}) for key, one in args.items()]
        behind.start({"goal": goal, "command": {"primitive": primitive, "args": args}})

    def carry_out(goal, primitive, **args):
        start(goal, primitive, **args)
        while behind.goals[goal].state == "running":
            behind.tick()
        assert behind.goals[goal].state == {"ended": {"success": None}}, behind.goals[goal].state

    carry_out(1, "go", to="kitchen_table")
    carry_out(2, "pick", object="mug_1")
    start(3, "place", object="mug_1", on="kitchen_table")
    while behind.beliefs.hand == "mug_1":
        behind.tick()
    for _ in range(250):
        behind.tick()
    assert behind.goals[3].state == "running"
    behind.cancel({"goal": 3})
    assert truths(behind, "on", "mug_1", "kitchen_table") == ({"truth": True}, {"truth": True})
    assert truths(behind, "holding", "mug_1") == ({"truth": False}, {"truth": False})
    off = np.array(behind.beliefs.entities["mug_1"]["pose"]["xyz"]) - behind.world.pose("mug_1")[0]
    assert np.linalg.norm(off) < 0.03


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
