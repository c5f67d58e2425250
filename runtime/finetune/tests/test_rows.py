"""Rows of every form, and lines that are none."""

import json

import pytest
from conftest import seen, trl

from motet_finetune import rows


def read(tmp_path, *lines):
    path = tmp_path / "train.jsonl"
    path.write_text("".join((line if isinstance(line, str) else json.dumps(line)) + "\n" for line in lines))
    return rows.read(path)


def test_forms_are_read(tmp_path):
    (one,) = read(tmp_path, trl("coke", "kitchen-1"))
    assert [message["role"] for message in one.prompt] == ["system", "user"]
    assert one.policy.startswith('{"motet": 1') and one.about["scene"] == "kitchen-1" and not one.images
    turns = [{"from": "human", "value": "<image>Bring it."}, {"from": "gpt", "value": "{}"}]
    (tmp_path / "a.png").write_bytes(b"")
    (two,) = read(tmp_path, {"conversations": turns, "image": "a.png"})
    assert two.prompt == [{"role": "user", "content": "Bring it."}] and two.images == (tmp_path / "a.png",)
    (three,) = read(tmp_path, {"conversations": [{**turns[0], "value": "x"}, turns[1]], "system": "s"})
    assert three.prompt[0] == {"role": "system", "content": "s"} and three.prompt[1]["content"] == "x"
    (four,) = read(tmp_path, {"text": "<history> <robot> no\n<user> get coke\n<robot> go counter, pick coke"})
    assert four.prompt.endswith("<user> get coke\n<robot>") and four.policy == " go counter, pick coke"


@pytest.mark.parametrize(
    ("lines", "why"),
    [
        (["{"], ":1: no row"),
        (["[]"], ":1: no row"),
        ([{"messages": []}], ":1: no row"),
        ([{"messages": [{"role": "user", "content": "x"}] * 2}], "the last message is not the policy"),
        ([{"text": "get coke"}], "no <robot>"),
        ([{"text": "<robot> "}], "an empty policy"),
        ([trl("coke", "k"), {"text": "<user> x\n<robot> y"}], ":2: not of the form"),
        ([seen("coke", "nowhere")], ":1: there is no picture"),
        ([], "no rows"),
    ],
)
def test_a_line_that_is_no_row_is_an_error_with_its_place(tmp_path, lines, why):
    with pytest.raises(rows.RowError) as error:
        read(tmp_path, *lines)
    assert why in str(error.value)


class Template:
    chat_template = "{{ messages }}"

    def __init__(self, knows):
        self.knows = knows

    def apply_chat_template(self, messages, tokenize):
        if messages[0]["role"] == "system" and not self.knows:
            raise ValueError("Conversation roles must alternate")
        return "".join(message["content"] for message in messages)


def test_the_system_message_goes_to_the_user_where_a_template_has_no_such_role():
    prompt = [{"role": "system", "content": "a"}, {"role": "user", "content": "b"}]
    assert rows.conversation(Template(True), prompt) == prompt
    assert rows.conversation(Template(False), prompt) == [{"role": "user", "content": "a\n\nb"}]


def test_rows_with_requests_of_an_evaluation_are_left_out(tmp_path):
    known = read(tmp_path, trl("coke", "k"), trl("mug", "k"), {**trl("tea", "k"), "motet": {}})
    path = tmp_path / "papers.jsonl"
    path.write_text('{"request": "bring me the  Coke", "cell": "x"}\n\n{"request": "Bring me the tea!"}\n')
    (left,) = rows.without(known, rows.requests(path))
    assert left.prompt[1]["content"].endswith("Bring me the mug.")
    (one,) = read(tmp_path, {"text": "<user> Get coke.\n<robot> pick coke"})
    assert rows.without([one], {"get coke"}) == [] and rows.without([one], {"coke"}) == [one]
    path.write_text('{"text": "x"}\n')
    with pytest.raises(rows.RowError, match="no file of requests"):
        rows.requests(path)
