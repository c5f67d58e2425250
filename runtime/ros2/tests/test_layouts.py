"""The layouts and the codec, checked against the type stores and the codec of `rosbags`."""

import json
import subprocess

import numpy as np
import pytest
from host import DRIVER
from rosbags.typesys import Stores, get_typestore

DISTRIBUTIONS = {"humble": Stores.ROS2_HUMBLE, "iron": Stores.ROS2_IRON, "jazzy": Stores.ROS2_JAZZY,
                 "kilted": getattr(Stores, "ROS2_KILTED", None), "lyrical": getattr(Stores, "ROS2_LYRICAL", None)}
# Type stores of rosbags call these fields as Python may.
PASCAL = {"D": "d", "K": "k", "R": "r", "P": "p"}


def value(store, name, depth):
    """A message with values that are not zero, as JSON and as rosbags has it."""
    made, plain = {}, {}
    for field, (kind, detail) in store.fielddefs[name][1]:
        own = field
        if kind.name == "BASE":
            made[own] = plain[own] = scalar(detail[0], depth)
        elif kind.name == "NAME":
            made[own], plain[own] = value(store, detail, depth + 1)
        else:
            (inner, what), count = detail[0], detail[1] if kind.name == "ARRAY" else 2
            if inner.name == "BASE":
                plain[own] = [scalar(what[0], depth + at) for at in range(count)]
                made[own] = plain[own] if what[0] in ("string", "bool") else np.array(plain[own], dtype=what[0].replace("octet", "uint8"))
            else:
                pairs = [value(store, what, depth + at) for at in range(count)]
                made[own], plain[own] = [pair[0] for pair in pairs], [pair[1] for pair in pairs]
    return store.types[name](**made), plain


def scalar(kind, depth):
    if kind == "string":
        return "ab" * (depth + 1)
    if kind == "bool":
        return depth % 2 == 0
    return 0.5 + depth if kind.startswith("float") else 3 + depth


@pytest.mark.parametrize("distribution", DISTRIBUTIONS)
def test_messages_are_those_of_rosbags(distribution):
    if DISTRIBUTIONS[distribution] is None:
        pytest.skip("rosbags has no type store of " + distribution)
    store = get_typestore(DISTRIBUTIONS[distribution])
    listed = subprocess.run([DRIVER, "layouts", "--distribution", distribution], capture_output=True, text=True, check=True)
    names = [line.split()[1] for line in listed.stdout.splitlines() if line.startswith("message")]
    checked = []
    for name in names:
        full = name.replace("/", "/msg/")
        if full not in store.types or name == "std_msgs/Empty":
            continue
        message, plain = value(store, full, 0)
        expected = bytes(store.serialize_cdr(message, full))[4:]
        done = subprocess.run([DRIVER, "layouts", "--distribution", distribution, "--encode", name, "--json", json.dumps(plain)],
                              capture_output=True, text=True)
        assert done.returncode == 0, (name, done.stderr)
        found = bytes.fromhex(done.stdout.strip())
        assert found == expected[:len(found)] and not any(expected[len(found):]), name
        checked.append(name)
    print("%s: %d of %d messages are in the type store of rosbags" % (distribution, len(checked), len(names)))
    assert len(checked) >= 25, checked
