"""Primitives as tasks: generators that aim the actuators once a tick, and end with a value or a failure.

A task that is not resumed holds still, since the targets stay where they are.
"""

import numpy as np

from .camera import NoGraphics
from .motion import Path, near_turn, phases, set_targets, timed
from .observation import AT_PLACE
from .planner import quoted

# Differences in m or rad up to which the robot stands at the beginning of a path.
BEGINS = 0.05
# Distance in m from a thing up to which a given point counts as being at it.
NEAR_GRASP = 0.05
# Error in m or rad of a servo above which something is in the way.
BLOCKED = 0.12


class Failed(Exception):
    """A failure of a primitive: its kind, and what happened, in words."""

    def __init__(self, kind, text):
        super().__init__(text)
        self.kind, self.text = kind, text


# Failure kinds by the reasons of geometry.
KINDS = {"blocked_path": "blocked", "no_free_pose": "unreachable", "out_of_reach": "unreachable",
         "too_heavy": "too_heavy", "not_in_view": "not_found"}


class Tasks:
    """Carries out commands in a world."""

    def __init__(self, world, observer, beliefs, planner, eyes, options):
        self.world, self.observer, self.beliefs = world, observer, beliefs
        self.planner, self.eyes, self.options = planner, eyes, options
        self.goal = world.target.copy()  # targets that the tasks aim at
        self.rate = np.zeros_like(self.goal)
        self.said = []
        self.answers = list(options.answers)

    def task(self, command):
        """The task of a command; None where there is none."""
        run = getattr(self, "do_" + command["primitive"], None)
        if run is None:
            return None
        return run({name: value for name, value in command["args"]}, Motion(command))

    # Parts of tasks.

    def aim(self, path, elapsed, mask):
        """Aims the actuators of a mask at a path."""
        target, rate = path.at(elapsed + self.world.tick / 2.0)
        self.goal[mask], self.rate[mask] = target[mask], rate[mask]

    def follow(self, points, times, speed, what=None, watch=None):
        """Follows points. Fails with `blocked` where the robot meets something, or falls behind."""
        world, model = self.world, self.world.model
        points = [np.array(point) for point in points]
        points[0] = self.goal.copy()
        mask = np.any(np.abs(np.array(points) - points[0]) > 1e-9, axis=0)
        if not mask.any():
            return
        path = Path(points, times) if times is not None else timed(points, model.speeds, speed)
        elapsed, behind = 0.0, 0
        while elapsed < path.end:
            self.aim(path, elapsed, mask)
            elapsed += world.tick
            yield
            off = np.abs(world.data.qpos[model.control_qpos] - self.goal)
            off[list(model.grips)] = 0.0
            behind = behind + 1 if off[mask].max() > BLOCKED else 0
            if behind > 25:
                met = world.bumped() or what or "something"
                # What pushes on would push for ever.
                self.goal[mask] = world.data.qpos[model.control_qpos][mask]
                raise Failed("blocked", "%s is in the way" % met)
            if watch is not None:
                watch()
        self.goal[mask] = points[-1][mask]

    def grip(self, closed, seconds):
        """Closes or opens the hand over a time, from where its fingers are."""
        world, model = self.world, self.world.model
        start = {at: world.data.qpos[model.control_qpos[at]] for at in model.grips}
        ticks = int(seconds / world.tick)
        for tick in range(ticks):
            for at, (opened, shut) in model.grips.items():
                to = shut if closed else opened
                self.goal[at] = start[at] + (to - start[at]) * min(2.0 * (tick + 1) / ticks, 1.0)
            yield

    def pause(self, seconds):
        """Waits."""
        for _ in range(max(1, int(round(seconds / self.world.tick)))):
            yield

    def straight(self, way, share=0.4):
        """Moves the hand along a straight line in the map, as far as it goes."""
        world = self.world
        place, rotation = world.tip()
        points = [self.goal.copy()]
        for step in range(1, 5):
            target = world.reacher.solve(world.data.qpos, points[-1], place + way * step / 4.0, rotation)
            if target is None:
                break
            for at in world.model.grips:
                target[at] = self.goal[at]
            points.append(target)
        if len(points) > 1:
            yield from self.follow(points, None, share)

    def motion(self, motion, query, fail="unreachable"):
        """Points and times of the motion of a command, from where the robot stands; else of one of its own."""
        witness = motion.witness
        if witness is not None:
            points = self.points(witness)
            if np.abs(points[0] - self.goal)[self.arm_and_base()].max() <= BEGINS:
                return points, motion.times, witness
        witness, why = self.planner.plan(self.beliefs.now(), query)
        if witness is None:
            raise Failed(KINDS.get(why[0], fail), why[1])
        return self.points(witness), None, witness

    def points(self, witness):
        """Targets of the waypoints of a witness."""
        names = witness.get("joints")
        path = witness["path"]
        if names is not None:
            path = [{"base": one["base"], "joints": dict(zip(names, one["joints"]))} for one in path]
        saved, self.world.target = self.world.target, self.goal.copy()
        points = self.world.targets(path)
        self.world.target = saved
        return points

    def arm_and_base(self):
        """Actuators but for those of the hand."""
        return [at for at in range(len(self.goal)) if at not in self.world.model.grips]

    # Moving.

    def do_go(self, args, motion):
        to = entity(args["to"])
        points, times, _ = self.motion(motion, "go_to(%s)" % quoted(to))
        yield from self.drive(points, times, motion.speed, to)
        self.observer.visited.add(to)
        self.observer.visited.update(self.world.bearers(to) if to in self.world.model.free else [])

    def drive(self, points, times, speed, to):
        held = self.world.held()
        if self.world.model.drives:
            points = [np.array(point) for point in points]
            points[-1][:2] += self.options.chance.error(self.options.rates["base"]["error_m"], "base")

        def watch():
            met = self.world.bumped(held)
            if met is not None and met != to:
                raise Failed("blocked", "%s is in the way" % met)

        yield from self.follow(points, times, speed, watch=watch)
        yield from self.pause(0.2)

    def do_go_to_pose(self, args, motion):
        pose = args["to"]["pose"]
        x, y, _ = pose["xyz"]
        yaw = yaw_of(pose["quaternion"])
        points, times, _ = self.motion(motion, "stand_at(pose(%.4f m, %.4f m, %.5f rad))" % (x, y, yaw))
        yield from self.drive(points, times, motion.speed, None)

    def do_turn(self, args, motion):
        target = self.goal.copy()
        target[2] += number(args["by"])
        yield from self.drive([self.goal.copy(), target], None, motion.speed, None)

    def do_home(self, _args, motion):
        yield from self.take_posture("home", motion)

    def do_start_pose(self, _args, motion):
        yield from self.take_posture("start", motion)

    def take_posture(self, posture, motion):
        points, times, _ = self.motion(motion, "posture(%s)" % posture, "blocked")
        yield from self.follow(points, times, motion.speed)
        self.observer.posture = {"home": "home", "start": "ready"}[posture]

    def do_wake_up(self, _args, _motion):
        yield from self.pause(2.0)
        self.observer.standing = True

    # Using the hand.

    def do_pick(self, args, motion):
        thing = entity(args["object"])
        side = args.get("from", {}).get("case", "auto")
        query = "reach(%s)" % quoted(thing) if side == "auto" else "reach(%s, %s)" % (quoted(thing), side)
        begun = self.goal.copy()
        points = yield from self.grasp(thing, query, motion)
        yield from self.straight(np.array([0.0, 0.0, 0.06]))
        if not self.world.holds(thing):
            raise Failed("slipped", "%s slipped out of the hand" % thing)
        yield from self.way_back(points, begun, motion, thing)
        self.beliefs.rests(thing, None, None)
        self.observer.moved.add(thing)

    def do_grasp(self, args, motion):
        thing, at = entity(args["object"]), args.get("at", {}).get("pose")
        place = None if at is None else np.array(at["xyz"], dtype=float)
        if place is not None:
            self.check_grasp(thing, place)
        yield from self.grasp(thing, "reach(%s)" % quoted(thing), motion, place)

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

    def aside(self, points, off):
        """Points of a way whose last leg ends elsewhere by an offset of the hand, in m; None out of reach."""
        world, model = self.world, self.world.model
        if float(np.linalg.norm(off)) < 1e-4:
            return points
        moved = [np.array(point) for point in points]
        for at in range(max(1, len(points) - 2), len(points)):
            set_targets(model, world.reacher.data, world.data.qpos.copy(), points[at])
            place, rotation = world.reacher.pose(world.reacher.data.qpos.copy())
            target = world.reacher.solve(world.data.qpos, moved[at], place + off, rotation)
            if target is None:
                return None
            for grip in model.grips:
                target[grip] = points[at][grip]
            moved[at] = target
        return moved

    def to_point(self, points, place):
        """Points of a way on which the fingers close in the plane across them through a point."""
        world = self.world
        set_targets(world.model, world.reacher.data, world.data.qpos.copy(), points[-1])
        tip, rotation = world.reacher.pose(world.reacher.data.qpos.copy())
        across = rotation[:, 0]
        return self.aside(points, across * float(across @ (place - tip)))

    def grasp(self, thing, query, motion, place=None):
        """Reaches a thing and closes the hand around it. Gives the points of the way there."""
        points, times, _ = self.motion(motion, query)
        if place is not None:
            points = self.to_point(points, place)
            if points is None:
                raise Failed("unreachable", "the hand does not reach the point on %s" % thing)
        dx, dy = self.options.chance.error(self.options.rates["hand"]["error_m"], "hand", thing)
        points = self.aside(points, np.array([dx, dy, 0.0])) or points
        yield from self.follow(points, times, motion.speed, thing)
        yield from self.grip(True, 1.0)
        held = self.world.held()
        if thing not in held:
            near = np.linalg.norm(self.world.pose(thing)[0] - self.world.tip()[0]) if self.world.pose(thing) else 9.0
            kind, text = ("slipped", "%s is not between the fingers") if near < 0.25 else (
                "not_found", "%s is not where it was expected")
            yield from self.grip(False, 0.6)
            yield from self.straight(-0.08 * self.world.tip()[1][:, 2])
            raise Failed(kind, text % thing)
        return points

    def way_back(self, points, begun, motion, thing):
        """Goes back the way it came with what it holds, and on to where the command leaves the robot."""
        start = self.goal.copy()
        back = [start] + [point.copy() for point in reversed(points[:-1])]
        for point in back:
            for at in self.world.model.grips:
                point[at] = start[at]
        # The last approach again, higher: the thing still stands low.
        if len(back) > 2:
            lifted = self.raised(back[1], 0.06)
            if lifted is not None:
                back[1] = lifted
        leaves = self.leaves(motion, begun)
        if leaves is not None and np.abs(leaves - back[-1])[self.arm_and_base()].max() > 1e-3:
            back.append(leaves)

        def watch():
            if thing is not None and not self.world.holds(thing):
                self.lost += 1
                if self.lost > 12:
                    raise Failed("slipped", "%s fell on the way back" % thing)
            else:
                self.lost = 0

        self.lost = 0
        yield from self.follow(back, None, motion.speed, watch=watch)
        yield from self.pause(0.2)

    def raised(self, point, height):
        """Targets near to others with the hand higher."""
        world = self.world
        set_targets(world.model, world.reacher.data, world.data.qpos.copy(), point)
        place, rotation = world.reacher.pose(world.reacher.data.qpos.copy())
        raised = world.reacher.solve(world.data.qpos, point, place + np.array([0.0, 0.0, height]), rotation)
        if raised is not None:
            for at in world.model.grips:
                raised[at] = point[at]
        return raised

    def leaves(self, motion, begun):
        """Targets where a command leaves the robot, as far as it says; else where it began."""
        if motion.leaves is None:
            return begun
        target = begun.copy()
        if self.world.model.drives and motion.leaves.get("base") is not None:
            x, y, yaw = motion.leaves["base"]
            target[:3] = [x, y, near_turn(yaw, self.goal[2])]
        joints = motion.leaves.get("joints") or {}
        for joint, value in (joints.items() if isinstance(joints, dict) else []):
            at = self.world.model.controls.get(joint)
            if at is not None:
                target[at] = value
        for at in self.world.model.grips:
            target[at] = self.goal[at]
        return target

    def do_lift(self, args, motion):
        held = self.world.held()
        by = number(args["by"])
        before = self.world.tip()[0][2]
        yield from self.straight(np.array([0.0, 0.0, by]))
        if held and not self.world.holds(held[0]):
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
        if not world.holds(thing):
            raise Failed("slipped", "the hand does not hold %s" % thing)
        points, times, _ = self.motion(motion, query)
        parts = phases(points, world.model.grips, "draw")
        approach = parts[0][1]
        yield from self.follow(approach, times[: len(approach)] if times else None, motion.speed, on,
                               self.keeps(thing))
        yield from self.grip(False, 0.8)
        yield from self.straight(-0.08 * world.tip()[1][:, 2])
        yield from self.way_back(approach, begun, motion, None)
        where = "in" if world.is_in(thing, on) else "on" if world.is_on(thing, on) else None
        self.beliefs.rests(thing, where, on)
        self.beliefs.saw(thing, *world.pose(thing))
        self.observer.moved.add(thing)
        if where is None:
            raise Failed("slipped", "%s does not rest on %s" % (thing, on))

    def keeps(self, thing):
        """A check that fails where a thing is lost from the hand."""
        self.lost = 0

        def watch():
            self.lost = 0 if self.world.holds(thing) else self.lost + 1
            if self.lost > 12:
                raise Failed("slipped", "%s slipped out of the hand" % thing)

        return watch

    def do_handover(self, args, motion):
        world = self.world
        thing, person = entity(args["object"]), entity(args["to"])
        begun = self.goal.copy()
        if not world.holds(thing):
            raise Failed("slipped", "the hand does not hold %s" % thing)
        points, times, _ = self.motion(motion, "offer(%s, %s)" % (quoted(thing), quoted(person)))
        yield from self.follow(points, times, motion.speed, person, self.keeps(thing))
        yield from self.pause(self.options.reaction())
        if self.options.refuses(person):
            raise Failed("refused", "%s does not take it" % person)
        at = world.model.people[person]
        world.carried_by[thing] = (person, world.pose(thing)[0] - world.data.mocap_pos[at])
        yield from self.grip(False, 0.8)
        self.beliefs.rests(thing, None, None)
        self.observer.moved.add(thing)
        yield from self.straight(-0.05 * world.tip()[1][:, 2])
        yield from self.way_back(points, begun, motion, None)

    def do_open(self, args, motion):
        yield from self.swing(entity(args["what"]), "pull", True, motion)

    def do_close(self, args, motion):
        yield from self.swing(entity(args["what"]), "push", False, motion)

    def swing(self, what, query, opens, motion):
        """Opens or closes a container by its handle."""
        world, begun = self.world, self.goal.copy()
        if world.is_open(what) is opens:
            return
        points, times, _ = self.motion(motion, "%s(%s)" % (query, quoted(what)))
        parts, at = phases(points, world.model.grips), 0
        for deed, part in parts:
            if deed == "grip":
                yield from self.grip(True, 1.0)
            elif deed == "release":
                yield from self.grip(False, 0.6)
            else:
                share = motion.speed * (0.5 if deed == "draw" else 1.0)
                yield from self.follow(part, None, share, None if deed == "draw" else what)
        if not any(deed == "release" for deed, _ in parts) and any(deed == "grip" for deed, _ in parts):
            yield from self.grip(False, 0.6)
            yield from self.straight(-0.08 * world.tip()[1][:, 2])
        is_open = world.is_open(what)
        self.beliefs.opened(what, is_open)
        yield from self.home_again(begun, motion)
        if is_open is not opens:
            if self.observer.is_locked(what):
                raise Failed("blocked", "%s is locked" % what)
            raise Failed("slipped" if opens else "blocked", "%s is %s" % (what, "open" if is_open else "closed"))

    def home_again(self, begun, motion):
        """Brings the arm to where the command leaves it, by a way of its own."""
        if motion.leaves is None or np.abs(self.goal - self.leaves(motion, begun))[self.arm_and_base()].max() > 0.02:
            witness, _ = self.planner.plan(self.beliefs.now(), "posture(home)")
            if witness is not None:
                yield from self.follow(self.points(witness), None, motion.speed)
                self.observer.posture = "home"

    def do_push(self, args, motion):
        what, begun = entity(args["what"]), self.goal.copy()
        points, times, _ = self.motion(motion, "push(%s)" % quoted(what))
        yield from self.follow(points, times, motion.speed)
        yield from self.way_back(points, begun, motion, None)
        self.observer.moved.add(what)

    # Looking.

    def look(self, one, motion):
        """Turns the camera to an entity. Fails with `not_found` where it does not come into view."""
        points, times, _ = self.motion(motion, "look(%s)" % quoted(one), "not_found")
        yield from self.follow(points, times, motion.speed)
        yield from self.pause(0.1)

    def seen(self, wanted, motion):
        """Ids of the entities, of some, that the camera sees now or after it has turned to where they should be."""
        try:
            found = self.eyes.known(wanted)
        except NoGraphics as error:
            raise Failed("not_found", str(error)) from None
        for one in wanted:
            if one in found or one not in self.world.model.body_of:
                continue
            try:
                yield from self.look(one, motion if len(wanted) == 1 else Motion(None))
            except Failed:
                continue
            found |= self.eyes.known(wanted)
        return [one for one in wanted if one in found]

    def objects(self, what):
        """Objects that a description fits."""
        model = self.world.model
        return [one for one in self.beliefs.matches(what) if model.entities[one]["kind"] not in
                ("Surface", "Container", "Person", "Place", "Zone")]

    def do_detect(self, args, motion):
        found = yield from self.seen(self.objects(args["what"]["text"]), motion)
        yield from self.pause(0.3)
        if not found:
            raise Failed("not_found", "nothing in view is called %s" % args["what"]["text"])
        if len(found) > 1:
            raise Failed("ambiguous", "%d things in view are called %s" % (len(found), args["what"]["text"]))
        self.observer.moved.add(found[0])
        return {"entity": found[0]}

    def do_detect_all(self, args, motion):
        found = yield from self.seen(self.objects(args["what"]["text"]), motion)
        yield from self.pause(0.3)
        self.observer.moved.update(found)
        return {"list": [{"entity": one} for one in found]}

    def do_search(self, args, motion):
        what = args["what"]["text"]
        for place in args["around"]["list"]:
            to = entity(place)
            if not self.observer.serves(to):
                try:
                    yield from self.do_go({"to": {"entity": to}}, Motion(None))
                except Failed as failure:
                    if place is args["around"]["list"][-1]:
                        raise failure
                    continue
            found = yield from self.seen(self.objects(what), Motion(None))
            found = [one for one in found if self.observer.serves(one)]
            if len(found) > 1:
                raise Failed("ambiguous", "%d things here are called %s" % (len(found), what))
            if found:
                self.observer.moved.add(found[0])
                return {"entity": found[0]}
        raise Failed("not_found", "nothing at these places is called %s" % what)

    def do_locate(self, args, motion):
        one = entity(args["object"])
        found = yield from self.seen([one], motion)
        if not found:
            raise Failed("not_found", "%s is not in view" % one)
        position, quaternion = self.eyes.pose(one)
        w, x, y, z = (float(part) for part in quaternion)
        return {"pose": {"xyz": [float(part) for part in position], "quaternion": [x, y, z, w]}}

    def do_ground(self, args, motion):
        return (yield from self.do_locate(args, motion))

    def do_inspect(self, args, motion):
        one = entity(args["what"])
        if one in self.world.model.body_of:
            found = yield from self.seen([one], motion)
            if not found and not self.observer.is_visible(one):
                raise Failed("not_found", "%s is not in view" % one)
        self.observer.moved.add(one)
        self.beliefs.opened(one, self.world.is_open(one))

    # Talking.

    def do_say(self, args, _motion):
        self.said.append(args["text"]["text"])
        yield from self.pause(max(0.3, 0.06 * len(args["text"]["text"])))

    def do_ask(self, args, _motion):
        self.said.append(args["question"]["text"])
        yield from self.pause(1.0 + self.options.reaction())
        if self.options.refuses():
            raise Failed("refused", "nobody answers")
        return {"text": self.answers.pop(0) if self.answers else "yes"}

    def do_choose(self, args, _motion):
        self.said.append(args["question"]["text"])
        yield from self.pause(1.0 + self.options.reaction())
        listed = args["among"]["list"]
        if not listed or self.options.refuses():
            raise Failed("refused", "nobody chooses")
        answer = self.answers.pop(0) if self.answers else None
        fitting = self.beliefs.matches(answer) if answer else []
        return next((one for one in listed if entity(one) in fitting), listed[0])


class Motion:
    """What a command says about its motion: a witness with times, the speed, and where it leaves the robot."""

    def __init__(self, command):
        command = command or {}
        motions = command.get("motions") or ([command["motion"]] if command.get("motion") else [])
        self.witness = motions[0].get("witness") if motions else None
        self.leaves = command.get("leaves")
        self.speed = float((command.get("manner") or {}).get("speed", 1.0))
        path = self.witness["path"] if self.witness else []
        times = [point.get("at") for point in path]
        increasing = all(times) if len(times) < 2 else all(a is not None and b is not None and b >= a
                                                           for a, b in zip(times, times[1:]))
        self.times = times if path and None not in times and increasing else None


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

