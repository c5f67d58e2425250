"""The driver protocol, version 2 (docs/drivers.md), over the world."""

import json
import os
import selectors
import sys
import time

import numpy as np

from .begin import WrongStart, begun, model_of
from .beliefs import Beliefs, relative
from .camera import NoGraphics
from .chance import Chance, profile
from .disorder import People, displace
from .eyes import Eyes
from .faults import TAKES, Faults
from .observation import UNKNOWN, Observer, named, needs_eyes
from .planner import Planner
from .senses import Senses
from .tasks import Failed, Tasks
from .world import World

REFUSED, METHOD_NOT_FOUND, INVALID_PARAMS, INTERNAL = 1, -32601, -32602, -32603
# After so many seconds without a word a host on a wall clock has vanished.
SILENCE = 5.0
# Seconds between two reports `moved`, and between two answers to what is watched.
MOVED_EVERY, TOLD_EVERY = 0.05, 0.02
# Seconds in which things come to rest before a run.
SETTLES = 0.3
# Seconds between two looks for what is watched.
LOOK_EVERY = 1.0
# Difference of a grip in m, or of its quaternion, that is not told.
SAME_GRIP = 0.002
# Primitives after which nothing new is in view.
SPEECH = ("say", "ask", "choose")
# Entities that stand in no scene.
PLACELESS = ("robot", "start")


class Options:
    """What goes wrong by itself, as a profile says, what people answer, and a script of faults."""

    def __init__(self, rates=None, seed=0, answers=(), faults=None):
        self.rates = rates or profile("ideal")
        self.chance = Chance(seed)
        self.answers, self.faults = [*answers, *(faults or {}).get("answers", [])], faults

    def reaction(self):
        """Seconds that a person takes."""
        people = self.rates["people"]
        return 0.8 + (people["late_secs"] if self.chance.comes(people["late"], "late") else 0.0)

    def refuses(self, person=""):
        """True where a person does not do what they are asked."""
        return self.chance.comes(self.rates["people"]["refuse"], "refuse", person)

    def friction(self):
        """Friction of a run, as a share of the model's."""
        return 1.0 + float(np.clip(self.chance.error(self.rates["hand"]["friction"], "friction")[0], -0.9, 1.0))


class Error(Exception):
    """An answer that is an error."""

    def __init__(self, code, message, data=None):
        super().__init__(message)
        self.code, self.data = code, data


class Goal:
    """A goal with its task."""

    def __init__(self, command, task):
        self.command, self.task = command, task
        self.state, self.is_held = "running", False


class Driver:
    """Keeps goals, answers calls, and lets the world go on."""

    def __init__(self, model, command, options, oracle=False, walks=(), says=(), told=None, detector=None,
                 judged=None):
        self.detector, self.judged = detector, oracle if judged is None else judged
        self.model, self.command, self.options, self.room = model, command, options, told
        self.oracle, self.walks, self.says = oracle, list(walks), list(says)
        self.instance, self.forgets = "%d-%d" % (os.getpid(), time.time_ns()), 0
        self.say = lambda message: None
        self.run, self.protocol, self.has_clock, self.is_greeted = None, 2, False, False
        self.declared, self.offset, self.given = {}, 0.0, []
        self.make()

    def make(self):
        """Makes the world as it is at the start."""
        self.world = World(self.model)
        rates, chance = self.options.rates, self.options.chance
        self.model.mj.geom_friction[:, 0] = self.options.friction()
        self.truth_of = Observer(self.world)
        self.beliefs = Beliefs(self.world, self.room, self.oracle)
        self.senses = None if self.oracle else Senses(self.world, self.beliefs)
        self.observer = Observer(self.world, self.senses, self.truth_of.own)
        displace(self.world, rates["room"], chance)
        self.people = People(self.world, self.walks, self.says, rates["people"]["walk_per_min"], Chance(chance.seed))
        self.eyes = Eyes(self.world, self.beliefs, self.oracle, rates["camera"], chance, self.detector)
        planner = Planner(self.command, self.model.source) if self.command else None
        self.tasks = Tasks(self.world, self.observer, self.beliefs, planner, self.eyes, self.options)
        self.goals, self.watched, self.moved_at, self.looked_at, self.told_at = {}, [], -1.0, -1.0, -1.0
        self.gripped, self.faults = (None, None), Faults(self.options.faults)
        self.tasks.answered = lambda: self.faults.answered(self.world.now - self.offset)
        self.hold_what_is_held()
        self.world.settle(SETTLES)

    def hold_what_is_held(self):
        """Closes the fingers around what the scene puts between them."""
        holding = self.model.scene["robot"].get("holding")
        if holding in self.model.free:
            self.world.settle_in_hand(holding)
            self.beliefs.holds(holding)
            self.tasks.goal[:] = self.world.target

    # Calls.

    def hello(self, params):
        version = params["protocol"]
        if version not in (1, 2):
            raise Error(INVALID_PARAMS, "this driver speaks versions 1 and 2 of the protocol")
        if params.get("robot", self.model.robot) not in ("", self.model.robot):
            raise Error(INVALID_PARAMS, "this driver has the robot `%s`, not `%s`" % (self.model.robot, params["robot"]))
        run = params.get("run")
        if self.run is not None and run != self.run or run is None:
            self.stop_all()
            self.goals, self.watched = {}, []
            # Who knew the driver before is not to take a forgotten goal for one that never began.
            self.forgets += 1
        self.run, self.protocol = run, version
        if params.get("state") and not params.get("resumed"):
            self.begin(params["state"])
        self.declared = {one["name"]: one.get("fails", []) for one in params.get("primitives", [])}
        # The time of a run begins at 0, or goes on where the host says.
        self.offset = self.world.now - float(params.get("at", 0.0))
        self.has_clock, self.is_greeted = version >= 2, True
        capabilities = {"hold": "all", "update": {"only": []}}
        if version >= 2:
            capabilities.update({"clock": "driver", "moved": True, "look": True, "detections": True, "told": True,
                                 "state": True, "primitives": {"only": self.tasks.names()}})
        return {"protocol": version, "driver": "motet_mujoco 0.1.0", "instance": "%s-%d" % (self.instance, self.forgets),
                "capabilities": capabilities}

    def begin(self, state):
        """Makes the world anew, so that it begins in facts."""
        facts = [(fact["query"]["fact"], fact["holds"]) for fact in state if "fact" in fact["query"]]
        facts = [(fact["fluent"], [named(arg["is"]) for arg in fact["args"]], holds) for fact, holds in facts
                 if "any" not in fact["args"]]
        fields = [(fact["query"]["field"], fact.get("value") or {}) for fact in state if "field" in fact["query"]]
        grips = {field["entity"]: value["pose"] for field, value in fields if field["field"] == "grip"}
        planner = Planner(self.command, self.model.source) if self.command else None
        try:
            scene = begun(self.model.scene, facts, planner, grips)
            self.room = None if self.room is None else begun(self.room, facts, None, grips, is_told=True)
            self.model = model_of(self.model.source, scene, self.command)
        except WrongStart as error:
            raise Error(INVALID_PARAMS, str(error)) from None
        self.eyes.close()
        self.make()
        # What nobody can observe is as the host says.
        self.given = [(fact["query"], fact["holds"]) for fact in state]
        for query, holds in self.given:
            fluent = query.get("fact", {}).get("fluent")
            if fluent is None:
                continue
            found = self.truth_of.answer(query)
            if fluent in ("holding", "open", "on", "in") and found != {"truth": holds}:
                raise Error(INVALID_PARAMS, "the world cannot begin with `%s` %s" % (words(query), str(holds).lower()))

    def start(self, params):
        number, command = params["goal"], params["command"]
        if number not in self.goals:
            self.options.chance.next()
            fate = self.faults.of_call(command["primitive"])
            task = self.tasks.task(command)
            self.goals[number] = Goal(command, task if task is None else fated(task, fate, self.tasks))
            strange = [one for one in entities(command["args"]) if one not in (*PLACELESS, *self.beliefs.entities)]
            kinds = self.kinds(command["primitive"]) or ["refused"]
            if "refuses" in fate:
                self.goals[number].state = {"refused": fate["refuses"]}
            elif strange:
                self.goals[number].state = {"refused": {"kind": kinds[0],
                                                        "text": "the scene of this driver has no `%s`" % strange[0]}}
            elif task is None:
                self.goals[number].state = {"refused": {"kind": kinds[0],
                                                        "text": "this robot cannot do that in physics"}}
        state = self.goals[number].state
        if isinstance(state, dict) and "refused" in state:
            raise Error(REFUSED, "the goal is refused", {"failure": state["refused"]})
        return {}

    def update(self, _params):
        return {}

    def cancel(self, params):
        if self.running(params["goal"]):
            self.end(params["goal"], "interrupted")
        return {}

    def hold(self, params):
        goal = self.running(params["goal"])
        if goal:
            goal.is_held = True
            self.freeze()
        return {}

    def proceed(self, params):
        goal = self.running(params["goal"])
        if goal:
            goal.is_held = False
        return {}

    def safe_stop(self, params):
        number = params["goal"]
        if self.running(number):
            self.goals[number].task.close()
            self.freeze()
        if number not in self.goals or self.goals[number].state == "running":
            self.goals[number] = Goal(None, None)
            self.goals[number].state = "stopped"
        self.report("stopped", {"goal": number})
        return {}

    def observe(self, params):
        return {"answer": self.answer(params["query"])}

    def answer(self, query):
        """The answer to a query, as the robot knows it after a look."""
        if needs_eyes(query):
            self.refresh()
        return self.known(query)

    def known(self, query):
        """The answer to a query, as the robot knows it now."""
        answer = self.observer.answer(query)
        given = next((holds for fact, holds in self.given if fact == query), None) if answer == UNKNOWN else None
        return answer if given is None else {"truth": given}

    def refresh(self):
        """Looks at what is in view, unless the robot perceives by the truth or cannot see."""
        if self.oracle or self.looked_at == self.world.now:
            return
        self.looked_at = self.world.now
        try:
            self.eyes.refresh()
        except NoGraphics:
            return

    def truth(self, params):
        """The answer to a query by the truth of the world, whatever the robot knows."""
        if not self.judged:
            raise Error(METHOD_NOT_FOUND, "the truth is told with `--oracle` only")
        return {"answer": self.truth_of.answer(params["query"])}

    def watch(self, params):
        query = params["query"]
        answer = self.answer(query)
        self.watched = [(known, value) for known, value in self.watched if known != query] + [(query, answer)]
        return {"answer": answer}

    def unwatch(self, params):
        self.watched = [(known, value) for known, value in self.watched if known != params["query"]]
        return {}

    def status(self, params):
        def state(number):
            return self.goals[number].state if number in self.goals else "unknown"

        return {"goals": [{"goal": number, "state": state(number)} for number in params["goals"]]}

    def ping(self, _params):
        return {}

    def look(self, params):
        try:
            picture = self.eyes.look(params.get("camera"))
        except NoGraphics as error:
            raise Error(INTERNAL, str(error)) from None
        if picture is None:
            raise Error(INVALID_PARAMS, "the robot has no camera `%s`" % params.get("camera"))
        return picture.message()

    def detections(self, _params):
        try:
            return {"detections": self.eyes.detections()}
        except NoGraphics as error:
            raise Error(INTERNAL, str(error)) from None

    def told(self, params):
        """Takes in where a thing is, for what the robot does from now on."""
        thing = params["thing"]
        position = (thing.get("pose") or {}).get("xyz")
        if thing["id"] not in self.beliefs.entities and position is not None:
            self.world.call(thing["id"], np.array(position, dtype=float))
        size = None if position is None else self.eyes.size(position)
        self.beliefs.told(thing["id"], thing.get("support"), position, thing.get("label"), size)
        self.eyes.take(thing["id"], position)
        return {}

    def advance(self, params):
        """Lets the world go on until the first report, or until a time."""
        until, is_over, say = float(params["until"]) + self.offset, False, self.say

        def noted(message):
            nonlocal is_over
            is_over |= message["method"] != "moved"
            say(message)

        self.say = noted
        try:
            while not is_over and self.world.now + self.world.tick <= until + 1e-9:
                self.tick()
        finally:
            self.say = say
        return {"now": round((self.world.now if is_over else max(self.world.now, until)) - self.offset, 6)}

    METHODS = ("hello start update cancel hold proceed safe_stop observe watch unwatch status ping look detections "
               "told truth advance").split()

    # The world.

    def tick(self):
        """Goes on by a tick: tasks aim, people walk, the world moves, and what changed is told."""
        self.tasks.rate[:] = self.tasks.change[:] = 0.0
        for number, goal in sorted(self.goals.items()):
            if goal.state != "running" or goal.is_held:
                continue
            outcome = None
            try:
                next(goal.task)
            except StopIteration as done:
                outcome = {"success": done.value}
            except Failed as failure:
                outcome = {"failure": self.failure(goal.command["primitive"], failure)}
            except Scripted as failure:
                outcome = {"failure": failure.report}
            for text in self.tasks.planned:
                self.report("feedback", {"goal": number, "text": text[:1000], "own_motion": True})
            self.tasks.planned.clear()
            if self.tasks.news and self.protocol >= 2:
                self.report("detected", {"detections": list(self.tasks.news)})
            self.tasks.news.clear()
            if outcome is not None:
                self.end(number, outcome)
        self.faults.tick(self.world, self.people, self.observer.own, self.options.chance, self.world.now - self.offset)
        for person, text in self.people.tick():
            self.report("heard", {"text": text, "from": person})
        self.world.step(self.tasks.goal, self.tasks.rate, self.tasks.change)
        self.observer.own.tick(self.world)
        if self.senses is not None:
            self.senses.tick()
        is_due = self.world.now - self.looked_at >= LOOK_EVERY
        if is_due and any(needs_eyes(query) for query, _ in self.watched):
            self.refresh()
        self.tell()

    def tell(self):
        """Reports answers that changed, and where everything is."""
        if self.world.now >= self.told_at + TOLD_EVERY:
            self.told_at = self.world.now
            for at, (query, before) in enumerate(self.watched):
                now = self.known(query)
                if now != before and not alike(now, before):
                    self.watched[at] = (query, now)
                    self.report("observed", {"query": query, "answer": now})
        if self.protocol >= 2 and self.world.now - self.moved_at >= MOVED_EVERY:
            self.moved_at = self.world.now
            self.report("moved", self.where())

    def where(self):
        """Where everything is, as the report `moved` says it: the robot, and each thing where it is believed to be. With
        `--oracle` the robot knows where things are."""
        world, model = self.world, self.model
        values = world.data.qpos[model.control_qpos].round(5).tolist()
        base = ("base/x", "base/y", "base/yaw")
        joints = {joint: values[at] for joint, at in model.controls.items() if joint not in base}
        things = []
        for thing in self.beliefs.things():
            pose = self.observer.room.pose(thing)
            if pose is None:
                continue
            position, (w, x, y, z) = pose
            things.append({"id": thing, "xyz": [round(float(part), 4) for part in position],
                           "quaternion": [round(float(part), 5) for part in (x, y, z, w)]})
        base = world.base().round(5).tolist()
        return {"at": round(world.now - self.offset, 4), "base": base, "joints": joints, "things": things}

    def freeze(self):
        """Keeps every joint where it is."""
        at = list(range(len(self.tasks.goal)))
        arm = [one for one in at if one not in self.model.grips]
        self.tasks.goal[arm] = self.world.data.qpos[self.model.control_qpos][arm]

    # Goals.

    def failure(self, primitive, failure):
        """A failure as its primitive declares it."""
        kinds = self.kinds(primitive)
        kind = failure.kind if failure.kind in kinds or not kinds else kinds[-1]
        return {"kind": kind, "text": str(failure)[:1000]}

    def kinds(self, primitive):
        """Failure kinds that a primitive declares."""
        return self.declared.get(primitive, [])

    def running(self, number):
        goal = self.goals.get(number)
        return goal if goal is not None and goal.state == "running" else None

    def end(self, number, outcome):
        self.goals[number].task.close()
        self.goals[number].state, self.told_at = {"ended": outcome}, -1.0
        if outcome == "interrupted":
            self.freeze()
        self.tell_grip()
        self.report("ended", {"goal": number, "outcome": outcome})
        if self.goals[number].command["primitive"] not in SPEECH:
            self.notice(outcome == "interrupted")

    def tell_grip(self):
        """Reports how the hand holds what it holds, if that is new: the pose of the thing in the frame of the tip."""
        thing = next(iter(self.beliefs.in_hand()), None)
        grip = None if thing is None else relative(self.world.tip_frame(), *self.beliefs.held_pose(thing))
        last, self.gripped = self.gripped, (thing, grip)
        if thing is None or last[0] == thing and np.abs(np.concatenate(grip) - np.concatenate(last[1])).max() < SAME_GRIP:
            return
        w, x, y, z = (float(part) for part in grip[1])
        pose = {"xyz": [float(part) for part in grip[0]], "quaternion": [x, y, z, w]}
        query = {"field": {"entity": thing, "field": "grip"}}
        self.report("observed", {"query": query, "answer": {"value": {"pose": pose}}})

    def notice(self, is_broken_off=False):
        """Reports what is in view and was not known, or not there; where a command was broken off, also what it left
        elsewhere out of view: the host does not know how far it came."""
        try:
            new = self.eyes.news(is_broken_off) if self.protocol >= 2 else []
        except NoGraphics:
            return
        if new:
            self.report("detected", {"detections": new})

    def stop_all(self):
        """Stops everything that moves."""
        for number in list(self.goals):
            goal = self.running(number)
            if goal:
                goal.task.close()
                goal.state = "stopped"
        self.freeze()

    # Messages.

    def report(self, method, params):
        self.say({"jsonrpc": "2.0", "method": method, "params": params})

    def take(self, line):
        """Takes a line in. False where the host goes."""
        message = json.loads(line)
        method = message.get("method")
        if method == "bye":
            self.stop_all()
            return False
        answer = {"jsonrpc": "2.0", "id": message.get("id")}
        later = []
        say, self.say = self.say, later.append
        try:
            if method not in self.METHODS:
                raise Error(METHOD_NOT_FOUND, "there is no method `%s`" % method)
            answer["result"] = getattr(self, method)(message.get("params", {}))
        except Error as error:
            answer["error"] = {"code": error.code, "message": str(error), "data": error.data}
        except (KeyError, TypeError, ValueError) as error:
            answer["error"] = {"code": INVALID_PARAMS, "message": "bad parameters: %r" % error, "data": None}
        finally:
            self.say = say
        # What an `advance` reports comes before its answer, and what any other call reports after it.
        messages = [*later, answer] if method == "advance" else [answer, *later]
        for one in messages:
            self.say(one)
        return True


class Scripted(Exception):
    """A failure that a script of faults asks for."""

    def __init__(self, report):
        super().__init__(str(report))
        self.report = report


def fated(task, fate, tasks):
    """A task with what a script of faults does to it: it fails after its time without a change, hangs, or is slower."""
    if "fails" in fate or "hangs" in fate:
        task.close()
        yield from tasks.pause(TAKES * fate["slower"])
        while "hangs" in fate:
            yield
        raise Scripted(fate["fails"])
    done = 0.0
    while True:
        done += 1.0 if fate["slower"] <= 1.0 else 1.0 / fate["slower"]
        if done >= 1.0 - 1e-9:
            done -= 1.0
            try:
                next(task)
            except StopIteration as end:
                return end.value
        yield


def words(query):
    """A fact as the language writes it."""
    args = [named(arg["is"]) if arg != "any" else "any" for arg in query["fact"]["args"]]
    return "%s(%s)" % (query["fact"]["fluent"], ", ".join(str(arg) for arg in args))


def entities(value):
    """Names of the entities in a value, or in arguments."""
    if isinstance(value, dict):
        return [value["entity"]] if "entity" in value else entities(list(value.values()))
    return [one for part in value for one in entities(part)] if isinstance(value, list) else []


def alike(now, before):
    """True for readings that differ by less than a host could use."""
    try:
        one, other = now["value"]["number"], before["value"]["number"]
    except (KeyError, TypeError):
        return False
    return abs(one - other) < 0.005


def serve(driver, read_fd, write, speed=1.0):
    """Serves a host until it goes. Without a clock of the driver, the world follows the wall clock."""
    said = []
    driver.say = lambda message: said.append(json.dumps(message).encode() + b"\n")
    selector = selectors.DefaultSelector()
    selector.register(read_fd, selectors.EVENT_READ)
    rest, heard, began = b"", time.monotonic(), time.monotonic()
    offset = driver.world.now

    def send():
        # At once, so that the host wakes up once for all of them.
        if said:
            write(b"".join(said))
            said.clear()

    while True:
        if driver.has_clock or not driver.is_greeted:
            # Until the host has said whose the clock is, nothing moves.
            wait = None
            began = time.monotonic()
        else:
            behind = offset + (time.monotonic() - began) * speed - driver.world.now
            wait = 0.0 if behind >= driver.world.tick else driver.world.tick / speed
        ready = selector.select(wait)
        if not driver.has_clock and driver.is_greeted:
            ticks = 0
            while offset + (time.monotonic() - began) * speed - driver.world.now >= driver.world.tick and ticks < 50:
                driver.tick()
                ticks += 1
            send()
            if time.monotonic() - heard > SILENCE:
                return
        if not ready:
            continue
        data = os.read(read_fd, 65536)
        heard = time.monotonic()
        if not data:
            return
        *lines, rest = (rest + data).split(b"\n")
        is_on = all(driver.take(line) for line in lines if line.strip())
        send()
        if not is_on:
            return


def stdio(driver, speed):
    """Serves the host at standard input and output."""

    def write(data):
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()

    serve(driver, sys.stdin.fileno(), write, speed)
    driver.stop_all()
    driver.eyes.close()
