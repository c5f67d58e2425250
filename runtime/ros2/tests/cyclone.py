"""Types, services and actions of ROS 2 over Eclipse Cyclone DDS, another implementation than that of the driver."""

import re
import time
from dataclasses import dataclass, field
from pathlib import Path

from cyclonedds.core import Policy, Qos
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import make_idl_struct, types
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from cyclonedds.util import duration

PRIMITIVES = {"bool": bool, "int8": types.int8, "int16": types.int16, "int32": types.int32, "int64": types.int64,
              "uint8": types.uint8, "byte": types.uint8, "char": types.uint8, "uint16": types.uint16,
              "uint32": types.uint32, "uint64": types.uint64, "float32": types.float32, "float64": types.float64,
              "string": str}
LAYOUTS = Path(__file__).resolve().parent.parent / "layouts"
RELIABLE = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.Volatile,
               Policy.History.KeepLast(64))
LATCHED = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.TransientLocal,
              Policy.History.KeepLast(1))


class Types:
    """Classes of Cyclone DDS for the layouts of a distribution."""

    def __init__(self, distribution="jazzy"):
        self.fields, self.kinds, self.classes, self.names = {}, {}, {}, {}
        for file in ("common", distribution):
            self.read((LAYOUTS / (file + ".layouts")).read_text())
        header = make_idl_struct("RequestHeader", "RequestHeader", {"guid": types.uint64, "seq": types.int64})
        self.header = header

    def read(self, text):
        name, part = None, 0
        for line in text.splitlines():
            line = line.split("#")[0].strip()
            found = re.match(r"(MSG|SRV|ACTION) (\S+)$", line)
            if found:
                kind, name, part = found[1], found[2], 0
                self.kinds[name] = kind
                self.ends = {"MSG": [""], "SRV": ["_Request", "_Response"],
                             "ACTION": ["_Goal", "_Result", "_Feedback"]}[kind]
                for end in self.ends:
                    self.fields[name + end] = []
                if kind == "ACTION":
                    uuid = ("unique_identifier_msgs/UUID", "goal_id")
                    self.fields[name + "_SendGoal_Request"] = [uuid, (name + "_Goal", "goal")]
                    self.fields[name + "_SendGoal_Response"] = [("bool", "accepted"), ("builtin_interfaces/Time", "stamp")]
                    self.fields[name + "_GetResult_Request"] = [uuid]
                    self.fields[name + "_GetResult_Response"] = [("int8", "status"), (name + "_Result", "result")]
                    self.fields[name + "_FeedbackMessage"] = [uuid, (name + "_Feedback", "feedback")]
            elif line == "---":
                part += 1
            elif line and not ("=" in line and "<=" not in line):
                type_name, own = line.split()[:2]
                self.fields[name + self.ends[part]].append((type_name, own))

    def of(self, name):
        """The class of a message."""
        if name not in self.classes:
            package, own = name.split("/")
            kind = next(kind for base, kind in self.kinds.items() if name == base or name.startswith(base + "_"))
            kind = {"MSG": "msg", "SRV": "srv", "ACTION": "action"}[kind]
            fields = {own: self.type(text, package) for text, own in self.fields[name]}
            fields = fields or {"structure_needs_at_least_one_member": types.uint8}
            dds = "%s::%s::dds_::%s_" % (package, kind, own)
            # Requests and responses stand in a call, which has their name.
            is_part = name.endswith(("_Request", "_Response"))
            self.classes[name] = make_idl_struct(own, own + "Data" if is_part else dds, fields)
            self.names[name] = dds
        return self.classes[name]

    def type(self, text, package):
        base, _, count = text.partition("[")
        inner = PRIMITIVES.get(base) or self.of(base if "/" in base else "%s/%s" % (package, base))
        if not count:
            return inner
        size = count.rstrip("]")
        if not size or size.startswith("<="):
            return types.sequence[inner]
        return types.array[inner, int(size)]

    def call(self, name):
        """The class of a request or a response with the header of Cyclone DDS."""
        inner = self.of(name)
        return make_idl_struct(inner.__name__ + "Call", self.names[name], {"header": self.header, "data": inner})

    def zero(self, name, /, **values):
        """A message with zeros, apart from some fields. Nested messages are dictionaries."""
        package = name.split("/")[0]
        made = {}
        for text, own in self.fields[name]:
            base, _, count = text.partition("[")
            full = base if base in PRIMITIVES or "/" in base else "%s/%s" % (package, base)
            given = values.pop(own, None)
            size = count.rstrip("]")
            if count:
                given = [] if given is None else list(given)
                if size.isdigit() and not given:
                    given = [0] * int(size)
                made[own] = given if base in PRIMITIVES else [self.made(full, one) for one in given]
            elif base in PRIMITIVES:
                made[own] = given if given is not None else {"bool": False, "string": ""}.get(base, 0.0 if "float" in base else 0)
            else:
                made[own] = self.made(full, given or {})
        assert not values, "%s has no %s" % (name, list(values))
        made = made or {"structure_needs_at_least_one_member": 0}
        return self.of(name)(**made)

    def made(self, name, value):
        return self.zero(name, **value) if isinstance(value, dict) else value


def stamp(now=None):
    """The time as builtin_interfaces/Time."""
    now = time.time() if now is None else now
    return {"sec": int(now), "nanosec": int((now % 1.0) * 1e9)}


class Node:
    """A participant with topics."""

    def __init__(self, types_of, domain):
        self.types, self.participant = types_of, DomainParticipant(domain)

    def topic(self, name, of, qos):
        return Topic(self.participant, name, of, qos=qos)

    def publisher(self, name, type_name, qos=RELIABLE):
        return DataWriter(self.participant, self.topic("rt" + name, self.types.of(type_name), qos), qos=qos)

    def subscription(self, name, type_name, qos=RELIABLE):
        return DataReader(self.participant, self.topic("rt" + name, self.types.of(type_name), qos), qos=qos)


class Service:
    """A server of a service, with the header of Cyclone DDS."""

    def __init__(self, node, name, type_name):
        self.types, self.type_name = node.types, type_name
        request = node.topic("rq" + name + "Request", node.types.call(type_name + "_Request"), RELIABLE)
        self.response = node.types.call(type_name + "_Response")
        reply = node.topic("rr" + name + "Reply", self.response, RELIABLE)
        self.reader = DataReader(node.participant, request, qos=RELIABLE)
        self.writer = DataWriter(node.participant, reply, qos=RELIABLE)

    def requests(self):
        return [one for one in self.reader.take(64) if hasattr(one, "data")]

    def reply(self, header, seq=None, **values):
        header = type(header)(guid=header.guid, seq=header.seq if seq is None else seq)
        self.writer.write(self.response(header=header, data=self.types.zero(self.type_name + "_Response", **values)))


EXECUTING, CANCELING, SUCCEEDED, CANCELED, ABORTED = 2, 3, 4, 5, 6


@dataclass
class Goal:
    id: tuple
    goal: object
    begun: float
    status: int = EXECUTING
    result: dict = field(default_factory=dict)
    asked: list = field(default_factory=list)
    is_told: bool = False


class ActionServer:
    """A server of an action. `faults` are those of the whole server: see `robot.py`."""

    def __init__(self, node, name, type_name, accept, begin, cancel, faults=()):
        self.types, self.name, self.type_name, self.faults = node.types, name, type_name, set(faults)
        self.accept, self.begin, self.on_cancel = accept, begin, cancel
        own = name + "/_action/"
        self.send = Service(node, own + "send_goal", type_name + "_SendGoal")
        self.get = Service(node, own + "get_result", type_name + "_GetResult")
        self.cancel = Service(node, own + "cancel_goal", "action_msgs/CancelGoal")
        self.feedback = node.publisher(own + "feedback", type_name + "_FeedbackMessage")
        self.status = node.publisher(own + "status", "action_msgs/GoalStatusArray", LATCHED)
        self.goals, self.late = {}, []

    def running(self):
        return [goal for goal in self.goals.values() if goal.status in (EXECUTING, CANCELING)]

    def end(self, goal, status, **result):
        goal.status, goal.result = status, result
        self.tell()

    def tell(self):
        states = [{"goal_info": {"goal_id": {"uuid": list(goal.id)}}, "status": goal.status} for goal in self.goals.values()]
        self.status.write(self.types.zero("action_msgs/GoalStatusArray", status_list=states[-20:]))

    def answer(self, header, accepted):
        if "other-goal" in self.faults:
            # Answers for a call that nobody made, before the right one.
            self.send.reply(header, seq=header.seq + 1000, accepted=not accepted)
        if "late" in self.faults:
            self.late.append((time.monotonic() + 3.0, header, accepted))
            return
        if "silent" not in self.faults:
            self.send.reply(header, accepted=accepted)
        if "twice" in self.faults:
            self.send.reply(header, accepted=accepted)
            self.send.reply(header, accepted=not accepted)

    def step(self):
        """Answers what has come."""
        now = time.monotonic()
        for due, header, accepted in [one for one in self.late if one[0] <= now]:
            self.send.reply(header, accepted=accepted)
        self.late = [one for one in self.late if one[0] > now]
        for request in self.send.requests():
            data = request.data
            accepted = self.accept(data.goal)
            if accepted:
                goal = Goal(tuple(data.goal_id.uuid), data.goal, now)
                self.goals[goal.id] = goal
                self.begin(goal)
                if "mute" not in self.faults:
                    self.tell()
            self.answer(request.header, accepted)
        for request in self.cancel.requests():
            wanted = tuple(request.data.goal_info.goal_id.uuid)
            found = [goal for goal in self.running() if goal.id == wanted or not any(wanted)]
            heeds = "ignore-cancel" not in self.faults
            for goal in found if heeds else ():
                goal.status = CANCELING
                self.on_cancel(goal)
            infos = [{"goal_id": {"uuid": list(goal.id)}} for goal in found]
            self.cancel.reply(request.header, return_code=0 if found else 2, goals_canceling=infos)
        for request in self.get.requests():
            goal = self.goals.get(tuple(request.data.goal_id.uuid))
            if goal is None:
                self.get.reply(request.header, status=0)
            else:
                goal.asked.append(request.header)
        for goal in self.goals.values():
            if goal.status > CANCELING:
                for header in goal.asked:
                    for _ in range(2 if "twice" in self.faults else 1):
                        self.get.reply(header, status=goal.status, result=goal.result)
                goal.asked = []
