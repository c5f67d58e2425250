"""Models: what `motet robots mjcf` writes, compiled, with the ids of what the driver needs."""

import json
import os
import shutil
import subprocess
from urllib.parse import quote, unquote

import mujoco
import numpy as np


# Seconds within which the base and a joint reach their greatest speed, as in the time parametrisation of witnesses.
RAMPS = (1.0, 0.5)


class ModelError(Exception):
    """The model of a robot in a scene cannot be made; the text is for people."""


def turned(pose):
    """Quaternion w, x, y, z of a pose of a scene."""
    quaternion = np.zeros(4)
    mujoco.mju_euler2Quat(quaternion, np.array(pose.get("rpy", (0.0, 0.0, 0.0)), dtype=float), "XYZ")
    return quaternion


def find_motet(path=None):
    """Path of the command `motet`: the one given, the one in $MOTET, or the one in $PATH."""
    found = path or os.environ.get("MOTET") or shutil.which("motet")
    if not found:
        raise ModelError("the command `motet` is not in PATH; name it with --motet")
    return found


def motet(command, *arguments, ok=(0,)):
    """Standard output of a motet command. Its standard error is the reason where it fails."""
    try:
        done = subprocess.run([command, *arguments], capture_output=True, text=True, check=False)
    except OSError as error:
        raise ModelError("`%s` cannot be started: %s" % (command, error)) from None
    if done.returncode not in ok:
        reason = (done.stderr.strip() or done.stdout.strip() or "exit code %d" % done.returncode)[:2000]
        raise ModelError("`motet %s` failed: %s" % (arguments[0], reason))
    return done.stdout


def save(path, scene):
    """Writes a scene into a file: beside it first, so that nobody ever reads a part of one."""
    text, beside = json.dumps(scene), "%s.%d" % (path, os.getpid())
    with open(beside, "w", encoding="utf-8") as out:
        out.write(text)
    os.replace(beside, path)


def name(text):
    """A name as the model writes it: `/`, `%` and control characters as in a URL."""
    if text == "world":
        return "%77orld"
    return "".join(quote(c, safe="") if c in "/%" or not c.isprintable() and ord(c) < 160 else c for c in text)


class Model:
    """A compiled model with ids and data by name. Everything that does not change in a run."""

    def __init__(self, xml, source=None):
        self.source = source  # the robot as the command line names it
        try:
            self.mj = mujoco.MjModel.from_xml_string(xml)
        except ValueError as error:
            raise ModelError("MuJoCo does not take the model: %s" % error) from None
        # What sleeps leaves few constraints, for which a dense solver is faster, most of all with a thing in the hand.
        self.mj.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        m = self.mj
        self.scene = json.loads(self.text("scene"))
        self.entities = {entity["id"]: entity for entity in self.scene["entities"]}
        self.robot, self.drive = self.text("robot"), self.text("drive")
        self.drives = self.drive != "fixed"
        # Actuators in order: the base's three where it drives, then joints by the names of the URDF.
        actuators = [m.actuator(at).name for at in range(m.nu)]
        self.controls = {unquote(name.removeprefix("robot/")): at for at, name in enumerate(actuators)}
        joints = [m.actuator_trnid[at, 0] for at in range(m.nu)]
        self.control_qpos = np.array([m.jnt_qposadr[joint] for joint in joints], dtype=int)
        self.control_qvel = np.array([m.jnt_dofadr[joint] for joint in joints], dtype=int)
        # Stiffness of each servo, and the seconds by which its damping makes it lag.
        self.stiffness = np.maximum(m.actuator_gainprm[:, 0], 1e-9)
        self.lag = -m.actuator_biasprm[:, 2] / self.stiffness
        # Joints that follow others: positions of both in `qpos`, an offset and a factor.
        pairs = [at for at in np.flatnonzero(m.eq_type == mujoco.mjtEq.mjEQ_JOINT) if m.eq_obj2id[at] >= 0]
        self.followers = [(int(m.jnt_qposadr[m.eq_obj1id[at]]), int(m.jnt_qposadr[m.eq_obj2id[at]]),
                           *m.eq_data[at, :2].tolist()) for at in pairs]
        # Matrix from the rates of the actuators to those of all degrees of freedom.
        self.transmission = np.zeros((m.nv, m.nu))
        self.transmission[self.control_qvel, np.arange(m.nu)] = 1.0
        for at in pairs:
            leader = m.jnt_dofadr[m.eq_obj2id[at]]
            self.transmission[m.jnt_dofadr[m.eq_obj1id[at]]] = m.eq_data[at, 1] * self.transmission[leader]
        numbers = {m.numeric(at).name: np.array(m.numeric(at).data) for at in range(m.nnumeric)}
        base = numbers["speed/base"]
        self.card = numbers["card"]  # radius of the base, reach, payload, opening
        sights = {key.removeprefix("sight/"): value for key, value in numbers.items() if key.startswith("sight/")}
        self.sight = {unquote(key): value for key, value in sights.items()}
        speeds = [base[0], base[0], base[1]] if self.drives else []
        for name_ in actuators[len(speeds) :]:
            speeds.append(float(numbers[name_.replace("robot/", "speed/", 1)][0]))
        self.speeds = np.array(speeds)
        self.ramps = np.array([RAMPS[0] if at < 3 and self.drives else RAMPS[1] for at in range(m.nu)])
        grips = {key.removeprefix("hand/"): value for key, value in numbers.items() if key.startswith("hand/")}
        self.grips = {self.controls[unquote(key)]: value for key, value in grips.items()}
        # Joints of fingers that give way: positions in `qpos`, where they rest, and their travel.
        self.springs = [(int(m.jnt_qposadr[at]), float(m.qpos_spring[m.jnt_qposadr[at]]), float(np.ptp(m.jnt_range[at])))
                        for at in np.flatnonzero((m.jnt_stiffness > 0.0) & m.jnt_limited)]
        # Bodies: who is an entity, a door, or the robot.
        self.body_of = {unquote(m.body(at).name): at for at in range(1, m.nbody)}
        self.owner = [None] * m.nbody
        for at in range(1, m.nbody):
            called = m.body(at).name
            if called == "robot" or called.startswith("robot/"):
                self.owner[at] = "robot"
            else:
                self.owner[at] = unquote(called.removesuffix("/door"))
        self.geom_owner = [self.owner[m.geom_bodyid[at]] for at in range(m.ngeom)]
        self.floor = m.geom("floor").id
        self.hand_geoms = {at for at in range(m.ngeom) if is_hand(m.geom(at).name)}
        self.tip = mujoco.mj_name2id(m, mujoco.mjtObj.mjOBJ_SITE, "robot/hand")
        # Free things and doors by id.
        self.free, self.doors = {}, {}
        for at in range(m.njnt):
            called = m.joint(at).name
            if m.jnt_type[at] == mujoco.mjtJoint.mjJNT_FREE:
                self.free[unquote(called)] = (m.jnt_qposadr[at], m.jnt_dofadr[at])
            elif called.endswith("/travel"):
                low, high = m.jnt_range[at]
                opened = high if high > -low else low
                self.doors[unquote(called.removesuffix("/travel"))] = (m.jnt_qposadr[at], opened, at)
        self.people = {self.owner[at]: m.body_mocapid[at] for at in range(m.nbody) if m.body_mocapid[at] >= 0}
        self.cameras = [unquote(m.camera(at).name) for at in range(m.ncam)]

    def text(self, called):
        """A text of the model."""
        at = mujoco.mj_name2id(self.mj, mujoco.mjtObj.mjOBJ_TEXT, called)
        if at < 0:
            raise ModelError("the model has no text `%s`; write it with `motet robots mjcf`" % called)
        start, size = self.mj.text_adr[at], self.mj.text_size[at]
        return bytes(self.mj.text_data[start : start + size - 1]).decode()

    def mass(self, thing):
        """Mass of an entity in kg."""
        return float(self.mj.body_mass[self.body_of[thing]])

    def leaf_of(self, container):
        """Body in whose frame the inside of a container is: that of its drawer, where it has one."""
        is_drawer = "slide" in self.entities[container].get("travel", {})
        body = self.body_of[container]
        return self.body_of.get(container + "/door", body) if is_drawer else body

    def drawn(self, container):
        """Offset in m in the map by which an open drawer is off its place; None of what is no drawer."""
        return drawn(self.entities[container])

    def posture(self, called):
        """Targets of all actuators in a posture, or None."""
        at = mujoco.mj_name2id(self.mj, mujoco.mjtObj.mjOBJ_KEY, "posture/" + name(called))
        return None if at < 0 else np.array(self.mj.key_ctrl[at])

    @property
    def arm(self):
        """Actuators of neither base nor hand."""
        first = 3 if self.drives else 0
        return [at for at in range(first, self.mj.nu) if at not in self.grips]


def drawn(entity):
    """Offset in m in the map by which an entity, an open drawer, is off its place; None of what is no
    drawer."""
    slide = entity.get("travel", {}).get("slide")
    if slide is None or "pose" not in entity:
        return None
    off = np.zeros(3)
    mujoco.mju_rotVecQuat(off, np.array(slide["axis"]) * slide["distance"], turned(entity["pose"]))
    return off


def is_hand(called):
    """True for the name of a part of the hand."""
    head, _, tail = called.partition("/")
    return head == "hand" and tail.isdigit()


def load(robot, scene, command):
    """The model of a robot in a scene, both as the command line names them."""
    return Model(motet(command, "robots", "mjcf", "--robot", robot, "--scene", scene), robot)
