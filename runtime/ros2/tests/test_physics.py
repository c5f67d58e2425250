"""The world of MuJoCo behind the topics of ROS 2: Motet, DDS, physics."""

import json
import subprocess
import threading
import time
from queue import Queue

from host import HERE, MOTET, RobotProcess

EXAMPLES = HERE.parent.parent.parent / "examples"
DRIVER = "ros2:%s" % (HERE / "hsr.toml")


def run(driver, *flags):
    """Runs `fetch_mug`; the events of the run, and the exit code."""
    command = [MOTET, "run", str(EXAMPLES / "fetch_mug.motet"), "--robot", "hsr", "--scene", "kitchen", "--driver", driver,
               "--format", "json", *flags]
    done = subprocess.run(command, capture_output=True, text=True, timeout=240)
    return [json.loads(line) for line in done.stdout.splitlines()], done


def endings(events):
    return [(event["step"], event["ending"]) for event in events if event["event"] == "ended"]


def test_fetch_mug_through_dds_ends_as_the_direct_run_does():
    with RobotProcess("--physics") as robot:
        events, done = run(DRIVER)
        assert done.returncode == 0, done.stdout[-2000:] + done.stderr
        gripped = robot.events("gripped")
        assert [event["held"] for event in gripped] == [[], ["mug_1"], []], gripped
        assert gripped[-1]["given"] == {"mug_1": "user"}
    direct, done = run("mujoco", "--speed", "max", "--profile", "ideal")
    assert done.returncode == 0, done.stdout[-2000:] + done.stderr
    assert endings(events) == endings(direct)


class Agent:
    """A client of `motet mcp`."""

    def __init__(self):
        command = [MOTET, "mcp", "--robot", "hsr", "--scene", "kitchen", "--drive", DRIVER]
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
        answer = self.answers[self.number] = Queue()
        self.send({"jsonrpc": "2.0", "id": self.number, "method": method, "params": params})
        return answer

    def call(self, method, **params):
        return self.begin(method, **params).get(timeout=90)

    def close(self):
        self.process.stdin.close()
        self.process.wait(timeout=20)


def test_a_policy_is_swapped_in_mid_motion():
    with RobotProcess("--physics") as robot:
        agent = Agent()
        first = agent.begin("tools/call", name="run_policy", arguments={"policy": "policy a for hsr { go(kitchen_table) done }"})
        while not robot.events("trajectory"):
            time.sleep(0.05)
        time.sleep(2.0)
        swapped = agent.call("tools/call", name="swap_policy", arguments={"policy": "policy b for hsr { go(user) done }"})
        assert not swapped["result"].get("isError"), swapped
        ended = first.get(timeout=90)
        assert not ended["result"].get("isError"), ended
        agent.close()
        before, *_, after = robot.events("trajectory")
        assert before["id"] in [event["id"] for event in robot.events("cancel")]
        assert after["id"] in [event["id"] for event in robot.events("done")]
        # The second path begins where the first one was left.
        assert abs(after["points"][0][1][0] - before["points"][-1][1][0]) > 0.1
