"""Cameras: colour and depth pictures of the world, rendered without a window."""

import base64
import functools

import cv2
import mujoco
import numpy as np

WIDTH, HEIGHT = 640, 480
# Nothing farther than this in m is in a depth picture.
FARTHEST = 12.0
# Shapes beside those of the model that a scene may show.
SHOWN = 100


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
            local = rays(self.depth.shape, self.focal) * self.depth[..., None].astype(np.float32)
            self.placed = cv2.transform(local, np.column_stack([self.rotation, self.position]))
        return self.placed

    def samples(self, step):
        """Points in the map of each so many-th row and column where something is seen, as rows."""
        depth = self.depth[::step, ::step]
        local = rays(self.depth.shape, self.focal)[::step, ::step] * depth[..., None]
        return local[depth > 0.0] @ self.rotation.T + self.position

    def window(self, corners):
        """Part of the picture in which something shows, by the corners of a box around it, as rows: slices of rows and
        columns, and its greatest depth in m. None where it is out of view."""
        local = (corners - self.position) @ self.rotation
        far = float(local[:, 2].max())
        if far <= 0.0:
            return None
        if local[:, 2].min() <= 1e-3:
            return (slice(None), slice(None)), far
        pixels = local[:, :2] / local[:, 2:] * self.focal + np.array(self.centre)
        low, high = np.floor(pixels.min(axis=0)).astype(int) - 1, np.ceil(pixels.max(axis=0)).astype(int) + 2
        (left, top), (right, bottom) = np.maximum(low, 0), np.minimum(high, self.depth.shape[::-1])
        return None if left >= right or top >= bottom else ((slice(top, bottom), slice(left, right)), far)

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
        png = cv2.imencode(".png", cv2.cvtColor(self.colour, cv2.COLOR_RGB2BGR))[1].tobytes()
        mm = np.clip(np.round(self.depth * 1000.0), 0, 65535).astype("<u2")
        return {
            "image": {"width": width, "height": height, "png": base64.b64encode(png).decode()},
            "depth": {"width": width, "height": height, "mm": base64.b64encode(mm.tobytes()).decode()},
            "camera": {"name": self.name, "fx": self.focal, "fy": self.focal, "cx": cx, "cy": cy,
                       "pose": {"xyz": [float(part) for part in self.position], "quaternion": [x, y, z, w]}},
        }


class NoGraphics(Exception):
    """There is no graphics library that renders without a window."""


class Camera:
    """Renders pictures of a world. Its graphics are made when the first picture is asked for."""

    def __init__(self, world):
        self.world, self.graphics = world, None

    def look(self, name):
        """A picture of a camera."""
        world, mj = self.world, self.world.model.mj
        at = world.model.cameras.index(name)
        if self.graphics is None:
            try:
                self.graphics = Graphics(mj)
            except Exception as error:  # each library has exceptions of its own
                raise NoGraphics("no picture can be rendered (%s); install EGL, or run with --oracle" % error) from None
        mujoco.mj_camlight(mj, world.data)
        colour, depth = self.graphics.render(world.data, at)
        focal = HEIGHT / 2.0 / np.tan(np.radians(mj.cam_fovy[at]) / 2.0)
        # The axes of images: x to the right, y down, z ahead.
        rotation = world.data.cam_xmat[at].reshape(3, 3) @ np.diag([1.0, -1.0, -1.0])
        # In whole mm, as a depth camera and the protocol have it.
        depth = np.round(np.where(depth > FARTHEST, 0.0, depth) * 1000.0).astype(np.uint16) / 1000.0
        return Picture(name, colour, depth, world.data.cam_xpos[at].copy(), rotation, float(focal))


class Graphics:
    """Renders without a window. In contrast to `mujoco.Renderer` it reads colours and depths of one rendering, and loads
    no large font."""

    def __init__(self, mj):
        # On a CPU, shadows and smooth edges take ten times as long as the picture.
        mj.vis.quality.offsamples = mj.vis.quality.shadowsize = 0
        self.mj, self.scene = mj, mujoco.MjvScene(mj, mj.ngeom + SHOWN)
        self.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = 0
        self.options, self.camera = mujoco.MjvOption(), mujoco.MjvCamera()
        self.camera.type = mujoco.mjtCamera.mjCAMERA_FIXED
        self.window, self.rect = mujoco.GLContext(WIDTH, HEIGHT), mujoco.MjrRect(0, 0, WIDTH, HEIGHT)
        self.window.make_current()
        self.context = mujoco.MjrContext(mj, mujoco.mjtFontScale.mjFONTSCALE_50.value)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN.value, self.context)
        self.context.readDepthMap = mujoco.mjtDepthMap.mjDEPTH_ZEROFAR

    def render(self, data, at):
        """Colours and depths in m of the camera with a number."""
        self.camera.fixedcamid = at
        everything = mujoco.mjtCatBit.mjCAT_ALL.value
        for _ in range(2):
            # The light of the camera is where the camera was in the update before.
            mujoco.mjv_updateScene(self.mj, data, self.options, None, self.camera, everything, self.scene)
        self.window.make_current()
        mujoco.mjr_render(self.rect, self.scene, self.context)
        colour, depth = np.empty((HEIGHT, WIDTH, 3), dtype=np.uint8), np.empty((HEIGHT, WIDTH), dtype=np.float32)
        mujoco.mjr_readPixels(colour, depth, self.rect, self.context)
        # From the reversed depth of the projection to metres; its first row is the lowest.
        near, far = (self.mj.stat.extent * np.array([self.mj.vis.map.znear, self.mj.vis.map.zfar])).tolist()
        return colour[::-1].copy(), near * far / (near + depth[::-1].astype(float) * (far - near))

    def __del__(self):
        if hasattr(self, "context"):
            # Before the window goes in which it is.
            with self.window.as_current():
                self.context.free()


@functools.lru_cache(maxsize=4)
def rays(shape, focal):
    """Directions of all pixels in the frame of a camera, 1 m ahead of it."""
    height, width = shape
    rows, columns = np.indices(shape)
    across, down = (columns - (width - 1) / 2.0) / focal, (rows - (height - 1) / 2.0) / focal
    return np.stack([across, down, np.ones(shape)], axis=-1).astype(np.float32)


def quaternion(rotation):
    """Quaternion w, x, y, z of a rotation."""
    found = np.zeros(4)
    mujoco.mju_mat2Quat(found, np.ascontiguousarray(rotation).ravel())
    return [float(part) for part in found]
