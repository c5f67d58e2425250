#!/usr/bin/env python3
"""Plays requests through `motet do --planner` against a model that answers files.

    play.py MOTET REQUESTS.tsv FOLDER [--robot NAME …] [--scene NAME …] [--first N] [--jobs N] [--ask never|FILE]

A line of REQUESTS.tsv is a request, and behind a tab what a sensible person would want. Robots and scenes take turns.
The chats appear in FOLDER/chats (see server.py and pending.py); FOLDER/conversations has a record of each request.
Behind the last one the tables are written (see judge.py). A request that has a record is not played again.
"""

import argparse
import json
import shutil
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from judge import judge
from server import serve


def tasks(args):
    """The requests with robot and scene."""
    lines = args.requests.read_text(encoding="utf-8").splitlines()
    rows = [line.split("\t") for line in lines if line.strip()]
    for number, row in enumerate(rows[: args.first], 1):
        yield {
            "number": number,
            "request": row[0].strip(),
            "wanted": row[1].strip() if len(row) > 1 else "",
            "robot": args.robot[(number - 1) % len(args.robot)],
            "scene": args.scene[(number - 1) // len(args.robot) % len(args.scene)],
        }


def play(task, args, url):
    """Carries out one request, and keeps its record."""
    folder = args.folder / "conversations" / f"{task['number']:03d}"
    if (folder / "exit").exists():
        return
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "task.json").write_text(json.dumps(task, ensure_ascii=False, indent=1), encoding="utf-8")
    ask = ["never"] if args.ask == "never" else ["script", args.ask]
    command = [str(args.motet), "do", task["request"], "--robot", task["robot"], "--scene", task["scene"]]
    command += ["--planner", url, "--model", "queue", "--timeout", str(args.timeout), "--ask", *ask]
    command += ["--speed", "max", "--record", str(folder / "record")]
    ran = subprocess.run(command, capture_output=True, stdin=subprocess.DEVNULL, check=False)
    (folder / "output.txt").write_bytes(ran.stdout + ran.stderr)
    (folder / "exit").write_text(f"{ran.returncode}\n", encoding="utf-8")
    print(f"{task['number']:3} exit {ran.returncode}  {task['request']}", flush=True)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("motet", type=Path)
    options.add_argument("requests", type=Path)
    options.add_argument("folder", type=Path)
    options.add_argument("--robot", nargs="+", default=["hsr", "anymal_z1"])
    options.add_argument("--scene", nargs="+", default=["kitchen"])
    options.add_argument("--first", type=int)
    options.add_argument("--jobs", type=int, default=4, help="conversations at once")
    options.add_argument("--ask", default="never", help="`never`, or a file with one answer a line")
    options.add_argument("--timeout", type=int, default=24 * 3600, help="seconds that a chat waits")
    args = options.parse_args()
    url, end = serve(args.folder / "chats")
    print(f"chats in {args.folder / 'chats'}", flush=True)
    with ThreadPoolExecutor(args.jobs) as pool:
        for done in [pool.submit(play, task, args, url) for task in tasks(args)]:
            done.result()
    end()
    judge(args.folder)
    print((args.folder / "summary.txt").read_text(encoding="utf-8"), end="")


if __name__ == "__main__":
    main()
