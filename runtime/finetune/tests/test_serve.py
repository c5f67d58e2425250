"""Replies under a grammar, the server, and the judge."""

import base64
import io
import json
import os
import shutil
import urllib.error
import urllib.request

import pytest

from motet_finetune import judge, reply, rows, serve
from motet_finetune.reply import Reply

SCHEMA = {
    "type": "object",
    "properties": {"do": {"enum": ["go", "pick"]}, "to": {"enum": ["coke", "red mug"]}},
    "required": ["do", "to"],
    "additionalProperties": False,
}
LARK = '%llguidance {}\nstart: "go " ("coke" | "apple")\n'


def ask(url, **body):
    request = urllib.request.Request(
        f"{url}/v1/chat/completions", json.dumps(body).encode(), {"Content-Type": "application/json"}
    )
    try:
        with urllib.request.urlopen(request) as answer:
            return answer.status, answer.read().decode()
    except urllib.error.HTTPError as error:
        return error.code, error.read().decode()


def said(text="Bring it."):
    return [{"role": "system", "content": "s"}, {"role": "user", "content": text}]


def test_replies_are_held_to_their_grammars_row_by_row(model, data):
    replier = reply.opened(model("qwen2"), most_tokens=40)
    asked = rows.read(data / "test.jsonl")[:3]
    first, second, free = replier.replies(asked, [reply.schema(SCHEMA), reply.lark(LARK), None])
    assert set(json.loads(first.text)) == {"do", "to"} and first.is_whole
    assert second.text in ("go coke", "go apple") and second.is_whole
    assert free.tokens == 40 or free.is_whole
    # Alone a row gets the reply that it gets beside others.
    assert replier.replies(asked[:1], [reply.schema(SCHEMA)])[0] == first


def test_a_grammar_that_is_none_is_an_error(model, data):
    replier = reply.opened(model("qwen2"), most_tokens=8)
    with pytest.raises(reply.GrammarError):
        replier.replies(rows.read(data / "test.jsonl")[:1], [reply.lark("start: nothing")])


def test_a_server_answers_as_dialects_ask(model):
    with serve.served(reply.opened(model("qwen2"), most_tokens=40), "tiny") as url:
        form = {"type": "json_schema", "json_schema": {"name": "p", "strict": True, "schema": SCHEMA}}
        for grammar in ({"structured_outputs": {"json": SCHEMA}}, {"response_format": form}):
            status, text = ask(url, messages=said(), **grammar)
            choice = json.loads(text)["choices"][0]
            assert status == 200 and choice["finish_reason"] == "stop"
            assert set(json.loads(choice["message"]["content"])) == {"do", "to"}
        for grammar in ({"structured_outputs": {"grammar": LARK}}, {"grammar": LARK}, {"ebnf": LARK}):
            status, text = ask(url, messages=said(), stream=True, **grammar)
            first, last = [line.removeprefix("data: ") for line in text.splitlines() if line]
            assert json.loads(first)["choices"][0]["delta"]["content"].startswith("go ") and last == "[DONE]"
        with urllib.request.urlopen(f"{url}/v1/models") as answer:
            assert json.loads(answer.read())["data"][0]["id"] == "tiny"


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"messages": 3},
        {"messages": [{"role": "user"}]},
        {"messages": said(), "grammar": "start: nothing"},
        {"messages": said(), "structured_outputs": {"json": {"type": 7}}},
        {"messages": [{"role": "user", "content": [{"type": "image_url", "image_url": {"url": "file:///x.png"}}]}]},
    ],
)
def test_a_request_that_cannot_be_answered_is_an_error(model, body):
    with serve.served(reply.opened(model("qwen2"), most_tokens=8), "tiny") as url:
        status, text = ask(url, **body)
        assert status == 400 and json.loads(text)["error"]["message"]
        assert ask(url, messages=said())[0] == 200


def test_pictures_reach_the_model():
    from PIL import Image

    file = io.BytesIO()
    Image.new("RGB", (8, 6), (1, 2, 3)).save(file, "PNG")
    asked = []

    class Looks:
        def replies(self, asked_rows, grammars):
            asked.extend((row.prompt, [Image.open(image).size for image in row.images]) for row in asked_rows)
            return [Reply("{}", True, 1)]

    picture = {"url": f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}"}
    content = [{"type": "text", "text": "Look."}, {"type": "image_url", "image_url": picture}]
    with serve.served(Looks(), "eye") as url:
        assert ask(url, messages=[{"role": "user", "content": content}])[0] == 200
    assert asked == [([{"role": "user", "content": "Look."}], [(8, 6)])]


MOTET = os.environ.get("MOTET") or shutil.which("motet")


@pytest.mark.skipif(not MOTET, reason="needs the command motet, in PATH or in $MOTET")
def test_the_judge_counts_what_can_run(tmp_path):
    import subprocess

    flags = ["--robot", "hsr", "--room", "kitchen", "--scenes", "4", "--cases", "3", "--test", "0.5"]
    subprocess.run([MOTET, "dataset", "--out", str(tmp_path / "data"), *flags], check=True)
    known = rows.read(tmp_path / "data" / "test.jsonl")
    broken = {
        "motet": 1,
        "policy": "p",
        "result": None,
        "robot": "hsr",
        "achieves": None,
        "keep": None,
        "steps": [{"do": "pick", "object": "nothing", "from": "auto"}],
        "finally": None,
    }

    class Knows:
        """Gives the row's own policy under another name, and in turn one that cannot run, and half a one."""

        def __init__(self):
            self.asked = 0

        def replies(self, asked, grammars):
            assert all(grammar for grammar in grammars)
            return [self.reply(row) for row in asked]

        def reply(self, row):
            self.asked += 1
            right = json.dumps({**json.loads(row.policy), "policy": "other"})
            return [Reply(right, True, 9), Reply(json.dumps(broken), True, 9), Reply(right, False, 9)][
                self.asked % 3 - 1
            ]

    found = judge.judge(MOTET, Knows(), tmp_path / "data", tmp_path / "out")
    thirds = [len(known[at::3]) for at in range(3)]
    assert (found.rows, found.whole, found.can_run, found.same) == (
        len(known),
        thirds[0] + thirds[1],
        thirds[0],
        thirds[0],
    )
    assert sum(found.reasons.values()) == thirds[1] + thirds[2]
