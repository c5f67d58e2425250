"""Looking: primitives that turn a camera to things and say what they are. The rest of the tasks looks by them, too.

Where a thing should be is for the beliefs, and what a picture shows is for the eyes.
"""

import itertools

import numpy as np

from .camera import NoGraphics
from .eyes import extent
from .moving import INSIDE, SPARE, Failed, Mover
from .planner import quoted

# Distance in m of the base from a thing up to which it looks for a better place to see it.
ABOUT_HERE = 2.0
# How often a camera on the hand is turned at most so that the hand does not hide a thing.
AIMS = 2
# Seconds that a look takes once the camera stands still.
LOOKS = 0.5


class Looker(Mover):
    """Looks for things in a world."""

    def __init__(self, world, observer, beliefs, planner, eyes, options):
        super().__init__(world, observer, beliefs, planner, options)
        self.eyes = eyes
        self.news = []  # detections that the host has not been told of yet

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
            if not (yield from self.around(query, one, place, spot, motion)):
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
                has_looked = True
                found |= self.eyes.known(wanted)
                if one in found:
                    break
            if has_looked and one not in found and one in self.beliefs.things() and one not in self.beliefs.in_hand():
                # It is not where it should be: anything alike in view is it.
                self.beliefs.forget(one)
                self.eyes.at = -1.0
                found |= self.eyes.known(wanted)
        return [one for one in wanted if one in found]

    def seen_at(self, place, wanted, motion):
        """Ids of the entities, of some, that the camera sees when it looks at a place as a whole."""
        kind = self.beliefs.entities.get(place, {}).get("kind")
        if not wanted or kind not in ("Surface", "Container") or place not in self.world.model.body_of:
            return []
        for spot in self.beliefs.places(place, kind == "Container", 0.05)[:1]:
            try:
                yield from self.look(INSIDE, motion.part(), spot)
            except Failed:
                return []
        seen = self.eyes.known(wanted)
        return [one for one in wanted if one in seen]

    def objects(self, what):
        """Objects that a description fits."""
        known = self.beliefs.entities
        return [one for one in self.beliefs.matches(what) if known[one]["kind"] not in
                ("Surface", "Container", "Person", "Place", "Zone")]

    def do_detect(self, args, motion):
        found = yield from self.seen(self.objects(args["what"]["text"]), motion)
        yield from self.pause(0.3)
        if not found:
            raise Failed("not_found", "nothing in view is called %s" % args["what"]["text"])
        if len(found) > 1:
            raise Failed("ambiguous", "%d things in view are called %s" % (len(found), args["what"]["text"]))
        self.observer.own.moved.add(found[0])
        yield from self.leave(motion)
        return {"entity": found[0]}

    def do_detect_all(self, args, motion):
        found = yield from self.seen(self.objects(args["what"]["text"]), motion)
        yield from self.pause(0.3)
        self.observer.own.moved.update(found)
        yield from self.leave(motion)
        return {"list": [{"entity": one} for one in found]}

    def do_locate(self, args, motion):
        one = entity(args["object"])
        found = yield from self.seen([one], motion)
        if not found:
            raise Failed("not_found", "%s is not in view" % one)
        seen = self.eyes.pose(one)
        if seen is None:
            raise Failed("not_found", "nobody knows where %s is" % one)
        position, quaternion = seen
        w, x, y, z = (float(part) for part in quaternion)
        yield from self.leave(motion)
        return {"pose": {"xyz": [float(part) for part in position], "quaternion": [x, y, z, w]}}

    def do_ground(self, args, motion):
        return (yield from self.do_locate(args, motion))

    def do_inspect(self, args, motion):
        one = entity(args["what"])
        if one in self.world.model.body_of:
            found = yield from self.seen([one], motion)
            if not found:
                raise Failed("not_found", "%s is not in view" % one)
        self.observer.own.moved.add(one)
        is_open = self.eyes.sees_open(one)
        if is_open is not None:
            self.beliefs.opened(one, is_open)
        yield from self.leave(motion)

    def leave(self, motion):
        """Goes to where a command leaves the robot after a look, if it says so and there is a way and time for it.
        What is new in view is told first."""
        leaves = self.leaves(motion, self.goal)
        if np.abs(leaves - self.goal).max() <= 1e-3:
            return
        try:
            self.news.extend(self.eyes.news())
        except NoGraphics:
            pass
        yield from self.stand(leaves, motion)
        target = self.goal.copy()
        target[self.world.model.arm] = leaves[self.world.model.arm]
        path = self.path([self.goal.copy(), target], motion)
        if self.world.now + path.end <= motion.until - SPARE and self.is_way(self.goal, target):
            yield from self.follow(path)


def entity(value):
    """Id in a value."""
    return value.get("entity")
