#!/usr/bin/env python3
"""A server of chats whose model is whoever writes files.

    server.py FOLDER [PORT]

It speaks the protocol of OpenAI. Each chat becomes FOLDER/NNN.request.json, and its reply is what appears as
FOLDER/NNN.reply.txt: write it under another name and rename it. While nobody has answered, a stream is kept open.
"""

import http.server
import json
import os
import sys
import threading
import time
from pathlib import Path

# What a chat and a reply may have, in bytes.
LARGEST_CHAT, LARGEST_REPLY = 4 << 20, 1 << 20
# How long a chat waits for its reply, and between two signs of life, in seconds.
LONGEST_WAIT_S, SIGN_S, LOOK_S = 24 * 3600, 5, 0.1
# Characters of a piece of a stream.
PIECE = 400


class Queue:
    """The folder of chats and replies."""

    def __init__(self, folder):
        self.folder = Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.lock = threading.Lock()
        self.is_over = False

    def add(self, chat):
        """Writes a chat, and returns the file of its reply."""
        with self.lock:
            numbers = [int(file.name[:4]) for file in self.folder.glob("[0-9]*.request.json")]
            stem = self.folder / f"{max(numbers, default=0) + 1:04d}"
            put(f"{stem}.request.json", json.dumps(chat, ensure_ascii=False, indent=1))
        return Path(f"{stem}.reply.txt")

    def pieces(self, reply):
        """The pieces of a reply as soon as it is there, and before that an empty one now and then."""
        begun = told = time.monotonic()
        while not reply.exists():
            if self.is_over or time.monotonic() - begun > LONGEST_WAIT_S:
                return
            if time.monotonic() - told > SIGN_S:
                told = time.monotonic()
                yield ""
            time.sleep(LOOK_S)
        text = reply.read_bytes()[:LARGEST_REPLY].decode("utf-8", "replace")
        for at in range(0, len(text), PIECE):
            yield text[at : at + PIECE]


def put(path, text):
    """Writes a file so that nobody reads a part of it."""
    part = f"{path}.part"
    Path(part).write_text(text, encoding="utf-8")
    os.rename(part, path)


def handler(queue):
    """The handler of the server of a queue."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def log_message(self, *_):
            pass

        def do_POST(self):
            try:
                size = int(self.headers.get("content-length", ""))
                chat = json.loads(self.rfile.read(size)) if 0 < size <= LARGEST_CHAT else None
                texts = [message["content"] for message in chat["messages"]]
            except (ValueError, TypeError, KeyError):
                return self.send_error(400, "this is no chat")
            if not texts:
                return self.send_error(400, "this chat has no message")
            try:
                self.answer(chat)
            except (BrokenPipeError, ConnectionResetError):
                pass  # Nobody listens any more.

        def answer(self, chat):
            reply = queue.add(chat)
            if not chat.get("stream"):
                message = {"role": "assistant", "content": "".join(queue.pieces(reply))}
                body = json.dumps({"choices": [{"message": message, "finish_reason": "stop"}]}).encode()
                self.send_response(200)
                self.send_header("content-type", "application/json")
                self.send_header("content-length", str(len(body)))
                self.end_headers()
                self.wfile.write(body)
                return
            self.send_response(200)
            self.send_header("content-type", "text/event-stream")
            self.end_headers()
            for piece in queue.pieces(reply):
                self.event({"content": piece}, None)
            self.event({}, "stop")
            self.wfile.write(b"data: [DONE]\n\n")

        def event(self, delta, finish):
            event = {"choices": [{"index": 0, "delta": delta, "finish_reason": finish}]}
            self.wfile.write(b"data: " + json.dumps(event).encode() + b"\n\n")
            self.wfile.flush()

    return Handler


def serve(folder, port=0):
    """Starts a server in a thread; its address, and what ends it."""
    queue = Queue(folder)
    server = http.server.ThreadingHTTPServer(("127.0.0.1", port), handler(queue))
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()

    def end():
        queue.is_over = True
        server.shutdown()

    return f"http://127.0.0.1:{server.server_port}", end


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    url, _ = serve(sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 8123)
    print(f"{url}, chats in {sys.argv[1]}", flush=True)
    threading.Event().wait()
