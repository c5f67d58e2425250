"""A small server of chats for one model, as far as `motet do --planner` needs it: each reply under the grammar of its request.

It answers one request at a time and sends a reply in one piece. For a robot, serve the merged model with vLLM or llama.cpp.
"""

from __future__ import annotations

import base64
import json
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

from .reply import GrammarError, Replier, Reply, lark, schema
from .rows import Row

__all__ = ["serve", "served"]

LONGEST = 64 * 1024 * 1024


def serve(replier: Replier, name: str, port: int) -> ThreadingHTTPServer:
    """A server on the loopback; port 0 takes a free one. The caller has it serve."""
    turn = threading.Lock()

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def log_message(self, format: str, *of: Any) -> None:
            pass

        def do_GET(self) -> None:
            self._send(
                200, "application/json", json.dumps({"object": "list", "data": [{"id": name, "object": "model"}]})
            )

        def do_POST(self) -> None:
            try:
                length = int(self.headers.get("Content-Length", ""))
                if not 0 <= length <= LONGEST:
                    raise ValueError(f"a body of {length} bytes")
                body = json.loads(self.rfile.read(length))
                with turn, tempfile.TemporaryDirectory() as folder:
                    row = _row(body["messages"], Path(folder))
                    said = replier.replies([row], [_grammar(body)])[0]
            except (ValueError, KeyError, TypeError, AttributeError, GrammarError, OSError) as why:
                self._send(400, "application/json", json.dumps({"error": {"message": f"{type(why).__name__}: {why}"}}))
                return
            if body.get("stream"):
                events = [_chunk(name, said), "[DONE]"]
                self._send(200, "text/event-stream", "".join(f"data: {event}\n\n" for event in events))
            else:
                self._send(200, "application/json", _whole(name, said))

        def _send(self, status: int, kind: str, text: str) -> None:
            self.close_connection = True
            data = text.encode()
            self.send_response(status)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(data)))
            self.send_header("Connection", "close")
            self.end_headers()
            try:
                self.wfile.write(data)
            except OSError:
                # Nobody listens any more.
                pass

    return ThreadingHTTPServer(("127.0.0.1", port), Handler)


@contextmanager
def served(replier: Replier, name: str) -> Iterator[str]:
    """A server in the background, as long as the context is open; gives its address."""
    server = serve(replier, name, 0)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_address[1]}"
    finally:
        server.shutdown()
        server.server_close()


def _grammar(body: dict[str, Any]) -> str | None:
    """The grammar of a request, wherever a dialect of `motet do --dialect` puts it; none if it has none."""
    outputs = body.get("structured_outputs") or {}
    form = (body.get("response_format") or {}).get("json_schema") or {}
    if "json" in outputs:
        return schema(outputs["json"])
    if "schema" in form:
        return schema(form["schema"])
    text = outputs.get("grammar") or body.get("grammar") or body.get("ebnf")
    return lark(text) if text else None


def _row(messages: list[dict[str, Any]], folder: Path) -> Row:
    """The messages of a request as a row. Pictures, which come as data in addresses, are put into a folder."""
    prompt: list[dict[str, str]] = []
    images: list[Path] = []
    for message in messages:
        content = message["content"]
        parts: list[dict[str, Any]] = [{"type": "text", "text": content}] if isinstance(content, str) else content
        for part in parts:
            if part["type"] == "image_url":
                head, _, data = part["image_url"]["url"].partition(";base64,")
                if not head.startswith("data:image/"):
                    raise ValueError("a picture is not in its address: only `data:image/…;base64,` is read")
                images.append(folder / str(len(images)))
                images[-1].write_bytes(base64.b64decode(data, validate=True))
        text = "".join(part["text"] for part in parts if part["type"] == "text")
        prompt.append({"role": message["role"], "content": text})
    return Row(prompt, "", tuple(images), {})


def _why(said: Reply) -> str:
    return "stop" if said.is_whole else "length"


def _chunk(name: str, said: Reply) -> str:
    choice = {"index": 0, "delta": {"role": "assistant", "content": said.text}, "finish_reason": _why(said)}
    return json.dumps({"object": "chat.completion.chunk", "model": name, "choices": [choice]})


def _whole(name: str, said: Reply) -> str:
    choice = {"index": 0, "message": {"role": "assistant", "content": said.text}, "finish_reason": _why(said)}
    return json.dumps({"object": "chat.completion", "model": name, "choices": [choice]})
