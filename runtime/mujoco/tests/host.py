"""A small host for tests: it speaks version 2 of the driver protocol with a driver process."""

import json
import os
import subprocess
import sys


class Host:
    """A driver process, and what it reported."""

    def __init__(self, robot, scene, *flags):
        here = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
        environment = dict(os.environ, PYTHONPATH=here)
        command = [sys.executable, "-m", "motet_mujoco", "--robot", robot, "--scene", scene, *flags]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                        env=environment)
        self.number, self.now, self.reports, self.goals = 0, 0.0, [], 0
        self.welcome = self.call("hello", protocol=2, run="test", resumed=False, robot=robot, policy="test",
                                 primitives=[])

    def call(self, method, **params):
        """Calls a method; the result, or the error as {"error": …}."""
        self.number += 1
        params["at"] = self.now
        line = json.dumps({"jsonrpc": "2.0", "id": self.number, "method": method, "params": params})
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        while True:
            message = json.loads(self.process.stdout.readline())
            if message.get("id") == self.number:
                return message["result"] if "result" in message else {"error": message["error"]}
            self.reports.append(message)

    def start(self, primitive, **args):
        """Starts a goal; its number, and the answer."""
        self.goals += 1
        command = {"primitive": primitive, "args": list(args.items()), "uses": [], "deadline_secs": 120.0}
        return self.goals, self.call("start", goal=self.goals, command=command)

    def advance(self, secs):
        """Lets time pass."""
        end = self.now + secs
        while self.now < end - 1e-6:
            self.now = self.call("advance", until=min(self.now + 0.5, end))["now"]

    def carry_out(self, primitive, patience=150.0, **args):
        """Carries out a primitive; its outcome."""
        goal, answer = self.start(primitive, **args)
        if "error" in answer:
            return answer
        begun = self.now
        while self.now - begun < patience:
            self.now = self.call("advance", until=self.now + 0.5)["now"]
            for report in self.reports:
                if report["method"] == "ended" and report["params"]["goal"] == goal:
                    return report["params"]["outcome"]
        return "late"

    def holds(self, fluent, *args):
        """The truth of a fact."""
        patterns = [{"is": {"entity": one}} if one != "any" else "any" for one in args]
        answer = self.call("observe", query={"fact": {"fluent": fluent, "args": patterns}})["answer"]
        return answer if answer == "unknown" else answer["truth"]

    def close(self):
        """Ends the driver; its exit code."""
        self.process.stdin.write(json.dumps({"jsonrpc": "2.0", "method": "bye", "params": {}}) + "\n")
        self.process.stdin.close()
        return self.process.wait(timeout=20)


def entity(one):
    """Value of an entity."""
    return {"entity": one}


def text(one):
    """Value of a text."""
    return {"text": one}


def pose(place):
    """Value of a pose."""
    return {"pose": {"xyz": place, "quaternion": [0.0, 0.0, 0.0, 1.0]}}


def fact(fluent, *args, holds=True):
    """A fact of `hello`."""
    return {"query": {"fact": {"fluent": fluent, "args": [{"is": {"entity": one}} for one in args]}}, "holds": holds}


def forgotten(scene, thing):
    """A scene that does not say where a thing is."""
    keys = ("pose", "on", "in")
    return {**scene, "entities": [{key: value for key, value in one.items() if one["id"] != thing or key not in keys}
                                  for one in scene["entities"]]}


def placed(world, base, tilt=-0.5):
    """Puts the robot somewhere at once, its head bent: the targets for that. The base may be x and y alone."""
    target = world.target.copy()
    target[: len(base)] = base
    target[world.model.controls["head_tilt_joint"]] = tilt
    world.data.qpos[world.model.control_qpos] = target
    return target
