#!/usr/bin/env python3
"""Inputs made to cost more than their size: `measure.py MOTET [WORD …]`.

Runs MOTET on each case of `cases.tsv` whose name has one of the words, and prints a row with the time of the
processor and the peak memory of each. A case has a name, a kind, and a text with `\\n` for a line break. In a
text `«COUNT|PART|SEPARATOR»` is a part COUNT times, or as often as the case has room for; `#` in it is its
number, and `#+` the next one.
"""

import os
import re
import resource
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
KITCHEN = ["--robot", "hsr", "--scene", "kitchen"]
WAIT = "policy p { wait 1 s }\n"
SCENE = '{"motet_scene":1,"robot":{"base":[0,0,0]},"entities":[%s]}'
SEE = 'policy p { let m = detect("mug") say("hi") go(user) }\n'
DOMAIN = "(define (domain d) (:requirements :typing) (:types t) (:predicates (p ?x - t)))"
# By kind: the largest size in bytes, the files, with `%s` for the text, and the command.
KINDS = {
    "json": (4_000_000, {"p.json": "%s"}, ["check", "p.json", *KITCHEN]),
    "jsonl": (4_000_000, {"p.jsonl": "%s"}, ["check", "p.jsonl", *KITCHEN]),
    "text": (4_000_000, {"p.motet": "%s"}, ["check", "p.motet", *KITCHEN]),
    "alone": (4_000_000, {"p.motet": "%s"}, ["check", "p.motet"]),
    "policy": (4_000_000, {"p.motet": "policy p { %s }"}, ["check", "p.motet", *KITCHEN]),
    "reply": (32_000, {"p.motet": "policy p { %s }"}, ["check", "p.motet", *KITCHEN]),
    "domain": (4_000_000, {"d.motet": "%s", "p.motet": WAIT},
               ["check", "p.motet", "--robot", "hsr", "--domain", "d.motet"]),
    "scene": (4_000_000, {"s.json": SCENE, "p.motet": SEE},
              ["check", "p.motet", "--robot", "hsr", "--scene", "s.json"]),
    "state": (4_000_000, {"s.json": "%s", "p.motet": WAIT},
              ["check", "p.motet", *KITCHEN, "--state", "s.json"]),
    "card": (4_000_000, {"r/robot.toml": "%s", "p.motet": WAIT}, ["check", "p.motet", "--robot", "r"]),
    "request": (4_000, {}, ["plan", *KITCHEN, "--"]),
    "room": (4_000_000, {"s.json": SCENE},
             ["plan", "--robot", "hsr", "--scene", "s.json", "bring me the red mug"]),
    "objects": (4_000_000, {"d.pddl": DOMAIN, "o.pddl": "(define (problem p) (:domain d) %s)"},
                ["import", "pddl", "d.pddl", "o.pddl"]),
    "urdf": (4_000_000, {"r.urdf": '<robot name="r">%s</robot>'}, ["robots", "add", "r.urdf", "--to", "r"]),
    "tree": (4_000_000, {"t.xml": '<root BTCPP_format="4">%s</root>'}, ["import", "btcpp", "t.xml"]),
    "faults": (4_000_000, {"f.json": '{"calls": [%s]}', "p.motet": SEE},
               ["run", "p.motet", *KITCHEN, "--speed", "max", "--faults", "f.json"]),
    "dialogue": (4_000_000, {"d.txt": "%s"}, ["dialog", "d.txt", *KITCHEN]),
}
# Most seconds and MB that the documents promise.
PROMISED = {"reply": (0.5, 500), "request": (0.5, 500)}
GROUP = re.compile("«([0-9]*)\\|(.*?)\\|([^|]*?)»", re.DOTALL)


def repeated(part, separator, count, room):
    """A part as often as asked for, or as there is room for."""
    parts = []
    while len(parts) < count and room > 0:
        index = len(parts)
        parts.append(part.replace("#+", str(index + 1)).replace("#", str(index)))
        room -= len(parts[-1].encode()) + len(separator)
    return separator.join(parts)


def filled(text, size):
    """The text of a case with its groups written out."""
    text = text.replace("\\\\", "\0").replace("\\n", "\n").replace("\0", "\\")
    room = size - len(GROUP.sub("", text).encode()) - 200
    return GROUP.sub(lambda of: repeated(of[2], of[3], int(of[1] or size), room), text)


def write(folder, kind, text):
    """Writes the files of a case in a process of its own, whose memory would count as that of the next."""
    child = os.fork()
    if child == 0:
        size, files, _ = KINDS[kind]
        for file, around in files.items():
            path = os.path.join(folder, file)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as out:
                out.write(around.replace("%s", filled(text, size)))
        os._exit(0)
    os.waitpid(child, 0)


def run(motet, folder, arguments):
    """Exit code, seconds of the processor, MB, and the last line of what a command says."""
    said = os.path.join(folder, "said")
    child = os.fork()
    if child == 0:
        os.chdir(folder)
        out = os.open(said, os.O_WRONLY | os.O_CREAT)
        os.dup2(out, 1)
        os.dup2(out, 2)
        resource.setrlimit(resource.RLIMIT_CPU, (8, 8))
        resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
        os.execv(motet, [motet, *arguments])
    _, status, usage = os.wait4(child, 0)
    with open(said, encoding="utf-8", errors="replace") as file:
        last = file.read().strip().rsplit("\n", 1)[-1]
    return os.waitstatus_to_exitcode(status), usage.ru_utime + usage.ru_stime, usage.ru_maxrss // 1024, last


def main():
    """Measures the cases that were asked for."""
    motet, words = os.path.abspath(sys.argv[1]), sys.argv[2:]
    with open(os.path.join(HERE, "cases.tsv"), encoding="utf-8") as file:
        cases = [line.rstrip("\n").split("\t") for line in file]
    missed = 0
    print("| case | bytes | seconds | MB | exit | last line |\n|---|---|---|---|---|---|")
    for name, kind, text in cases:
        if words and not any(word in name for word in words):
            continue
        with tempfile.TemporaryDirectory() as folder:
            size, files, arguments = KINDS[kind]
            write(folder, kind, text)
            arguments = arguments if files else [*arguments, filled(text, size)]
            paths = [os.path.join(folder, file) for file in files]
            sizes = [os.path.getsize(path) for path in paths] or [len(arguments[-1].encode())]
            code, seconds, mb, last = run(motet, folder, arguments)
            most_seconds, most_mb = PROMISED.get(kind, (2, 500))
            is_met = code in (0, 1, 2, 3) and seconds <= most_seconds and mb <= most_mb
            missed += not is_met
            mark = "" if is_met else " **!**"
            row = [name, f"{max(sizes):,}", f"{seconds:.2f}{mark}", mb, code, last[:80].replace("|", " ")]
            print("|", " | ".join(map(str, row)), "|", flush=True)
    print(f"\n{missed} of them miss the aim")


if __name__ == "__main__":
    main()
