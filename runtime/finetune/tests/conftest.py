"""Shared fixtures: rows in files, and tiny models with random weights. Nothing is downloaded."""

import json
import os

import pytest

# A test that would ask the hub fails instead.
os.environ["HF_HUB_OFFLINE"] = "1"
os.environ.setdefault("CUDA_VISIBLE_DEVICES", "")

SYSTEM = "You plan for a robot.\nAnswer with one policy and nothing else, as JSON."
THINGS = ["red mug", "coke", "apple", "wrench", "book", "plate"]


def policy(thing):
    return json.dumps({"motet": 1, "steps": [{"do": "go", "to": thing}, {"do": "pick", "object": thing}]})


def trl(thing, scene):
    said = [("system", SYSTEM), ("user", f"# Request\nBring me the {thing}."), ("assistant", policy(thing))]
    messages = [{"role": role, "content": text} for role, text in said]
    return {
        "messages": messages,
        "motet": {"robot": "hsr", "scene": scene, "task": "bring", "failures": "", "turn": "0"},
    }


def seen(thing, scene):
    row = trl(thing, scene)
    for message in row["messages"]:
        message["content"] = [{"type": "text", "text": message["content"]}]
    row["messages"][1]["content"].insert(0, {"type": "image"})
    return {**row, "images": [f"images/{scene}.png"]}


def written(folder, make):
    folder.mkdir(exist_ok=True)
    for name, count in (("train", 12), ("test", 4)):
        rows = [make(f"{THINGS[at % len(THINGS)]} {at}", f"kitchen-{name}") for at in range(count)]
        (folder / f"{name}.jsonl").write_text("".join(json.dumps(row) + "\n" for row in rows))
    return folder


@pytest.fixture(scope="session")
def data(tmp_path_factory):
    """A folder of rows of text."""
    return written(tmp_path_factory.mktemp("data"), trl)


@pytest.fixture(scope="session")
def pictures(tmp_path_factory):
    """A folder of rows with pictures."""
    from PIL import Image

    folder = tmp_path_factory.mktemp("pictures")
    (folder / "images").mkdir()
    for number, name in enumerate(("train", "test")):
        Image.new("RGB", (64, 48), (200, 60 * number, 30)).save(folder / "images" / f"kitchen-{name}.png")
    return written(folder, seen)


@pytest.fixture(scope="session")
def model(tmp_path_factory):
    """A function that gives the folder of a tiny model of a kind."""
    import torch

    from motet_finetune import tiny

    torch.set_num_threads(1)
    texts = [SYSTEM, *(f"# Request\nBring me the {thing}.\n{policy(thing)}" for thing in THINGS)]
    made = {}

    def of(kind):
        if kind not in made:
            made[kind] = tmp_path_factory.mktemp("model") / kind
            tiny.make(kind, made[kind], texts, words=400, width=64, layers=2)
        return made[kind]

    return of
