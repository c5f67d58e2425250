"""A MuJoCo world for Motet: a driver, a judge of verdicts, and perception from pixels."""

import os

__version__ = "0.1.0"

# MuJoCo looks for its graphics when it is imported. EGL needs no window; it comes with Mesa and with drivers.
os.environ.setdefault("MUJOCO_GL", "egl")
# Matrices are small: more threads only take time to start.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
