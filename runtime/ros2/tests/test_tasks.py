"""`motet ros2 tasks`: a node asks Motet to run a policy."""

import json
import subprocess
import time
import uuid

import pytest
from cyclone import RELIABLE, Node, Types
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from host import DRIVER, MOTET

TYPE = "motet_msgs/RunPolicy"
SAYS = 'policy hello for hsr { say("Hello.") let answer = ask("Tea?") done }'
GOES = "policy far for hsr { go(kitchen_table) go(user) go(counter) done }"


class Client:
    """A client of the action."""

    def __init__(self, folder):
        name, self.types = folder + "/run_policy", Types()
        self.node, self.number = Node(self.types, 0), 0
        self.parts = {}
        for end, base in (("send_goal", TYPE + "_SendGoal"), ("get_result", TYPE + "_GetResult"), ("cancel_goal", "action_msgs/CancelGoal")):
            request, response = self.types.call(base + "_Request"), self.types.call(base + "_Response")
            own = "%s/_action/%s" % (name, end)
            writer = DataWriter(self.node.participant, self.node.topic("rq" + own + "Request", request, RELIABLE), qos=RELIABLE)
            reader = DataReader(self.node.participant, self.node.topic("rr" + own + "Reply", response, RELIABLE), qos=RELIABLE)
            self.parts[end] = (base, request, writer, reader)
        self.feedback = self.node.subscription(name + "/_action/feedback", TYPE + "_FeedbackMessage")
        # The last message is kept for late readers; this one hears all.
        self.state = self.node.subscription(folder + "/state", "std_msgs/String")
        self.questions = self.node.subscription(folder + "/questions", "std_msgs/String")
        self.answers = self.node.publisher(folder + "/answers", "std_msgs/String")
        time.sleep(1.5)

    def call(self, end, secs=20.0, **values):
        base, request, writer, reader = self.parts[end]
        self.number += 1
        header = self.types.header(guid=77, seq=self.number)
        writer.write(request(header=header, data=self.types.zero(base + "_Request", **values)))
        limit = time.monotonic() + secs
        while time.monotonic() < limit:
            for answer in reader.take(16):
                if getattr(answer, "header", None) and answer.header.guid == 77 and answer.header.seq == self.number:
                    return answer.data
            time.sleep(0.01)
        raise AssertionError("no answer of " + end)

    def texts(self, reader):
        return [json.loads(one.data) for one in reader.take(64) if hasattr(one, "data")]

    def wait(self, reader, wanted, secs=20.0):
        """The first text on a topic that is wanted."""
        limit = time.monotonic() + secs
        while time.monotonic() < limit:
            found = [text for text in self.texts(reader) if wanted(text)]
            if found:
                return found[0]
            time.sleep(0.02)
        raise AssertionError("nothing was said")

    def answer(self, text):
        """Sends an answer; what became of it."""
        self.answers.write(self.types.zero("std_msgs/String", data=text))
        return self.wait(self.state, lambda event: event["event"] == "answer")

    def start(self, policy):
        goal = list(uuid.uuid4().bytes)
        return goal, self.call("send_goal", goal_id={"uuid": goal}, goal={"policy": policy}).accepted

    def result(self, goal):
        answer = self.call("get_result", goal_id={"uuid": goal})
        return answer.status, answer.result


def served(folder, *flags):
    command = [DRIVER, "tasks", "--robot", "hsr", "--scene", "kitchen", "--middleware", "cyclonedds", "--motet", MOTET,
               "--action", folder + "/run_policy", *flags]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline().strip() == "ready"
    yield Client(folder)
    process.terminate()
    process.wait(timeout=10)


@pytest.fixture(scope="module")
def client():
    yield from served("/motet")


@pytest.fixture
def asking():
    yield from served("/asking", "--answers")


def test_a_node_has_a_policy_run_and_hears_its_events(client):
    goal, accepted = client.start(SAYS)
    assert accepted
    status, result = client.result(goal)
    assert (status, result.code) == (4, 0), result.text
    events = [json.loads(one.feedback.event) for one in client.feedback.take(64) if hasattr(one, "feedback")]
    assert any(event["event"] == "command" and event["primitive"] == "say" for event in events)
    digits = "".join("%02x" % byte for byte in goal)
    [question] = client.texts(client.questions)
    assert question["text"] == "Tea?" and question["options"] == [] and question["question"].startswith(digits + ":")
    assert [one for one in client.state.take(8) if hasattr(one, "data")]


def test_a_wrong_policy_ends_with_its_findings(client):
    goal, accepted = client.start("policy wrong for hsr { pick(mug_1) fly() done }")
    assert accepted
    status, result = client.result(goal)
    assert (status, result.code) == (6, 1) and "nothing has moved" in result.text
    events = [one.feedback.event for one in client.feedback.take(64) if hasattr(one, "feedback")]
    assert any("fly" in event for event in events)


def test_one_policy_runs_at_a_time_and_a_cancel_interrupts_it(client):
    goal, accepted = client.start(GOES)
    assert accepted
    time.sleep(1.0)
    assert not client.start(SAYS)[1]
    answer = client.call("cancel_goal", goal_info={"goal_id": {"uuid": goal}})
    assert answer.return_code == 0 and len(answer.goals_canceling) == 1
    status, result = client.result(goal)
    assert (status, result.code) == (5, 130)
    assert client.result(list(uuid.uuid4().bytes))[0] == 0


def test_a_node_answers_the_question_of_a_policy_once_and_by_its_id(asking):
    policy = 'policy offer for hsr { let answer = ask("Tea?") done }'
    goal, accepted = asking.start(policy)
    assert accepted
    question = asking.wait(asking.questions, lambda asked: asked["text"] == "Tea?")["question"]
    assert asking.answer("yes")["why"].startswith("an answer is no JSON")
    wrong = asking.answer(json.dumps({"question": "00:#1", "answer": "yes"}))
    assert not wrong["taken"] and wrong["why"] == "no such question is open"
    long = asking.answer(json.dumps({"question": question, "answer": "a" * 2000}))
    assert not long["taken"] and "more than 1000 characters" in long["why"]
    assert asking.answer(json.dumps({"question": question, "answer": "yes"}))["taken"]
    again = asking.answer(json.dumps({"question": question, "answer": "no"}))
    assert not again["taken"]
    status, result = asking.result(goal)
    assert (status, result.code) == (4, 0), result.text
    assert "/#" not in result.text, "the token of the page is for nobody else"
    events = [json.loads(one.feedback.event) for one in asking.feedback.take(64) if hasattr(one, "feedback")]
    assert [event["value"] for event in events if event["event"] == "bound"] == ["yes"]
