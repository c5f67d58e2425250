"""What the robot holds to be true: the room that it was told of, words of the host, and pixels."""

import json

import pytest
from host import Host, entity, text
from motet_mujoco.beliefs import Beliefs
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
