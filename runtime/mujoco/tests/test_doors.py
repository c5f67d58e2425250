"""How far pixels show a drawer or a door to be open."""

import numpy as np
import pytest
from host import placed
from motet_mujoco.beliefs import Beliefs
from motet_mujoco.camera import NoGraphics
from motet_mujoco.eyes import Eyes
from motet_mujoco.model import load
from motet_mujoco.world import World


@pytest.mark.parametrize("share", [0.0, 0.75, 0.97])
def test_a_door_is_seen_to_be_as_far_open_as_it_is(motet, share):
    """Else the rim of the leaf stands out beside its place, and is taken for a thing."""
    world = World(load("hsr", "kitchen", motet))
    joint, opened, _ = world.model.doors["fridge_1"]
    world.data.qpos[joint] = share * opened
    world.step(placed(world, [-0.3, -0.7, -np.pi / 2.0], -0.3))
    beliefs = Beliefs(world)
    eyes = Eyes(world, beliefs)
    try:
        found = eyes.detections()
        seen = eyes.opening("fridge_1")
    except NoGraphics as error:
        pytest.skip(str(error))
    finally:
        eyes.close()
    assert abs(seen - world.opening("fridge_1")) < 0.01
    assert not [one for one in found if one["id"] is None], found
    assert beliefs.entities["fridge_1"]["open"] is (share > 0.6)
