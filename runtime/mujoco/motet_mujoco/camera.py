"""Cameras: colour and depth pictures of the world, rendered without a window."""

import base64
import functools
import struct
import zlib

import mujoco
import numpy as np

WIDTH, HEIGHT = 640, 480
# Nothing farther than this in m is in a depth picture.
FARTHEST = 12.0


class Picture:
    """What a camera saw: colour, depth in m (0 where nothing is), and where the camera was."""

    def __init__(self, name, colour, depth, position, rotation, focal):
        self.name, self.colour, self.depth = name, colour, depth
        self.position, self.rotation, self.focal = position, rotation, focal
        self.placed = None

    @property
    def centre(self):
        """Principal point in pixels."""
        return (self.colour.shape[1] - 1) / 2.0, (self.colour.shape[0] - 1) / 2.0

    def points(self):
        """Points in the map of all pixels, as an array of rows and columns."""
        if self.placed is None:
            self.placed = (rays(self.depth.shape, self.focal) * self.depth[..., None]) @ self.rotation.T + self.position
        return self.placed

    def samples(self, step):
        """Points in the map of each so many-th row and column where something is seen, as rows."""
        depth = self.depth[::step, ::step]
        local = rays(self.depth.shape, self.focal)[::step, ::step] * depth[..., None]
        return local[depth > 0.0] @ self.rotation.T + self.position

    def window(self, corners):
        """Part of the picture in which something shows, by the corners of a box around it, as rows: slices of rows and
        columns, and its least and greatest depth in m. None where it is behind the camera."""
        local = (corners - self.position) @ self.rotation
        near, far = float(local[:, 2].min()), float(local[:, 2].max())
        if far <= 0.0:
            return None
        if near <= 1e-3:
            return (slice(None), slice(None)), (near, far)
        pixels = local[:, :2] / local[:, 2:] * self.focal + np.array(self.centre)
        low, high = np.floor(pixels.min(axis=0)).astype(int) - 1, np.ceil(pixels.max(axis=0)).astype(int) + 2
        (left, top), (right, bottom) = np.maximum(low, 0), np.maximum(high, 0)
        return (slice(top, bottom), slice(left, right)), (near, far)

    def shows_behind(self, point, far, frame):
        """True if the picture shows something more than a distance in m behind a point of the map, or nothing there.
        Within a frame of so many pixels it does not show the point."""
        x, y, ahead = self.rotation.T @ (point - self.position)
        if ahead <= 0.0:
            return False
        cx, cy = self.centre
        column, row = round(x / ahead * self.focal + cx), round(y / ahead * self.focal + cy)
        height, width = self.depth.shape
        if not (frame <= column < width - frame and frame <= row < height - frame):
            return False
        depth = self.depth[row, column]
        return bool(depth == 0.0 or depth > ahead + far)

    def message(self):
        """The answer to `look` of the driver protocol."""
        height, width = self.depth.shape
        w, x, y, z = quaternion(self.rotation)
        cx, cy = self.centre
        mm = np.clip(np.round(self.depth * 1000.0), 0, 65535).astype("<u2")
        return {
            "image": {"width": width, "height": height, "png": base64.b64encode(png(self.colour)).decode()},
            "depth": {"width": width, "height": height, "mm": base64.b64encode(mm.tobytes()).decode()},
            "camera": {"name": self.name, "fx": self.focal, "fy": self.focal, "cx": cx, "cy": cy,
                       "pose": {"xyz": [float(part) for part in self.position], "quaternion": [x, y, z, w]}},
        }


class NoGraphics(Exception):
    """There is no graphics library that renders without a window."""


class Camera:
    """Renders pictures of a world. Made when the first picture is asked for: it needs a graphics library."""

    def __init__(self, world):
        self.world = world
        self.renderer = None

    def look(self, name):
        """A picture of a camera."""
        world, mj = self.world, self.world.model.mj
        if self.renderer is None:
            try:
                mj.vis.quality.offsamples = 0
                self.renderer = mujoco.Renderer(mj, HEIGHT, WIDTH)
            except Exception as error:  # each library has exceptions of its own
                raise NoGraphics("no picture can be rendered (%s); install EGL, or run with --oracle" % error) from None
            # The first picture of a renderer differs a little from the same one later.
            self._render(world.model.cameras.index(name))
        at = world.model.cameras.index(name)
        colour, depth = self._render(at)
        depth[depth > FARTHEST] = 0.0
        focal = HEIGHT / 2.0 / np.tan(np.radians(mj.cam_fovy[at]) / 2.0)
        # The axes of images: x to the right, y down, z ahead.
        rotation = world.data.cam_xmat[at].reshape(3, 3) @ np.diag([1.0, -1.0, -1.0])
        # In whole mm, as a depth camera and the protocol have it.
        depth = np.round(depth * 1000.0).astype(np.uint16) / 1000.0
        return Picture(name, colour, depth, world.data.cam_xpos[at].copy(), rotation, float(focal))

    def _render(self, at):
        """Colours and depths in m of the camera with a number."""
        renderer, data = self.renderer, self.world.data
        mujoco.mj_camlight(self.world.model.mj, data)
        renderer.update_scene(data, at)
        # On a CPU, shadows and smooth edges take ten times as long as the picture.
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        colour = renderer.render().copy()
        renderer.enable_depth_rendering()
        renderer.update_scene(data, at)
        depth = renderer.render().copy()
        renderer.disable_depth_rendering()
        return colour, depth


@functools.lru_cache(maxsize=4)
def rays(shape, focal):
    """Directions of all pixels in the frame of a camera, 1 m ahead of it."""
    height, width = shape
    rows, columns = np.indices(shape)
    across, down = (columns - (width - 1) / 2.0) / focal, (rows - (height - 1) / 2.0) / focal
    return np.stack([across, down, np.ones(shape)], axis=-1)


def quaternion(rotation):
    """Quaternion w, x, y, z of a rotation."""
    found = np.zeros(4)
    mujoco.mju_mat2Quat(found, np.ascontiguousarray(rotation).ravel())
    return [float(part) for part in found]


def png(colour):
    """A colour picture as a PNG file."""
    height, width, _ = colour.shape
    rows = np.concatenate([np.zeros((height, 1), dtype=np.uint8), colour.reshape(height, -1)], axis=1)

    def chunk(kind, data):
        check = zlib.crc32(kind + data)
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", check)

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    body = zlib.compress(rows.tobytes(), 3)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
