"""A model behind HTTP on the loopback, as far as OpenAI's chat is needed: replies in one piece or as server-sent events.

What the model may write is a Lark grammar that the server was given, or the JSON Schema of the request, wherever one of the
dialects of `motet do --dialect` puts it.
"""

import json
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

from mistralrs import Architecture, ChatCompletionRequest, ModelDType, Runner, Which

# Longer than any policy that is asked for here, so that a model without an end is cut off and that is seen.
MOST_TOKENS = 3072


class Model:
    """A model that writes one reply at a time."""

    def __init__(self, folder, lark=None):
        which = Which.Plain(model_id=str(folder), arch=Architecture.Qwen2, dtype=ModelDType.F32)
        self.runner = Runner(which=which, no_paged_attn=True, prefix_cache_n=0, token_source="none")
        self.lark = lark
        self.turn = threading.Lock()

    def pieces(self, messages, schema=None):
        """The pieces of a reply, and why it ended with the last."""
        kind, grammar = ("lark", self.lark) if schema is None else ("json_schema", json.dumps(schema))
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


def schema_of(body):
    """The JSON Schema of a request, in vLLM's dialect or in OpenAI's."""
    schema = body.get("structured_outputs", {}).get("json")
    if schema is None:
        schema = body.get("response_format", {}).get("json_schema", {}).get("schema")
    # What the grammar leaves open, a model without sense fills with blanks.
    return schema and {**schema, "x-guidance": {"whitespace_flexible": False}}


def serve(model, log):
    """Starts a server for a model; each reply is added to the log. Gives the server with its address."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def log_message(self, *_):
            pass

        def do_POST(self):
            body = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
            schema = schema_of(body)
            self.close_connection = True
            self.send_response(200)
            streams = body.get("stream", False)
            self.send_header("Content-Type", "text/event-stream" if streams else "application/json")
            self.send_header("Connection", "close")
            self.end_headers()
            said, why = "", None
            for piece, why in model.pieces(body["messages"], schema):
                said += piece
                if streams and not self.say({"choices": [{"index": 0, "delta": {"content": piece}, "finish_reason": why}]}):
                    why = "left"
                    break
            log.append({"held": "lark" if schema is None else "schema", "said": said, "why": why})
            if streams:
                self.say(None)
            else:
                message = {"role": "assistant", "content": said}
                whole = {"choices": [{"index": 0, "message": message, "finish_reason": why}]}
                self.wfile.write(json.dumps(whole).encode())

        def say(self, event):
            """Writes an event; false where nobody listens any more."""
            try:
                text = "[DONE]" if event is None else json.dumps(event)
                self.wfile.write(f"data: {text}\n\n".encode())
                self.wfile.flush()
                return True
            except OSError:
                return False

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server, f"http://127.0.0.1:{server.server_address[1]}"
