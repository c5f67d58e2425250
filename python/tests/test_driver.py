"""Drivers as classes, led through the messages of the protocol."""

import asyncio
import json
import socket
import threading

import pytest
from motet.clock import new_loop
from motet.driver import Driver, Failed, Lost, Refused, observes, performs
from motet.protocol import Session
from motet.serving import _run, serve_connection
from motet.values import ANY, Case, Pose, Text, decode, encode


class Robot(Driver):
    owns_clock, can_hold, can_update = True, ("go",), ("go",)
    door = False

    def __init__(self):
        self.said, self.stopped = [], []

    async def go(self, goal, to):
        for _ in range(10):
            await goal.sleep(1.0)
            await goal.feedback(f"nearer to {goal.args['to']}", own_motion=not goal.motion.path)
            if goal.cancelled():
                self.said.append("braked")
                return

    async def say(self, goal, text):
        await goal.sleep(2.0)
        self.said.append(text)

    async def pick(self, goal, object, from_):
        if object == "anvil":
            raise Refused("unreachable", "too heavy")
        await goal.sleep(0.5)
        raise Failed({"mug": "slipped", "eel": "melted"}[object])

    async def ask(self, goal, question):
        return {"how many": 3, "which": ["a", "b"]}[question]

    async def open(self, goal, what):
        await goal.sleep(1.0)
        self.door = True

    async def close(self, goal, container):
        await goal.sleep(1.0)
        self.door = False

    async def search(self, goal, what):
        await goal.sleep(1.0)
        goal.not_held()
        self.report_detected([{"label": what, "confidence": 0.5}])
        self.report_observed({"measure": {"measure": "battery", "args": []}}, 0.25)
        await goal.sleep(1.0)
        raise Lost("the link to the arm is gone")

    def truth(self, query):
        return self.door

    def shutdown(self):
        self.said.append("the end")

    @observes("open")
    def is_open(self, container):
        return self.door

    def battery(self):
        return 0.5

    async def stop(self, goal):
        self.stopped.append(goal.number)


PRIMITIVES = [
    {"name": "go", "fails": ["unreachable", "timeout"]},
    {"name": "pick", "fails": ["slipped", "unreachable", "timeout"]},
    {"name": "ask", "result": "Text", "fails": ["timeout"]},
    {"name": "say", "fails": ["timeout"]},
    {"name": "open", "fails": ["stuck", "timeout"]},
    {"name": "close", "fails": ["stuck", "timeout"]},
    {"name": "search", "fails": ["timeout"]},
]


class Host:
    """A host in a thread of its own, at the other end of a pair of sockets."""

    def __init__(self, robot):
        self.id, (own, other) = 0, socket.socketpair()
        self.file, self.socket, self.reports = own.makefile("r"), own, []
        self.thread = threading.Thread(target=_run, args=(robot, lambda session: serve_connection(session, other)))
        self.thread.start()

    def call(self, method, **params):
        self.id += 1
        message = {"jsonrpc": "2.0", "id": self.id, "method": method, "params": params}
        self.socket.sendall(json.dumps(message).encode() + b"\n")
        while (said := json.loads(self.file.readline())).get("id") != self.id:
            self.reports.append((said["method"], said["params"]))
        return said.get("result", said.get("error"))

    def start(self, goal, primitive, at=0.0, **args):
        tagged = [[name, value] for name, value in args.items()]
        return self.call("start", goal=goal, at=at, command={"primitive": primitive, "args": tagged, "uses": []})

    def pass_until(self, until):
        now = -1.0
        while now < until:
            now = self.call("advance", until=until, at=max(now, 0.0))["now"]

    def of(self, method):
        return [params for said, params in self.reports if said == method]

    def close(self):
        self.socket.close()
        self.file.close()
        self.thread.join(10)
        assert not self.thread.is_alive()


@pytest.fixture
def robot():
    return Robot()


@pytest.fixture
def host(robot):
    host = Host(robot)
    host.call("hello", protocol=2, run="r", at=0.0, primitives=PRIMITIVES)
    yield host
    host.close()


def entity(name):
    return {"entity": name}


def test_goals_end_in_success_failure_and_refusal(host):
    assert host.start(1, "pick", object=entity("mug"), **{"from": {"case": "top"}}) == {}
    refused = host.start(2, "pick", object=entity("anvil"), **{"from": {"case": "top"}})
    assert refused == {"code": 1, "message": "too heavy", "data": {"failure": {"kind": "unreachable", "text": "too heavy"}}}
    host.start(3, "pick", object=entity("eel"), **{"from": {"case": "top"}})
    host.start(4, "say", text={"text": "hi"})
    host.start(5, "fly")
    host.pass_until(3.0)
    # `melted` is not declared, so it is the first failure that is.
    assert host.of("ended") == [
        {"goal": 1, "outcome": {"failure": "slipped"}},
        {"goal": 3, "outcome": {"failure": {"kind": "slipped", "text": "melted"}}},
        {"goal": 4, "outcome": {"success": None}},
    ]
    states = {of["goal"]: of["state"] for of in host.call("status", goals=[1, 2, 5, 9])["goals"]}
    assert states[1] == {"ended": {"failure": "slipped"}} and states[9] == "unknown"
    assert states[5]["refused"]["kind"] == "refused"


def test_close_is_a_primitive_and_not_the_end_of_the_driver(robot):
    host = Host(robot)
    capabilities = host.call("hello", protocol=2, run="r", at=0.0, primitives=PRIMITIVES)["capabilities"]
    assert "close" in capabilities["primitives"]["only"] and "shutdown" not in capabilities["primitives"]["only"]
    robot.door = True
    host.start(1, "close", container=entity("drawer"))
    host.pass_until(2.0)
    assert host.of("ended") == [{"goal": 1, "outcome": {"success": None}}] and not robot.door
    host.close()
    assert robot.said == ["the end"]


def test_driver_reports_detections_observations_and_losses(host, robot):
    host.start(1, "search", what={"text": "cup"})
    host.pass_until(1.5)
    assert host.of("not_held") == [{"goal": 1}]
    assert host.of("detected") == [{"detections": [{"label": "cup", "confidence": 0.5}]}]
    query = {"measure": {"measure": "battery", "args": []}}
    assert host.of("observed") == [{"query": query, "answer": {"value": {"number": 0.25}}}]
    host.pass_until(3.0)
    assert host.of("lost") == [{"goal": 1}] and host.of("ended") == []
    host.call("safe_stop", goal=1)
    host.pass_until(4.0)
    assert host.of("stopped") == [{"goal": 1}] and robot.stopped == [1]
    assert host.call("status", goals=[1])["goals"] == [{"goal": 1, "state": "stopped"}]


def test_truth_is_the_answer_to_a_judge(host, robot):
    query = {"fact": {"fluent": "open", "args": [{"is": entity("drawer")}]}}
    assert host.call("truth", query=query) == {"answer": {"truth": False}}
    robot.door = True
    assert host.call("truth", query=query) == {"answer": {"truth": True}}


def test_a_second_start_does_nothing(host, robot):
    for _ in range(2):
        assert host.start(1, "say", text={"text": "hi"}) == {}
    host.pass_until(3.0)
    assert host.start(1, "say", text={"text": "hi"}) == {}
    host.pass_until(6.0)
    assert robot.said == ["hi"] and len(host.of("ended")) == 1


def test_a_goal_that_polls_ends_by_itself_and_another_is_interrupted(host, robot):
    host.start(1, "go", to=entity("table"))
    host.start(2, "say", text={"text": "never"})
    host.pass_until(1.5)
    for goal in (1, 2):
        host.call("cancel", goal=goal)
    host.pass_until(4.0)
    ended = {of["goal"]: of["outcome"] for of in host.of("ended")}
    assert ended == {1: "interrupted", 2: "interrupted"} and robot.said == ["braked"]


def test_a_held_goal_takes_no_time_and_a_new_target(host):
    host.start(1, "go", to=entity("table"))
    host.pass_until(1.5)
    host.call("hold", goal=1)
    host.pass_until(20.0)
    assert len(host.of("feedback")) == 1
    host.call("update", goal=1, command={"primitive": "go", "args": [["to", entity("shelf")]]})
    host.call("proceed", goal=1)
    host.pass_until(29.0)
    assert [of["text"] for of in host.of("feedback")][:2] == ["nearer to table", "nearer to shelf"]
    assert host.of("feedback")[0]["own_motion"] is True, "it has no witness to follow"
    assert host.of("ended") == [{"goal": 1, "outcome": {"success": None}}]
    host.start(2, "say", text={"text": "hi"})
    assert host.call("hold", goal=2)["message"] == "`say` cannot be held"


def test_a_safe_stop_ends_what_runs_and_says_nothing_else(host, robot):
    host.start(1, "go", to=entity("table"))
    for goal in (1, 7):
        host.call("safe_stop", goal=goal)
    host.pass_until(15.0)
    assert host.of("stopped") == [{"goal": 1}, {"goal": 7}] and host.of("ended") == []
    assert robot.stopped == [1, 7]


def test_observations_and_watches(host):
    door = {"fact": {"fluent": "open", "args": [{"is": entity("fridge_1")}]}}
    assert host.call("watch", query=door) == {"answer": {"truth": False}}
    assert host.call("observe", query={"measure": {"measure": "battery", "args": []}})["answer"] == {"value": {"number": 0.5}}
    assert host.call("observe", query={"measure": {"measure": "force", "args": []}})["answer"] == "unknown"
    host.start(1, "open", what=entity("fridge_1"))
    host.pass_until(2.0)
    assert host.of("observed") == [{"query": door, "answer": {"truth": True}}]


def test_a_mistake_of_the_driver_is_a_failure_and_one_of_the_host_an_error(host, capsys):
    host.start(1, "ask", question={"text": "why"})
    host.pass_until(1.0)
    assert host.of("ended")[0]["outcome"]["failure"]["text"].startswith("failed: KeyError")
    assert "KeyError" in capsys.readouterr().err
    assert host.call("start", goal=2)["code"] == -32602
    assert host.call("dance")["code"] == -32601
    assert host.call("hello", protocol=1, run="x", primitives=[])["message"].startswith("this driver speaks version 2")


def test_another_run_forgets_the_goals_of_the_one_before(host, robot):
    host.start(1, "go", to=entity("table"))
    host.call("hello", protocol=2, run="next", at=0.0, primitives=PRIMITIVES)
    assert host.call("status", goals=[1])["goals"] == [{"goal": 1, "state": "unknown"}]
    host.pass_until(20.0)
    assert host.of("ended") == [] and robot.stopped == [1]


def test_values_have_their_tags():
    assert encode(Text("hi"), None) == {"text": "hi"} and encode(Case("left"), "Side") == {"case": "left"}
    assert encode([1], "List<Int>") == {"list": [{"int": 1}]} and encode(1, "Mass") == {"number": 1.0}
    pose = encode(Pose((1.0, 2.0, 3.0)), "Pose")
    assert decode(pose) == Pose((1.0, 2.0, 3.0)) and decode("any") is ANY
    with pytest.raises(TypeError):
        encode(object(), None)


def test_a_loop_on_the_clock_of_the_wall_keeps_a_driver(robot):
    robot.owns_clock = False
    loop = new_loop(False)
    session = Session(robot, loop)

    async def lead():
        await session.take(json.dumps({"id": 1, "method": "hello", "params": {"protocol": 2, "run": "r", "primitives": []}}).encode())
        command = {"primitive": "open", "args": [["what", entity("fridge_1")]]}
        await session.take(json.dumps({"id": 2, "method": "start", "params": {"goal": 1, "command": command}}).encode())
        await asyncio.wait_for(session.tasks[1], 10)

    loop.run_until_complete(lead())
    assert robot.door and session.states[1] == {"ended": {"success": None}}
    loop.close()


def test_a_driver_says_which_primitives_it_has():
    class Any(Robot):
        async def perform(self, goal, **args):
            pass

    class Odd(Driver):
        async def return_(self, goal):
            pass

        async def _helper(self):
            pass

        def at(self, place):
            return True

    assert Robot()._capabilities()["primitives"] == {"only": ["ask", "close", "go", "open", "pick", "say", "search"]}
    assert Any()._capabilities()["primitives"] == "all"
    assert Odd()._capabilities()["primitives"] == {"only": ["return"]}


def test_a_primitive_with_a_name_of_the_base_class_is_marked():
    class Own(Driver):
        owns_clock = True

        def __init__(self):
            self.done = []

        @performs("stop")
        async def halt(self, goal, side):
            self.done.append(f"halt {side}")

        @performs("look")
        async def look_at(self, goal, thing):
            self.done.append(f"look {thing}")

        @observes("truth")
        def honesty(self):
            return 0.75

        async def stop(self, goal):
            self.done.append("stand still")

        async def look(self, camera):
            return {"image": "", "camera": camera}

    robot = Own()
    assert robot._capabilities()["primitives"] == {"only": ["look", "stop"]} and robot._capabilities()["look"]
    assert robot._unfit({"stop": ("side",), "look": ("thing",)}) == []
    host = Host(robot)
    named = [{"name": name, "fails": ["timeout"]} for name in ("stop", "look")]
    host.call("hello", protocol=2, run="r", at=0.0, primitives=named)
    host.start(1, "stop", side=entity("left"))
    host.start(2, "look", thing=entity("mug"))
    host.pass_until(1.0)
    assert host.call("look", camera="head")["camera"] == "head"
    assert host.call("observe", query={"measure": {"measure": "truth", "args": []}})["answer"] == {"value": {"number": 0.75}}
    assert [of["outcome"] for of in host.of("ended")] == [{"success": None}] * 2
    host.close()
    assert robot.done == ["halt left", "look mug"]


def test_a_primitive_that_hides_a_method_of_the_base_class_is_refused():
    for name, source in {
        "look": "async def look(self, goal, thing): ...",
        "stop": "async def stop(self, goal, side): ...",
        "observe": "async def observe(self, goal, thing): ...",
        "report_moved": "async def report_moved(self, goal, a, b, c): ...",
    }.items():
        with pytest.raises(TypeError, match=rf'`Own.{name}` does not take .*@motet.performs\("{name}"\)'):
            exec(f"class Own(Driver):\n    {source}", {"Driver": Driver})

    class Quiet(Driver):
        async def stop(self, goal):
            pass

    assert Quiet()._capabilities()["primitives"] == {"only": []}
    assert Quiet()._unfit({"stop": ()}) == ['`stop` is a method of the protocol: mark a coroutine with `@motet.performs("stop")`']
