"""Profiles and draws: the files of the kinematic world, their limits, and rates that come as often as they say."""

import numpy as np
import pytest
from motet_mujoco.chance import Chance, profile
from motet_mujoco.disorder import displace
from motet_mujoco.model import ModelError, load
from motet_mujoco.world import World


def test_profiles_are_those_of_the_kinematic_world():
    ideal, typical, harsh = (profile(name) for name in ("ideal", "typical", "harsh"))
    assert not any(value for table in ideal.values() for value in table.values())
    assert 0.0 < typical["hand"]["error_m"] < harsh["hand"]["error_m"]


@pytest.mark.parametrize("text, why", [("[hand]\nslip = 1.5", "not between"), ("[hand]\nslipp = 0.1", "slipp"),
                                       ("[feet]\nx = 1", "feet"), ("[hand", "cannot be read"),
                                       ("[hand]\nslip = true", "True"), ("hand = 3", "hand")])
def test_a_wrong_profile_is_an_error(tmp_path, text, why):
    path = tmp_path / "odd.toml"
    path.write_text(text)
    with pytest.raises(ModelError, match=why):
        profile(str(path))


def test_no_profile_is_an_error():
    with pytest.raises(ModelError, match="typical"):
        profile("perfect")


def test_draws_come_as_often_as_they_say():
    chance, comes, errors = Chance(7), 0, []
    for _ in range(4000):
        chance.next()
        comes += chance.comes(0.05, "slip", "mug_1")
        errors.append(chance.error(0.01, "hand"))
    assert 150 < comes < 250
    assert np.linalg.norm(errors, axis=1).max() <= 0.02 + 1e-12
    assert Chance(3).random("slip").random() == Chance(3).random("slip").random()
    assert Chance(3).random("slip").random() != Chance(3).random("drop").random()


def test_things_stand_elsewhere_on_what_bears_them(motet):
    world = World(load("hsr", "kitchen", motet))
    before = {thing: world.pose(thing)[0] for thing in world.model.free}
    displace(world, {"shift_m": 0.03, "misplaced": 0.0}, Chance(1))
    moved = {thing: float(np.linalg.norm(world.pose(thing)[0] - at)) for thing, at in before.items()}
    assert 0.0 < max(moved.values()) < 0.0601
    displace(world, {"shift_m": 0.0, "misplaced": 1.0}, Chance(1))
    world.wait(1.0)
    on = {thing: world.bearers(thing) for thing in before}
    elsewhere = [thing for thing, entity in world.model.entities.items()
                 if thing in before and "on" in entity and entity["on"] not in on[thing]]
    assert elsewhere and not any("floor" in bearers for bearers in on.values()), on
