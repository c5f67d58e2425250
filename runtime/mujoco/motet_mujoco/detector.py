"""A detector of things by colour, size and shape, from one picture with depth.

It knows the furniture, as a robot that has a map does, and takes for a thing what stands out from it. It never asks
the simulator: all that it gets is pixels, the pose of the camera and the scene's fixed solids. The driver calls it;
any other is a process that does what this does:

    python -m motet_mujoco.detector     reads pictures as JSON lines (`look` of the driver protocol, with "solids"),
                                        and answers each with a line of detections
"""

import base64
import itertools
import json
import sys

import cv2
import numpy as np

# Colours by their names, as the model paints them.
COLOURS = {"red": (200, 38, 38), "green": (64, 150, 60), "blue": (40, 84, 190), "yellow": (232, 200, 48),
           "orange": (236, 134, 32), "purple": (128, 62, 160), "pink": (232, 130, 170), "brown": (122, 82, 48),
           "black": (36, 36, 40), "white": (240, 240, 238), "grey": (130, 132, 136)}
# Distance in m within which a point belongs to known furniture, and to the floor.
NEAR_FURNITURE, NEAR_FLOOR = 0.008, 0.02
# Jump in depth in m between pixels of two things, difference of hue between them in degrees, and pixels of the smallest
# thing.
JUMP, HUE, SMALLEST = 0.03, 32.4, 40
# Extent in m of the largest thing.
LARGEST = 0.6
# The order of labels is that of the pixels with one thread only, and a run is measured on one core.
cv2.setNumThreads(1)
# Signs of the corners of a box.
SIGNS = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
# Height in m below its top from which on the side of a round thing shows. Errors in m of the points of a
# circle up to which what looks round is round, and what looks flat.
RIM, ROUGH, SMOOTH = 0.006, 0.002, 0.0008


class Detection:
    """A thing in a picture: where it is, how large, and what it looks like."""

    def __init__(self, label, position, extent, confidence, colour):
        self.label, self.position, self.extent = label, position, extent
        self.confidence, self.colour = confidence, colour


def detect(picture, solids):
    """Things in a picture, the largest in pixels first. `solids` are those of known furniture: dictionaries with
    `xyz`, `rotation` (3 × 3) and `box` (half sides) or `cylinder` (radius, half height)."""
    points = picture.points()
    new = (picture.depth > 0.0) & (points[..., 2] >= NEAR_FLOOR)
    nearest = picture.depth[new].min(initial=np.inf)
    for solid in solids:
        shown = picture.window(corners(solid))
        if shown is not None and shown[1] >= nearest:
            new[shown[0]] &= ~belongs(points[shown[0]], solid)
    labels = components(new, picture.depth, picture.colour)
    counts = np.bincount(labels.ravel())
    found = []
    for label in np.argsort(-counts, kind="stable"):
        if label == 0 or counts[label] < SMALLEST:
            continue
        mask = labels == label
        one = describe(points[mask].astype(float), picture.colour[mask], mask, picture.position)
        if one is not None:
            found.append(one)
    return found


def corners(solid):
    """Corners of a box around a solid with all that belongs to it, as rows."""
    half = solid["box"] if "box" in solid else [solid["cylinder"][0]] * 2 + [solid["cylinder"][1]]
    return SIGNS * (np.array(half) + NEAR_FURNITURE + 1e-6) @ np.array(solid["rotation"]).T + np.array(solid["xyz"])


def belongs(points, solid):
    """Mask of the points, as rows or a picture of them, that belong to a solid."""
    if not points.size:
        return np.zeros(points.shape[:-1], dtype=bool)
    to_solid = np.array(solid["rotation"]).T
    local = cv2.transform(points if points.ndim == 3 else points[:, None], np.column_stack([to_solid, -to_solid @ solid["xyz"]]))
    if "box" in solid:
        half = np.array(solid["box"]) + NEAR_FURNITURE
    else:
        radius, half = (size + NEAR_FURNITURE for size in solid["cylinder"])
        # Across, the distance from the axis counts.
        local[..., 0], local[..., 1], half = np.hypot(local[..., 0], local[..., 1]), 0.0, (radius, 0.0, half)
    return cv2.inRange(local, np.negative(half), half).astype(bool).reshape(points.shape[:-1])


def components(mask, depth, colour):
    """Connected parts of a mask, cut where depth jumps or the hue changes: an array of labels, 0 outside, in the order
    of their first pixels."""
    labels = np.zeros(mask.shape, dtype=np.int32)
    left, top, width, height = cv2.boundingRect(mask.astype(np.uint8))
    if not width:
        return labels
    part = slice(top, top + height), slice(left, left + width)
    mask, depth, (hue, grey) = mask[part], depth[part], hues(colour[part])
    # Between the pixels stands what connects them.
    grid = np.zeros((2 * height - 1, 2 * width - 1), dtype=np.uint8)
    grid[::2, ::2] = mask
    for down, right in ((0, 1), (1, 0)):
        one = (slice(0, height - down), slice(0, width - right))
        two = (slice(down, height), slice(right, width))
        turn = np.abs(hue[one] - hue[two])
        alike = (np.minimum(turn, 360.0 - turn) < HUE) & ~grey[one] & ~grey[two] | grey[one] & grey[two]
        grid[down::2, right::2] = mask[one] & mask[two] & (np.abs(depth[one] - depth[two]) < JUMP) & alike
    labels[part] = cv2.connectedComponents(grid, connectivity=4)[1][::2, ::2]
    return labels


def hues(colour):
    """Hue of each pixel in degrees, and a mask of the pixels without one."""
    hue, share, most = cv2.split(cv2.cvtColor(colour.astype(np.float32) / 255.0, cv2.COLOR_RGB2HSV))
    return hue, share * most < 0.12 * np.maximum(most, 0.2)


def describe(points, colours, mask, eye):
    """The detection of one part of a picture from an eye; None for something that is no thing."""
    low, high = np.percentile(points, [1, 99], axis=0)
    extent = high - low
    if extent.max() > LARGEST or extent.max() < 0.008:
        return None
    horizontal = max(extent[0], extent[1])
    height = extent[2]
    centre = (low + high) / 2.0
    rows, columns = np.flatnonzero(mask.any(axis=1)), np.flatnonzero(mask.any(axis=0))
    is_cut = rows[0] == 0 or columns[0] == 0 or rows[-1] == mask.shape[0] - 1 or columns[-1] == mask.shape[1] - 1
    fill = mask.sum() / float((rows[-1] - rows[0] + 1) * (columns[-1] - columns[0] + 1))
    shape = shape_of(points, extent, fill)
    colour = np.median(colours, axis=0)
    seen = min(1.0, mask.sum() / 400.0)
    confidence = (0.5 if is_cut else 0.9) * (0.5 + 0.5 * seen)
    ball = fitted(points, "sphere", max(horizontal, height))
    if ball is not None and ball[2] < SMOOTH:
        shape = "sphere"
    circle = ball if shape == "sphere" else fitted(points, shape, horizontal)
    if shape != "sphere" and circle is not None:
        # The curve of a side says more than how wide it looks.
        shape = "cylinder" if circle[2] < (ROUGH if shape == "cylinder" else SMOOTH) else "box"
    if circle is not None and circle[2] < ROUGH and shape != "box":
        centre[:2], horizontal = circle[0][:2], 2.0 * circle[1]
        if shape == "sphere":
            centre[2], height = circle[0][2], horizontal
    elif shape != "box":
        centre[:2] = middle(points, eye)
    if shape == "sphere":
        wide = max(horizontal, height)
        size = np.array([wide] * 3)
    elif shape == "cylinder":
        size = np.array([horizontal, horizontal, height])
    else:
        size = np.array([max(extent[0], 0.01), max(extent[1], 0.01), max(height, 0.01)])
    return Detection("%s %s" % (colour_name(colour), shape), centre, size, confidence, colour)


def middle(points, eye):
    """Middle of a round thing in the plane: half its width behind the side that one sees, if no more of it shows."""
    ahead = points[:, :2].mean(axis=0) - eye[:2]
    ahead /= max(np.linalg.norm(ahead), 1e-9)
    across = np.array([-ahead[1], ahead[0]])
    near, far = np.percentile(points[:, :2] @ ahead, [1, 99])
    left, right = np.percentile(points[:, :2] @ across, [1, 99])
    return ahead * max(near + (right - left) / 2.0, (near + far) / 2.0) + across * (left + right) / 2.0


def fitted(points, shape, wide):
    """Middle and radius of a round thing by the curve of its side, and the error of the points, in m. A part
    of the side is enough where something hides the rest. It is the circle, or the sphere, of the least
    algebraic error (Kåsa 1976). None where too few points show a side. The error is infinite if the radius
    does not go with the width that shows."""
    if shape != "sphere":
        points = points[points[:, 2] < points[:, 2].max() - RIM][:, :2]
    if len(points) < SMALLEST:
        return None
    origin = points.mean(axis=0)
    local = points - origin
    found, *_ = np.linalg.lstsq(np.column_stack([2.0 * local, np.ones(len(local))]), (local**2).sum(axis=1))
    radius = float(np.sqrt(max(found[-1] + found[:-1] @ found[:-1], 0.0)))
    error = float(np.sqrt(np.mean((np.linalg.norm(local - found[:-1], axis=1) - radius) ** 2)))
    return origin + found[:-1], radius, error if 0.45 * wide < radius < 1.2 * wide else np.inf


def shape_of(points, extent, fill):
    """`sphere`, `cylinder` or `box`, by how the points curve."""
    height = extent[2]
    horizontal = max(extent[0], extent[1])
    # Width at a quarter of the height from above and below, as a share of that in the middle.
    low, high = points[:, 2].min(), points[:, 2].max()
    widths = []
    for share in (0.1, 0.5, 0.9):
        band = np.abs(points[:, 2] - (low + (high - low) * share)) < 0.08 * max(high - low, 1e-3)
        if band.sum() < 5:
            widths.append(0.0)
            continue
        widths.append(float(np.ptp(points[band][:, :2], axis=0).max()))
    if widths[1] > 0 and max(widths[0], widths[2]) < 0.8 * widths[1] and 0.7 < height / max(horizontal, 1e-6) < 1.3:
        return "sphere"
    # A flat face keeps one depth, a round one does not.
    middle = np.abs(points[:, 2] - (low + high) / 2.0) < 0.25 * max(high - low, 1e-3)
    if middle.sum() >= 12:
        flat = points[middle][:, :2]
        centred = flat - flat.mean(axis=0)
        _, spread, _ = np.linalg.svd(centred, full_matrices=False)
        bend = spread[-1] / max(spread[0], 1e-9)
        if 0.12 < bend < 0.6 and fill > 0.7:
            return "cylinder"
    return "box"


def colour_name(colour):
    """The name of the nearest colour, whatever the light on it."""
    colour = np.asarray(colour, dtype=float)
    bright = colour.sum() / 3.0
    span = colour.max() - colour.min()
    if span < 0.15 * max(colour.max(), 50.0):
        return "black" if bright < 60 else "white" if bright > 190 else "grey"
    unit = colour / np.linalg.norm(colour)
    chromatic = {name: np.array(value, dtype=float) for name, value in COLOURS.items()
                 if name not in ("black", "white", "grey")}
    return max(chromatic, key=lambda name: unit @ (chromatic[name] / np.linalg.norm(chromatic[name])))


# As a process of its own.


def unpack(message):
    """A picture of a `look` message."""
    from .camera import Picture

    image, depth, camera = message["image"], message["depth"], message["camera"]
    png = np.frombuffer(base64.b64decode(image["png"]), dtype=np.uint8)
    colour = cv2.cvtColor(cv2.imdecode(png, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    mm = np.frombuffer(base64.b64decode(depth["mm"]), dtype="<u2").reshape(depth["height"], depth["width"])
    x, y, z, w = camera["pose"]["quaternion"]
    rotation = matrix(w, x, y, z)
    return Picture(camera["name"], colour, mm / 1000.0, np.array(camera["pose"]["xyz"]), rotation, camera["fx"])


def matrix(w, x, y, z):
    """Rotation of a quaternion."""
    return np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])


def wire(found):
    """Detections as the driver protocol writes them, without ids."""
    return [{"label": one.label, "id": None, "extent": [round(float(part), 4) for part in one.extent],
             "pose": {"xyz": [round(float(part), 4) for part in one.position], "quaternion": [0.0, 0.0, 0.0, 1.0]},
             "confidence": round(float(one.confidence), 3)} for one in found]


def main():
    for line in sys.stdin:
        message = json.loads(line)
        found = detect(unpack(message), message.get("solids", []))
        print(json.dumps({"detections": wire(found)}), flush=True)


if __name__ == "__main__":
    main()
