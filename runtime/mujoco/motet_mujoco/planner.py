"""Motions of the driver's own: `motet feasible` asked about the scene as the robot believes it to be."""

import json
import math
import os
import tempfile

from .model import ModelError, motet


class Planner:
    """Plans where a command brings no motion, or one that begins elsewhere."""

    def __init__(self, command, robot):
        self.command, self.robot = command, robot

    def plan(self, scene, query):
        """(witness, None), or (None, (reason, text)) where there is none."""
        handle, path = tempfile.mkstemp(suffix=".json", prefix="motet-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as out:
                json.dump(scene, out)
            text = motet(self.command, "feasible", "--robot", self.robot, "--scene", path, "--for", query,
                         "--format", "json", ok=(0, 1))
        except ModelError as error:
            return None, ("unknown", str(error))
        finally:
            os.unlink(path)
        answer = json.loads(text.splitlines()[0])
        if answer.get("answer") == "feasible":
            return answer["witness"], None
        return None, (answer.get("reason", "unknown"), answer.get("says", "no motion was found"))


def rpy(quaternion):
    """Roll, pitch and yaw of a rotation w, x, y, z."""
    w, x, y, z = (float(part) for part in quaternion)
    roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    pitch = math.asin(max(-1.0, min(1.0, 2.0 * (w * y - z * x))))
    yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
    return [roll, pitch, yaw]


def quoted(entity):
    """An id as the language writes it."""
    return entity if entity.isidentifier() and entity.isascii() else "`%s`" % entity
