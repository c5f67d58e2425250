"""The files of `motet dataset` have the shapes that trainers read.

    for form in trl llamafactory qwen-vl inteliplan; do motet dataset --out DATA/$form --form $form; done
    python tests/peers/datasets/shapes.py DATA

Forms of which DATA has no folder are passed over. With `motet dataset --images` every row has a picture that is there.

The rules are those of the trainers' documentation and of the code that reads their files: TRL (dataset formats), LLaMA-Factory
(data/README.md: turns alternate, `human` first), Qwen2.5-VL (qwenvl/data/data_processor.py: every turn that is not `human` is an
answer, each placeholder has its image). Where Hugging Face `datasets` is installed, it loads every file too: all rows of a file have the
same columns with the same types.
"""

import json
import struct
import sys
import zlib
from pathlib import Path

ABOUT = {"robot", "scene", "task", "failures", "turn"}


def texts(values):
    return all(isinstance(value, str) and value for value in values)


def picture(path):
    """The pixels of a PNG of eight bits a colour, as many bytes as its head says."""
    bytes = path.read_bytes()
    assert bytes[:8] == b"\x89PNG\r\n\x1a\n", path
    at, data, kinds = 8, b"", []
    while at < len(bytes):
        length, kind = struct.unpack(">I4s", bytes[at : at + 8])
        body = bytes[at + 8 : at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", bytes[at + 8 + length : at + 12 + length])[0], path
        data += body if kind == b"IDAT" else b""
        kinds.append(kind)
        if kind == b"IHDR":
            width, height, depth, colours = struct.unpack(">IIBB", body[:10])
        at += 12 + length
    assert kinds[0] == b"IHDR" and kinds[-1] == b"IEND" and (depth, colours) == (8, 2), path
    assert len(zlib.decompress(data)) == height * (1 + 3 * width), path


def pictures(paths, folder):
    for path in paths:
        place = folder / path
        if place not in LOOKED_AT:
            picture(place)
            LOOKED_AT.add(place)


LOOKED_AT = set()


def trl(row, folder):
    assert [message["role"] for message in row["messages"]] == ["system", "user", "assistant"]
    assert all(set(message) == {"role", "content"} for message in row["messages"])
    contents = [message["content"] for message in row["messages"]]
    if "images" in row:
        # Parts in every message: a column of texts and lists has no type.
        shown = [part for content in contents for part in content if part["type"] == "image"]
        assert len(shown) == len(row["images"]) and contents[1][0] == {"type": "image"}
        pictures(row["images"], folder)
        parts = [[part for part in content if part["type"] == "text"] for content in contents]
        assert all(len(part) == 1 for part in parts)
        contents = [part[0]["text"] for part in parts]
    assert texts(contents)
    json.loads(contents[-1])


def llamafactory(row, folder):
    info = json.loads((folder / "dataset_info.json").read_text())
    for name in ("train", "test"):
        described = info[f"motet_{name}"]
        assert described["formatting"] == "sharegpt" and (folder / described["file_name"]).is_file()
        assert all(column in row for column in described["columns"].values())
    turns = row["conversations"]
    assert len(turns) % 2 == 0 and texts([row["system"]])
    # Paths are as seen from the folder of dataset_info.json; each has its tag.
    images = row.get("images", [])
    assert ("images" in row) == ("images" in info["motet_train"]["columns"])
    assert sum(turn["value"].count("<image>") for turn in turns) == len(images)
    pictures(images, folder)
    for index, turn in enumerate(turns):
        assert turn["from"] == ("human", "gpt")[index % 2] and texts([turn["value"]])


def qwen_vl(row, folder):
    assert [turn["from"] for turn in row["conversations"]] == ["human", "gpt"]
    images = row.get("image", [])
    images = [images] if isinstance(images, str) else images
    asked = row["conversations"][0]["value"]
    assert asked.count("<image>") == len(images) and "<video>" not in asked
    pictures(images, folder)
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
        if not folder.is_dir():
            continue
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
    if not passed:
        raise SystemExit(f"{root}: no rows")
    print(f"{passed} rows in {sum((root / form).is_dir() for form in FORMS)} forms, {len(LOOKED_AT)} pictures" + (", loaded by datasets too" if load_dataset else ""))


if __name__ == "__main__":
    main()
