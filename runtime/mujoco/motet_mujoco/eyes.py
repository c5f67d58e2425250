"""Eyes: what the robot sees, as detections with the ids of what it knows.

By pixels: pictures go to a detector in a process of its own, and what it finds is matched with the things that the
robot believes to be about there. With `--oracle`, by the truth of the simulator.
"""

import json
import os
import subprocess
import sys

import numpy as np

from .camera import Camera, NoGraphics
from .chance import Chance

# Distance in m within which a detection may be a known thing, and the part of its size by which it may differ.
ABOUT, UNLIKE = 0.3, 0.75
# Distance in m from which a thing counts as being elsewhere.
ELSEWHERE = 0.08


class Eyes:
    """Detections of all cameras of the robot."""

    def __init__(self, world, observer, beliefs, oracle=False, rates=None, chance=None, command=None):
        self.world, self.observer, self.beliefs = world, observer, beliefs
        self.oracle, self.chance = oracle, chance or Chance(0)
        self.rates = rates or {"error_per_m": 0.0, "miss": 0.0, "confuse": 0.0}
        self.told = {}  # where the host was told that something is
        self.camera = Camera(world)
        self.command = command or [sys.executable, "-m", "motet_mujoco.detector"]
        self.process, self.last, self.at, self.sure = None, [], -1.0, set()

    def look(self, name=None):
        """A picture of a camera; of the first without a name."""
        cameras = self.world.model.cameras
        if not cameras:
            return None
        if name is not None and name not in cameras:
            return None
        return self.camera.look(name or cameras[0])

    def detections(self):
        """What is in view now, as the driver protocol writes it."""
        if self.at == self.world.now:
            return self.last
        self.last = self.erred(self.truth() if self.oracle else self.matched())
        self.at = self.world.now
        self.sure = {one["id"] for one in self.last if one["id"] is not None}
        for one in self.last:
            if one["id"] in self.world.model.free:
                # Pixels tell where it is, not how it is turned.
                quaternion = self.world.pose(one["id"])[1] if self.oracle else None
                self.beliefs.saw(one["id"], np.array(one["pose"]["xyz"]), quaternion)
        return self.last

    def erred(self, found):
        """Detections with the errors of the profile: some are missed, some taken for another, all a little off."""
        kept, rates, eye = [], self.rates, self.eye()
        for at, one in enumerate(found):
            of, far = one["id"] or "%d" % at, float(np.linalg.norm(np.array(one["pose"]["xyz"]) - eye))
            # As a thing of 10 cm at 1 m would be.
            small = max(1.0, far * 0.1 / max(float(np.max(one["extent"])), 0.01))
            if self.chance.comes(min(rates["miss"] * small, 1.0), "miss", of):
                continue
            off = self.chance.error(rates["error_per_m"] * far, "place", of)
            one["pose"]["xyz"] = [round(float(part), 4) for part in np.array(one["pose"]["xyz"]) + [*off, 0.0]]
            kept.append(one)
        entities = self.world.model.entities
        for at, one in enumerate(kept):
            alike = [other for other in kept[at + 1 :] if one["id"] and other["id"]
                     and entities[one["id"]].get("class") == entities[other["id"]].get("class")]
            if alike and self.chance.comes(rates["confuse"], "confuse", one["id"]):
                for key in ("id", "label"):
                    one[key], alike[0][key] = alike[0][key], one[key]
        return kept

    def eye(self):
        """Position of the first camera, or of the base without one."""
        model = self.world.model
        if not model.cameras:
            return np.array([*self.world.base()[:2], 1.0])
        return self.world.data.cam_xpos[model.mj.camera(model.cameras[0]).id].copy()

    def news(self):
        """Detections that the host does not know of: things without an id, and things elsewhere than it was told."""
        new, held = [], self.world.held()
        for one in self.detections():
            place = np.array(one["pose"]["xyz"])
            if one["id"] in held:
                continue
            if one["id"] is None:
                unknown = [at for key, at in self.told.items() if isinstance(key, tuple)]
                if any(np.linalg.norm(place - at) < ABOUT for at in unknown):
                    continue
                self.told[(one["label"], tuple(place))] = place
            else:
                was = self.told.get(one["id"])
                if was is None:
                    was = np.array(self.world.model.entities[one["id"]]["pose"]["xyz"])
                if np.linalg.norm(place - was) < ELSEWHERE:
                    continue
                self.told[one["id"]] = place
            new.append(one)
        return new

    def known(self, wanted):
        """Ids among those wanted that are in view now."""
        self.detections()
        fixed = [one for one in wanted if one not in self.world.model.free and one in self.world.model.body_of]
        return {one for one in wanted if one in self.sure} | {one for one in fixed if self.observer.is_visible(one)}

    def pose(self, one):
        """Position and rotation of an entity as it was last seen."""
        for found in self.last:
            if found["id"] == one:
                x, y, z, w = found["pose"]["quaternion"]
                return np.array(found["pose"]["xyz"]), np.array([w, x, y, z])
        return self.world.pose(one)

    def truth(self):
        """What the simulator knows to be in view."""
        found = []
        for thing in self.world.model.free:
            # Where the robot holds a thing, it knows it.
            if not any(self.observer.sees(camera, thing) for camera in self.world.model.cameras):
                continue
            position, (w, x, y, z) = self.world.pose(thing)
            entity = self.world.model.entities[thing]
            found.append({"label": (entity.get("names") or [entity.get("class") or thing])[0], "id": thing,
                          "pose": {"xyz": [float(part) for part in position],
                                   "quaternion": [float(x), float(y), float(z), float(w)]},
                          "extent": [float(part) for part in extent(entity)], "confidence": 1.0})
        return found

    def matched(self):
        """What the detector finds in the pictures of all cameras, with the ids of known things."""
        found = []
        for name in self.world.model.cameras:
            picture = self.camera.look(name)
            found.extend(self.ask(dict(picture.message(), solids=self.solids())))
        taken = set()
        for one in found:
            one["id"] = self.match(one, taken)
            if one["id"] is not None:
                taken.add(one["id"])
                entity = self.world.model.entities[one["id"]]
                one["label"] = (entity.get("names") or [entity.get("class") or one["id"]])[0]
                one["pose"]["xyz"] = centred(one, entity)
        return found

    def match(self, one, taken):
        """Id of the believed thing that a detection fits best; None for something new."""
        position, size = np.array(one["pose"]["xyz"]), np.array(one["extent"])
        best = None
        for thing in self.world.model.free:
            entity = self.beliefs.entities[thing]
            pose = entity.get("pose")
            if thing in taken or pose is None:
                continue
            off = float(np.linalg.norm(position - np.array(pose["xyz"])))
            like = unlike(size, extent(entity))
            colour = 0.0 if painted(entity, one["label"]) else 0.3
            if off <= ABOUT and like <= UNLIKE and colour == 0.0:
                worth = off / ABOUT + like
                if best is None or worth < best[0]:
                    best = (worth, thing)
        return best[1] if best else None

    def ask(self, message):
        """The answer of the detector."""
        if self.process is None or self.process.poll() is not None:
            # The package need not be installed.
            here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
            paths = [here, os.environ.get("PYTHONPATH", "")]
            environment = dict(os.environ, PYTHONPATH=os.pathsep.join(path for path in paths if path))
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                            env=environment)
        self.process.stdin.write(json.dumps(message) + "\n")
        self.process.stdin.flush()
        line = self.process.stdout.readline()
        if not line:
            raise NoGraphics("the detector ended")
        return json.loads(line)["detections"]

    def solids(self):
        """Known furniture with its drawers and doors as they now are, people, and the robot itself."""
        model, data = self.world.model, self.world.data
        solids = []
        for at in range(model.mj.ngeom):
            owner = model.geom_owner[at]
            if owner is None or owner in model.free:
                continue
            kind, size = model.mj.geom_type[at], model.mj.geom_size[at]
            solid = {"xyz": data.geom_xpos[at].tolist(), "rotation": data.geom_xmat[at].reshape(3, 3).tolist()}
            if kind == 6:  # box
                solid["box"] = size.tolist()
            elif kind == 5:  # cylinder
                solid["cylinder"] = [float(size[0]), float(size[1])]
            elif kind == 3:  # capsule
                solid["cylinder"] = [float(size[0]), float(size[1] + size[0])]
            elif kind == 2:  # sphere
                solid["box"] = [float(size[0])] * 3
            else:
                continue
            solids.append(solid)
        return solids

    def close(self):
        """Ends the detector."""
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait(timeout=5)


def extent(entity):
    """Sides of the box around an entity as it stands."""
    shape = entity.get("shape", {})
    if "box" in shape:
        return np.array(shape["box"], dtype=float)
    if "sphere" in shape:
        return np.full(3, 2.0 * shape["sphere"]["radius"])
    if "cylinder" in shape:
        radius, height = shape["cylinder"]["radius"], shape["cylinder"]["height"]
        return np.array([2.0 * radius, 2.0 * radius, height])
    if "capsule" in shape:
        radius, height = shape["capsule"]["radius"], shape["capsule"]["height"]
        return np.array([2.0 * radius, 2.0 * radius, height + 2.0 * radius])
    return np.full(3, 0.06)


def unlike(one, other):
    """Greatest relative difference of two extents, sorted: the sides of a turned thing change places."""
    one, other = np.sort(one), np.sort(other)
    return float(abs(np.log(np.maximum(one[-1], 1e-3) / np.maximum(other[-1], 1e-3))))


def painted(entity, label):
    """True unless the names of an entity say another colour than the label of a detection."""
    from .detector import COLOURS

    words = " ".join([*entity.get("names", []), entity["id"]]).lower().replace("_", " ").split()
    said = [word for word in words if word in COLOURS]
    return not said or label.split()[0] in (said[0], *ALIKE.get(said[0], ()))


# Colours that light turns into each other.
ALIKE = {"orange": ("brown", "red", "yellow"), "brown": ("orange", "red"), "purple": ("pink", "blue"),
         "black": ("grey",), "white": ("grey",), "grey": ("white", "black"), "yellow": ("orange",), "pink": ("red",)}


def centred(one, entity):
    """Middle of a known thing whose near side was seen: its top is seen, and its height is that of its shape."""
    position = np.array(one["pose"]["xyz"])
    position[2] += one["extent"][2] / 2.0 - extent(entity)[2] / 2.0
    return [round(float(part), 4) for part in position]
