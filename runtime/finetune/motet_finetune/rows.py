"""Rows of `motet dataset` as prompts and completions: what the model is asked, and the policy that it is to write."""

from __future__ import annotations

import json
import re
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from pathlib import Path
from typing import Any

__all__ = ["ROBOT", "Row", "RowError", "conversation", "folded", "read", "requests", "table", "text", "without"]

ROBOT = "<robot>"


class RowError(ValueError):
    """A line that is no row, with its file and line."""


@dataclass(frozen=True)
class Row:
    """A row of any of the forms. Texts of a conversation are messages; a row of InteLiPlan's form is one text."""

    prompt: list[dict[str, str]] | str
    policy: str
    images: tuple[Path, ...]
    about: dict[str, str]


def read(path: Path) -> list[Row]:
    """Reads the rows of a file. All are of one form, as a trainer needs them."""
    rows: list[Row] = []
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as why:
        raise RowError(f"{path}: {why}") from why
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            row = _row(json.loads(line), path.parent)
        except (KeyError, IndexError, TypeError, ValueError, AttributeError) as why:
            raise RowError(f"{path}:{number}: no row of `motet dataset`: {why!r}") from why
        for image in row.images:
            if not image.is_file():
                raise RowError(f"{path}:{number}: there is no picture {image}")
        if rows and (isinstance(row.prompt, str), not row.images) != (
            isinstance(rows[0].prompt, str),
            not rows[0].images,
        ):
            raise RowError(f"{path}:{number}: not of the form of the row before")
        rows.append(row)
    if not rows:
        raise RowError(f"{path}: no rows")
    return rows


def _row(value: dict[str, Any], folder: Path) -> Row:
    images = value.get("images", value.get("image", []))
    images = tuple(folder / one for one in ([images] if isinstance(images, str) else images))
    about = value.get("motet", {})
    prompt: list[dict[str, str]] | str
    if "messages" in value:
        *asked, said = [{"role": one["role"], "content": text(one["content"])} for one in value["messages"]]
        if said["role"] != "assistant" or not asked:
            raise ValueError("the last message is not the policy")
        prompt, policy = asked, said["content"]
    elif "conversations" in value:
        roles = {"human": "user", "gpt": "assistant"}
        *asked, said = [
            {"role": roles[one["from"]], "content": one["value"].replace("<image>", "")}
            for one in value["conversations"]
        ]
        if said["role"] != "assistant" or not asked:
            raise ValueError("the last turn is not the policy")
        system = [{"role": "system", "content": value["system"]}] if "system" in value else []
        prompt, policy = system + asked, said["content"]
    else:
        before, marker, policy = value["text"].rpartition(ROBOT)
        if not marker:
            raise ValueError(f"no {ROBOT}")
        prompt = before + marker
    if not policy.strip():
        raise ValueError("an empty policy")
    return Row(prompt, policy, images, about)


def requests(path: Path) -> set[str]:
    """The requests of an evaluation: the key `request` of each line of a file, such as `eval/tasks/papers.jsonl`."""
    try:
        lines = [line for line in path.read_text(encoding="utf-8").splitlines() if line.strip()]
        return {_plain(json.loads(line)["request"]) for line in lines}
    except (OSError, KeyError, TypeError, ValueError, AttributeError) as why:
        raise RowError(f"{path}: no file of requests: {why!r}") from why


def without(known: list[Row], asked: AbstractSet[str]) -> list[Row]:
    """The rows of which no line is one of the requests. Letter case and punctuation do not count."""

    def has_none(row: Row) -> bool:
        texts = [row.prompt] if isinstance(row.prompt, str) else [one["content"] for one in row.prompt]
        return not asked & {_plain(line) for text in texts for line in text.splitlines()}

    return [row for row in known if has_none(row)]


def _plain(line: str) -> str:
    words = re.sub(r"[.,!?;]", "", line.lower().removeprefix("<user>"))
    return " ".join(words.split())


def text(content: str | list[dict[str, str]]) -> str:
    """The text of a message, whose pictures come from the column of pictures."""
    if isinstance(content, str):
        return content
    return "".join(part["text"] for part in content if part["type"] == "text")


def folded(prompt: list[dict[str, str]]) -> list[dict[str, str]]:
    """A prompt whose system message begins the first message of the user, for templates without a system role."""
    if len(prompt) < 2 or prompt[0]["role"] != "system":
        return prompt
    system, user, *rest = prompt
    return [{**user, "content": f"{system['content']}\n\n{user['content']}"}, *rest]


def conversation(tokenizer: Any, prompt: list[dict[str, str]]) -> list[dict[str, str]]:
    """A prompt as the chat template of a tokenizer takes it. Training and serving both use it, so that they agree."""
    if not tokenizer.chat_template:
        raise RowError("the model has no chat template: take one that follows instructions")
    # Where a template knows the role, its text is in what it makes; Mistral's first ones raise an error instead.
    marker = "\u2020system\u2020"
    probe = [{"role": "system", "content": marker}, {"role": "user", "content": "?"}]
    try:
        knows = marker in tokenizer.apply_chat_template(probe, tokenize=False)
    except Exception:  # noqa: BLE001 - templates are programs, and raise what they like
        knows = False
    return prompt if knows else folded(prompt)


def table(rows: list[Row], processor: Any) -> Any:
    """The rows as TRL's `SFTTrainer` reads them: columns `prompt`, `completion`, and `images` where rows have pictures."""
    from datasets import Dataset, Image, List

    # The tokenizer of a model that sees takes texts, as its processor does not in each version.
    tokenizer = getattr(processor, "tokenizer", processor)

    def record(row: Row) -> dict[str, Any]:
        if isinstance(row.prompt, str):
            return {"prompt": row.prompt, "completion": row.policy}
        prompt = conversation(tokenizer, row.prompt)
        known: dict[str, Any] = {"prompt": prompt, "completion": [{"role": "assistant", "content": row.policy}]}
        if row.images:
            known["images"] = [str(image) for image in row.images]
        return known

    made = Dataset.from_list([record(row) for row in rows])
    return made.cast_column("images", List(Image())) if rows[0].images else made
