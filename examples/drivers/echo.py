#!/usr/bin/env python3
"""A driver for Motet that moves nothing: it takes its time over every goal and says that it did it.

It speaks the driver protocol, version 2 (docs/drivers.md), on standard input and output, or with --port on a TCP port of this
machine, one connection at a time. Goals outlast a connection for a while, so a host that crashed can ask what became of
them; who does not come back leaves a robot alone, and it stops. With --clock driver its time stands still between calls,
as that of a simulator does. Needs nothing but Python 3.8 and its standard library; to
make a driver of it, put your robot's calls into `Robot`.
"""

import argparse
import json
import os
import selectors
import socket
import sys
import time

PROTOCOL = 2
REFUSED = 1
METHOD_NOT_FOUND = -32601
INVALID_PARAMS = -32602

# A host says something every second; after so many seconds without a word it has vanished.
SILENCE = 5.0


class Robot:
    """What moves. Here nothing does: every goal succeeds after a while."""

    def __init__(self, seconds, refuse):
        self.seconds = seconds
        self.refuse = refuse
        self.results = {}

    def meet(self, primitives):
        """Learns which primitives there are, and what they give."""
        self.results = {primitive["name"]: primitive.get("result") for primitive in primitives}

    def accepts(self, command):
        """The failure in which a command ends that is not accepted, or None."""
        return "unreachable" if command["primitive"] in self.refuse else None

    def result(self, command):
        """What a command gives, as the type of its result asks for."""
        return example(self.results.get(command["primitive"]))

    def answer(self, query):
        """What the robot sees: that every fact holds, that all is 1 m away, and that any other measure is 0.05."""
        if "fact" in query:
            return {"truth": True}
        measure = query.get("measure", {}).get("measure")
        return {"value": {"number": 1.0 if measure == "distance" else 0.05}}


def example(kind):
    """A value of a type, as the language writes it."""
    if kind is None:
        return None
    if kind.startswith("List<"):
        return {"list": [example(kind[5:-1])]}
    plain = {"Text": {"text": "yes"}, "Bool": {"bool": True}, "Int": {"int": 1}, "Number": {"number": 1.0}}
    if kind in plain:
        return plain[kind]
    if kind == "Pose":
        return {"pose": {"xyz": [0.0, 0.0, 0.0], "quaternion": [0.0, 0.0, 0.0, 1.0]}}
    if kind in ("Length", "Angle", "Duration", "Mass", "Force", "Speed", "Ratio"):
        return {"number": 1.0}
    return {"entity": "echo_1"}


class Error(Exception):
    """An answer that is an error."""

    def __init__(self, code, message, data=None):
        super().__init__(message)
        self.code, self.data = code, data


class Driver:
    """The protocol: keeps goals, answers calls, reports ends."""

    def __init__(self, robot, owns_clock=False):
        self.robot = robot
        self.owns_clock = owns_clock
        self.now = 0.0  # time of the run, if it is ours
        self.run = None  # the run that the goals belong to
        self.instance = "%d-%d" % (os.getpid(), time.time_ns())
        self.goals = {}  # number -> {"state", "command", "left" or "due"}
        self.watched = []
        self.say = lambda message: None

    # Calls, by the name of their method. What they return is the result.

    def hello(self, params):
        if params["protocol"] != PROTOCOL:
            raise Error(INVALID_PARAMS, "this driver speaks version %d of the protocol" % PROTOCOL)
        if params["run"] != self.run:
            self.forget()
            self.run, self.now = params["run"], params.get("at", 0.0)
        self.robot.meet(params["primitives"])
        capabilities = {"hold": "all", "update": "all", "moved": self.owns_clock}
        if self.owns_clock:
            capabilities["clock"] = "driver"
        return {
            "protocol": PROTOCOL,
            "driver": "echo 2.0",
            "instance": self.instance,
            "capabilities": capabilities,
        }

    def forget(self):
        """Another run begins: its goals have numbers of their own."""
        self.stop_all()
        self.goals.clear()
        self.watched.clear()

    def advance(self, params):
        """Lets our own time pass until the first goal ends."""
        self.now = max(self.now, earliest(self.first_due(), params["until"]))
        self.finish_due()
        self.report("moved", {"at": self.now, "base": [0.0, 0.0, 0.0]})
        return {"now": self.now}

    def start(self, params):
        number, command = params["goal"], params["command"]
        if number not in self.goals:
            failure = self.robot.accepts(command)
            if failure is None:
                due = self.time() + self.robot.seconds
                self.goals[number] = {"state": "running", "command": command, "due": due}
            else:
                self.goals[number] = {"state": {"refused": failure}}
        state = self.goals[number]["state"]
        if isinstance(state, dict) and "refused" in state:
            raise Error(REFUSED, "the goal is refused", {"failure": state["refused"]})
        return {}

    def update(self, params):
        goal = self.running(params["goal"])
        if goal:
            goal["command"] = params["command"]
        return {}

    def cancel(self, params):
        if self.running(params["goal"]):
            self.end(params["goal"], "interrupted")
        return {}

    def hold(self, params):
        goal = self.running(params["goal"])
        if goal and "due" in goal:
            goal["left"] = max(0.0, goal.pop("due") - self.time())
        return {}

    def proceed(self, params):
        goal = self.running(params["goal"])
        if goal and "left" in goal:
            goal["due"] = self.time() + goal.pop("left")
        return {}

    def safe_stop(self, params):
        number = params["goal"]
        if self.running(number) or number not in self.goals:
            self.goals[number] = {"state": "stopped"}
        self.report("stopped", {"goal": number})
        return {}

    def observe(self, params):
        return {"answer": self.robot.answer(params["query"])}

    def watch(self, params):
        if params["query"] not in self.watched:
            self.watched.append(params["query"])
        return {"answer": self.robot.answer(params["query"])}

    def unwatch(self, params):
        if params["query"] in self.watched:
            self.watched.remove(params["query"])
        return {}

    def status(self, params):
        state = lambda number: self.goals.get(number, {"state": "unknown"})["state"]
        return {"goals": [{"goal": number, "state": state(number)} for number in params["goals"]]}

    def ping(self, _params):
        return {}

    METHODS = "hello start update cancel hold proceed safe_stop observe watch unwatch status ping advance".split()

    # Goals.

    def running(self, number):
        goal = self.goals.get(number)
        return goal if goal and goal["state"] == "running" else None

    def end(self, number, outcome):
        self.goals[number] = {"state": {"ended": outcome}}
        self.report("ended", {"goal": number, "outcome": outcome})

    def time(self):
        return self.now if self.owns_clock else time.monotonic()

    def finish_due(self):
        now = self.time()
        due = [number for number, goal in self.goals.items() if goal.get("due", now + 1.0) <= now]
        for number in due:
            self.end(number, {"success": self.robot.result(self.goals[number]["command"])})

    def first_due(self):
        """When the first goal ends, or None."""
        return min((goal["due"] for goal in self.goals.values() if "due" in goal), default=None)

    def next_due(self):
        """Seconds on the wall until a goal ends, or None."""
        due = None if self.owns_clock else self.first_due()
        return None if due is None else max(0.0, due - time.monotonic())

    def stop_all(self):
        for number in list(self.goals):
            if self.running(number):
                self.goals[number] = {"state": "stopped"}

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
        answer = {"jsonrpc": "2.0", "id": message["id"]}
        self.now = max(self.now, message.get("params", {}).get("at", self.now))
        later = []
        say = self.say
        if method != "advance":
            self.say = later.append  # what another call reports comes after its answer
        try:
            if method not in self.METHODS:
                raise Error(METHOD_NOT_FOUND, "there is no method `%s`" % method)
            answer["result"] = getattr(self, method)(message.get("params", {}))
        except Error as error:
            answer["error"] = {"code": error.code, "message": str(error), "data": error.data}
        except (KeyError, TypeError) as error:
            answer["error"] = {"code": INVALID_PARAMS, "message": "bad parameters: %r" % error, "data": None}
        finally:
            self.say = say
        self.say(answer)
        for report in later:
            self.say(report)
        return True


def serve(driver, read_fd, write):
    """Serves one connection until the host goes. Answers whether it said goodbye."""
    driver.say = lambda message: write((json.dumps(message) + "\n").encode())
    selector = selectors.DefaultSelector()
    selector.register(read_fd, selectors.EVENT_READ)
    rest = b""
    heard = time.monotonic()
    while True:
        # Nothing moves while our own time stands still, however long the host is silent.
        left = None if driver.owns_clock else heard + SILENCE - time.monotonic()
        wait = earliest(driver.next_due(), left)
        ready = selector.select(wait if wait is None else max(0.0, wait))
        driver.finish_due()
        if not ready and (left is None or left > 0.0):
            continue
        data = os.read(read_fd, 65536) if ready else b""
        heard = time.monotonic()
        if not data:
            driver.say = lambda message: None
            return False
        *lines, rest = (rest + data).split(b"\n")
        for line in lines:
            if line.strip() and not driver.take(line):
                return True


def earliest(*seconds):
    """The least of them that is not None; None if all are."""
    return min((one for one in seconds if one is not None), default=None)


def listen(driver, port, grace):
    """Serves one TCP connection of this machine after the other. What runs has `grace` seconds without one."""
    with socket.create_server(("127.0.0.1", port)) as server:
        print("listening on tcp://127.0.0.1:%d" % server.getsockname()[1], flush=True)
        alone = None  # since when a host is missed
        while True:
            left = None if alone is None else max(0.0, alone + grace - time.monotonic())
            server.settimeout(earliest(driver.next_due(), left))
            try:
                connection, _ = server.accept()
            except (TimeoutError, socket.timeout, BlockingIOError):
                driver.finish_due()
                if left == 0.0:
                    driver.stop_all()
                    alone = None
                continue
            alone = None
            with connection:
                connection.setblocking(True)
                try:
                    said_bye = serve(driver, connection.fileno(), connection.sendall)
                except OSError:
                    driver.say = lambda message: None
                    said_bye = False
            if not said_bye:
                alone = time.monotonic()


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--seconds", type=float, default=0.2, help="how long every goal takes")
    parser.add_argument("--refuse", action="append", default=[], metavar="PRIMITIVE", help="a primitive to refuse")
    parser.add_argument("--port", type=int, help="a TCP port instead of standard input and output; 0 takes a free one")
    parser.add_argument("--clock", choices=["wall", "driver"], default="wall", help="whose time a run goes by")
    parser.add_argument("--grace", type=float, default=10.0, help="seconds that goals go on for without a host, with --port")
    args = parser.parse_args()
    driver = Driver(Robot(args.seconds, args.refuse), args.clock == "driver")
    if args.port is not None:
        listen(driver, args.port, args.grace)
        return

    def write(data):
        sys.stdout.buffer.write(data)
        sys.stdout.buffer.flush()

    serve(driver, sys.stdin.fileno(), write)
    driver.stop_all()


if __name__ == "__main__":
    try:
        main()
    except (KeyboardInterrupt, BrokenPipeError):
        pass
