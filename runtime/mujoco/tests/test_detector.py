"""What pixels tell: things by colour, size and shape, with the ids of what is known."""

import numpy as np
import pytest
from host import placed
from motet_mujoco import detector
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.camera import Camera, NoGraphics
from motet_mujoco.eyes import Eyes
from motet_mujoco.model import load
from motet_mujoco.world import World


@pytest.fixture(scope="module")
def kitchen(motet):
    """The robot before the table, the head bent."""
    world = World(load("hsr", "kitchen", motet))
    world.step(placed(world, [0.9, 0.4]))
    beliefs = Beliefs(world)
    eyes = Eyes(world, beliefs)
    try:
        eyes.look()
    except NoGraphics as error:
        pytest.skip(str(error))
    yield eyes
    eyes.close()


def test_things_on_the_table_are_found_by_pixels(kitchen):
    found = {one["id"]: one for one in kitchen.detections()}
    assert {"mug_1", "apple", "glass_1"} <= set(found)
    for thing in ("mug_1", "apple", "glass_1"):
        off = np.array(found[thing]["pose"]["xyz"]) - kitchen.world.pose(thing)[0]
        assert np.linalg.norm(off) < 0.01, (thing, off)
    assert "bottle" not in found, "it stands behind the robot"


def test_a_thing_that_was_moved_is_seen_where_it_is(kitchen):
    world = kitchen.world
    place = world.pose("mug_1")[0] + [0.0, -0.15, 0.0]
    world.place("mug_1", place)
    world.wait(0.5)
    kitchen.detections()
    believed = np.array(kitchen.beliefs.entities["mug_1"]["pose"]["xyz"])
    assert np.linalg.norm(believed - place) < 0.05


def test_an_unknown_thing_has_no_id(kitchen):
    kitchen.beliefs.entities["apple"]["pose"]["xyz"] = [5.0, 5.0, 0.7]
    kitchen.world.wait(0.1)
    new = [one for one in kitchen.detections() if one["id"] is None]
    assert any("green" in one["label"] for one in new), new


def test_news_are_told_once(kitchen):
    """What stands where the host was told is no news, and what was moved is, once."""
    kitchen.at, kitchen.told = -1.0, {}
    first = {one["id"] for one in kitchen.news()}
    assert "mug_1" in first and "glass_1" not in first
    assert kitchen.news() == []


def test_pictures_survive_the_wire(kitchen):
    picture = kitchen.look()
    again = detector.unpack(picture.message())
    assert np.array_equal(again.colour, picture.colour)
    assert np.abs(again.depth - picture.depth).max() < 0.001
    assert np.allclose(again.rotation, picture.rotation, atol=1e-6)


@pytest.mark.parametrize("colour, name", [((190, 30, 35), "red"), ((70, 10, 12), "red"), ((230, 210, 60), "yellow"),
                                          ((128, 130, 131), "grey"), ((20, 20, 22), "black"), ((250, 250, 249), "white")])
def test_colours_have_names(colour, name):
    assert detector.colour_name(colour) == name


def test_the_camera_has_no_window(kitchen):
    assert isinstance(kitchen.camera, Camera)


def test_parts_of_a_thing_are_no_new_things(motet):
    """A bottle stands before the magazine and divides it in the picture."""
    world = World(load("hsr", "living_room", motet))
    target = world.target.copy()
    target[:3] = [0.6324, 0.5059, 0.6747]
    world.data.qpos[world.model.control_qpos] = target
    world.step(target)
    eyes = Eyes(world, Beliefs(world))
    try:
        found = eyes.detections()
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        eyes.close()
    assert "magazine" in {one["id"] for one in found}
    assert not [one for one in found if one["id"] is None and one["confidence"] > 0.5], found


def test_a_side_of_a_large_thing_tells_where_all_of_it_is(motet):
    """From the start the camera at the wrist sees the near side of the vise, 13 cm before its middle."""
    world = World(load("anymal_z1", "lab", motet))
    eyes = Eyes(world, Beliefs(world))
    try:
        found = {one["id"]: one for one in eyes.detections()}
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        eyes.close()
    assert np.linalg.norm(np.array(found["vise"]["pose"]["xyz"]) - world.pose("vise")[0]) < 0.05


def test_a_book_on_a_notebook_of_its_colour_is_seen_as_both(motet):
    world = World(load("hsr", "lab", motet))
    world.step(placed(world, [0.2, -1.2, -np.pi / 2.0]))
    eyes = Eyes(world, Beliefs(world))
    try:
        both = {one["id"]: np.array(one["pose"]["xyz"]) for one in eyes.detections()}
        for thing in ("notebook", "book"):
            assert np.linalg.norm(both[thing] - world.pose(thing)[0]) < 0.02, (thing, both[thing])
        # The book alone is no pile.
        world.place("notebook", np.array([4.0, 4.0, 0.05]))
        world.wait(0.5)
        alone = {one["id"] for one in eyes.detections()}
        assert "book" in alone and "notebook" not in alone, alone
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        eyes.close()


def seen_as(eyes, *found):
    """Ids that detections get: (label, place, size)."""
    ones = [{"id": None, "label": label, "extent": list(size), "confidence": 0.9,
             "pose": {"xyz": [float(part) for part in place], "quaternion": [0.0, 0.0, 0.0, 1.0]}}
            for label, place, size in found]
    eyes.assign(ones)
    return [one["id"] for one in ones]


def test_the_best_fit_of_all_comes_first(kitchen):
    """What is found first may be a piece of something else that stands near."""
    mug = np.array(kitchen.beliefs.entities["mug_1"]["pose"]["xyz"])
    piece = ("red box", mug + [0.2, 0.05, -0.03], (0.05, 0.05, 0.04))
    whole = ("red cylinder", mug, (0.08, 0.08, 0.1))
    assert seen_as(kitchen, piece, whole)[1] == "mug_1"
    assert seen_as(kitchen, whole, piece)[0] == "mug_1"


def test_a_lost_thing_that_is_still_there_is_no_other_one(kitchen):
    """A hand that closed beside a thing may have pushed it a little. What stands near has no colour in its name."""
    beliefs = kitchen.beliefs
    apple, glass = (np.array(beliefs.entities[one]["pose"]["xyz"]) for one in ("apple", "glass_1"))
    beliefs.saw("glass_1", apple + [0.0, 0.25, 0.0])
    beliefs.forget("apple")
    assert seen_as(kitchen, ("green sphere", apple + [0.05, 0.0, -0.02], (0.07, 0.07, 0.06))) == ["apple"]
    beliefs.told("apple", {"on": "kitchen_table"}, apple)
    beliefs.saw("glass_1", glass)


def test_what_the_hand_holds_is_no_other_thing(kitchen, monkeypatch):
    beliefs = kitchen.beliefs
    mug = np.array(beliefs.entities["mug_1"]["pose"]["xyz"])
    monkeypatch.setattr(beliefs, "in_hand", lambda: ["bottle"])
    bottle = beliefs.entities["bottle"]["pose"]["xyz"]
    beliefs.saw("bottle", mug + [0.2, 0.0, 0.0])
    part = ("red cylinder", mug + [0.2, 0.0, 0.05], (0.07, 0.07, 0.08))
    assert "mug_1" not in seen_as(kitchen, part)
    assert seen_as(kitchen, ("red cylinder", mug, (0.08, 0.08, 0.1))) == ["mug_1"]
    beliefs.saw("bottle", np.array(bottle))


def test_a_place_that_was_not_measured_has_no_error(kitchen):
    """Else it would move on with each look at a part of a thing."""
    mug = kitchen.beliefs.entities["mug_1"]["pose"]["xyz"]
    kitchen.rates = {"error_per_m": 0.05, "miss": 0.0, "confuse": 0.0}
    try:
        part = {"id": "mug_1", "label": "red mug", "extent": [0.03, 0.02, 0.03], "confidence": 0.9,
                "pose": {"xyz": list(mug), "quaternion": [0.0, 0.0, 0.0, 1.0]}}
        part["pose"]["xyz"] = kitchen.middle(part)
        assert kitchen.erred([part])[0]["pose"]["xyz"] == pytest.approx(mug, abs=1e-4)
    finally:
        kitchen.rates = {"error_per_m": 0.0, "miss": 0.0, "confuse": 0.0}


def test_a_picture_is_taken_anew_only_where_it_may_show_something_else(kitchen, monkeypatch):
    world, taken, look = kitchen.world, [], kitchen.camera.look
    monkeypatch.setattr(kitchen.camera, "look", lambda name: taken.append(name) or look(name))
    world.wait(0.5)
    kitchen.detections()
    first, taken[:] = [one["id"] for one in kitchen.last], []
    world.step()
    assert [one["id"] for one in kitchen.detections()] == first and not taken
    # What is believed may change the ids.
    kitchen.beliefs.forget("mug_1")
    kitchen.at = -1.0
    assert "mug_1" in {one["id"] for one in kitchen.detections()} and not taken
    world.place("mug_1", world.pose("mug_1")[0] + [0.0, 0.01, 0.0])
    world.step()
    kitchen.detections()
    assert taken


def test_components_are_cut_where_depth_or_colour_jumps():
    """A snake of pixels is one part, however long; a jump of the depth or of the hue makes two."""
    mask = np.zeros((9, 9), dtype=bool)
    mask[::2] = True
    mask[1::4, -1] = mask[3::4, 0] = True
    depth, colour = np.ones(mask.shape), np.zeros((9, 9, 3), dtype=np.uint8)
    colour[...] = (200, 38, 38)
    labels = detector.components(mask, depth, colour)
    assert labels.max() == 1 and np.array_equal(labels > 0, mask)
    depth[6:] += 0.1
    assert detector.components(mask, depth, colour).max() == 2
    colour[:2] = (40, 84, 190)
    labels = detector.components(mask, depth, colour)
    assert labels.max() == 3 and labels[0, 0] == 1 and labels[8, 8] == 3
