"""The files of `motet dataset` have the shapes that trainers read.

    for form in trl llamafactory qwen-vl inteliplan; do motet dataset --out DATA/$form --form $form; done
    python tests/peers/datasets/shapes.py DATA

The rules are those of the trainers' documentation and of the code that reads their files: TRL (dataset formats), LLaMA-Factory
(data/README.md: turns alternate, `human` first), Qwen2.5-VL (qwenvl/data/data_processor.py: every turn that is not `human` is an
answer, each placeholder has its image). Where Hugging Face `datasets` is installed, it loads every file too: all rows of a file have the
same columns with the same types.
"""

import json
import sys
from pathlib import Path

ABOUT = {"robot", "scene", "task", "failures", "turn"}


def texts(values):
    return all(isinstance(value, str) and value for value in values)


def trl(row, _):
    assert [message["role"] for message in row["messages"]] == ["system", "user", "assistant"]
    assert all(set(message) == {"role", "content"} for message in row["messages"])
    assert texts(message["content"] for message in row["messages"])
    json.loads(row["messages"][-1]["content"])


def llamafactory(row, folder):
    info = json.loads((folder / "dataset_info.json").read_text())
    for name in ("train", "test"):
        described = info[f"motet_{name}"]
        assert described["formatting"] == "sharegpt" and (folder / described["file_name"]).is_file()
        assert all(column in row for column in described["columns"].values())
    turns = row["conversations"]
    assert len(turns) % 2 == 0 and texts([row["system"]])
    for index, turn in enumerate(turns):
        assert turn["from"] == ("human", "gpt")[index % 2] and texts([turn["value"]])


def qwen_vl(row, _):
    assert [turn["from"] for turn in row["conversations"]] == ["human", "gpt"]
    images = row.get("image", [])
    images = [images] if isinstance(images, str) else images
    asked = row["conversations"][0]["value"]
    assert asked.count("<image>") == len(images) and "<video>" not in asked
    assert not {"data_path", "num_tokens"} & set(row)
    json.loads(row["conversations"][-1]["value"])


def inteliplan(row, _):
    tags = [line.split(" ", 1)[0] for line in row["text"].splitlines()]
    order = ["<history>", "<user>", "<vision>", "<feasibility>", "<robot>"]
    assert tags == [tag for tag in order if tag in tags] and {"<user>", "<robot>"} <= set(tags)


FORMS = {"trl": trl, "llamafactory": llamafactory, "qwen-vl": qwen_vl, "inteliplan": inteliplan}


def main():
    root = Path(sys.argv[1])
    try:
        from datasets import load_dataset
    except ImportError:
        load_dataset = None
    passed = 0
    for form, check in FORMS.items():
        folder = root / form
        rooms = {json.loads(line)["name"] for line in (folder / "scenes.jsonl").read_text().splitlines()}
        sides = {}
        for name in ("train", "test"):
            path = folder / f"{name}.jsonl"
            rows = [json.loads(line) for line in path.read_text().splitlines()]
            for number, row in enumerate(rows, 1):
                try:
                    check(row, folder)
                    assert set(row["motet"]) == ABOUT and all(isinstance(value, str) for value in row["motet"].values())
                    assert row["motet"]["scene"] in rooms
                except (AssertionError, KeyError, ValueError, IndexError) as wrong:
                    raise SystemExit(f"{path}:{number}: not as {form} is read: {wrong!r}") from wrong
            sides[name] = {row["motet"]["scene"].rsplit(".", 1)[0] for row in rows}
            passed += len(rows)
            if load_dataset and rows:
                loaded = load_dataset("json", data_files=str(path), split="train", cache_dir=str(root / "cache"))
                assert len(loaded) == len(rows), path
        assert not sides["train"] & sides["test"], f"{form}: rooms on both sides"
    print(f"{passed} rows in {len(FORMS)} forms" + (", loaded by datasets too" if load_dataset else ""))


if __name__ == "__main__":
    main()
