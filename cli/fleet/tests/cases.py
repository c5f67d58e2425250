"""What operators do with a fleet, and what becomes of it: policies that take over, questions, stops, keys, the page."""

import json
import os
import re
import signal
import statistics
import subprocess
import time
import urllib.error
import urllib.request
from pathlib import Path


class Cases:
    """Cases on the robots r0 to r3, after the faults are over. A soak has the robots and the folder."""

    def cases(self):
        self.swaps()
        self.late_swaps()
        self.questions()
        self.stops()
        self.ids()
        self.revoked()
        self.permissions()
        self.page()
        self.secrets()

    def key(self, name="anna"):
        path = self.folder / (name + ".key")
        if not path.exists():
            self.fleet("key", str(path))
        return ["--key", str(path)]

    def wait(self, what, why):
        """Waits until something is so; what it gives."""
        limit = time.monotonic() + self.args.patience
        while time.monotonic() < limit:
            if found := what():
                return found
            time.sleep(0.1)
        raise AssertionError(why)

    def swaps(self):
        """Times from the offer of a policy to the news that it has taken over, in ms."""
        (self.folder / "long.motet").write_text("policy long for hsr { go(kitchen_table) go(user) go(counter) go(user) done }")
        key = str(self.folder / "anna.key")
        self.fleet("send", "r0", str(self.folder / "long.motet"), "--key", key, "--id", "long")
        self.wait(lambda: "long:" in self.fleet("status"), "the order does not begin")
        time.sleep(0.5)
        times, refused = [], []
        for number in range(self.args.swaps):
            place = ("user", "counter", "kitchen_table")[number % 3]
            (self.folder / "swap.motet").write_text('policy s%d for hsr { go(%s) say("Here I am.") done }' % (number, place))
            answer = json.loads(self.fleet("swap", "r0", str(self.folder / "swap.motet"), "--key", key, ok=(0, 1)))
            assert answer["id"], answer
            if "policy" in answer:
                times.append(answer["ms"])
            else:
                # The state has changed since the check: the policy before goes on.
                refused.append(answer["problem"])
        self.fleet("stop", "r0", ok=(0, 1))
        times.sort()
        print("swaps: median %.1f ms, p99 %.1f ms, greatest %.1f ms of %d; %d refused %s"
              % (statistics.median(times), times[int(0.99 * (len(times) - 1))], times[-1], len(times), len(refused), refused[:2]))

    def kill_run(self, order):
        """Kills the process of the run of an order."""
        for process in self.runs():
            if order.encode() in Path("/proc/%d/cmdline" % process).read_bytes():
                os.kill(process, signal.SIGKILL)

    def send_policy(self, robot, order, steps, key=None):
        path = self.folder / (order + ".motet")
        path.write_text("policy own for hsr { %s done }" % steps)
        self.fleet("send", robot, str(path), *(key or self.key()), "--id", order)

    def result(self, robot, order):
        path = self.folder / robot / "orders" / order / "result.json"
        limit = time.monotonic() + self.args.patience
        while not path.exists() and time.monotonic() < limit:
            time.sleep(0.1)
        return json.loads(path.read_text())

    def question(self, robot):
        """The open question of a robot, as `ask` shows it."""
        limit = time.monotonic() + self.args.patience
        while time.monotonic() < limit:
            shown = self.fleet("ask", robot, ok=(0, 2))
            if "question " in shown:
                return shown.split("question ")[-1].strip()
            time.sleep(0.2)
        raise AssertionError("%s asks nothing" % robot)

    def questions(self):
        """An answer is for the question that was read, and somebody answers also after the run was killed."""
        key = ["--key", str(self.folder / "anna.key")]
        self.send_policy("r1", "asks", 'let one = ask("May I go?") go(user) go(counter) let two = ask("May I stop?") say(two)')
        first = self.question("r1")
        wrong = self.fleet("ask", "r1", "yes", "--question", "other/1:3", *key, ok=(1,))
        assert "does not run" in wrong, wrong
        self.fleet("ask", "r1", "yes", "--question", first, *key)
        self.wait(lambda: "asks: go(" in self.fleet("status"), "the answer does not arrive")
        self.kill_run("asks")
        second = self.question("r1")
        assert second != first, second
        late = self.fleet("ask", "r1", "no", "--question", first, *key, ok=(1,))
        assert "waits no longer" in late, late
        self.fleet("ask", "r1", "yes", "--question", second, *key)
        assert self.result("r1", "asks")["outcome"] == "done"

    def stops(self):
        """A stop holds although the process of the run has just been killed, and a policy takes over no other order."""
        self.send_policy("r1", "stops", "go(user) go(counter) go(user) go(counter)")
        self.wait(lambda: "stops: go(" in self.fleet("status"), "the order does not begin")
        key = ["--key", str(self.folder / "anna.key")]
        other = self.fleet("swap", "r1", str(self.folder / "swap.motet"), "--order", "asks", *key, ok=(1,))
        assert "the order `asks` does not run" in other, other
        self.kill_run("stops")
        self.fleet("stop", "r1")
        result = self.result("r1", "stops")
        assert (result["state"], result["outcome"]) == ("ended", "interrupted"), result

    def permissions(self):
        """A robot may not give orders, and an order with a wrong key or for another robot does not run."""
        policy, key = self.folder / "policy.motet", str(self.folder / "anna.key")
        answer = self.fleet("send", "r1", str(policy), *self.key("eve"), "--id", "strange", "--wait", ok=(1,))
        assert "their key is not trusted" in answer, answer
        try:
            self.fleet("send", "r1", str(policy), "--key", key, "--id", "by-robot", role="r2")
        except (AssertionError, subprocess.TimeoutExpired):
            pass
        else:
            raise AssertionError("a robot gave an order")
        refused = [line for line in (self.folder / "server.log").read_text().splitlines() if "Violation" in line]
        # What the robot tried above, and nothing else.
        assert refused and all("motet.orders" in line or "_INBOX_operator" in line for line in refused), refused[:3]

    def late_swaps(self):
        """A policy that is wrong comes back with its findings. One that was put while the agent was down is offered at its
        start, one that was put while the link was cut when it is mended; each once, and none again later."""
        self.send_policy("r0", "late", "go(kitchen_table) go(user) go(counter) go(user) go(kitchen_table) go(user)")
        self.wait(lambda: "late: go(" in self.fleet("status"), "the order does not begin")
        wrong = self.folder / "wrong.motet"
        wrong.write_text('policy wrong for hsr { go(3 kg) pick(user) nonsense(1) }')
        answer = json.loads(self.fleet("swap", "r0", str(wrong), *self.key(), ok=(1,)))
        codes = {finding["code"] for finding in answer["findings"]}
        assert answer["problem"] and any(code.startswith("M02") or code.startswith("M03") for code in codes), answer
        counts = {}

        def offered():
            marks = {path.name for path in (self.folder / "r0" / "swaps").iterdir() if "." not in path.name}
            return marks, (self.folder / "r0" / "orders" / "late" / "run" / "000000000000.journal").read_bytes()

        def takes_over(name, away, back):
            """Puts a policy while something is away."""
            path = self.folder / (name + ".motet")
            path.write_text('policy %s for hsr { go(counter) go(user) go(kitchen_table) go(user) say("%s is done.") done }' % (name, name))
            before, _ = offered()
            away()
            command = [self.args.fleet, "fleet", "--server", "nats://127.0.0.1:%d" % self.port, "--login", str(self.login("operator")),
                       "swap", "r0", str(path), *self.key()]
            swap = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
            time.sleep(1.5)
            assert swap.poll() is None and offered()[0] == before, "nobody is there to offer it"
            back()
            out, err = swap.communicate(timeout=60)
            assert swap.returncode == 0, (out, err)
            answer = json.loads(out)
            assert answer["policy"] == name and answer["order"] == "late", answer
            counts[answer["id"]] = len(offered()[0] - before)

        def kill():
            self.agents["r0"].kill()
            self.agents["r0"].wait()

        takes_over("restarted", kill, lambda: self.start_agent("r0"))
        takes_over("mended", self.proxy.cut, self.proxy.mend)
        # Nothing is offered again by a mere new link, a new agent or a new server.
        marks, _ = offered()
        self.proxy.cut()
        self.proxy.mend()
        kill()
        self.start_agent("r0")
        self.fault("server")
        self.fleet("swap", "r0", str(wrong), *self.key(), ok=(1,), tries=20)
        assert len(offered()[0] - marks) == 1 and list(counts.values()) == [1, 1], (counts, marks)
        swapped = offered()[1].count(b'"swapped"')
        self.fleet("stop", "r0")
        assert self.result("r0", "late")["outcome"] == "interrupted"
        print("late swaps: %d policies took over, %d marks of swaps in the journal" % (len(counts), swapped))

    def ids(self):
        """Another policy under an id that was used before is refused, and the result of the first one stays."""
        path = self.folder / "other.motet"
        path.write_text('policy other for hsr { say("Something else.") done }')
        used = list(self.orders)[0]
        robot = self.orders[used]
        kept = self.folder / "kept.motet"
        # It is over: the sender sees it. It is under way: the robot refuses it, also within two minutes.
        answer = json.loads(self.fleet("send", robot, str(path), *self.key(), "--id", used, ok=(1,)))
        assert answer["state"] == "refused" and "is that of another order" in answer["why"], answer
        assert answer["other"]["outcome"] == "done", answer
        kept.write_text('policy own for hsr { go(user) go(counter) go(user) go(counter) done }')
        self.fleet("send", "r2", str(kept), *self.key(), "--id", "kept")
        self.wait(lambda: "kept: go(" in self.fleet("status"), "the order does not begin")
        command = [self.args.fleet, "fleet", "--server", "nats://127.0.0.1:%d" % self.port, "--login", str(self.login("operator")),
                   "send", "r2", str(path), *self.key(), "--id", "kept", "--wait"]
        refused = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        same = subprocess.Popen([str(kept) if word == str(path) else word for word in command], stdout=subprocess.PIPE, text=True)
        time.sleep(1.0)
        self.fleet("stop", "r2")
        answer = json.loads(refused.communicate(timeout=60)[0])
        assert refused.returncode == 1 and answer["state"] == "refused", answer
        assert "the id `kept` is that of another order" in answer["why"], answer
        assert self.result("r2", "kept")["outcome"] == "interrupted"
        # The same order once more is no other one.
        assert json.loads(same.communicate(timeout=60)[0])["outcome"] == "interrupted" and same.returncode == 3

    def revoked(self):
        """A run whose order is of a key that is trusted no more is stopped, also by an agent that is started anew; an order of
        a stranger with the same id changes nothing."""
        trust = self.folder / "anna.pub"
        anna = trust.read_text()
        bert = self.key("bert")

        def trusts(*keys):
            draft = self.folder / "trust.new"
            draft.write_text("".join(keys))
            draft.replace(trust)

        def ended(order):
            result = self.result("r1", order)
            assert (result["state"], result["outcome"]) == ("ended", "interrupted"), result
            assert "the key of the order is trusted no more" in result["why"], result
            command = ["send", "r1", str(self.folder / (order + ".motet")), *bert, "--id", order, "--wait"]
            told = json.loads(self.fleet(*command, ok=(3,)))
            assert told["why"] == result["why"] and told["order"] == order, told

        trusts(anna, (self.folder / "bert.pub").read_text())
        steps = "go(user) go(counter) go(user) go(counter) go(user)"
        self.send_policy("r1", "first", steps, bert)
        self.wait(lambda: "first: go(" in self.fleet("status"), "the order does not begin")
        stranger = ["send", "r1", str(self.folder / "first.motet"), *self.key("eve"), "--id", "first"]
        self.fleet(*stranger)
        time.sleep(1.0)
        assert "first: go(" in self.fleet("status")
        trusts(anna)
        ended("first")
        # The agent is down when the key goes.
        trusts(anna, (self.folder / "bert.pub").read_text())
        self.send_policy("r1", "second", steps, bert)
        self.wait(lambda: "second: go(" in self.fleet("status"), "the order does not begin")
        self.agents["r1"].kill()
        self.agents["r1"].wait()
        self.kill_run("second")
        trusts(anna)
        self.start_agent("r1")
        ended("second")

    def page(self):
        """The page of the fleet shows robots, results and journals, answers and stops, and is for who has its address."""
        command = [self.args.fleet, "fleet", "--server", "nats://127.0.0.1:%d" % self.port, "--login", str(self.login("operator")),
                   "view", *self.key(), "--motet", self.args.motet]
        served = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        self.others.append(served)
        address = served.stdout.readline().split()[-1]
        base, token = address.split("/#")

        def get(path, body=None, **headers):
            request = urllib.request.Request(base + path, data=body, headers={"x-motet-token": token, **headers})
            try:
                with urllib.request.urlopen(request, timeout=60) as answer:
                    return answer.status, answer.headers, answer.read().decode()
            except urllib.error.HTTPError as error:
                return error.code, error.headers, error.read().decode()

        status, headers, html = get("/")
        assert status == 200 and "frame-ancestors 'none'" in headers["content-security-policy"] and token not in html
        for wrong in ({"x-motet-token": "0" * 24}, {"x-motet-token": ""}, {"host": "evil.example:80"}):
            for path, body in (("/robots", None), ("/stop/r1", b""), ("/answer/r1", b"{}"), ("/journal/r1/stops", b"")):
                assert get(path, body, **wrong)[0] == 403, (wrong, path)
        assert get("/stop/no%20robot", b"")[0] == 404

        def shown():
            """The page, once it has read the results up to those of the cases before."""
            told = json.loads(get("/robots")[2])
            results = {(result["robot"], result["order"]): result for result in told["results"]}
            return (told, results) if ("r1", "stops") in results else None

        told, results = self.wait(shown, "the results are not shown")
        assert [robot for robot, _ in told["robots"]] == sorted(self.agents) and told["signs"] and told["shows"], told
        assert results["r1", "stops"]["outcome"] == "interrupted", results
        assert len(told["results"]) <= 100
        order = next(order for (robot, order), result in results.items() if result["outcome"] == "done" and order in self.orders)
        status, _, made = get("/journal/%s/%s" % (self.orders[order], order), b"")
        assert status == 200, made
        place = json.loads(made)["page"]
        status, headers, html = get(place, **{"x-motet-token": ""})
        assert status == 200 and "sandbox" in headers["content-security-policy"]
        assert "Order %s." % order.split("-")[1] in html, html[:500]
        assert get("/journal/" + "0" * 24)[0] == 404 and get(place, host="evil.example:80")[0] == 404
        assert get("/journal/r1/never", b"")[0] == 502
        # A question is answered and a run is stopped by the page. It stays open for 2 min of the run's time: a browser needs
        # some of them, and is slow on a machine that does other things.
        self.agents["r3"].kill()
        self.agents["r3"].wait()
        self.start_agent("r3", speed=1)
        self.send_policy("r3", "page", 'let one = ask("Which way?") say(one) %s' % ("go(user) go(counter) " * 12))
        asked = self.question("r3")
        assert get("/answer/r3", json.dumps({"question": asked, "text": ""}).encode())[0] == 422
        if self.args.page:
            script = ["node", self.args.page, address, str(self.folder), "r3", "page", "left"]
            subprocess.run(script, check=True, timeout=240)
        else:
            answered = get("/answer/r3", json.dumps({"question": asked, "text": "left"}).encode())
            assert answered[0] == 200, answered
            self.wait(lambda: "page: go(" in self.fleet("status"), "the answer does not arrive")
            stopped = json.loads(get("/stop/r3", b"")[2])
            assert stopped["order"] == "page", stopped
        assert self.result("r3", "page")["outcome"] == "interrupted"
        found = lambda: [result for result in json.loads(get("/robots")[2])["results"] if result["order"] == "page"]
        assert self.wait(found, "the result is not shown")[0]["outcome"] == "interrupted"
        served.kill()

    def secrets(self):
        """Neither passwords nor keys nor the tokens of pages are in a log; a token is in a file of its owner alone."""
        secrets = ["-password", *(path.read_text().strip() for path in self.folder.glob("*.key"))]
        pages = list(self.folder.glob("*/orders/*/page"))
        assert len(pages) >= len(self.orders), len(pages)
        for page in pages:
            assert page.stat().st_mode & 0o077 == 0, page
            secrets.append(page.read_text().strip().split("#")[1])
        logs = [*self.folder.glob("*.log"), *self.folder.glob("*/orders/*/*.log"), *self.folder.glob("*/orders/*/*.jsonl")]
        assert len(logs) > len(pages), len(logs)
        # Any token of a page, also of those that a later page has replaced.
        token = re.compile(r"127\.0\.0\.1:\d+/#\w+")
        for log in logs:
            text = log.read_text()
            found = [secret[:4] for secret in secrets if secret in text]
            assert not found and not token.search(text), (log, found)
        print("secrets: none of %d in %d logs" % (len(secrets), len(logs)))
