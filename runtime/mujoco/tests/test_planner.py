"""Motions of the driver's own: budgets and clearances that are tried."""

import os
import stat

from motet_mujoco.planner import Planner

# A command that answers as `motet feasible` does: with a motion only for the flags that it is told of.
STAND_IN = """#!/bin/sh
case "$*" in
    *"%s"*) echo '{"answer": "feasible", "witness": {"path": []}}' ;;
    *) echo '{"answer": "unknown", "says": "%s"}' ;;
esac
"""


def planner(folder, flags, says):
    """A planner whose command finds a motion with some flags only."""
    path = folder / "motet"
    path.write_text(STAND_IN % (flags, says))
    os.chmod(path, stat.S_IRWXU)
    return Planner(str(path), "hsr")


def test_a_search_that_ends_without_an_answer_is_tried_with_greater_budgets(tmp_path):
    found, why = planner(tmp_path, "--effort 100", "the search ran out of its budget").plan({}, "put(mug_1, drawer_1)")
    assert found == {"path": []} and why is None


def test_a_robot_that_stands_too_near_moves_with_less_clearance(tmp_path):
    found, _ = planner(tmp_path, "--clearance", "the clearance is not kept").plan({}, "posture(home)")
    assert found == {"path": []}


def test_planner_gives_the_reason_without_a_motion(tmp_path):
    found, why = planner(tmp_path, "no such flag", "the drawer is closed").plan({}, "put(mug_1, drawer_1)")
    assert found is None and why == ("unknown", "the drawer is closed")
