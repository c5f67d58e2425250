"""Primitives as tasks: generators that aim the actuators once a tick, and end with a value or a failure.

A task that is not resumed holds still, since the targets stay where they are.
"""

import numpy as np

from .camera import NoGraphics
from .jaw import FEELS_AT, aside, shifted, spared
from .motion import near_turn, phases
from .looking import Looker
from .moving import POSTURES, SPARE, THINKS, Failed, Motion
from .observation import AT_PLACE
from .planner import quoted, stand_at
from .world import OPENED

# Primitives that do not move the arm, and those that begin with the arm wherever it is: they fold it, or look.
ARMLESS = ("say", "ask", "choose", "wake_up")
ANYWHERE = ("home", "start_pose", "detect", "detect_all", "locate", "ground", "inspect")
# Distance in m from a thing up to which a given point counts as being at it.
NEAR_GRASP = 0.05
# Way in m of the base on which it leaves what pressed on the robot as a drive began.
LEAVES = 0.1
# Distance in m that a handle moves in the hand at least where its drawer or door is not locked.
GIVES = 0.04
# Distances in m, beyond that of a drive to a person, from which the hand may hold something out, and turns in rad of the
# base there. Nearer than a drive leads the base comes last: policies keep a distance from people.
OFFERS, TURNED = (0.0, 0.15, -0.05, -0.1), (0.0, 0.6, -0.6, 1.2, -1.2)


class Felt(Exception):
    """The hand has felt a thing."""


class Tasks(Looker):
    """Carries out commands in a world."""

    def __init__(self, world, observer, beliefs, planner, eyes, options):
        super().__init__(world, observer, beliefs, planner, eyes, options)
        self.said = []
        self.news = []  # detections that the host has not been told of yet
        self.answers = list(options.answers)
        self.answered = lambda: None  # called when a person has answered

    def names(self):
        """Names of the primitives."""
        return sorted(name[3:] for name in dir(self) if name.startswith("do_"))

    def task(self, command):
        """The task of a command; None where there is none."""
        run = getattr(self, "do_" + command["primitive"], None)
        if run is None:
            return None
        motion = Motion(command, self.world.now)
        task = run({name: value for name, value in command["args"]}, motion)
        return task if command["primitive"] in ARMLESS else self.from_rest(task, motion, command["primitive"] in ANYWHERE)

    # Moving.

    def do_go(self, args, motion):
        yield from self.come_off(motion)
        to = entity(args["to"])
        about = self.about(to)
        if motion.witness is None and self.room.is_open(about) and (yield from self.face(about, motion)):
            self.observer.own.visited.update((to, about))
            return
        held, path = self.room.held(), (yield from self.motion(motion, "go_to(%s)" % quoted(about)))
        if held and to in self.world.model.people:
            # The hand may hold it otherwise than whoever planned the way expected.
            path = yield from self.offering(path, held[0], to, motion)
        yield from self.drive(path, to)
        self.observer.own.visited.add(to)
        self.observer.own.visited.update(self.room.supports(to) if to in self.beliefs.things() else [])

    def about(self, to):
        """What to drive to for an entity: for a thing whose place is not known, what it is in or on, or was before it
        was missed there."""
        known = self.beliefs.entities.get(to, {})
        if to not in self.beliefs.things() or self.room.pose(to) is not None and "in" not in known:
            return to
        return known.get("in") or known.get("on") or min(self.beliefs.gone.get(to, ()), default=to)

    def offering(self, path, thing, person, motion):
        """The path to a place from which the hand can hold a thing out to a person: its own, or else one around the
        person. Its own where no place was found."""
        query, scene = "offer(%s, %s)" % (quoted(thing), quoted(person)), self.beliefs.now()
        end, (x, y, _) = path.points[-1][:3], self.beliefs.entities[person]["pose"]["xyz"]
        far, angle = float(np.hypot(*(end[:2] - [x, y]))), float(np.arctan2(end[1] - y, end[0] - x))
        places = [tuple(float(part) for part in end)]
        for off in OFFERS:
            for beside in (0.0, 0.3, -0.3, 0.8, -0.8):
                at = angle + beside
                stand = x + (far + off) * np.cos(at), y + (far + off) * np.sin(at)
                places.extend((*stand, float(near_turn(at + np.pi + turn, end[2]))) for turn in TURNED)
        for at, (px, py, yaw) in enumerate(places):
            scene["robot"]["base"] = [float(px), float(py), float(yaw)]
            # The host waits for an answer while the world stands still.
            yield from self.pause(THINKS)
            if self.planner.ask(scene, query)[0] is None:
                continue
            if at == 0:
                return path
            witness, _ = self.planner.plan(self.beliefs.now(), stand_at(px, py, yaw))
            if witness is not None:
                return self.own(witness, motion)
        return path

    def drive(self, path, to):
        held = self.room.held()
        if self.world.model.drives:
            last = path.strokes[-1].points[-1] = path.strokes[-1].points[-1].copy()
            last[:2] += self.options.chance.error(self.options.rates["base"]["error_m"], "base")

        begun, left = self.world.base(), list(self.world.bumps())

        def is_leaving():
            """True where the base is still about to leave what pressed on the robot as it began."""
            is_near = np.hypot(*(self.world.base() - begun)[:2]) < LEAVES
            return is_near and all(any(np.linalg.norm(at - one) < LEAVES for one in left) for at in self.world.bumps())

        def watch():
            met = self.room.bumped(held)
            if met is not None and met != to and not is_leaving():
                raise Failed("blocked", "%s is in the way" % met)

        yield from self.follow(path, watch=watch)
        yield from self.pause(0.2)

    def do_go_to_pose(self, args, motion):
        yield from self.come_off(motion)
        pose = args["to"]["pose"]
        x, y, _ = pose["xyz"]
        yaw = yaw_of(pose["quaternion"])
        path = yield from self.motion(motion, stand_at(x, y, yaw))
        yield from self.drive(path, None)

    def do_turn(self, args, motion):
        yield from self.come_off(motion)
        target = self.goal.copy()
        target[2] += number(args["by"])
        yield from self.drive(self.path([self.goal.copy(), target], motion), None)

    def do_home(self, _args, motion):
        yield from self.take_posture("home", motion)

    def do_start_pose(self, _args, motion):
        yield from self.take_posture("ready", motion)

    def take_posture(self, posture, motion):
        yield from self.follow((yield from self.motion(motion, POSTURES[posture], "blocked")))
        self.observer.own.posture, self.is_adrift = posture, False

    def do_wake_up(self, _args, _motion):
        yield from self.pause(2.0)
        self.observer.own.standing = True

    # Using the hand.

    def do_pick(self, args, motion):
        thing = entity(args["object"])
        side, begun = args.get("from", {}).get("case", "auto"), self.goal.copy()
        query = "reach(%s)" % quoted(thing) if side == "auto" else "reach(%s, %s)" % (quoted(thing), side)
        path = yield from self.grasp(thing, query, motion)
        yield from self.straight(np.array([0.0, 0.0, 0.06]), motion)
        if not self.room.holds(thing):
            self.beliefs.forget(thing)
            yield from self.draw_back(path, begun, motion)
            self.glance()
            raise Failed("slipped", "%s slipped out of the hand" % thing)
        yield from self.way_back(path, begun, motion, thing)
        self.beliefs.rests(thing, None, None)
        self.observer.own.moved.add(thing)

    def do_grasp(self, args, motion):
        thing, at = entity(args["object"]), args.get("at", {}).get("pose")
        query = "reach(%s)" % quoted(thing)
        if at is not None:
            place = np.array(at["xyz"], dtype=float)
            self.check_grasp(thing, place)
            query = "reach_at(%s, pose(%.4f m, %.4f m, %.4f m, 0 rad))" % (quoted(thing), *place)
        yield from self.grasp(thing, query, motion)

    def check_grasp(self, thing, place):
        """Checks a point that the hand is to close at: within reach, and at the thing."""
        gap, (x, y, _) = self.beliefs.gap(thing, place), self.world.base()
        if gap is None:
            raise Failed("not_found", "there is no %s" % thing)
        far, reach = float(np.hypot(place[0] - x, place[1] - y)), self.world.model.card[1]
        # The base may still move a little.
        if gap > NEAR_GRASP and far > reach + AT_PLACE * self.world.model.drives:
            raise Failed("unreachable", "the point is %.2f m away at a height of %.2f m, the hand reaches %.2f m"
                         % (far, place[2], reach))
        if gap > NEAR_GRASP:
            raise Failed("not_found", "the hand closes %.2f m beside %s" % (gap, thing))

    def grasp(self, thing, query, motion):
        """Reaches a thing and closes the hand around it. Gives the path of the way there."""
        begun = self.goal.copy()
        path = yield from self.motion(motion, query)
        points, feels = spared(self.world, self.beliefs, path.points, thing)
        off = np.array([*self.options.chance.error(self.options.rates["hand"]["error_m"], "hand", thing), 0.0])
        path = path.to(aside(self.world, points, off) or points)
        yield from self.follow(path, thing)
        yield from self.feel(feels, off, motion)
        yield from self.grip(True, 0.8)
        if not self.room.grasps(thing):
            # A hand feels if it closes around nothing.
            kind, text = ("slipped", "%s is not between the fingers") if self.room.is_touched(thing) else (
                "not_found", "%s is not where it was expected")
            self.beliefs.forget(thing)
            yield from self.draw_back(path, begun, motion)
            self.glance()
            raise Failed(kind, text % thing)
        self.beliefs.holds(thing, float(self.world.tip()[0][2]))
        return path

    def feel(self, targets, off, motion):
        """Moves the hand aside until it feels a thing, along targets that are an offset in m elsewhere."""
        if not targets or self.world.feels_touch():
            return
        targets = [shifted(self.world, target, off) for target in targets]
        if any(target is None for target in targets):
            return

        def watch():
            if self.world.feels_touch():
                raise Felt

        try:
            yield from self.follow(self.path([self.goal.copy(), *targets], motion, FEELS_AT), watch=watch)
        except Felt:
            return

    def do_lift(self, args, motion):
        held = self.room.held()
        by = number(args["by"])
        before = self.world.tip()[0][2]
        yield from self.straight(np.array([0.0, 0.0, by]), motion)
        if held and not self.room.holds(held[0]):
            self.beliefs.forget(held[0])
            raise Failed("slipped", "%s slipped out of the hand" % held[0])
        if self.world.tip()[0][2] - before < 0.5 * by:
            raise Failed("blocked", "the hand does not get higher from here")

    def do_place(self, args, motion):
        thing, on = entity(args["object"]), entity(args["on"])
        rules = []
        for rule in ("near", "beside"):
            if rule in args and entity(args[rule]) not in (None, on):
                rules.append("%s: %s" % (rule, quoted(entity(args[rule]))))
        if number(args.get("away_from_edge", {"number": 0.0})) > 0.0:
            rules.append("away_from_edge: %.4f m" % number(args["away_from_edge"]))
        if args.get("upright", {"bool": True}).get("bool") is False:
            rules.append("upright: false")
        query = "put(%s)" % ", ".join([quoted(thing), quoted(on), *rules])
        yield from self.put(thing, on, query, motion)

    def do_place_at(self, args, motion):
        thing, on = entity(args["object"]), entity(args["on"])
        pose = args["at"]["pose"]
        x, y, z = pose["xyz"]
        yaw = yaw_of(pose["quaternion"])
        place = "%.4f m, %.4f m, %.5f rad" % (x, y, yaw) if z == 0.0 else "%.4f m, %.4f m, %.4f m, %.5f rad" % (x, y, z, yaw)
        yield from self.put(thing, on, "put(%s, %s, at: pose(%s))" % (quoted(thing), quoted(on), place), motion)

    def put(self, thing, on, query, motion):
        world, begun = self.world, self.goal.copy()
        if not self.room.holds(thing):
            raise Failed("slipped", "the hand does not hold %s" % thing)
        path = yield from self.motion(motion, query, thing=thing)
        approach = phases(path.points, world.model.grips, "draw")[0][1]
        path = path.until(approach)
        yield from self.follow(path, on, self.keeps(thing))
        # Where it is let go is felt; where it comes to rest is for the next look.
        released = self.beliefs.held_pose(thing)
        self.beliefs.hand = None
        self.beliefs.looked(thing, *self.beliefs.falls(thing, on, *released))
        yield from self.grip(False, 0.8)
        yield from self.straight(-0.08 * world.tip()[1][:, 2], motion)
        yield from self.way_back(path, begun, motion, None)
        self.observer.own.moved.add(thing)
        known = self.beliefs.entities[thing]
        if on not in (known.get("on"), known.get("in")):
            self.beliefs.rests(thing, "in" if self.beliefs.entities[on]["kind"] == "Container" else "on", on)
        # Where the camera does not show that it is elsewhere, it is where the hand let it go.
        self.glance()
        if not self.room.is_in(thing, on) and not self.room.is_on(thing, on):
            self.beliefs.forget(thing)
            raise Failed("slipped", "%s does not rest on %s" % (thing, on))

    def do_handover(self, args, motion):
        world = self.world
        thing, person = entity(args["object"]), entity(args["to"])
        begun = self.goal.copy()
        if not self.room.holds(thing):
            raise Failed("slipped", "the hand does not hold %s" % thing)
        query = "offer(%s, %s)" % (quoted(thing), quoted(person))
        try:
            path = yield from self.motion(motion, query)
        except Failed:
            # The base came to stand a little beside where the hand could do it.
            here = self.path([self.goal.copy(), self.goal.copy()])
            path = yield from self.offering(here, thing, person, motion.part())
            if not self.world.model.drives or path is here:
                raise
            yield from self.drive(path, person)
            path = yield from self.motion(motion.part(), query)
        yield from self.follow(path, person, self.keeps(thing))
        yield from self.pause(self.options.reaction())
        if self.options.refuses(person):
            raise Failed("refused", "%s does not take it" % person)
        at = world.model.people[person]
        world.carried_by[thing] = (person, world.pose(thing)[0] - world.data.mocap_pos[at])
        released = self.beliefs.held_pose(thing)
        self.beliefs.hand = None
        self.beliefs.rests(thing, None, None)
        self.beliefs.saw(thing, *released)
        self.beliefs.given[thing] = person
        yield from self.grip(False, 0.8)
        self.observer.own.moved.add(thing)
        yield from self.straight(-0.05 * world.tip()[1][:, 2], motion)
        yield from self.way_back(path, begun, motion, None)

    def do_open(self, args, motion):
        yield from self.swing(entity(args["what"]), "pull", True, motion)

    def do_close(self, args, motion):
        yield from self.swing(entity(args["what"]), "push", False, motion)

    def swing(self, what, query, opens, motion):
        """Opens or closes a container by its handle."""
        world, begun = self.world, self.goal.copy()
        if self.observer.room.is_open(what) is opens:
            return
        path = yield from self.motion(motion, "%s(%s)" % (query, quoted(what)))
        parts, drawn = phases(path.points, world.model.grips), None
        for phase, part in parts:
            if phase == "grip":
                yield from self.grip(True, 1.0)
            elif phase == "release":
                yield from self.grip(False, 0.6)
            else:
                if phase == "draw":
                    # The way here leads through what is opened or closed.
                    self.trail.clear()
                    drawn, watch = self.drawing(part)
                    is_whole = False
                    try:
                        yield from self.follow(self.path(part, motion, 0.5), watch=watch)
                        is_whole = True
                    finally:
                        if not is_whole:
                            # It ended on its way: nobody knows how far it is open.
                            self.beliefs.opened(what, None)
                    self.trail.clear()
                    continue
                yield from self.follow(self.path(part, motion), what)
        far, whole, is_felt = drawn or (1.0, 1.0, True)
        is_open = world.is_open(what) if self.beliefs.oracle else opens if far >= OPENED * whole else None
        # After a motion that failed, only a look tells how far it came.
        self.beliefs.opened(what, is_open)
        if not any(phase == "release" for phase, _ in parts) and any(phase == "grip" for phase, _ in parts):
            yield from self.grip(False, 0.6)
            yield from self.straight(-0.08 * world.tip()[1][:, 2], motion)
        # The base drives on once it is known how far the leaf stands in its way.
        is_folded = yield from self.folded_again(begun, motion)
        self.glance()
        is_open = self.room.is_open(what)
        if is_folded and is_open is not None:
            yield from self.stand(self.leaves(motion, begun), motion)
            self.glance()
            is_open = self.room.is_open(what)
        if is_open is opens:
            if opens and motion.leaves is None:
                yield from self.face(what, motion)
            return
        is_stuck = world.is_locked(what) if self.beliefs.oracle else opens and is_felt and far < GIVES
        if is_stuck:
            self.beliefs.locked(what)
            raise Failed("blocked", "%s does not give way: it is locked" % what)
        if is_open is None:
            raise Failed("slipped" if opens else "blocked", "the hand lost the handle of %s" % what)
        raise Failed("slipped" if opens else "blocked", "%s is %s" % (what, "open" if is_open else "closed"))

    def drawing(self, part):
        """How far the hand has drawn a handle, in m, how far it is to, and whether it had the handle at all, as a list
        that fills; and a check that fills it. The fingers feel the handle as long as they do not close on nothing."""
        begin, end = self.world.tip()[0], self.frame(part[-1])[0]
        drawn = [0.0, float(np.linalg.norm(end - self.frame(part[0])[0])), self.world.is_gripping()]

        def watch():
            if self.world.is_gripping():
                drawn[0] = max(drawn[0], float(np.linalg.norm(self.world.tip()[0] - begin)))

        return drawn, watch

    def do_push(self, args, motion):
        what, begun = entity(args["what"]), self.goal.copy()
        path = yield from self.motion(motion, "push(%s)" % quoted(what))
        yield from self.follow(path)
        yield from self.way_back(path, begun, motion, None)
        self.observer.own.moved.add(what)

    # Looking.

    def objects(self, what):
        """Objects that a description fits."""
        known = self.beliefs.entities
        return [one for one in self.beliefs.matches(what) if known[one]["kind"] not in
                ("Surface", "Container", "Person", "Place", "Zone")]

    def do_detect(self, args, motion):
        wanted = self.objects(args["what"]["text"])
        found = yield from self.sought(wanted, motion)
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

    def do_search(self, args, motion):
        what, places = args["what"]["text"], args["around"]["list"]
        # The place that the motion that was sent leads to.
        sent = next((one for one in places if one in motion.about), places[0] if places else None)
        for place in places:
            to, way = entity(place), motion if place == sent else motion.part()
            if not self.observer.serves(to) or self.sent(way) is not None:
                try:
                    yield from self.do_go({"to": {"entity": to}}, way)
                except Failed as failure:
                    if place is places[-1]:
                        raise failure
                    continue
            wanted = self.objects(what)
            found = yield from self.seen(wanted, motion.part())
            found += yield from self.seen_at(to, [one for one in wanted if one not in found], motion)
            found = [one for one in found if to in self.room.supports(one) or self.observer.serves(one)]
            if len(found) > 1:
                raise Failed("ambiguous", "%d things here are called %s" % (len(found), what))
            if found:
                self.observer.own.moved.add(found[0])
                yield from self.leave(motion)
                return {"entity": found[0]}
        raise Failed("not_found", "nothing at these places is called %s" % what)

    def do_locate(self, args, motion):
        one = entity(args["object"])
        found = yield from self.sought([one], motion)
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
            found = yield from self.sought([one], motion)
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

    # Talking.

    def do_say(self, args, _motion):
        self.said.append(args["text"]["text"])
        yield from self.pause(max(0.3, 0.06 * len(args["text"]["text"])))

    def do_ask(self, args, _motion):
        self.said.append(args["question"]["text"])
        yield from self.pause(1.0 + self.options.reaction())
        answer = self.answer("yes")
        if answer is None:
            raise Failed("refused", "nobody answers")
        return {"text": answer}

    def answer(self, usual):
        """The next answer of a person; None where they refuse."""
        answer = self.answers.pop(0) if self.answers else usual
        if answer is None or self.options.refuses():
            return None
        self.answered()
        return answer

    def do_choose(self, args, _motion):
        self.said.append(args["question"]["text"])
        yield from self.pause(1.0 + self.options.reaction())
        listed = args["among"]["list"]
        answer = self.answer("") if listed else None
        if answer is None:
            raise Failed("refused", "nobody chooses")
        fitting = self.beliefs.matches(answer) if answer else []
        return next((one for one in listed if entity(one) in fitting), listed[0])


def entity(value):
    """Id in a value."""
    return value.get("entity")


def number(value):
    """Number in a value."""
    return float(value.get("number", value.get("int", 0.0)))


def yaw_of(quaternion):
    """Yaw of a rotation x, y, z, w."""
    x, y, z, w = quaternion
    return float(np.arctan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z)))

