"""Runs in the simulator and on drivers in this process, and replays of them."""

import asyncio
import json
import signal
import threading

import motet
import pytest
from conftest import ROOT, setting

GREET = 'policy greet for hsr { say("Hello!") done }'
FETCH = ROOT / "examples/fetch_mug.motet"


@pytest.mark.parametrize("name", ["fetch_mug", "tidy_table", "object_slips", "person_in_the_way"])
def test_simulate_does_what_the_command_does(name, command):
    example = ROOT / f"examples/{name}.motet"
    of = setting(example)
    flags = ["--robot", of["robot"], "--scene", of["scene"], "--seed", 7]
    run = motet.simulate(example, seed=7, **of)
    ran = command("run", example, *flags, "--speed", "max", "--format", "json").splitlines()
    of_run = [line for line in ran if json.loads(line)["event"] != "diagnostic"]
    assert run.to_json().splitlines() == of_run
    assert run.replay().is_identical and run.events[-1].event == "finished"


def test_a_run_is_a_sequence_of_events_that_can_be_replayed(tmp_path):
    run = motet.simulate(FETCH, robot="hsr", scene="kitchen", record=tmp_path / "run")
    assert run.ok and run.outcome == "done" and run.failure is None and run.duration > 1.0
    names = [event.event for event in run]
    assert names.count("command") > 2 and names[-1] == "finished" and len(run) == len(names)
    picked = next(event for event in run if event.event == "command" and event.more["primitive"] == "pick")
    before, after = run.replay(at=picked.at - 0.001), run.replay(at=run.duration)
    assert "identical" in before.verdict and before.entries < after.entries
    assert before.state["at"] <= picked.at * 1e9 and before.state != after.state
    on_disk = motet.replay(tmp_path / "run")
    assert on_disk.is_identical and on_disk.state is None
    assert motet.replay(tmp_path / "run", entry=3).state == run.replay(entry=3).state
    with pytest.raises(motet.InputError, match="not empty"):
        motet.simulate(FETCH, robot="hsr", scene="kitchen", record=tmp_path / "run")
    with pytest.raises(motet.InputError, match="no journal|cannot read"):
        motet.replay(tmp_path / "nothing")
    with pytest.raises(ValueError, match="no time"):
        run.replay(at=float("nan"))


def test_faults_and_answers_are_values():
    with pytest.raises(motet.InputError):
        motet.simulate(GREET, faults={"calls": 3})
    with pytest.raises(motet.InputError, match="there is no profile `typcal`"):
        motet.simulate(GREET, profile="typcal")
    with pytest.raises(motet.PolicyError) as raised:
        motet.simulate("policy drop for hsr { place(mug_1, shelf) done }", scene="kitchen")
    assert raised.value.diagnostics[0].code == "M0501"
    assert motet.simulate(GREET, seed=3).to_json() == motet.simulate(GREET, seed=3).to_json()


def test_pandas_has_a_row_for_each_event():
    pandas = pytest.importorskip("pandas")
    run = motet.simulate(GREET)
    table = run.to_pandas()
    assert isinstance(table, pandas.DataFrame) and len(table) == len(run) and "event" in table


class Robot(motet.Driver):
    owns_clock = True

    def __init__(self):
        self.said, self.is_closed = [], False

    async def say(self, goal, text):
        await goal.feedback(f"saying {text}")
        await goal.sleep(2.0)
        self.said.append(text)

    def shutdown(self):
        self.is_closed = True


def test_drive_runs_a_driver_on_the_engine(tmp_path):
    robot, heard = Robot(), []
    run = motet.drive(GREET, robot, say=heard.append, record=tmp_path / "run")
    assert run.ok and robot.said == ["Hello!"] and robot.is_closed
    assert run.duration == pytest.approx(2.0, abs=0.1)
    assert any("saying Hello!" in text for text in heard)
    assert run.replay().is_identical and motet.replay(tmp_path / "run").is_identical


def test_drive_on_the_clock_of_the_wall_gives_the_driver_its_turn():
    class Slow(Robot):
        owns_clock = False

        async def say(self, goal, text):
            sum(range(100_000))  # A call of a library that does not await.
            self.said.append(threading.current_thread().name)

    robot = Slow()
    assert motet.drive(GREET, robot).ok and robot.said == ["motet driver"]


def test_drive_tells_failures_of_the_driver():
    class Mute(Robot):
        async def say(self, goal, text):
            raise motet.Failed("timeout", "no voice")

    run = motet.drive(GREET, Mute())
    assert (run.outcome, run.failure, run.why) == ("failed", "timeout", "no voice")

    class Endless(Robot):
        async def say(self, goal, text):
            await goal.feedback("x" * 3_000_000)
            await super().say(goal, text)

    assert motet.drive(GREET, Endless()).ok

    class Broken(Robot):
        def begin_run(self, run):
            raise RuntimeError("no power")

    with pytest.raises(motet.InputError, match="no power"):
        motet.drive(GREET, Broken())


def test_drive_refuses_a_driver_that_lacks_a_primitive_before_anything_moves():
    class Mute(motet.Driver):
        async def go(self, goal, to):
            raise AssertionError("nothing moves")

    class Deaf(Robot):
        async def say(self, goal):
            raise AssertionError("nothing moves")

    with pytest.raises(motet.InputError, match="the driver does not have `say`"):
        motet.drive("policy p for hsr { go(mug_1) say(\"Hello!\") done }", Mute(), scene="kitchen")
    with pytest.raises(motet.InputError, match="its `say` does not take `goal, text`"):
        motet.drive(GREET, Deaf())

    class Plain(motet.Driver):
        def say(self, goal, text):
            raise AssertionError("nothing moves")

    with pytest.raises(motet.InputError, match="the driver does not have `say`: its `say` is not an `async def`"):
        motet.drive(GREET, Plain())
    with pytest.raises(TypeError, match="an instance of a subclass"):
        motet.drive(GREET, Plain)

    class Anything(motet.Driver):
        async def perform(self, goal, **args):
            return None

    assert motet.drive(GREET, Anything()).ok


def test_drive_warns_of_facts_that_the_driver_does_not_observe():
    class Blind(motet.Driver):
        owns_clock = True

        async def perform(self, goal, **args):
            await goal.sleep(1.0)

    asks = "the policy asks for `visible`, and the driver has no method of that name"
    with pytest.warns(UserWarning, match=asks) as warned:
        run = motet.drive("policy get for hsr { go(mug_1) pick(mug_1) done }", Blind(), scene="kitchen")
    assert {warning.filename for warning in warned} == {__file__}
    assert (run.outcome, run.failure, run.why) == ("failed", "not_found", "needs visible(mug_1), which is unknown")
    [guard] = [event for event in run if event.event == "guard"]
    assert guard.more == {"need": 1, "needs": "visible(mug_1)", "truth": "unknown"}


def test_a_replay_has_a_state_for_people():
    run = motet.simulate(GREET)
    replay = run.replay(at=0.5)
    assert replay.text.startswith("`greet` at 0 s") and "runs " in replay.text
    assert str(replay) == replay.text + replay.verdict
    assert "runs " not in run.replay().text


def test_an_interrupt_stops_a_run_and_the_robot():
    class Endless(Robot):
        owns_clock = False

        async def say(self, goal, text):
            signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)
            try:
                await goal.sleep(3600.0)
            except asyncio.CancelledError:
                self.said.append("stopped")
                raise

    robot = Endless()
    with pytest.raises(KeyboardInterrupt):
        motet.drive(GREET, robot)
    assert robot.said == ["stopped"] and robot.is_closed


def test_the_laws_of_drivers_are_checked():
    with pytest.raises(TypeError, match="the class of the driver or a function that makes one"):
        motet.check_driver(Robot())
    with pytest.raises(motet.InputError, match="has to return a `motet.Driver`"):
        motet.check_driver(object)
    told = []

    class Keeper(Robot):
        takes_state = True

        def begin_run(self, run):
            super().begin_run(run)
            told.append(json.dumps(run.get("state")))

    found = motet.check_driver(Keeper, robot="hsr", scene="kitchen", state={"visited(shelf)": True})
    assert found.ok and len(found.scenes) > 5, str(found)
    assert sum("visited" in state for state in told) >= len(found.scenes), told[:1]

    class Liar(Robot):
        async def stop(self, goal):
            goal._session.report("ended", {"goal": goal.number, "outcome": {"success": None}})

    broken = motet.check_driver(Liar)
    assert not broken.ok and broken.broken[0].messages, str(broken)


def test_the_laws_are_checked_on_a_call_that_has_needs_or_ends_at_once():
    class Quick(motet.Driver):
        owns_clock = True

        async def pick(self, goal, object, from_):
            return None

    pick = "policy p for hsr { pick(mug_1) }"
    found = motet.check_driver(Quick, pick, scene="kitchen", state={"at(robot, mug_1)": True, "visible(mug_1)": True})
    assert found.ok and "held" in found.scenes, str(found)
    with pytest.raises(motet.InputError, match="observes `battery.* before its first call"):
        motet.check_driver(Quick, "policy p for hsr { if battery() > 20 % { go(shelf) } }", scene="kitchen")


def test_a_failure_that_the_primitive_does_not_declare_is_told():
    class Clumsy(motet.Driver):
        owns_clock = True

        async def go(self, goal, to):
            raise motet.Failed("stumbled", "over a cable")

    heard = []
    run = motet.drive("policy p for hsr { go(shelf) done }", Clumsy(), scene="kitchen", say=heard.append)
    assert run.outcome == "failed" and run.failure != "stumbled" and "stumbled: over a cable" in run.why
    assert any("`go` does not declare `stumbled`, but" in text for text in heard), heard


def test_asks_has_the_measures_and_the_goal_of_a_policy():
    text = "policy p for hsr achieves on(mug_1, shelf) { if battery() < 20 % { cannot } go(mug_1) pick(mug_1) go(shelf) "
    graph = motet.compile(text + "place(mug_1, shelf) done }", scene="kitchen")
    assert {"battery", "on", "visible"} <= graph.asks
