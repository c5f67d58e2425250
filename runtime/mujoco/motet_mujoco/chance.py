"""Chance: the rates of a profile, and seeded draws that depend on what they are for and on nothing else."""

import hashlib
import os
import tomllib

import numpy as np

from .model import ModelError

# The profiles of the kinematic world, which lie beside it in the sources and in this package once it is installed.
PROFILES = os.path.join(os.path.dirname(__file__), "profiles")
# Greatest number of each key, by its table.
KEYS = {
    "room": {"shift_m": 0.5, "misplaced": 1.0},
    "base": {"error_m": 0.5},
    "camera": {"error_per_m": 0.5, "miss": 1.0, "confuse": 1.0},
    "hand": {"error_m": 0.5, "slip": 1.0, "drop": 1.0, "short": 1.0, "stick": 1.0, "friction": 0.9},
    "people": {"refuse": 1.0, "late": 1.0, "late_secs": 600.0, "walk_per_min": 10.0},
}
# An error is at most so many times its standard deviation.
CUT = 2.0


def profile(named):
    """Numbers of a profile by table and key: a built-in name, or a TOML file. What it leaves out is 0."""
    path = os.path.join(PROFILES, named + ".toml") if "/" not in named else named
    path = path if os.path.exists(path) else named
    try:
        with open(path, "rb") as file:
            tables = tomllib.load(file)
    except (OSError, ValueError) as error:
        names = sorted(one[: -len(".toml")] for one in os.listdir(PROFILES))
        raise ModelError("the profile `%s` cannot be read: %s; built in are %s" % (
            named, error, ", ".join(names))) from None
    found = {table: dict.fromkeys(keys, 0.0) for table, keys in KEYS.items()}
    for table, numbers in tables.items():
        if table not in KEYS or not isinstance(numbers, dict):
            raise ModelError("%s: there is no table `%s`" % (named, table))
        for key, value in numbers.items():
            most = KEYS[table].get(key)
            if most is None:
                raise ModelError("%s: there is no number `%s.%s`" % (named, table, key))
            if isinstance(value, bool) or not isinstance(value, (int, float)) or not 0.0 <= value <= most:
                raise ModelError("%s: `%s.%s` is %r, which is not between 0 and %g" % (named, table, key, value, most))
            found[table][key] = float(value)
    return found


class Chance:
    """Draws of a run. Each has a generator of its own, from the seed, the occasion and what it is about."""

    def __init__(self, seed):
        self.seed, self.occasion = seed, 0

    def next(self):
        """Another occasion: one look, one grasp, one drive."""
        self.occasion += 1

    def random(self, purpose, of=""):
        """A generator for a purpose, such as `slip mug_1`."""
        said = "%d/%d/%s/%s" % (self.seed, self.occasion, purpose, of)
        return np.random.default_rng(int.from_bytes(hashlib.sha256(said.encode()).digest()[:8], "little"))

    def comes(self, rate, purpose, of=""):
        """True with a probability."""
        return rate > 0.0 and bool(self.random(purpose, of).random() < rate)

    def error(self, deviation, purpose, of=""):
        """Error in the plane with a standard deviation along each axis, cut off at twice the deviation."""
        if deviation <= 0.0:
            return np.zeros(2)
        random = self.random(purpose, of)
        length = deviation * min(np.sqrt(-2.0 * np.log(1.0 - random.random())), CUT)
        angle = 2.0 * np.pi * random.random()
        return length * np.array([np.cos(angle), np.sin(angle)])
