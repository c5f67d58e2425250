"""Checks, fixes and conversions: the same bytes as those of the command."""

import json
import os
import sys
import threading

import motet
import pytest
from conftest import EXAMPLES, ROOT, setting

WRONG = "policy drop for hsr { place(mug_1, shelf) sya(\"hello\") done }\n"


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda path: path.name)
def test_check_says_what_the_command_says(example, command):
    of = setting(example)
    flags = ["--robot", of["robot"], "--scene", of["scene"]]
    report = motet.check(example, **of)
    assert report.to_json() == command("check", example, "--format", "json", *flags)
    assert report.ok and report.raise_if_errors() is report
    graph = motet.compile(example, **of)
    assert graph.to_json().rstrip("\n") == command("compile", example, *flags).rstrip("\n")
    assert graph.tree().rstrip("\n") == command("compile", example, "--emit", "tree", *flags).rstrip("\n")


@pytest.mark.parametrize(
    ("text", "inputs"),
    [
        (WRONG, {"scene": "kitchen"}),
        (WRONG, {}),
        ("policy p for hsr { go(", {"scene": "kitchen"}),
        ('Sure! ```json\n{"motet":1,"policy":"p","robot":"hsr","steps":[{"do":"pik","object":"mug_1"}]}\n```', {}),
        ("", {"robot": "hsr", "scene": "kitchen"}),
        ("\ufeffpolicy p for hsr { say(\"\u2028ä\") }", {}),
        ("policy p for nobody { say(\"a\") }", {}),
    ],
)
def test_check_of_mistakes_says_what_the_command_says(text, inputs, command, tmp_path):
    file = tmp_path / "wrong.motet"
    file.write_bytes(text.encode())
    flags = [word for name, value in inputs.items() for word in (f"--{name}", value)]
    assert motet.check(file, **inputs).to_json() == command("check", file, "--format", "json", *flags)
    assert motet.check(text, name=str(file), **inputs).to_json() == motet.check(file, **inputs).to_json()


def test_bytes_that_are_no_text_are_a_diagnostic(command, tmp_path):
    file = tmp_path / "wrong.motet"
    file.write_bytes(b"policy \xff\xfe")
    report = motet.check(file)
    assert not report.ok and report.to_json() == command("check", file, "--format", "json")
    assert motet.fix(file).fixed is None
    big = motet.check("#" * (9 << 20))
    assert [found.code for found in big] == [found.code for found in big.errors] and len(big) == 1


def test_diagnostics_are_frozen_and_whole():
    report = motet.check(WRONG, scene="kitchen")
    found = report.errors[0]
    assert (found.code, found.file, found.span.line) == ("M0501", "policy", 1)
    assert WRONG.encode()[found.span.start : found.span.end] == b"place(mug_1, shelf)"
    assert str(found).startswith("policy:1:23: error: ")
    with pytest.raises(AttributeError):
        found.code = "M0000"
    assert {found, *report} == set(report.diagnostics) and report[0] in report
    with pytest.raises(motet.PolicyError, match="the policy is refused: ") as raised:
        report.raise_if_errors()
    assert raised.value.diagnostics == report.diagnostics and isinstance(raised.value, ValueError)
    assert "M0501" in report.render() and "place" in report.to_prompt() and motet.explain("M0501").startswith("#")


def test_a_mapping_is_a_policy():
    policy = json.loads((ROOT / "examples/fetch_mug.json").read_text())
    assert motet.check(policy, robot="hsr", scene="kitchen").ok
    with pytest.raises(motet.InputError, match="no JSON"):
        motet.check({"motet": object()})
    with pytest.raises(motet.InputError, match="give a path"):
        motet.check("fetch_mug.motet")


def test_fix_writes_what_the_command_writes(command, tmp_path):
    file = tmp_path / "wrong.motet"
    file.write_text('policy greet for hsr { sya("hello") done }\n')
    report = motet.fix(file)
    assert [(fix.code, fix.is_safe) for fix in report.applied] and report.ok
    command("check", file, "--fix")
    assert file.read_text() == report.fixed


def test_fmt_writes_what_the_command_writes(command):
    example = ROOT / "examples/fetch_mug.motet"
    assert motet.fmt(example) == example.read_text()
    for syntax in ("json", "text"):
        assert motet.fmt(example, to=syntax).rstrip("\n") == command("fmt", "--to", syntax, example).rstrip("\n")
    with pytest.raises(motet.PolicyError) as raised:
        motet.fmt("policy {")
    assert raised.value.diagnostics
    with pytest.raises(ValueError, match="no syntax"):
        motet.fmt("policy p { done }", to="yaml")


def test_robots_scenes_and_states_are_values_names_and_paths():
    robot = ROOT / "robots/models/panda"
    policy = "policy p { done }"
    for given in ("panda", robot, str(robot)):
        assert motet.check(policy, robot=given).ok
    if sys.version_info >= (3, 11):
        import tomllib

        card = tomllib.loads((ROOT / "robots/models/hsr/robot.toml").read_text())
        reach = motet.feasible("reach(mug_1)", robot=card | {"folder": ROOT / "robots/models/hsr"}, scene="kitchen")
        assert reach.ok and reach[0].witness == motet.feasible("reach(mug_1)", robot="hsr", scene="kitchen")[0].witness
        with pytest.raises(motet.InputError, match="`folder` is a path"):
            motet.check(policy, robot=card | {"folder": 3})
        del card["model"]
        assert motet.check("policy p { go(shelf) }", robot=card, scene="kitchen").ok
        with pytest.raises(motet.InputError) as raised:
            motet.check(policy, robot=card | {"base": 3})
        assert raised.value.diagnostics
    with pytest.raises(motet.InputError) as raised:
        motet.check(policy, scene={"entities": 3})
    assert raised.value.diagnostics
    with pytest.raises(motet.InputError, match="there is no scene `kitchn`.*did you mean"):
        motet.check(policy, scene="kitchn")
    for wrong in (
        {"clearance": {"base": 9.0}}, {"clearance": {"leg": 0.1}}, {"effort": 0}, {"effort": 1 << 20}, {"max_duration": -1.0},
        {"max_duration": float("nan")}, {"robot": "{"}, {"robot": {"name": None}}, {"robot": b"hsr"}, {"scene": "[" * 5000},
        {"scene": {"a": object()}}, {"state": {"on(a, b)": 1}}, {"domains": "nowhere.motet"}, {"robot": "/"},
    ):
        with pytest.raises(motet.InputError):
            motet.check(policy, **wrong)
    with pytest.raises(TypeError, match=r"check\(\) has no argument `bogus`: it takes robot, scene"):
        motet.check(policy, bogus=1)
    with pytest.raises(TypeError, match=r"simulate\(\) has no argument `profil`; did you mean `profile`\?"):
        motet.simulate(policy, profil="ideal")
    held = {"holding(mug_1)": True, "free(hand)": False, "at(robot, shelf)": True}
    carry = "policy p for hsr { place(mug_1, shelf) done }"
    assert motet.check(carry, scene="kitchen").errors and "M0501" not in {
        found.code for found in motet.check(carry, scene="kitchen", state=held)
    }


def test_files_that_change_are_read_again(tmp_path):
    state = tmp_path / "state.json"
    carry = "policy p for hsr { place(mug_1, shelf) done }"
    codes = lambda: {found.code for found in motet.check(carry, scene="kitchen", state=state)}  # noqa: E731
    state.write_text("{}")
    assert "M0501" in codes()
    state.write_text('{"holding(mug_1)": true, "free(hand)": false, "at(robot, shelf)": true}')
    assert "M0501" not in codes()


def test_plans_are_those_of_the_command(command):
    flags = ["--robot", "hsr", "--scene", "kitchen"]
    of = {"robot": "hsr", "scene": "kitchen"}
    plan = motet.plan("bring me the red mug", **of)
    assert plan.text.rstrip() == command("plan", "bring me the red mug", *flags).rstrip()
    goal = motet.plan(goals=["on(mug_1, shelf)"], **of)
    assert goal.graph.to_policy().rstrip() == command("plan", "--goal", "on(mug_1, shelf)", *flags).rstrip()
    with pytest.raises(motet.PlanError, match="no plan: "):
        motet.plan("make me a moon", **of)
    with pytest.raises(motet.PlanError) as raised:
        motet.plan(goals="onn(mug_1)", **of)
    assert raised.value.diagnostics
    with pytest.raises(TypeError):
        motet.plan()


def test_feasible_answers_what_the_command_answers(command, tmp_path):
    flags = ["--robot", "hsr", "--scene", "kitchen", "--for", "reach(mug_1)", "--for", "go_to(shelf)"]
    found = motet.feasible(["reach(mug_1)", "go_to(shelf)"], robot="hsr", scene="kitchen")
    assert found.to_json() == command("feasible", *flags, "--format", "json")
    assert str(found) == command("feasible", *flags, "--svg", tmp_path / "a.svg")
    assert found.svg == (tmp_path / "a.svg").read_text()
    assert found.ok and found[0].witness["path"][0]["base"] and found[0].query == "reach(mug_1)"
    assert str(found[0]) == found[0].text
    shut = ("--state", json.dumps({"open(fridge_1)": False}))
    flags = ["--robot", "hsr", "--scene", "kitchen", "--for", "reach(bottle)"]
    assert motet.feasible("reach(bottle)", robot="hsr", scene="kitchen", state={"open(fridge_1)": False}).to_json() == command(
        "feasible", *flags, *shut, "--format", "json"
    )
    with pytest.raises(motet.InputError, match="there is no motion `fly`"):
        motet.feasible("fly", robot="hsr", scene="kitchen")


def test_threads_check_at_the_same_time():
    kitchen = motet.Project(robot="hsr", scene="kitchen")
    want, got = kitchen.check(WRONG).to_json(), []
    threads = [threading.Thread(target=lambda: got.append(kitchen.check(WRONG).to_json())) for _ in range(8)]
    [thread.start() for thread in threads]
    [thread.join(60) for thread in threads]
    assert got == [want] * 8


def _resident_kib():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") // 1024


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="needs the memory of this process")
def test_ten_thousand_checks_leak_nothing():
    texts = [WRONG, (ROOT / "examples/fetch_mug.motet").read_text(), "policy {"]
    for _ in range(300):
        for text in texts:
            motet.check(text, robot="hsr", scene="kitchen")
    before = _resident_kib()
    for at in range(10_000):
        motet.check(texts[at % 3], robot="hsr", scene="kitchen")
    grown = _resident_kib() - before
    assert grown < 4096, f"{grown} KiB more after 10,000 checks"
