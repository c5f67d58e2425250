"""A small host, and the robot and the driver that it talks to."""

import base64
import io
import json
import os
import queue
import select
import signal
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

import numpy as np
from PIL import Image

HERE = Path(__file__).resolve().parent
DRIVER = os.environ.get("MOTET_ROS2", "motet-ros2")
MOTET = os.environ.get("MOTET", "motet")


class RobotProcess:
    """The robot of `robot.py` with faults."""

    def __init__(self, *flags, binding="hsr.toml"):
        self.log = tempfile.NamedTemporaryFile("r", suffix=".jsonl")
        command = [sys.executable, str(HERE / "robot.py"), str(HERE / binding), "--log", self.log.name, "--motet", MOTET, *flags]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline().strip() == "ready"

    def events(self, name=None):
        self.log.seek(0)
        events = [json.loads(line) for line in self.log if line.endswith("\n")]
        return [event for event in events if name in (None, event["event"])]

    def wait(self, name, secs=20.0, count=1):
        """True if something happens so often in time."""
        end = time.monotonic() + secs
        while len(self.events(name)) < count and time.monotonic() < end:
            time.sleep(0.02)
        return len(self.events(name)) >= count

    def close(self):
        self.process.send_signal(signal.SIGTERM)
        self.process.wait(timeout=10)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Driver:
    """`motet-ros2 drive`, and what it reported."""

    def __init__(self, binding="hsr.toml", run="test", greet=True, motet=MOTET, robot="hsr", scene="kitchen"):
        command = [DRIVER, "drive", str(HERE / binding), "--robot", robot, "--scene", scene, "--motet", motet]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.lines, self.number, self.reports, self.goals = queue.Queue(), 0, [], 0
        self.is_deaf = self.closes = False
        threading.Thread(target=self.read, daemon=True).start()
        self.alive, self.moved = True, {"joints": {}}
        threading.Thread(target=self.beat, daemon=True).start()
        self.lock = threading.Lock()
        if greet:
            found = ["not_found", "ambiguous"]
            fails = {"home": ["blocked"], "go": ["unreachable", "blocked"], "detect": found, "say": [], "detect_all": [],
                     "search": [*found, "unreachable", "blocked"], "locate": ["not_found"], "choose": ["refused", "ambiguous"]}
            results = {"detect": "Object", "detect_all": "List<Object>", "search": "Object", "locate": "Pose", "choose": "Object"}
            self.welcome = self.call("hello", protocol=2, run=run, resumed=False, at=0.0, robot=robot, policy="test",
                                     primitives=[{"name": name, "fails": kinds, "result": results.get(name)} for name, kinds in fails.items()])

    def read(self):
        output, bytes_of = self.process.stdout.fileno(), b""
        while not self.is_deaf:
            if not select.select([output], [], [], 0.05)[0]:
                continue
            read = os.read(output, 65536)
            if not read:
                break
            *lines, bytes_of = (bytes_of + read).split(b"\n")
            for line in lines:
                self.lines.put(json.loads(line))
        if self.closes:
            self.process.stdout.close()
        self.lines.put(None)

    def deaf(self, closes):
        """Reads no more, and may close the output."""
        self.closes, self.is_deaf = closes, True

    def beat(self):
        while self.alive:
            time.sleep(1.0)
            if self.alive:
                self.send({"jsonrpc": "2.0", "id": "beat", "method": "ping", "params": {}})

    def send(self, message):
        try:
            self.process.stdin.write(json.dumps(message) + "\n")
            self.process.stdin.flush()
        except (BrokenPipeError, ValueError):
            pass

    def next(self, secs):
        """The next message other than telemetry; None if none comes in time."""
        end = time.monotonic() + secs
        while time.monotonic() < end:
            try:
                message = self.lines.get(timeout=max(end - time.monotonic(), 0.001))
            except queue.Empty:
                return None
            if message is None:
                return None
            if message.get("id") == "beat":
                continue
            if message.get("method") == "moved":
                self.moved = message["params"]
                continue
            return message
        return None

    def call(self, method, **params):
        """The result of a call, or {"error": …}."""
        self.number += 1
        number = self.number
        self.send({"jsonrpc": "2.0", "id": number, "method": method, "params": params})
        while True:
            message = self.next(10.0)
            assert message is not None, "no answer to " + method
            if message.get("id") == number:
                return message["result"] if "result" in message else {"error": message["error"]}
            self.reports.append(message)

    def start(self, primitive, motions=(), **args):
        self.goals += 1
        command = {"primitive": primitive, "args": list(args.items()), "uses": [], "deadline_secs": 60.0, "motions": list(motions)}
        return self.goals, self.call("start", goal=self.goals, command=command)

    def discovers(self, joint, secs=30.0):
        """True once telemetry tells of a joint: with lost packets DDS may take its time."""
        end = time.monotonic() + secs
        while joint not in self.moved["joints"] and time.monotonic() < end:
            self.call("ping")
            time.sleep(0.1)
        return joint in self.moved["joints"]

    def move(self, query, *args):
        """Starts a motion without a path."""
        goal, answer = self.start("home", [{"query": query, "args": list(args), "verdict": "open"}])
        assert "error" not in answer, answer
        return goal

    def lift(self, height, secs=1.0, begin=0.0, clearance=0.1):
        """Starts a motion of the arm's lift."""
        path = [{"base": [0.0, 0.0, 0.0], "joints": [begin], "at": 0.0},
                {"base": [0.0, 0.0, 0.0], "joints": [height], "at": secs, "ramp": secs / 4.0}]
        witness = {"joints": ["arm_lift_joint"], "path": path, "clearance": clearance}
        return self.start("home", [{"query": "posture", "args": [{"case": "home"}], "verdict": "proven", "witness": witness}])[0]

    def report(self, method, goal, secs=10.0):
        """Parameters of a report about a goal; None if it does not come in time."""
        for at, message in enumerate(self.reports):
            if message.get("method") == method and message["params"].get("goal") == goal:
                return self.reports.pop(at)["params"]
        end = time.monotonic() + secs
        while time.monotonic() < end:
            message = self.next(end - time.monotonic())
            if message is None:
                return None
            if message.get("method") == method and message["params"].get("goal") == goal:
                return message["params"]
            self.reports.append(message)
        return None

    def ended(self, goal, secs=10.0):
        params = self.report("ended", goal, secs)
        return params and params["outcome"]

    def texts(self, goal):
        return [one["params"]["text"] for one in self.reports if one.get("method") == "feedback" and one["params"]["goal"] == goal]

    def kill(self):
        self.alive = False
        self.process.kill()
        self.process.wait()

    def close(self):
        """Says good-bye; the exit code."""
        self.alive = False
        self.send({"jsonrpc": "2.0", "method": "bye", "params": {}})
        try:
            return self.process.wait(timeout=10)
        finally:
            self.process.kill()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.alive:
            self.close()


def drive(driver, end, joints=(), secs=4.0, begin=(0.0, 0.0, 0.0)):
    """Starts a motion of the base to a place, and then of joints."""
    path = [{"base": list(begin), "joints": [0.0 for _ in joints], "at": 0.0},
            {"base": end, "joints": [0.0 for _ in joints], "at": secs, "ramp": 1.0}]
    if joints:
        path.append({"base": end, "joints": [value for _, value in joints], "at": secs + 1.0, "ramp": 0.3})
    witness = {"joints": [name for name, _ in joints], "path": path, "clearance": 0.1}
    args = {"to": {"entity": "counter"}}
    return driver.start("go", [{"query": "go_to", "args": [{"entity": "counter"}], "verdict": "proven", "witness": witness}], **args)[0]


def pixels(picture):
    """Rows of pixels of a picture that the driver took, and their depths in m."""
    image = Image.open(io.BytesIO(base64.b64decode(picture["image"]["png"])))
    assert image.size == (picture["image"]["width"], picture["image"]["height"])
    depth = np.frombuffer(base64.b64decode(picture["depth"]["mm"]), dtype="<u2").reshape(image.height, image.width)
    return np.asarray(image), depth / 1000.0


class Agent:
    """A client of `motet mcp`."""

    def __init__(self, robot, scene, driver):
        journals = tempfile.mkdtemp()
        command = [MOTET, "mcp", "--robot", robot, "--scene", scene, "--drive", driver, "--journals", journals]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        self.answers, self.number = {}, 0
        threading.Thread(target=self.read, daemon=True).start()
        self.call("initialize", protocolVersion="2025-06-18", capabilities={}, clientInfo={"name": "test", "version": "1"})
        self.send({"jsonrpc": "2.0", "method": "notifications/initialized"})

    def read(self):
        for line in self.process.stdout:
            message = json.loads(line)
            if message.get("id") in self.answers:
                self.answers[message["id"]].put(message)

    def send(self, message):
        self.process.stdin.write(json.dumps(message) + "\n")
        self.process.stdin.flush()

    def begin(self, method, **params):
        self.number += 1
        answer = self.answers[self.number] = queue.Queue()
        self.send({"jsonrpc": "2.0", "id": self.number, "method": method, "params": params})
        return answer

    def call(self, method, **params):
        return self.begin(method, **params).get(timeout=90)

    def close(self):
        self.process.stdin.close()
        self.process.wait(timeout=20)
