"""Whatever its weights, a model that is held to an exported grammar writes policies that are read, and right in names and types.

    python tests/models/tiny/run.py target/debug/motet [MODELS]

makes so many models with weights at random, 3 where nothing is said, and has each write policies under the Lark grammar and
under the JSON Schema of two robots. `motet check` may find fault with what no grammar can follow, and with nothing else; and
`motet do` comes to an end with each model, with a policy or with the reason why there is none.
"""

import json
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from server import Model, serve
from weights import train, write

ROOT = Path(__file__).parents[3]
WORLDS = [("hsr", "kitchen", "bring me the coke"), ("anymal_z1", "living_room", "put the cup on the cabinet")]
DIRECT = 6
# Which name is bound where and with which type, and the motions and facts of a state: no grammar follows these.
BINDINGS = {"M0203", "M0205", "M0206", "M0301"}
STATE = ("M05", "M06", "M07", "M08", "M09")


def motet(binary, *arguments, text=None):
    return subprocess.run([binary, *arguments], input=text, capture_output=True, text=True, timeout=600)


def checked(binary, world, reply):
    """The codes of the errors that the compiler finds in a reply."""
    robot, scene, _ = world
    ran = motet(binary, "check", "-", "--robot", robot, "--scene", scene, "--no-geometry", "--format", "json", text=reply)
    if ran.returncode not in (0, 1):
        raise SystemExit(f"motet check: {ran.stderr}")
    found = [json.loads(line) for line in ran.stdout.splitlines() if line.startswith("{")]
    return [one for one in found if one["severity"] == "error"]


def binding_only(error, reply):
    """Whether an error is about a name that the policy binds."""
    if error["code"] not in BINDINGS:
        return False
    span = error["span"]
    return error["code"] != "M0301" or "$" in reply.encode()[span["start"] : span["end"]].decode(errors="replace")


def judge(binary, world, reply, wrong, tally):
    errors = checked(binary, world, reply)
    for error in errors:
        if error["code"].startswith(STATE):
            tally["state"] += 1
        elif binding_only(error, reply):
            tally["bindings"] += 1
        else:
            wrong.append(f"{error['code']} {error['message']}: {reply}")
    tally["policies"] += 1
    tally["without an error"] += not errors


def carried_out(binary, world, url, dialect, folder, wrong, tally):
    """`motet do`, asked with the model at an address."""
    robot, scene, request = world
    flags = ["--planner", url, "--model", "tiny", "--dialect", dialect, "--repair", "1", "--timeout", "300"]
    flags += ["--no-geometry", "--ask", "never", "--speed", "max", "--record", str(folder)]
    ran = motet(binary, "do", request, "--robot", robot, "--scene", scene, *flags)
    tally[f"do ended with {ran.returncode}"] += 1
    if ran.returncode not in (0, 3):
        wrong.append(f"motet do ended with {ran.returncode}: {ran.stderr}")
        return
    talk = [json.loads(line) for line in (folder / "talk.jsonl").read_text().splitlines()]
    whats = Counter(line["what"] for line in talk)
    # A model without sense may write without an end, most of all under the schema, which leaves the length of texts open.
    if not whats["taken"] + whats["refused"] + whats["failed"]:
        wrong.append(f"motet do got no reply: {dict(whats)} {ran.stderr}")
    tally["broke off"] += whats["failed"]
    tally["taken"] += whats["taken"]
    tally["refused"] += whats["refused"]


def main():
    binary, models = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3
    begun = time.perf_counter()
    texts = [path.read_text() for path in sorted((ROOT / "examples").glob("*.*")) + [ROOT / "docs" / "language.md"]]
    tokenizer = train(texts)
    wrong, tally = [], Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for seed in range(models):
            folder = Path(scratch) / f"model_{seed}"
            parameters = write(folder, seed, tokenizer)
            for world in WORLDS:
                robot, scene, request = world
                flags = ["--robot", robot, "--scene", scene, "--no-geometry", "--depth", "2"]
                lark = motet(binary, "grammar", *flags, "--format", "lark", "--llguidance").stdout
                model, log = Model(folder, lark), []
                server, url = serve(model, log)
                for _ in range(DIRECT):
                    said, why = "", None
                    for piece, why in model.pieces([{"role": "user", "content": request}]):
                        said += piece
                    if why != "stop":
                        tally[f"ended by {why}"] += 1
                        continue
                    judge(binary, world, said, wrong, tally)
                for dialect in ("none", "vllm"):
                    carried_out(binary, world, url, dialect, folder / f"{robot}_{dialect}", wrong, tally)
                server.shutdown()
                for reply in log:
                    tally[f"held to {reply['held']}"] += 1
                    if reply["why"] == "stop":
                        judge(binary, world, reply["said"], wrong, tally)
                    else:
                        tally[f"ended by {reply['why']}"] += 1
    print(f"{models} models of {parameters} parameters, {tokenizer.get_vocab_size()} tokens: {time.perf_counter() - begun:.0f} s")
    for what, count in sorted(tally.items()):
        print(f"  {what}: {count}")
    for line in wrong:
        print(f"WRONG {line}")
    if wrong or not tally["policies"] or not tally["taken"] + tally["refused"]:
        raise SystemExit(1)


if __name__ == "__main__":
    main()
