"""Looking: how primitives turn the camera to what they are about, and where the base drives so that it shows.

Its parts are generators, as those of `moving.py`.
"""

import itertools

import numpy as np

from .camera import NoGraphics
from .eyes import extent
from .motion import near_turn
from .moving import SPARE, THINKS, Failed, Mover
from .planner import quoted, stand_at
from .sight import shows

# Id of what may be in a container.
INSIDE = "inside"
# Distances in m of the base from a hidden spot, beyond the reach of the robot. The spot is most often in or on something
# larger.
AROUND = (0.2, 0.1, -0.05)
# More of them from which it can be looked at, and the height in m at which the base has to have room there.
FARTHER, LOW = (0.5, 0.9), 0.15
# Distance in m from a spot up to which what stands before it may be what is looked for.
AT_SPOT = 0.15
# Directions in rad in which places around a spot are tried, from the direction of the robot.
TURNS = (0.0, 0.5, -0.5, 1.0, -1.0, 1.5, -1.5, 2.0, -2.0)
# Directions between them, for a robot that is to put something down: from few places it has a short way for that.
BETWEEN = (0.25, -0.25, 0.75, -0.75, 1.25, -1.25, 1.75, -1.75)
# Detour in m of the base, beyond a straight drive to a place, that is short enough: no more places are tried then.
DETOUR = 1.0
# Distance in m of the base from a thing up to which it looks for a better place to see it, and from a place up to which
# it looks there for what may be anywhere.
ABOUT_HERE = 2.0
# How often a camera on the hand is turned at most so that the hand does not hide a thing.
AIMS = 2
# How many things that look like a part of one that is sought are looked at once more.
PARTS = 2
# Seconds within which a camera turns to a place that is near at full speed.
TURNS_IN = 1.6
# Seconds that a look takes once the camera stands still.
LOOKS = 0.5


class Looker(Mover):
    """Moves the robot of a world, and looks."""

    def __init__(self, world, observer, beliefs, planner, eyes, options):
        super().__init__(world, observer, beliefs, planner, options)
        self.eyes = eyes

    def glance(self):
        """Looks at what is in view, if the robot can see."""
        try:
            self.eyes.refresh()
        except NoGraphics:
            return

    def look(self, one, motion, place=None):
        """Turns the camera to an entity, or to where it may be. What is hidden from here is looked at from another
        place. Fails with `not_found` where it does not come into view."""
        query = "look(%s)" % quoted(one)
        try:
            path = yield from self.motion(motion, query, "not_found", self.supposing(one, place))
        except Failed:
            spot = self.beliefs.entities[one].get("pose", {}).get("xyz") if place is None else place
            if spot is None or not self.may_show(one, spot):
                raise
            if not (yield from self.around(query, one, place, spot, motion, motion.until - TURNS_IN * motion.stretch)):
                raise
            path = yield from self.motion(motion.part(), query, "not_found", self.supposing(one, place))
        yield from self.follow(path)
        yield from self.uncover(one, place, motion)
        yield from self.pause(0.1)

    def uncover(self, one, place, motion):
        """Turns a camera on the hand so that the hand does not hide where an entity should be, if there is time
        for that."""
        if one not in self.beliefs.things():
            return
        known = self.beliefs.entities[one]
        middle = known.get("pose", {}).get("xyz") if place is None else place
        if middle is None:
            return
        signs = np.array(list(itertools.product((-1.0, 1.0), repeat=3)))
        corners = np.array(middle) + signs * extent(known) / 2.0
        for _ in range(AIMS):
            found = self.eyes.aside(corners)
            if found is None:
                return
            eye, turn = found
            tip, rotation = self.world.tip()
            at, qpos = eye + turn @ (tip - eye), self.world.data.qpos
            target = self.world.reacher.solve(qpos, self.goal, at, turn @ rotation)
            if target is None:
                return
            for grip in self.world.model.grips:
                target[grip] = self.goal[grip]
            path = self.path([self.goal.copy(), target], motion)
            if self.world.now + path.end > motion.until - LOOKS or not self.is_way(self.goal, target):
                return
            try:
                yield from self.follow(path)
            except Failed:
                # What shows from here is looked at.
                return
            yield from self.pause(0.1)

    def may_show(self, one, spot):
        """True if another place near might show an entity: it is about here, and not shut in."""
        supports = self.room.supports(one) if one in self.beliefs.things() else []
        is_shut = any(self.room.is_open(support) is False for support in supports)
        return not is_shut and bool(np.hypot(*(self.world.base()[:2] - np.array(spot[:2]))) <= ABOUT_HERE)

    def seen(self, wanted, motion):
        """Ids of the entities, of some, that the camera sees now or after it has turned to where they should be: by the
        motion that was sent, where the robot stands at its beginning."""
        path = self.sent(motion)
        if path is not None:
            try:
                yield from self.follow(path)
            except Failed:
                # What shows from here is looked at.
                pass
        try:
            found = self.eyes.known(wanted)
        except NoGraphics as error:
            raise Failed("not_found", str(error)) from None
        for one in wanted:
            if one in found or one not in self.beliefs.entities:
                continue
            has_looked = False
            for place in self.beliefs.supposed(one) or [None]:
                try:
                    yield from self.look(one, motion if path is None and len(wanted) == 1 else motion.part(), place)
                except Failed:
                    continue
                found |= self.eyes.known(wanted)
                if one not in found and self.is_adrift and self.eyes.is_covered(one):
                    yield from self.fold(motion)
                    found |= self.eyes.known(wanted)
                has_looked |= not self.eyes.is_covered(one)
                if one in found:
                    break
            if has_looked and one not in found and one in self.beliefs.things() and one not in self.beliefs.in_hand():
                # It is not where it should be: anything alike in view is it.
                self.beliefs.forget(one)
                self.eyes.at = -1.0
                found |= self.eyes.known(wanted)
        return [one for one in wanted if one in found]

    def sought(self, wanted, motion):
        """Ids of the entities, of some, that the camera sees where they should be, or else about here."""
        return (yield from self.seen(wanted, motion)) or (yield from self.seen_about(wanted, motion))

    def seen_about(self, wanted, motion):
        """Ids of the entities, of some whose place nobody knows, that the camera sees at the first place about here
        that shows any of them: in an open container before on a surface."""
        known = self.beliefs.entities
        lost = [one for one in wanted if one in self.beliefs.things()
                and not any(part in known[one] for part in ("pose", "on", "in"))]
        far = {place: self.observer.gap(place) for place, entity in known.items() if self.may_hold(entity)}
        near = [place for place, gap in far.items() if gap is not None and gap <= ABOUT_HERE]
        # What stands open was most likely opened for this.
        for place in sorted(near, key=lambda place: (self.room.is_open(place) is not True, far[place])):
            if self.world.now > motion.until - TURNS_IN * motion.stretch:
                return []
            found = yield from self.seen_at(place, lost, motion)
            if found:
                return found
        return []

    def may_hold(self, entity):
        """True for a surface, and for a container that is not believed to be closed."""
        return entity["kind"] == "Surface" or entity["kind"] == "Container" and self.room.is_open(entity["id"]) is not False

    def seen_at(self, place, wanted, motion):
        """Ids of the entities, of some, that the camera sees when it looks at a place as a whole."""
        kind = self.beliefs.entities.get(place, {}).get("kind")
        if not wanted or kind not in ("Surface", "Container") or place not in self.world.model.body_of:
            return []
        seen = set()
        for at, spot in enumerate(self.beliefs.spread(place, kind == "Container", 0.05)):
            if at > 0 and self.world.now > motion.until - TURNS_IN * motion.stretch:
                break
            try:
                yield from self.look(INSIDE, motion.part(), spot)
            except Failed:
                continue
            seen = self.eyes.known(wanted) or (yield from self.seen_whole(wanted, motion))
            if seen:
                break
        return [one for one in wanted if one in seen]

    def seen_whole(self, wanted, motion):
        """Ids of the entities, of some, that the camera sees when it looks at what may be a part of one that the rim of
        the picture cuts off."""
        seen = set()
        for spot in self.eyes.cut_off(wanted)[:PARTS]:
            try:
                yield from self.look(INSIDE, motion.part(), spot)
            except Failed:
                continue
            seen = self.eyes.known(wanted)
            if seen:
                break
        return seen

    def supposing(self, one, place):
        """The room as it is believed to be; with an entity at a place, or with a small thing there under an id that
        nothing has. What lies in something hides neither."""
        scene = self.beliefs.now()
        if place is not None:
            own = self.beliefs.entities.get(one, {"id": one, "kind": "Object", "shape": {"sphere": {"radius": 0.02}}})
            others = [known for known in scene["entities"] if known["id"] != one]
            for known in others:
                if known.get("in"):
                    known.pop("pose", None)
            pose = {"xyz": [float(part) for part in place], "rpy": [0.0, 0.0, 0.0]}
            scene["entities"] = [*others, {**own, "pose": pose}]
        return scene

    def face(self, container, motion):
        """Drives to where the inside of an open container shows and is within reach, if it is not so here: the first
        thing that is believed to lie there, or the bottom; with a thing in the hand, to where the hand can put it in.
        True if the robot stands there then."""
        query, held = "look(%s)" % INSIDE, self.room.held()
        known = [one for one in self.beliefs.entities.values() if one.get("in") == container and "pose" in one]
        place = self.beliefs.places(container, True, 0.05)[0]
        if known and not held:
            place = np.array(known[0]["pose"]["xyz"], dtype=float)

        def way(stand):
            return self.way_to_put(held[0], container, stand) if held else 0.0

        is_here = self.observer.serves(container) and way(self.world.base()) <= DETOUR
        if is_here and self.planner.ask(self.supposing(INSIDE, place), query)[0] is not None:
            return True
        came = yield from self.around(query, INSIDE, place, place, motion, motion.until - SPARE, way)
        return came and self.observer.serves(container)

    def way_to_put(self, thing, on, stand):
        """Way in m of the base from a place to where the hand puts a thing down; infinite without one."""
        scene = self.beliefs.now()
        scene["robot"]["base"] = [float(part) for part in stand]
        query = "put(%s, %s)" % (quoted(thing), quoted(on))
        witness, _ = self.put_witness(scene, query, thing, self.planner.ask)
        return np.inf if witness is None else driven(witness)

    def stands(self, spot, is_look):
        """Poses of the base around a spot: those from which the hand reaches it, the nearest directions first. For a
        look also farther ones: first those with nothing between the spot and the camera, the nearest places first, and
        none where furniture is believed to stand."""
        model, (x, y, yaw) = self.world.model, self.world.base()
        towards, offs = float(np.arctan2(y - spot[1], x - spot[0])), (*AROUND, *FARTHER) if is_look else AROUND
        found = []
        for off, turn in itertools.chain(*(itertools.product(offs, some) for some in (TURNS, BETWEEN))):
            far, angle = model.card[1] + off, towards + turn
            found.append((spot[0] + far * np.cos(angle), spot[1] + far * np.sin(angle), near_turn(angle + np.pi, yaw)))
        if not is_look:
            return found
        # It may be enough to turn where the robot stands.
        found.append((x, y, near_turn(towards + np.pi, yaw)))
        base = np.array([[*stand[:2], LOW] for stand in found])
        gaps = [one for one in (self.beliefs.gaps(fixed, base) for fixed in model.body_of) if one is not None]
        found = [stand for stand, gap in zip(found, np.min(gaps, axis=0)) if gap > model.card[0]]
        room, eye = self.beliefs.room(), self.eyes.eye()
        ahead, left = rotated(eye[:2] - [x, y], -yaw)

        def rank(stand):
            there = np.array([*(stand[:2] + rotated([ahead, left], stand[2])), eye[2]])
            return not shows(model, room, there, np.array(spot), AT_SPOT), np.hypot(stand[0] - x, stand[1] - y)

        return sorted(found, key=rank)

    def around(self, query, one, place, spot, motion, until=np.inf, way=None):
        """Drives to a place from which a motion is feasible while an entity is supposed to be at `place`. The places lie
        around a spot; the nearest ones are tried first. The first one without a long detour is taken, else the one with
        the shortest way; `way` gives the way in m of what comes next from a place. True if the base has come to such a
        place by a time."""
        model, (x, y, _) = self.world.model, self.world.base()
        best, least = None, np.inf
        for stand in self.stands(spot, way is None) if model.drives else ():
            if self.world.now + THINKS > until:
                break
            scene = self.supposing(one, place)
            scene["robot"]["base"] = [float(part) for part in stand]
            yield from self.pause(THINKS)
            if self.planner.ask(scene, query)[0] is None:
                continue
            straight, then = float(np.hypot(stand[0] - x, stand[1] - y)), 0.0 if way is None else way(stand)
            if best is not None and straight + then >= least:
                continue
            witness, _ = self.planner.plan(self.beliefs.now(), stand_at(*stand))
            path = None if witness is None else self.own(witness, motion)
            if path is None or self.world.now + path.end > until:
                continue
            cost = driven(witness) + then
            if best is None or cost < least:
                best, least = path, cost
            if cost <= straight + DETOUR:
                break
        if best is None or self.world.now + best.end > until:
            return False
        yield from self.follow(best)
        return True


def rotated(way, angle):
    """A way in the plane, turned by an angle."""
    return np.array([way[0] * np.cos(angle) - way[1] * np.sin(angle), way[0] * np.sin(angle) + way[1] * np.cos(angle)])


def driven(witness):
    """Way in m of the base along a witness."""
    bases = np.array([point["base"][:2] for point in witness["path"]])
    return float(np.linalg.norm(np.diff(bases, axis=0), axis=1).sum())
