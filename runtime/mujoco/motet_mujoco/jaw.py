"""Room between the jaws: how a hand with a fixed jaw comes to a thing.

A witness ends with the fixed jaw at the thing, and its tip would hit a thing that stands a little elsewhere. So the hand
comes with as much room on the one side of the thing as on the other, and moves aside until it feels the thing before it
closes. A hand whose jaws both move has enough room on both sides anyway.
"""

import numpy as np

from .clearance import NEARER, TOUCHES, Clearance
from .motion import frame_at

# The hand goes beside its way within this distance in m of its end.
NEAR = 0.12
# Distances in m to either side by which a hand is moved to find how much room it has there.
SPARES = tuple(0.005 * step for step in range(1, 11))
# Room in m on each side of a thing that is enough.
ENOUGH = 0.01
# Greatest and least offset in m of a hand that comes to a thing, and the way in m beyond the witness on which it feels
# for the thing.
OFFSET, LEAST, FEELS = 0.025, 0.004, 0.01
# Share of the greatest speeds at which the hand feels for a thing.
FEELS_AT = 0.1


def aside(world, points, off):
    """Points of a way that is elsewhere by an offset of the hand, in m, where the hand is near to its end; None out of
    reach."""
    if float(np.linalg.norm(off)) < 1e-4:
        return points
    moved = [np.array(point) for point in points]
    for at in range(approach(world, points), len(points)):
        moved[at] = shifted(world, points[at], off)
        if moved[at] is None:
            return None
    return moved


def approach(world, points):
    """Index of the point of a way from which on the hand is near to its end: one of the last two, or before."""
    end, first = frame_at(world, points[-1])[0], max(1, len(points) - 2)
    while first > 1 and np.linalg.norm(frame_at(world, points[first - 1])[0] - end) <= NEAR:
        first -= 1
    return first


def shifted(world, point, off):
    """Targets with the hand elsewhere by an offset in m; None out of reach."""
    place, rotation = frame_at(world, point)
    target = world.reacher.solve(world.data.qpos, point, place + off, rotation)
    if target is not None:
        for grip in world.model.grips:
            target[grip] = point[grip]
    return target


def spared(world, beliefs, points, thing):
    """A way to a thing with as much room on both sides of it as its jaws and the furniture leave, and the targets of
    the way aside on which the hand then feels for the thing: none where there is enough room anyway."""
    called = world.called.get(thing, thing)
    if called not in world.model.free or len(points) < 2:
        return points, []
    clearance, across = Clearance(world, beliefs, TOUCHES), frame_at(world, points[-1])[1][:, 1]
    body, at = world.model.body_of[called], world.model.free[called][0]
    place = clearance.start[at : at + 3].copy()

    def met(target):
        """Bodies that the robot touches other than the thing, and whether it touches the thing."""
        pairs = clearance.near(target)
        return {pair: gap for pair, gap in pairs.items() if body not in pair}, any(body in pair for pair in pairs)

    usual, _ = met(points[-1])

    def is_free(target):
        return all(gap >= usual.get(pair, np.inf) - NEARER for pair, gap in met(target)[0].items())

    def room(way):
        """Room in m on a side of the hand, found by moving the thing the other way."""
        found = 0.0
        for far in SPARES:
            clearance.start[at : at + 3] = place - far * way
            if met(points[-1])[1]:
                break
            found = far
        clearance.start[at : at + 3] = place
        return found

    one, other = room(across), room(-across)
    off = float(np.clip((one - other) / 2.0, -OFFSET, OFFSET)) * across
    if min(one, other) >= ENOUGH or np.linalg.norm(off) < LEAST:
        return points, []
    moved = aside(world, points, off)
    beyond = None if moved is None else shifted(world, points[-1], -off * FEELS / np.linalg.norm(off))
    if beyond is None or not is_free(beyond):
        return points, []
    first = approach(world, points)
    legs = zip(moved[first - 1 :], moved[first:])
    ways = [start + (end - start) * share for start, end in legs for share in np.linspace(0.2, 1.0, 5)]
    if not all(is_free(target) and not met(target)[1] for target in ways):
        return points, []
    return moved, [points[-1], beyond]
