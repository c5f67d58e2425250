"""The lock of the interpreter: other threads go on while the compiled part works."""

import json
import sys
import threading
import time

import motet
import pytest
from conftest import ROOT

OF = {"robot": "hsr", "scene": "kitchen"}
POLICY = (ROOT / "examples/fetch_mug.motet").read_text()
WORDS = json.dumps([f"word{at}" for at in range(50_000)] + ["</s>"]).encode()
LONG = "policy p for hsr { " + 'say("Hello!") ' * 3000 + "done }"


@pytest.fixture(scope="module")
def prepared(tmp_path_factory):
    """What the calls need, made before another thread counts."""
    folder = tmp_path_factory.mktemp("runs") / "run"
    run = motet.simulate(POLICY, record=folder, **OF)
    vocabulary = motet.Vocabulary.from_tokens([bytes([byte]) for byte in range(256)] + [b""], 256)
    environment = motet.Environment(**OF)
    decoder = motet.Decoder(tokenizer=vocabulary, environment=environment)
    made = {"project": motet.Project(**OF), "run": run, "folder": folder}
    return made | {"environment": environment, "vocabulary": vocabulary, "decoder": decoder}


CALLS = {
    "check": lambda of: of["project"].check(LONG),
    "fix": lambda of: of["project"].fix(LONG),
    "fmt": lambda of: of["project"].fmt(LONG),
    "compile": lambda of: of["project"].compile(LONG),
    "plan": lambda of: of["project"].plan("bring me the red mug"),
    "feasible": lambda of: motet.feasible(**OF),
    "simulate": lambda of: of["project"].simulate(POLICY),
    "replay": lambda of: of["run"].replay(at=1.0),
    "replay of a folder": lambda of: motet.replay(of["folder"]),
    "project": lambda of: motet.Project(**OF),
    "environment": lambda of: motet.Environment(**OF),
    "vocabulary of a file": lambda of: motet.Vocabulary.from_file(WORDS, "</s>"),
    "vocabulary of an encoding": lambda of: motet.Vocabulary.of_encoding("cl100k"),
    "vocabulary of tokens": lambda of: motet.Vocabulary.from_tokens([b"%d" % at for at in range(50_000)] + [b""], 50_000),
    "tokenize": lambda of: of["vocabulary"].tokenize(LONG.encode()),
    "decoder": lambda of: motet.Decoder(tokenizer=of["vocabulary"], environment=of["environment"]),
    "mask": lambda of: of["decoder"].clone().mask(),
}


@pytest.mark.parametrize("name", CALLS)
def test_another_thread_goes_on_during(name, prepared):
    ticks, ends = [0], threading.Event()

    def tick():
        while not ends.is_set():
            ticks[0] += 1
            time.sleep(0)

    before = sys.getswitchinterval()
    # From here on a thread has its turn only where another one gives the lock away.
    sys.setswitchinterval(3600.0)
    thread = threading.Thread(target=tick, daemon=True)
    try:
        thread.start()
        seen, until = ticks[0], time.monotonic() + 30.0
        # A short call may be over before the other thread wakes up.
        while ticks[0] == seen and time.monotonic() < until:
            CALLS[name](prepared)
        assert ticks[0] > seen, f"`{name}` held the lock of the interpreter"
    finally:
        ends.set()
        sys.setswitchinterval(before)
        thread.join(10)
