"""Verdicts of each robot borne out by physics: one grasp each, a drawer, a place."""

import json

import numpy as np
import pytest
from motet_mujoco import calibrate, judge
from motet_mujoco.model import load
from motet_mujoco.verdicts import SCENES, verdicts
from motet_mujoco.world import World

TABLE = SCENES["panda"][0]


@pytest.mark.parametrize("robot, scene, motion", [
    ("hsr", "kitchen", "reach(mug_1)"),
    ("anymal_z1", "lab", "reach(sample)"),
    ("panda", TABLE, "reach(book)"),
    ("hsr", "kitchen", "pull(drawer_1)"),
    ("hsr", "kitchen", "go_to(counter)"),
    ("hsr", "kitchen", "stand_at(pose(0.7 m, 1.8 m, 1 rad))"),
    ("hsr", "kitchen", "posture(home)"),
    ("hsr", "kitchen", "reach_at(mug_1, pose(1.98 m, 0.3 m, 0.79 m, 0 rad))"),
])
def test_a_verdict_holds(motet, robot, scene, motion):
    [(query, witness)] = verdicts(motet, robot, scene, motion)
    holds, why, error = judge.carry_out(World(load(robot, scene, motet)), query, witness)
    assert holds, why
    # A witness is followed within 3 mm and 2 mrad, along the whole path and at its end.
    assert np.all(error < [0.003, 0.002]), error
    assert np.all(error[0] >= error[1])


def test_a_grip_beside_the_thing_is_refuted(motet):
    """The judge can say no: with the thing elsewhere, there is nothing to hold."""
    [(query, witness)] = verdicts(motet, "hsr", "kitchen", "reach(mug_1)")
    world = World(load("hsr", "kitchen", motet))
    world.place("mug_1", world.pose("mug_1")[0] + [0.2, 0.0, 0.0])
    holds, why, _ = judge.carry_out(world, query, witness)
    assert not holds, why


def test_a_blocked_way_is_refuted(motet):
    """A person who stands in the way is touched."""
    [(query, witness)] = verdicts(motet, "hsr", "kitchen", "go_to(counter)")
    world = World(load("hsr", "kitchen", motet))
    middle = witness["path"][-1]["base"]
    world.data.mocap_pos[world.model.people["user"], :2] = middle[:2]
    holds, why, _ = judge.carry_out(world, query, witness)
    assert not holds and "user" in why


def test_trials_with_errors_have_seeds_and_intervals(motet, capsys):
    """Every verdict once for each seed, the same twice."""
    flags = ["--robot", "panda", "--kind", "reach", "--profile", "typical", "--seeds", "2", "--format", "json",
             "--motet", motet]
    assert judge.main(flags) == 0
    first = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    *trials, sums = first
    share = sums["shares"]["reach"]
    assert share["of"] == len(trials) == 2 * len({one["query"] for one in trials})
    low, high = share["interval"]
    assert 0.0 <= low < share["held"] / share["of"] <= high <= 1.0
    assert judge.main(flags) == 0
    again = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert again[:-1] == trials


def test_held_thing_is_carried(motet):
    """A drive with what a grasp holds drops nothing, and one with nothing has nothing to drop."""
    [(query, witness)] = verdicts(motet, "hsr", "kitchen", "reach(apple)")
    world = World(load("hsr", "kitchen", motet))
    assert judge.carry_out(world, query, witness)[0]
    assert calibrate.carried(world, "apple")
    world.move_fingers(False, 0.8)
    assert not calibrate.carried(world, "apple")


def test_trials_are_the_same_whatever_the_number_of_processes_and_shards(motet, capsys):
    def trials(*more):
        flags = ["--robot", "panda", "--kind", "reach", "--seeds", "2", "--profile", "typical", "--format", "json"]
        assert judge.main([*flags, "--motet", motet, *more]) == 0
        return [json.loads(line) for line in capsys.readouterr().out.splitlines()][:-1]

    all_of_them = trials()
    assert trials("-j", "3") == all_of_them
    assert [trials("--shard", "%d/2" % at) for at in (0, 1)] == [all_of_them[0::2], all_of_them[1::2]]
    for wrong in (["-j", "0"], ["--shard", "2/2"], ["--shard", "a"]):
        with pytest.raises(SystemExit):
            judge.main(["--robot", "panda", *wrong])


def test_thing_held_at_the_start_is_put_down(motet, capsys):
    """The fingers press on a thing all the way, also where a witness says how far apart they are."""
    assert judge.main(["--robot", "panda", "--kind", "put", "--format", "json", "--motet", motet]) == 0
    share = json.loads(capsys.readouterr().out.splitlines()[-1])["shares"]["put"]
    assert share["held"] == share["of"] > 10


def test_verdicts_about_people_and_cameras_hold(motet, capsys):
    flags = ["--kind", "look", "--kind", "posture", "--kind", "offer", "--format", "json", "--motet", motet]
    assert judge.main(["--robot", "hsr", "--scene", "living_room", *flags]) == 0
    shares = json.loads(capsys.readouterr().out.splitlines()[-1])["shares"]
    assert set(shares) == {"look", "posture", "offer"}
    for share in shares.values():
        assert share["held"] == share["of"] > 0


def test_motions_begin_with_a_door_open_and_with_a_thing_in_the_hand(motet, capsys):
    flags = ["--begin", "open", "--begin", "holding", "--kind", "push", "--kind", "posture", "--format", "json"]
    assert judge.main(["--robot", "hsr", "--scene", "kitchen", *flags, "--motet", motet]) == 0
    *trials, sums = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert all(one["holds"] for one in trials), trials
    assert {one["scene"].partition(", ")[2].partition(" ")[0] for one in trials} >= {"holding"}
    assert sums["shares"]["push"]["of"] > 0


def test_a_camera_that_points_elsewhere_refutes_a_look(motet):
    [(query, witness)] = verdicts(motet, "hsr", "kitchen", "look(mug_1)")
    world = World(load("hsr", "kitchen", motet))
    for point in witness["path"]:
        point["joints"]["head_pan_joint"] = 1.5
    holds, why, _ = judge.carry_out(world, query, witness)
    assert not holds and why == "out of view"


@pytest.mark.parametrize(("thing", "other", "are_alike"), [
    ("mug_1", "mug_2", True), ("mug_1", "glass_1", True), ("apple", "sponge", False), ("mug_1", "mug_1", False),
    ("mug_1", None, False),
])
def test_things_that_a_look_may_confuse(motet, thing, other, are_alike):
    entities = load("hsr", "kitchen", motet).entities
    assert calibrate.alike(entities, thing, other) is are_alike
