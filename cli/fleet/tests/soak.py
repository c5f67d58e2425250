"""Robots against one server that is killed, agents that are killed, runs that are killed, links that are cut: every order runs
once, and every journal arrives whole and in order."""

import argparse
import json
import os
import random
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path

from cases import Cases

ACCOUNTS = Path(__file__).resolve().parent / "accounts.conf"


class Proxy:
    """A link that can be cut."""

    def __init__(self, port, to):
        self.to, self.is_cut, self.open = to, False, set()
        self.listener = socket.create_server(("127.0.0.1", port))
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            near, _ = self.listener.accept()
            if self.is_cut:
                near.close()
                continue
            try:
                far = socket.create_connection(("127.0.0.1", self.to), timeout=2)
                far.settimeout(None)
            except OSError:
                near.close()
                continue
            self.open |= {near, far}
            for one, other in ((near, far), (far, near)):
                threading.Thread(target=self.pump, args=(one, other), daemon=True).start()

    def pump(self, one, other):
        try:
            while data := one.recv(65536):
                other.sendall(data)
        except OSError:
            pass
        for end in (one, other):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass

    def cut(self):
        self.is_cut = True
        for end in list(self.open):
            try:
                end.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        self.open.clear()

    def mend(self):
        self.is_cut = False


class Soak(Cases):
    def __init__(self, args):
        self.args, self.chance = args, random.Random(args.seed)
        self.folder = Path(args.folder)
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.port, self.server, self.agents, self.orders = args.port, None, {}, {}
        self.proxy = Proxy(args.port + 1, args.port)
        self.log, self.others = [], []

    def fleet(self, *words, ok=(0,), tries=1, role="operator"):
        """Runs `motet-fleet fleet`; its output."""
        command = [self.args.fleet, "fleet", "--server", "nats://127.0.0.1:%d" % self.port, "--login", str(self.login(role)), *words]
        for attempt in range(tries):
            done = subprocess.run(command, capture_output=True, text=True, timeout=120)
            if done.returncode in ok:
                return done.stdout
            time.sleep(0.5)
        raise AssertionError("%s: %s%s" % (words[:2], done.stdout, done.stderr))

    def login(self, role):
        path = self.folder / (role + ".login")
        if not path.exists():
            path.write_text("%s:%s-password\n" % (role, role))
        return path

    def accounts(self):
        """The users of this fleet, each robot with its own permissions."""
        path = self.folder / "accounts.conf"
        if not path.exists():
            before, robot, after = ACCOUNTS.read_text().split("    # ROBOT\n")
            path.write_text(before + "".join(robot.replace("NAME", "r%d" % at) for at in range(self.args.robots)) + after)
        return path

    def start_server(self):
        log = open(self.folder / "server.log", "a")
        command = [self.args.nats, "-c", str(self.accounts()), "-p", str(self.port), "-a", "127.0.0.1", "-js", "-sd", str(self.folder / "store")]
        self.server = subprocess.Popen(command, stdout=log, stderr=log)
        for _ in range(100):
            try:
                socket.create_connection(("127.0.0.1", self.port), timeout=1).close()
                return
            except OSError:
                time.sleep(0.05)
        raise AssertionError("the server does not start")

    def start_agent(self, robot, speed=None):
        number = int(robot[1:])
        port = self.port + 1 if number % 3 == 0 else self.port
        log = open(self.folder / (robot + ".log"), "a")
        command = [self.args.fleet, "agent", "--robot", robot, "--server", "nats://127.0.0.1:%d" % port, "--login",
                   str(self.login(robot)), "--trust", str(self.folder / "anna.pub"), "--card", "hsr", "--scene", "kitchen",
                   "--folder", str(self.folder / robot), "--speed", str(speed or self.args.speed), "--motet", self.args.motet]
        self.agents[robot] = subprocess.Popen(command, stdout=log, stderr=log)

    def send(self, number):
        robot = "r%d" % (number % self.args.robots)
        order = "order-%d" % number
        policy = self.folder / "policy.motet"
        more = " go(user)" if number % 10 == 0 else ""
        policy.write_text('policy work for hsr { say("Order %d.") say("Still here.")%s done }' % (number, more))
        self.fleet("send", robot, str(policy), "--key", str(self.folder / "anna.key"), "--id", order, tries=60)
        if number % 17 == 0:
            # The same order once more: it does not run twice.
            self.fleet("send", robot, str(policy), "--key", str(self.folder / "anna.key"), "--id", order, tries=60)
        self.orders[order] = robot

    def runs(self):
        """Processes of runs."""
        found = []
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit():
                try:
                    words = (entry / "cmdline").read_bytes().split(b"\0")
                except OSError:
                    continue
                if len(words) > 2 and words[1] == b"run" and str(self.folder).encode() in b" ".join(words):
                    found.append(int(entry.name))
        return found

    def fault(self, what):
        self.log.append(what)
        if what == "server":
            self.server.kill()
            self.server.wait()
            time.sleep(self.chance.uniform(0.2, 2.0))
            self.start_server()
        elif what == "agent":
            robot = self.chance.choice(list(self.agents))
            self.agents[robot].kill()
            self.agents[robot].wait()
            time.sleep(self.chance.uniform(0.0, 1.0))
            self.start_agent(robot)
        elif what == "run":
            for process in self.runs()[:2]:
                try:
                    os.kill(process, signal.SIGKILL)
                except OSError:
                    pass
        elif what == "link":
            self.proxy.cut()
            threading.Timer(self.args.cut, self.proxy.mend).start()

    def play(self):
        args = self.args
        self.start_server()
        self.fleet("init", tries=10, role="admin")
        self.fleet("key", str(self.folder / "anna.key"))
        for number in range(args.robots):
            self.start_agent("r%d" % number)
        faults = ["server"] * args.server_kills + ["agent"] * args.agent_kills + ["run"] * args.run_kills + ["link"] * args.link_cuts
        self.chance.shuffle(faults)
        begun, sent = time.monotonic(), 0
        while sent < args.orders or faults:
            share = (time.monotonic() - begun) / args.secs
            if faults and share > 1.0 - len(faults) / (args.server_kills + args.agent_kills + args.run_kills + args.link_cuts + 1):
                self.fault(faults.pop())
            if sent < args.orders and sent <= share * args.orders:
                self.send(sent)
                sent += 1
            else:
                time.sleep(0.02)
        self.log.append("all sent after %.0f s" % (time.monotonic() - begun))
        self.settle()
        self.took = time.monotonic() - begun

    def settle(self):
        """Waits until all orders have results and all journals have arrived."""
        limit = time.monotonic() + self.args.patience
        while time.monotonic() < limit:
            waiting = [order for order, robot in self.orders.items() if not (self.folder / robot / "orders" / order / "shipped").exists()]
            if not waiting:
                return
            time.sleep(0.5)
        raise AssertionError("%d orders wait: %s" % (len(waiting), waiting[:5]))

    def check(self):
        resumed = lines = 0
        for order, robot in self.orders.items():
            folder = self.folder / robot / "orders" / order
            result = json.loads((folder / "result.json").read_text())
            assert result == {"state": "ended", "outcome": "done", "why": None}, (order, result)
            own = b"".join(path.read_bytes() for path in sorted((folder / "run").glob("*.journal")))
            resumed += own.count(b'"entry":{"resumed"')
            said = own.count(b'"command":{"primitive":"say","args":[["text",{"text":"Order')
            begun = own.count(b'"event":"begin"')
            assert said == 1 and begun == 1, (order, said, begun)
            lines += own.count(b"\n")
            others = [other for other in self.agents if other != robot and (self.folder / other / "orders" / order).exists()]
            assert not others, (order, others)
        sample = list(self.orders) if self.args.all else self.chance.sample(list(self.orders), min(25, len(self.orders)))
        for order in sample:
            robot, copy = self.orders[order], self.folder / "copy" / order
            copy.parent.mkdir(exist_ok=True)
            self.fleet("journal", robot, order, str(copy), tries=3)
            own = b"".join(path.read_bytes() for path in sorted((self.folder / robot / "orders" / order / "run").glob("*.journal")))
            assert (copy / "000000000000.journal").read_bytes() == own, order
        for order in sample[:5]:
            done = subprocess.run([self.args.motet, "replay", str(self.folder / "copy" / order)], capture_output=True, text=True)
            assert done.returncode == 0, done.stderr
        print("%d orders of %d robots in %.0f s, %d journal lines: none lost, none doubled; %d journals from the server are whole; "
              "%d runs were continued; faults: %s" % (len(self.orders), self.args.robots, self.took, lines, len(sample), resumed, self.log))

    def close(self):
        for process in [*self.others, *self.agents.values(), self.server]:
            if process:
                process.kill()
        for process in self.runs():
            os.kill(process, signal.SIGKILL)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--folder", required=True)
    parser.add_argument("--motet", required=True)
    parser.add_argument("--fleet", required=True)
    parser.add_argument("--nats", default="nats-server")
    parser.add_argument("--port", type=int, default=4471)
    parser.add_argument("--robots", type=int, default=4)
    parser.add_argument("--orders", type=int, default=40)
    parser.add_argument("--secs", type=float, default=20.0)
    parser.add_argument("--server-kills", type=int, default=1)
    parser.add_argument("--agent-kills", type=int, default=2)
    parser.add_argument("--run-kills", type=int, default=2)
    parser.add_argument("--link-cuts", type=int, default=1)
    parser.add_argument("--cut", type=float, default=3.0, help="seconds of a cut link")
    parser.add_argument("--swaps", type=int, default=20)
    parser.add_argument("--speed", type=float, default=10.0)
    parser.add_argument("--patience", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--page", help="script that looks at the page of the fleet in a browser")
    parser.add_argument("--all", action="store_true", help="compare every journal with that of the server")
    soak = Soak(parser.parse_args())
    try:
        soak.play()
        soak.check()
        soak.cases()
    finally:
        soak.close()


if __name__ == "__main__":
    sys.exit(main())
