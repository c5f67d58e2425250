#!/usr/bin/env python3
"""Prints the chats that wait for a reply, the oldest first.

    pending.py FOLDER [HOW_MANY] [--wait SECONDS]

A system message is written to a file of its own and named, since many chats share it. With --wait it waits until a
chat is there.
"""

import argparse
import hashlib
import json
import time
from pathlib import Path


def waiting(folder):
    """The chats without a reply, each with the file that its reply goes to."""
    chats = []
    for file in sorted(Path(folder).glob("[0-9]*.request.json")):
        reply = file.with_name(file.name.replace(".request.json", ".reply.txt"))
        if not reply.exists():
            chats.append((json.loads(file.read_text(encoding="utf-8")), reply))
    return chats


def text(message):
    """The text of a message; pictures are only named."""
    content = message["content"]
    if isinstance(content, str):
        return content
    parts = [part.get("text", f"[{part.get('type')}]") for part in content]
    return "\n".join(parts)


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("folder", type=Path)
    options.add_argument("most", nargs="?", type=int, default=6)
    options.add_argument("--wait", type=float, default=0)
    args = options.parse_args()
    begun = time.monotonic()
    while not (chats := waiting(args.folder)) and time.monotonic() - begun < args.wait:
        time.sleep(0.2)
    print(f"{len(chats)} without a reply")
    for chat, reply in chats[: args.most]:
        system, *rest = chat["messages"]
        name = hashlib.sha1(text(system).encode()).hexdigest()[:8]
        file = args.folder / f"system_{name}.txt"
        file.write_text(text(system), encoding="utf-8")
        print(f"\n===== system message: {file}; write the reply to {reply} =====")
        for message in rest:
            print(f"--[{message['role']}]--\n{text(message).rstrip()}")


if __name__ == "__main__":
    main()
