#!/usr/bin/env python3
"""Checks the queue with a scripted answerer: test.py MOTET

Each conversation gets the replies that are written for it here, in order, and the tables say so.
"""

import csv
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path

from pending import text, waiting
from server import put

HERE = Path(__file__).parent


def policy(*steps):
    return '{"motet": 1, "policy": "scripted", "robot": "hsr", "steps": [' + ", ".join(steps) + "]}"


SAY = '{"do": "say", "text": "I know of none here."}'
JUGGLE = '{"do": "juggle"}'
# A request, what is wanted, the replies, and the row of the table from `first` on.
SCRIPT = [
    ("bring me the piano", "decline", [policy(SAY)], ["yes", "yes", "1", "0", "done"]),
    ("juggle a bit", "decline", [policy(JUGGLE), policy(SAY)], ["no", "yes", "2", "1", "done"]),
    ("sing", "decline", [policy(JUGGLE), policy(JUGGLE, SAY), policy(SAY)], ["no", "no", "3", "2", "done"]),
    ("that one", "ask", ["Which thing do you mean?"], ["yes", "yes", "1", "0", "failed"]),
]


def answer(folder, is_over):
    """Answers chats as the script says: a reply for each turn of the model."""
    while not is_over.is_set():
        for chat, reply in waiting(folder):
            messages = chat["messages"]
            turn = sum(message["role"] == "assistant" for message in messages)
            asked = text(messages[1])
            replies = next(replies for request, _, replies, _ in SCRIPT if request in asked.rsplit("# Request", 1)[1])
            put(reply, replies[turn])
        time.sleep(0.05)


def main():
    motet = Path(sys.argv[1]).absolute()
    with tempfile.TemporaryDirectory() as scratch:
        folder, requests = Path(scratch) / "played", Path(scratch) / "requests.tsv"
        requests.write_text("".join(f"{request}\t{wanted}\n" for request, wanted, _, _ in SCRIPT), encoding="utf-8")
        is_over = threading.Event()
        answerer = threading.Thread(target=answer, args=(folder / "chats", is_over))
        answerer.start()
        command = [sys.executable, str(HERE / "play.py"), str(motet), str(requests), str(folder)]
        ran = subprocess.run([*command, "--robot", "hsr", "--jobs", "2", "--timeout", "120"], timeout=600, check=True,
                             capture_output=True, text=True)
        is_over.set()
        answerer.join()
        rows = list(csv.reader((folder / "table.tsv").open(encoding="utf-8"), delimiter="\t", quoting=csv.QUOTE_NONE))
        assert len(rows) == len(SCRIPT) + 1, rows
        for row, (request, _, _, wanted) in zip(rows[1:], SCRIPT):
            assert row[2] == request and row[3:8] == wanted, (row, wanted)
        findings = [row[8] for row in rows[1:]]
        assert findings[0] == findings[3] == "" and "juggle" in findings[1] and findings[2].count("juggle") == 2, findings
        summary = (folder / "summary.txt").read_text(encoding="utf-8")
        assert "first replies that pass: 2 of 4 (50 %)" in summary, summary
        assert "pass after one repair at most: 3 of 4 (75 %)" in summary, summary
        assert "Wanted: decline" in (folder / "read.md").read_text(encoding="utf-8")
        # What was played is not played again.
        again = subprocess.run([*command, "--robot", "hsr"], timeout=60, check=True, capture_output=True, text=True)
        assert "exit" not in again.stdout, again.stdout
    print(ran.stdout, end="")


if __name__ == "__main__":
    main()
