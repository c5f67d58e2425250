"""Aiming: a camera on the hand is turned so that the hand does not hide what the robot looks at.

A way to look at something has it in the field of view, but the fingers cover a part of the picture. Which
part, the picture and the robot's own shape say. Nothing here asks the simulator. """

import numpy as np

from .detector import belongs

# Every which row and column of a picture is looked at, and the cells that are kept free around a thing and at
# the rim.
GRID, AROUND = 4, 3


def covered(picture, solids):
    """Mask of the cells of a picture in which some solids are seen, such as those of the robot itself."""
    points = picture.points()[::GRID, ::GRID]
    mask = np.zeros(points.shape[:2], dtype=bool)
    for solid in solids:
        mask |= belongs(points, solid)
    return mask & (picture.depth[::GRID, ::GRID] > 0.0)


def turn(picture, mask, points):
    """Rotation in the map about the camera after which some points, as rows, are seen together beside a mask,
    by the smallest turn. None if they are so already, or if the picture has no room for them."""
    local = (points - picture.position) @ picture.rotation
    if local[:, 2].min() <= 0.0:
        return None
    centre = np.array(picture.centre)
    pixels = local[:, :2] / local[:, 2:] * picture.focal + centre
    low = np.floor(pixels.min(axis=0) / GRID).astype(int) - AROUND
    size = np.ceil(pixels.max(axis=0) / GRID).astype(int) + AROUND + 1 - low
    rows, columns = mask.shape
    if size[1] > rows or size[0] > columns:
        return None
    sums = np.zeros((rows + 1, columns + 1), dtype=int)
    sums[1:, 1:] = mask.cumsum(axis=0).cumsum(axis=1)
    wide, high = size
    hidden = sums[high:, wide:] - sums[:-high, wide:] - sums[high:, :-wide] + sums[:-high, :-wide]
    free = np.argwhere(hidden == 0)[:, ::-1]
    if not len(free):
        return None
    best = free[np.argmin(np.sum((free - low) ** 2, axis=1))]
    if np.all(best == low):
        return None
    middle = (pixels.min(axis=0) + pixels.max(axis=0)) / 2.0
    moved = middle + (best - low) * GRID
    now, then = (np.array([*((at - centre) / picture.focal), 1.0]) for at in (middle, moved))
    return picture.rotation @ between(then, now) @ picture.rotation.T


def between(one, other):
    """The smallest rotation that turns a direction into another (Rodrigues)."""
    one, other = one / np.linalg.norm(one), other / np.linalg.norm(other)
    axis, cosine = np.cross(one, other), one @ other
    cross = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
    return np.eye(3) + cross + cross @ cross / (1.0 + cosine)
