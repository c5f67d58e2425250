"""Motions of the driver's own: `motet feasible` asked about the scene as the robot believes it to be."""

import json
import math
import os
import tempfile

from .model import ModelError, motet


# Clearances of a robot that stands too near to something.
LEAST = "base=0.01,arm=0.005"
# Words of an answer about a robot that touches something where it stands.
START = "at the start"
# Search budgets of a motion that the usual one did not decide.
EFFORTS = ("10", "100")


class Planner:
    """Plans where a command brings no motion, or one that begins elsewhere."""

    def __init__(self, command, robot):
        self.command, self.robot = command, robot

    def plan(self, scene, query):
        """(witness, None), or (None, (reason, text)) where there is none. Where the robot stands too near to something
        for the clearance that it keeps, it moves with less; where a search ends without an answer, it tries for
        longer."""
        witness, why = self.ask(scene, query)
        if witness is None and "budget" in why[1]:
            asked = (self.ask(scene, query, "--effort", effort)[0] for effort in EFFORTS)
            witness = next((one for one in asked if one is not None), None)
        elif witness is None and "clearance" in why[1]:
            witness, _ = self.ask(scene, query, "--clearance", LEAST)
        return witness, None if witness is not None else why

    def ask(self, scene, query, *flags):
        """The answer to one question, as `plan` gives it."""
        handle, path = tempfile.mkstemp(suffix=".json", prefix="motet-")
        try:
            with os.fdopen(handle, "w", encoding="utf-8") as out:
                json.dump(scene, out)
            text = motet(self.command, "feasible", "--robot", self.robot, "--scene", path, "--for", query,
                         "--format", "json", *flags, ok=(0, 1))
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


def stand_at(x, y, yaw):
    """Query for a way of the base to a place, in m and rad in the map."""
    return "stand_at(pose(%.4f m, %.4f m, %.5f rad))" % (x, y, yaw)


def quoted(entity):
    """An id as the language writes it."""
    return entity if entity.isidentifier() and entity.isascii() else "`%s`" % entity
