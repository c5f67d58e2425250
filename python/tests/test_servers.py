"""Processors of model servers, over fake batches of mixed requests. The servers themselves need a GPU and are not here."""

import json
from dataclasses import dataclass, field
from enum import Enum, auto
from importlib.metadata import entry_points
from types import SimpleNamespace
from typing import Any

import motet
import numpy
import pytest
from motet.sglang import MotetLogitProcessor
from motet.vllm import MotetLogitsProcessor

WANTED = {"robot": "hsr", "scene": "kitchen", "budget": 399}


class Direction(Enum):
    UNIDIRECTIONAL = auto()
    SWAP = auto()


@dataclass
class Update:
    """What vLLM tells a processor of its batch."""

    removed: list = field(default_factory=list)
    added: list = field(default_factory=list)
    moved: list = field(default_factory=list)


@dataclass
class Params:
    extra_args: Any = None


@pytest.fixture
def vocabulary(tokenizer):
    return motet.vocabulary(tokenizer)


@pytest.fixture
def processor(tokenizer):
    return MotetLogitsProcessor(SimpleNamespace(model_config=SimpleNamespace(tokenizer=str(tokenizer))))


def choose(logits, random):
    return [int((row + random.normal(size=row.shape)).argmax()) for row in logits]


def text_of(vocabulary, tokens):
    return b"".join(vocabulary.token(token) for token in tokens if token != vocabulary.end).decode()


def test_vllm_finds_the_processor():
    (found,) = [entry for entry in entry_points(group="vllm.logits_processors") if entry.name == "motet"]
    assert found.load() is MotetLogitsProcessor


def test_vllm_batches_of_mixed_requests_get_policies_that_check(processor, vocabulary):
    """Requests come, go and change places, as in continuous batching: each that asks gets a policy that checks."""
    random = numpy.random.default_rng(5)
    width, rows, waiting, done = len(vocabulary) + 3, {}, [], []
    for number in range(7):
        asks = number % 3 != 2
        spelling = json.dumps(WANTED) if number % 2 else WANTED
        waiting.append((asks, Params({"motet": spelling} if asks else None), []))
    for _step in range(3000):
        update = Update()
        for index in [index for index, (_, _, output) in rows.items() if output and output[-1] == vocabulary.end]:
            done.append(rows.pop(index))
            update.removed.append(index)
        # The last rows fill the gaps.
        for gap in sorted(update.removed):
            last = max(rows, default=-1)
            if last > gap:
                rows[gap] = rows.pop(last)
                update.moved.append((last, gap, Direction.UNIDIRECTIONAL))
        while waiting and len(rows) < 4:
            index, request = len(rows), waiting.pop(0)
            rows[index] = request
            update.added.append((index, request[1], [1, 2, 3], request[2]))
        if len(rows) > 1 and random.random() < 0.1:
            rows[0], rows[1] = rows[1], rows[0]
            update.moved.append((0, 1, Direction.SWAP))
        # vLLM takes requests out, then in, then moves them; here those that filled gaps moved before others came.
        split = [move for move in update.moved if move[2] is Direction.UNIDIRECTIONAL]
        processor.update_state(Update(update.removed, [], split))
        processor.update_state(Update([], update.added, [move for move in update.moved if move not in split]))
        processor.update_state(None)
        if not rows:
            break
        logits = numpy.zeros((len(rows), width))
        processor.apply(logits)
        for index, (asks, _, output) in rows.items():
            if not asks:
                assert numpy.isfinite(logits[index]).all()
                output.append(vocabulary.end if len(output) > 20 else 5)
            else:
                output.append(choose(logits[index][None], random)[0])
    assert len(done) == 7 and not processor._rows
    for asks, _, output in done:
        if asks:
            report = motet.check(text_of(vocabulary, output), robot="hsr", scene="kitchen", geometry=False)
            assert report.ok, str(report)


@pytest.mark.parametrize(
    ("asked", "why"),
    [
        ("{", "is no JSON"),
        ([], "is an object"),
        ({"robot": "hal"}, "there is no robot `hal`"),
        ({"robots": "hsr"}, "has no `robots`"),
        ({"robot": "hsr", "budget": -1}, "number of bytes"),
        ({"robot": "hsr", "budget": 3}, "no policy has at most 3 bytes"),
        ({"robot": "hsr", "modifiers": {}}, "of another type"),
        ({"robot": "hsr", "scene": [1]}, "of another type"),
        ({"robot": "hsr", "scene": {"entities": 3}}, "scene"),
        ({"robot": ["hsr"]}, "is the name"),
        ({"robot": "../../etc/passwd"}, "built-in name"),
        ({"robot": "hsr", "scene": "/etc/passwd"}, "built-in name"),
    ],
)
def test_vllm_refuses_wrong_requests_before_they_are_in_a_batch(asked, why):
    with pytest.raises(ValueError, match=why):
        MotetLogitsProcessor.validate_params(Params({"motet": asked}))
    MotetLogitsProcessor.validate_params(Params(None))
    MotetLogitsProcessor.validate_params(Params({"other": asked}))


def test_vllm_with_tokens_that_are_not_known_yet_is_an_error(processor):
    output = []
    processor.update_state(Update(added=[(0, Params({"motet": WANTED}), [], output)]))
    output.append(-1)
    with pytest.raises(RuntimeError, match="--no-async-scheduling"):
        processor.apply(numpy.zeros((1, 9)))
    assert not processor.is_argmax_invariant()


def test_sglang_batches_of_mixed_requests_get_policies_that_check(tokenizer, vocabulary):
    random = numpy.random.default_rng(6)
    processor, width = MotetLogitProcessor(), len(vocabulary) + 3
    requests = [SimpleNamespace(tokenizer=vocabulary, output_ids=[]) for _ in range(3)]
    params = [{"motet": WANTED, "__req__": requests[0]}, None, {"__req__": requests[1]}, {"motet": WANTED, "__req__": requests[2]}]
    own = [requests[0], None, requests[1], requests[2]]
    for _ in range(500):
        live = [at for at, one in enumerate(own) if one is None or not one.output_ids or one.output_ids[-1] != vocabulary.end]
        if not {0, 3} & set(live):
            break
        logits = processor(numpy.zeros((len(live), width)), [params[at] for at in live])
        for row, at in zip(logits, live):
            if own[at] is not None:
                own[at].output_ids.append(choose(row[None], random)[0] if "motet" in params[at] else 5)
            else:
                assert numpy.isfinite(row).all()
    for request in (requests[0], requests[2]):
        report = motet.check(text_of(vocabulary, request.output_ids), robot="hsr", scene="kitchen", geometry=False)
        assert report.ok and request.output_ids[-1] == vocabulary.end, str(report)
    assert processor(numpy.zeros((1, width)), None).shape == (1, width)


def test_sglang_ends_a_wrong_request_and_no_other(vocabulary, caplog):
    request = SimpleNamespace(tokenizer=vocabulary, output_ids=[])
    batch = [{"motet": {"robot": "hal"}, "__req__": request}, {"motet": WANTED, "__req__": request}]
    logits = MotetLogitProcessor()(numpy.zeros((2, len(vocabulary))), batch)
    assert numpy.isfinite(logits[0]).nonzero()[0].tolist() == [vocabulary.end]
    assert numpy.isfinite(logits[1]).sum() == 2 and "there is no robot `hal`" in caplog.text
