"""Runs `motet` over what a model wrote, and tells what no grammar can follow from what is wrong."""

import json
import re
import subprocess
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parents[3]
WORLDS = [("hsr", "kitchen", "bring me the coke"), ("anymal_z1", "living_room", "put the cup on the cabinet")]
# Which name is bound where and with which type, and the motions and facts of a state: no grammar follows these.
BINDINGS = {"M0203", "M0205", "M0206", "M0301"}
STATE = ("M05", "M06", "M07", "M08", "M09")
# The result that the head declares: no grammar follows the branches of a policy to their ends.
RESULTS = {"M0316", "M0317"}


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
    """Whether an error is about a name that the policy binds, or does not."""
    is_text = not reply.lstrip().startswith("{")
    span = error["span"]
    # In the text form, and in the braces of a text, what a policy binds is written like an entity, so a name that nobody bound
    # is one that is not there.
    is_in_text = is_text or reply.encode()[: span["start"]].endswith(b"{")
    if error["code"] not in BINDINGS and not (is_in_text and error["code"] == "M0202"):
        return False
    at = reply.encode()[span["start"] : span["end"]].decode(errors="replace")
    bound = set(re.findall(r"\b(?:let|each) (\w+)", reply)) if is_text else set()
    return error["code"] != "M0301" or "$" in at or at.strip() in bound


def judge(binary, world, reply, wrong, tally):
    errors = checked(binary, world, reply)
    for error in errors:
        if error["code"].startswith(STATE):
            tally["state"] += 1
        elif error["code"] in RESULTS:
            tally["results"] += 1
        elif binding_only(error, reply):
            tally["bindings"] += 1
        elif error["code"] == "M0107":
            # Of a number JSON Schema does not say how it is written: 1e888 is one.
            tally["numbers beyond any"] += 1
        else:
            wrong.append(f"{error['code']} {error['message']}: {reply}")
    tally["policies"] += 1
    tally["without an error"] += not errors


def carried_out(binary, world, url, dialect, folder, wrong, tally):
    """`motet do`, asked with the model at an address, in a dialect with the carrier of the grammar."""
    robot, scene, request = world
    dialect, carrier = dialect
    flags = ["--planner", url, "--model", "tiny", "--dialect", dialect, "--carrier", carrier, "--repair", "1", "--timeout", "300"]
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


def texts():
    """What the vocabulary is made from."""
    return [path.read_text() for path in sorted((ROOT / "examples").glob("*.*")) + [ROOT / "docs" / "language.md"]]


def report(headline, wrong, tally):
    """Prints what came of it, and ends with 1 where something is wrong or nothing came at all."""
    print(headline)
    for what, count in sorted(tally.items()):
        print(f"  {what}: {count}")
    for line in wrong:
        print(f"WRONG {line}")
    if wrong or not tally["policies"] or not tally["taken"] + tally["refused"]:
        raise SystemExit(1)
