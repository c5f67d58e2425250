"""Eyes: what the robot sees, as detections with the ids of what it knows.

By pixels: pictures go to a detector, another than that by colour and shape in a process of its own, and what it finds
is matched with the things that the robot believes to be about there. With `--oracle`, by the truth of the simulator.
"""

import copy
import json
import os
import subprocess

import mujoco
import numpy as np

from . import aim, sight
from .beliefs import ELSEWHERE
from .camera import Camera, NoGraphics
from .chance import Chance
from .detector import belongs, detect, wire
from .model import turned
from .world import OPENED

# Distance in m within which a detection may be a known thing, and the part of its size by which it may differ.
ABOUT, UNLIKE = 0.3, 0.75
# The same part for a thing that may be anywhere, and the part of its width below which what is seen is none.
UNLIKE_ANYWHERE, SLIVER = 0.3, 0.4
# Every which row and column of a depth picture is looked at, for what is known; the distance in m up to which a point
# is on it, and the number of points that show it.
GRID, ON, ENOUGH = 6, 0.02, 8
# Distance in m from a thing up to which what is seen is a part of it, and the share of its size below which a view
# of it is of a part.
PART, PARTLY = 0.03, 0.8
# Rate at which the detector by colour and shape misses a thing of 10 cm at 1 m without any chance, as
# `motet_mujoco.calibrate` measures it: `camera.miss` of a profile contains it.
MISSED = 0.012
# Length in m by which a side of a box is longer than it would be if the box were not turned.
TURNED = 0.01
# Distances in m by which a pile is higher than each thing in it, and by which a view of it is smaller.
PILED, HIDDEN = 0.005, 0.02
# Parts of the travel of a drawer or door that are told apart, finer places about the best of them that are
# compared, and the distance in m up to which a point is on the leaf.
STEPS, FINE, LEAF = 5, 41, 0.01
# Share of the way to a thing within which what a camera would meet is what it is mounted on.
OWN = 0.2
# Distance in m behind a thing from which on what shows there shows that the thing is gone, and the pixels of the rim
# of a picture that show nothing of it.
BEHIND, FRAME = 0.06, 4
# Motion in m or rad up to which a picture is not taken anew.
SAME = 2e-4


class Eyes:
    """Detections of all cameras of the robot."""

    def __init__(self, world, beliefs, oracle=False, rates=None, chance=None, command=None):
        self.world, self.beliefs = world, beliefs
        self.oracle, self.chance = oracle, chance or Chance(0)
        self.rates = rates or {"error_per_m": 0.0, "miss": 0.0, "confuse": 0.0}
        self.told = {}  # where the host was told that something is
        self.camera = Camera(world)
        self.command, self.process = command, None
        self.last, self.at, self.sure, self.pictures = [], -1.0, set(), []
        # What the last pictures were taken of, what the detector found in them, and how far doors are open in them.
        self.viewed, self.found, self.shares, self.beyond = None, [], {}, None

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
        # The surest comes first.
        self.last.sort(key=lambda one: -one["confidence"])
        self.at = self.world.now
        self.sure = {one["id"] for one in self.last if one["id"] is not None}
        for one in self.last:
            if one["id"] in self.beliefs.things():
                # Pixels tell where it is, not how it is turned.
                quaternion = self.world.pose(one["id"])[1] if self.oracle else None
                self.beliefs.looked(one["id"], np.array(one["pose"]["xyz"]), quaternion)
        return self.last

    def refresh(self):
        """Looks at what is in view. What is seen is noted, and what is not where it is believed to be is gone."""
        self.detections()
        for thing in self.beliefs.things():
            if thing not in self.sure and thing != self.beliefs.hand and self.is_gone(thing):
                self.beliefs.forget(thing)
        self.see_doors()

    def see_doors(self):
        """Notes which drawers and doors are seen to be open or closed."""
        for container in self.world.model.doors:
            if self.oracle:
                self.beliefs.opened(container, self.world.is_open(container))
                continue
            share = self.opening(container)
            if share is not None:
                self.beliefs.opened(container, share > OPENED, share)

    def is_gone(self, thing):
        """True if a depth picture shows what is behind the place where a thing is believed to be."""
        known = self.beliefs.entities.get(thing, {})
        if "pose" not in known or thing in self.beliefs.given:
            return False
        middle = np.array(known["pose"]["xyz"], dtype=float)
        up = np.array([0.0, 0.0, 0.5 * sight.halves(known.get("shape", {}))[0]])
        return any(all(picture.shows_behind(point, BEHIND, FRAME) for point in (middle - up, middle, middle + up))
                   for picture in self.pictures)

    def erred(self, found):
        """Detections with the errors of the profile: some are missed, some taken for another, all a little off."""
        kept, rates, eye = [], self.rates, self.eye()
        missed = rates["miss"] if self.oracle else max(0.0, rates["miss"] - MISSED)
        for at, one in enumerate(found):
            of, far = one["id"] or "%d" % at, float(np.linalg.norm(np.array(one["pose"]["xyz"]) - eye))
            # As a thing of 10 cm at 1 m would be.
            small = max(1.0, far * 0.1 / max(float(np.max(one["extent"])), 0.01))
            if self.chance.comes(min(missed * small, 1.0), "miss", of):
                continue
            off = self.chance.error(rates["error_per_m"] * far, "place", of)
            if one.pop("is_kept", False):
                # The place is the believed one: it was not measured, and its error does not grow.
                off = np.zeros(2)
            one["pose"]["xyz"] = [round(float(part), 4) for part in np.array(one["pose"]["xyz"]) + [*off, 0.0]]
            kept.append(one)
        entities = self.beliefs.entities
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

    def news(self, has_left=False):
        """Detections that the host does not know of: things without an id, and things elsewhere than it was told; also
        of those out of view, if the hand may have left some."""
        new, held = [], self.beliefs.in_hand()
        self.refresh()
        for one in [*self.last, *(self.felt() if has_left else [])]:
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
                    # As the host was told, in the room that it knows.
                    was = np.array(self.beliefs.first.get(one["id"], (1e3, 1e3, 1e3)))
                if np.linalg.norm(place - was) < ELSEWHERE:
                    continue
                self.told[one["id"]] = place
            new.append(one)
        return new

    def felt(self):
        """Things that are out of view where they were seen or felt last, as detections."""
        for thing in sorted(self.beliefs.seen - self.sure):
            known = self.beliefs.entities[thing]
            if "pose" in known:
                w, x, y, z = (float(part) for part in turned(known["pose"]))
                pose = {"xyz": list(known["pose"]["xyz"]), "quaternion": [x, y, z, w]}
                label = (known.get("names") or [known.get("class") or thing])[0]
                yield {"label": label, "id": thing, "pose": pose, "confidence": 1.0,
                       "extent": [float(part) for part in extent(known)]}

    def size(self, position):
        """Sides in m of what was last seen at a place, without an id; None where nothing was."""
        near = [one for one in self.last if one["id"] is None
                and np.linalg.norm(np.array(one["pose"]["xyz"]) - position) < ELSEWHERE]
        return near[0]["extent"] if near else None

    def take(self, thing, position):
        """Notes that the host was told of a thing, and that what is in view is to be matched anew."""
        self.at = -1.0
        self.told.pop(thing, None)
        if position is not None:
            self.told[thing] = np.array(position, dtype=float)

    def known(self, wanted):
        """Ids among those wanted that are in view now."""
        self.detections()
        fixed = [one for one in wanted if one not in self.beliefs.things() and one in self.world.model.body_of]
        return {one for one in wanted if one in self.sure} | {one for one in fixed if self.shows(one)}

    def shows(self, one):
        """True if furniture or a person is in view: the depth pictures have points where it should be."""
        if self.oracle:
            return self.world.is_visible(one)
        is_seen = any(np.count_nonzero(gaps <= ON) >= ENOUGH for gaps in self.gaps(one))
        # A drawer that stands open hides the rest of what it is in.
        return is_seen or self.sees_open(one) is not None

    def gaps(self, one):
        """Distances in m of the points of the depth pictures from where an entity is believed to be."""
        for picture in self.pictures:
            gaps = self.beliefs.gaps(one, picture.samples(GRID))
            if gaps is not None:
                yield gaps

    def sees_open(self, container):
        """True if a drawer or a door is seen to be open, False if it is seen to be closed; None if it is not seen."""
        if self.oracle:
            return self.world.is_open(container)
        share = self.opening(container) if container in self.world.model.doors else None
        return None if share is None else share > OPENED

    def opening(self, container):
        """Share of its travel by which a drawer or a door is seen to be open; None if it is not seen."""
        if container not in self.shares:
            self.shares[container] = self.measured(container)
        return self.shares[container]

    def measured(self, container):
        """The share by which a drawer or a door is open in the pictures."""
        model = self.world.model
        joint, opened, _ = model.doors[container]
        at_body = {body: np.flatnonzero(model.mj.geom_bodyid == model.body_of[body])
                   for body in (container, container + "/door")}
        leaf, data, room = at_body[container + "/door"], mujoco.MjData(model.mj), self.beliefs.room()
        middle, far = room.xpos[model.body_of[container]], sweep(model, container)
        if self.beyond is None:
            # What is seen of the robot itself with what it holds is no leaf.
            self.beyond = np.concatenate([np.zeros((0, 3)), *(picture.samples(GRID) for picture in self.pictures)])
            for solid in self.own():
                self.beyond = self.beyond[~belongs(self.beyond, solid)]
        points = self.beyond[np.linalg.norm(self.beyond - middle, axis=1) <= far]
        if len(points) < ENOUGH:
            return None
        # Nor is the frame.
        for solid in self.solids(at_body[container]):
            points = points[~belongs(points, solid)]
        data.qpos[:], data.mocap_pos[:] = room.qpos, room.mocap_pos

        def on_leaf(share, near):
            data.qpos[joint] = opened * share
            mujoco.mj_kinematics(model.mj, data)
            return np.count_nonzero(within(model.mj, data, leaf, points, near))

        counts = [on_leaf(step / STEPS, LEAF) for step in range(STEPS + 1)]
        best = int(np.argmax(counts))
        if counts[best] < ENOUGH:
            return None
        # A leaf that is not quite where it should be would stand out beside its place like a thing.
        shares = np.clip(best / STEPS + np.linspace(-0.5, 0.5, FINE) / STEPS, 0.0, 1.0)
        fine = np.array([on_leaf(share, LEAF / 2.0) for share in shares])
        return float(np.mean(shares[fine >= 0.98 * fine.max()]))

    def pose(self, one):
        """Position and rotation of an entity as it was last seen, or else as it is believed to be; None if nothing
        is known of it."""
        for found in self.last:
            if found["id"] == one:
                x, y, z, w = found["pose"]["quaternion"]
                return np.array(found["pose"]["xyz"]), np.array([w, x, y, z])
        if self.oracle:
            return self.world.pose(one)
        pose = self.beliefs.entities.get(one, {}).get("pose")
        return None if pose is None else (np.array(pose["xyz"], dtype=float), turned(pose))

    def truth(self):
        """What the simulator knows to be in view."""
        found = []
        for thing in self.world.model.free:
            # Where the robot holds a thing, it knows it.
            if not self.world.is_visible(thing):
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
        for person in self.world.model.people:
            self.beliefs.scan(person)
        if not self.is_same(self.view()[:1]):
            self.pictures, self.shares = [self.camera.look(name) for name in self.world.model.cameras], {}
            self.viewed = self.beyond = None
        self.see_doors()
        view = self.view()
        if not self.is_same(view):
            solids = self.solids()
            self.viewed, self.found = view, [one for picture in self.pictures for one in self.detect(picture, solids)]
        for one in copy.deepcopy(self.found):
            found.extend(self.parts(one))
        held = self.beliefs.in_hand()
        for thing in held:
            # Where the hand holds it, the robot knows it, and what is seen there is no other thing.
            self.beliefs.saw(thing, *self.beliefs.held_pose(thing))
        self.assign(found)
        parts = {one["id"] for one in found}.union(held)
        return [one for one in found if one["id"] is not None
                or not self.is_part(one, parts | self.larger(one))]

    def view(self):
        """What pictures are taken of, and what the detector knows of it: positions in the world, and those of doors and
        people as they are believed to be."""
        model, data = self.world.model, self.world.data
        room, doors = self.beliefs.room(), [at for at, _, _ in model.doors.values()]
        world = np.concatenate([data.qpos, data.mocap_pos.ravel(), data.mocap_quat.ravel()])
        return [world, np.concatenate([room.qpos[doors], room.mocap_pos.ravel()])]

    def is_same(self, view):
        """True if the last pictures show a view, or the first parts of one."""
        return self.viewed is not None and all(
            np.abs(one - other).max(initial=0.0) < SAME for one, other in zip(view, self.viewed))

    def assign(self, found):
        """Gives detections the ids of known things, the best fit first. A piece of a thing that is where it
        should be, in its colour, is no other thing that moved there."""
        fits = sorted((worth, at, thing) for at, one in enumerate(found) for worth, thing in self.fits(one))
        colours, entities = {}, self.beliefs.entities
        for _, at, thing in fits:
            one = found[at]
            if one["id"] is not None or thing in colours:
                continue
            place, colour = one["pose"]["xyz"], one["label"].split()[0]
            alike = [other for other, painted_as in colours.items() if painted_as == colour]
            if self.beliefs.gap(thing, place) not in (None, 0.0) and self.is_part(one, alike):
                continue
            one["id"], colours[thing] = thing, colour
        for one in found:
            if one["id"] is not None:
                entity = entities[one["id"]]
                one["label"] = (entity.get("names") or [entity.get("class") or one["id"]])[0]
                one["pose"]["xyz"] = self.middle(one)

    def parts(self, one):
        """A detection, or both things where it is as high as two known ones of its colour, one on the other, about
        there: in a picture they are one."""
        position, high = np.array(one["pose"]["xyz"]), one["extent"][2]
        things = {thing: self.beliefs.entities[thing] for thing in self.beliefs.things()}
        for pair in ([upper, things[upper["on"]]] for upper in things.values() if upper.get("on") in things):
            off, sizes = self.off(pair[1], position), np.array([extent(part) for part in pair])
            heights = sizes[:, 2]
            wide = abs(max(one["extent"][:2]) - np.max(sizes[:, :2]))
            is_pile = max(heights) + PILED < high < sum(heights) + PILED and high > sum(heights) - HIDDEN
            if off is None or off > ABOUT or not is_pile or wide > HIDDEN or not all(
                    painted(part, one["label"]) for part in pair):
                continue
            top = position[2] + high / 2.0
            return [dict(one, extent=[*one["extent"][:2], float(own)],
                         pose=dict(one["pose"], xyz=[*one["pose"]["xyz"][:2], round(float(middle), 4)]))
                    for own, middle in zip(heights, (top - heights[0] / 2.0, top - heights[0] - heights[1] / 2.0))]
        return [one]

    def middle(self, one):
        """Middle of a known thing of which a side was seen. A part of it that is seen where the thing should be says
        that it is there."""
        believed = self.beliefs.entities[one["id"]]
        seen, whole = np.array(one["extent"]), extent(believed)
        is_part = np.max(seen) < PARTLY * np.max(whole)
        if is_part and self.beliefs.gap(one["id"], one["pose"]["xyz"]) in (None, 0.0) and "pose" in believed:
            place = np.array(believed["pose"]["xyz"], dtype=float)
            if "cylinder" in believed.get("shape", {}) and np.abs(seen - whole)[:2].max() < 0.1 * whole[0]:
                # The curve of any part of its side says where its axis is.
                place[:2] = one["pose"]["xyz"][:2]
            else:
                one["is_kept"] = True
            return [round(float(part), 4) for part in place]
        return centred(one, believed, self.eye())

    def larger(self, one):
        """Believed things of which a detection may be a part by its size and its colour."""
        things = {thing: self.beliefs.entities[thing] for thing in self.beliefs.things()}
        return {thing for thing, entity in things.items() if painted(entity, one["label"])
                and np.max(one["extent"]) < PARTLY * np.max(extent(entity))}

    def is_covered(self, thing):
        """True if the robot itself hides the middle of a thing where it is believed to be, as its own joints tell."""
        pose, model, room = self.beliefs.entities.get(thing, {}).get("pose"), self.world.model, self.beliefs.room()
        if self.oracle or pose is None or not model.cameras:
            return False
        way = np.array(pose["xyz"], dtype=float) - self.eye()
        far, _ = sight.ray(model, room, self.eye() + OWN * way, self.eye() + way, sight.ROBOT)
        return 0.0 <= far < (1.0 - OWN) * np.linalg.norm(way)

    def cut_off(self, wanted):
        """Places of detections without an id that may be things of some ids, of which the rim of a picture cuts off the
        rest."""
        things = [self.beliefs.entities[thing] for thing in wanted if thing in self.beliefs.things()]
        return [one["pose"]["xyz"] for one in self.last if one["id"] is None and any(
            painted(entity, one["label"]) and np.max(one["extent"]) < 1.1 * np.max(extent(entity)) for entity in things)]

    def is_part(self, one, taken):
        """True for a detection that is a part of a thing of which another part was recognised, as where something
        stands before its middle."""
        gaps = [self.beliefs.gap(thing, one["pose"]["xyz"]) for thing in taken]
        return any(gap is not None and gap <= PART for gap in gaps)

    def fits(self, one):
        """Believed things that a detection may be, each with how badly it fits."""
        position, size, held = np.array(one["pose"]["xyz"]), np.array(one["extent"]), self.beliefs.in_hand()
        is_held = self.is_part(one, held)
        for thing in self.beliefs.things():
            entity = self.beliefs.entities[thing]
            if not painted(entity, one["label"]) or (thing in held) is not is_held:
                continue
            off, like = self.off(entity, position), unlike(size, extent(entity))
            lost = self.beliefs.lost.get(thing) if off is None else None
            if lost is not None and np.linalg.norm(position - lost) <= ABOUT:
                # It is most likely not far from where it was.
                off = float(np.linalg.norm(position - lost))
            if off is None and np.sort(size)[1] < SLIVER * np.sort(extent(entity))[1]:
                continue
            if off is not None and off <= ABOUT and like <= UNLIKE or off is None and like <= UNLIKE_ANYWHERE:
                # What is known to be about there comes before what may be anywhere.
                yield (2.0 if off is None else off / ABOUT) + like, thing

    def off(self, entity, position):
        """Distance in m from where a thing is believed to be, or from what it is on or in; None if it may be
        anywhere."""
        pose = entity.get("pose")
        if pose is not None:
            return float(np.linalg.norm(position - np.array(pose["xyz"])))
        support = entity.get("on") or entity.get("in")
        return None if support is None else self.beliefs.gap(support, position)

    def detect(self, picture, solids):
        """What the detector finds in a picture, as the driver protocol writes it."""
        if self.command is None:
            return wire(detect(picture, solids))
        return self.ask(dict(picture.message(), solids=solids))

    def ask(self, message):
        """The answer of a detector in a process of its own."""
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

    def solids(self, geoms=None):
        """Known furniture with its drawers and doors and people as they are believed to be, and the robot itself; or
        some geoms."""
        model, data = self.world.model, self.beliefs.room()
        solids = []
        for at in range(model.mj.ngeom) if geoms is None else geoms:
            owner = model.geom_owner[at]
            if owner is None or geoms is None and owner in model.free:
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

    def own(self):
        """Solids of the robot itself with what it holds."""
        owners = np.array(self.world.model.geom_owner, dtype=str)
        return self.solids(np.flatnonzero(np.isin(owners, ["robot", *self.beliefs.in_hand()])))

    def aside(self, corners):
        """How to turn the camera on the hand about itself so that the hand does not hide some points of the
        map, as rows: (place of the camera, rotation). None where it does not, or where the camera is not on
        the hand."""
        model = self.world.model
        mj = model.mj
        if self.oracle or not model.cameras or model.tip < 0:
            return None
        bodies = mj.cam_bodyid[mj.camera(model.cameras[0]).id], mj.site_bodyid[model.tip]
        if mj.body_weldid[bodies[0]] != mj.body_weldid[bodies[1]]:
            return None
        picture = self.look()
        turn = aim.turn(picture, aim.covered(picture, self.own()), corners)
        return None if turn is None else (picture.position, turn)

    def close(self):
        """Ends the detector."""
        if self.process is not None:
            self.process.stdin.close()
            self.process.wait(timeout=5)


def sweep(model, container):
    """Distance in m from a container within which its leaf stays on all of its way, with what counts as being on it."""
    mj, at, (_, opened, joint) = model.mj, model.body_of[container + "/door"], model.doors[container]
    geoms = np.flatnonzero(mj.geom_bodyid == at)
    leaf = max(float(np.linalg.norm(mj.geom_pos[geom])) + float(mj.geom_rbound[geom]) for geom in geoms)
    return float(np.linalg.norm(mj.body_pos[at]) + 2.0 * np.linalg.norm(mj.jnt_pos[joint])) + leaf + abs(opened) + LEAF


def within(mj, data, geoms, points, near):
    """Points, as rows, that are in one of some boxes, or nearer to it than so many m."""
    found = np.zeros(len(points), dtype=bool)
    for at in geoms:
        if mj.geom_type[at] == mujoco.mjtGeom.mjGEOM_BOX:
            local = (points - data.geom_xpos[at]) @ data.geom_xmat[at].reshape(3, 3)
            is_in = np.abs(local) <= mj.geom_size[at] + near
            found |= is_in[:, 0] & is_in[:, 1] & is_in[:, 2]
    return found


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


def centred(one, entity, eye):
    """Middle of a known thing whose near side was seen from an eye: its top is seen, and its height is that
    of its shape. What a box has more than was seen of it is behind that side."""
    position, size = np.array(one["pose"]["xyz"]), np.array(one["extent"])
    position[2] += size[2] / 2.0 - extent(entity)[2] / 2.0
    if "box" in entity.get("shape", {}) and "pose" in entity:
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, turned(entity["pose"]))
        hidden = (np.abs(rotation.reshape(3, 3)) @ extent(entity) - size)[:2]
        # A side that is longer than it should be is one of a thing that is turned.
        if hidden.min() > -TURNED:
            most, ahead = np.maximum(hidden, 0.0) / 2.0, int(np.argmax(np.abs(position - eye)[:2]))
            # Across the view it may be hidden on either side: it is where it is believed to be.
            shift = np.clip(np.array(entity["pose"]["xyz"])[:2] - position[:2], -most, most)
            shift[ahead] = np.sign(position - eye)[ahead] * most[ahead]
            position[:2] += shift
    return [round(float(part), 4) for part in position]
