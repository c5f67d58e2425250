"""A model behind HTTP on the loopback, in the protocols of `protocols.py`: replies in one piece or as server-sent events.

What the model may write is the grammar of the request, wherever one of the dialects of `motet do --dialect` puts it, or else the
Lark grammar that the server was given.
"""

import json
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from mistralrs import Architecture, ChatCompletionRequest, ModelDType, Runner, Which
from protocols import PROTOCOLS

# Longer than any policy that is asked for here, so that a model without an end is cut off and that is seen.
MOST_TOKENS = 3072


class Model:
    """A model that writes one reply at a time."""

    def __init__(self, folder, lark=None):
        which = Which.Plain(model_id=str(folder), arch=Architecture.Qwen2, dtype=ModelDType.F32)
        self.runner = Runner(which=which, no_paged_attn=True, prefix_cache_n=0, token_source="none")
        self.lark = lark
        self.turn = threading.Lock()

    def pieces(self, messages, held=None):
        """The pieces of a reply, and why it ended with the last."""
        kind, grammar = held or ("lark", self.lark)
        request = ChatCompletionRequest(
            messages=messages,
            model="default",
            max_tokens=MOST_TOKENS,
            temperature=1.0,
            stream=True,
            grammar=grammar,
            grammar_type=kind,
        )
        with self.turn:
            for chunk in self.runner.send_chat_completion_request(request):
                choice = chunk.choices[0]
                yield choice.delta.content or "", choice.finish_reason


def serve(model, log):
    """Starts a server for a model; each reply is added to the log. Gives the server with its address."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def log_message(self, *_):
            pass

        def do_POST(self):
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            protocol = PROTOCOLS[self.path]()
            messages, held = protocol.asked(body)
            self.close_connection = True
            self.send_response(200)
            streams = body.get("stream", False)
            self.send_header("Content-Type", "text/event-stream" if streams else "application/json")
            self.send_header("Connection", "close")
            self.end_headers()
            said, why = "", None
            listens = not streams or self.say(protocol.begin())
            for piece, why in model.pieces(messages, held):
                said += piece
                if streams and not self.say(protocol.piece(piece)):
                    listens = False
                    break
            why = why if listens else "left"
            log.append({"held": held[0] if held else "lark", "path": self.path, "said": said, "why": why})
            if streams:
                self.say(protocol.end(said, why))
            else:
                self.wfile.write(json.dumps(protocol.whole(said, why)).encode())

        def say(self, events):
            """Writes events; false where nobody listens any more."""
            try:
                for event in events:
                    text = event if isinstance(event, str) else json.dumps(event)
                    self.wfile.write(f"data: {text}\n\n".encode())
                self.wfile.flush()
                return True
            except OSError:
                return False

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server, f"http://127.0.0.1:{server.server_address[1]}"
