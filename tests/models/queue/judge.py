#!/usr/bin/env python3
"""Judges the conversations that `play.py` recorded, and writes tables beside them.

    judge.py FOLDER

`table.tsv` has a row for each request: if the first reply passed, if the reply after one repair did, how many replies
went back and with which findings, and how the conversation ended. `summary.txt` has the shares. `read.md` shows what
happened beside what a sensible person would want, for a second reader, who fills in `verdicts.tsv`.
"""

import csv
import json
import sys
from collections import Counter
from pathlib import Path

COLUMNS = ["number", "robot", "request", "first", "after_one_repair", "replies", "sent_back", "outcome", "findings"]


class Conversation:
    """What a record says of one request."""

    def __init__(self, folder):
        self.task = json.loads((folder / "task.json").read_text(encoding="utf-8"))
        talk = folder / "record" / "talk.jsonl"
        lines = talk.read_text(encoding="utf-8").splitlines() if talk.exists() else []
        self.events = [json.loads(line) for line in lines]
        self.replies = list(self.judged())
        outcomes = [event["outcome"] for event in self.events if event["what"] == "outcome"]
        self.outcome = outcomes[-1] if outcomes else "none"

    def judged(self):
        """Each reply that arrived: the number of its round, its text, and what was found; none if it passed."""
        for event in self.events:
            if event["what"] in ("taken", "begun"):
                yield event.get("round", 0), event["reply"], None
            elif event["what"] == "said":
                yield event["round"], event["words"], None
            elif event["what"] == "refused":
                yield event["round"], event["reply"], event["findings"]

    @property
    def is_answered(self):
        return bool(self.replies)

    @property
    def first(self):
        """True if the first reply was not sent back."""
        return self.replies[0][2] is None

    @property
    def after_one_repair(self):
        """True if the first reply passed, or the one after it."""
        return self.first or (len(self.replies) > 1 and self.replies[1][2] is None)

    @property
    def sent_back(self):
        return [findings.strip() for _, _, findings in self.replies if findings is not None]

    def row(self):
        task = self.task
        told = [len(self.replies), len(self.sent_back), self.outcome, " | ".join(self.sent_back).replace("\n", " / ")]
        passed = [self.first, self.after_one_repair] if self.is_answered else [None, None]
        words = [{True: "yes", False: "no", None: "none"}[one] for one in passed]
        return [task["number"], task["robot"], task["request"], *words, *told]

    def lines(self):
        """The conversation for a reader."""
        task = self.task
        yield f"## {task['number']}. {task['request']}"
        yield f"Robot {task['robot']}, scene {task['scene']}. Wanted: {task['wanted'] or 'nothing is said'}"
        for event in self.events:
            if event["what"] in ("taken", "begun"):
                yield f"- reply: `{one_line(event['reply'])}`"
            elif event["what"] == "said":
                yield f"- reply in words: {one_line(event['words'])}"
            elif event["what"] == "refused":
                yield f"- reply that went back: `{one_line(event['reply'])}`\n  - found: {one_line(event['findings'])}"
            elif event["what"] == "failed":
                yield f"- no reply: {event['why']}"
            elif event["what"] == "question":
                yield f"- asked: {one_line(event['question'])}; answered: {event['answer'] or 'nobody'}"
            elif event["what"] == "ended":
                yield f"- the policy ended: {event['how']}"
        yield f"- outcome: {self.outcome}"


def one_line(text):
    return " ".join(text.split())


def share(part, whole):
    return f"{part} of {whole} ({100 * part / whole:.0f} %)" if whole else "none"


def judge(folder):
    """Writes the tables; what the summary counts."""
    folder = Path(folder)
    tasks = sorted(task.parent for task in folder.glob("conversations/*/task.json"))
    conversations = [Conversation(task) for task in tasks]
    answered = [one for one in conversations if one.is_answered]
    with (folder / "table.tsv").open("w", encoding="utf-8", newline="") as out:
        table = csv.writer(out, delimiter="\t", quoting=csv.QUOTE_NONE, escapechar="\\", lineterminator="\n")
        table.writerow(COLUMNS)
        table.writerows(one.row() for one in conversations)
    (folder / "read.md").write_text("\n\n".join("\n".join(one.lines()) for one in conversations) + "\n", encoding="utf-8")
    verdicts = folder / "verdicts.tsv"
    if not verdicts.exists():
        head = "number\tas a sensible person would want (yes, no)\twhy\n"
        verdicts.write_text(head + "".join(f"{one.task['number']}\t\t\n" for one in conversations), encoding="utf-8")
    found = Counter(line for one in answered for text in one.sent_back for line in text.splitlines())
    sums = {
        "requests": len(conversations),
        "answered": len(answered),
        "first": sum(one.first for one in answered),
        "after_one_repair": sum(one.after_one_repair for one in answered),
        "replies": sum(len(one.replies) for one in answered),
        "sent_back": sum(len(one.sent_back) for one in answered),
        "outcomes": dict(sorted(Counter(one.outcome for one in conversations).items())),
    }
    lines = [
        f"first replies that pass: {share(sums['first'], len(answered))}",
        f"pass after one repair at most: {share(sums['after_one_repair'], len(answered))}",
        f"replies that went back: {share(sums['sent_back'], sums['replies'])}",
        f"outcomes: {', '.join(f'{count} {outcome}' for outcome, count in sums['outcomes'].items())}",
        f"without a reply: {len(conversations) - len(answered)}",
        "",
        "findings:",
        *(f"{count:4} {line}" for line, count in found.most_common()),
    ]
    (folder / "summary.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")
    return sums


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    judge(sys.argv[1])
    print((Path(sys.argv[1]) / "summary.txt").read_text(encoding="utf-8"), end="")
