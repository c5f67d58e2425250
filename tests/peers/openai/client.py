#!/usr/bin/env python3
"""The official Python client of OpenAI with `motet serve`, in front of a server whose replies are scripted.

    python tests/peers/openai/client.py target/release/motet
"""

import json
import os
import subprocess
import sys
import threading
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import openai

MOTET = os.path.abspath(sys.argv[1])
KEY = "sk-of-this-test"
#: A policy that checks, and one that names a thing that is not there.
FETCH = '{"motet": 1, "policy": "p", "steps": [{"do": "go", "to": "mug_1"}, {"do": "pick", "object": "mug_1"}, {"end": "done"}]}'
WRONG = '{"motet": 1, "policy": "p", "steps": [{"do": "go", "to": "moon"}, {"end": "done"}]}'
PICTURE = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="


class Upstream(BaseHTTPRequestHandler):
    """A server of chat completions that gives one reply after the other and keeps the requests."""

    replies, heard, keys = [], [], []

    def do_POST(self):
        body = self.rfile.read(int(self.headers["Content-Length"]))
        self.heard.append(json.loads(body))
        self.keys.append(self.headers.get("Authorization"))
        message = self.replies.pop(0)
        choice = {"index": 0, "delta": message, "finish_reason": "stop"}
        usage = {"prompt_tokens": 100, "completion_tokens": 20, "total_tokens": 120}
        events = [{"choices": [choice]}, {"choices": [], "usage": usage}]
        data = "".join(f"data: {json.dumps(event)}\n\n" for event in events) + "data: [DONE]\n\n"
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.end_headers()
        self.wfile.write(data.encode())

    def log_message(self, *words):
        pass


def script(*replies):
    Upstream.replies[:] = [{"role": "assistant", "content": text} if isinstance(text, str) else text for text in replies]
    Upstream.heard.clear()


def is_accepted(policy):
    line = [MOTET, "check", "-", "--robot", "hsr", "--scene", "kitchen"]
    return subprocess.run(line, input=policy, text=True, capture_output=True).returncode == 0


def talk(client):
    ask = [{"role": "user", "content": "pick up the red mug"}]
    assert [model.id for model in client.models.list()] == ["m"]
    assert client.models.retrieve("m").id == "m"

    script(FETCH)
    reply = client.chat.completions.create(model="m", messages=ask)
    assert reply.choices[0].finish_reason == "stop" and is_accepted(reply.choices[0].message.content), reply
    assert reply.usage.total_tokens == 120 and Upstream.keys[-1] == f"Bearer {KEY}", (reply.usage, Upstream.keys)

    script(FETCH)
    picture = {"type": "image_url", "image_url": {"url": PICTURE}}
    seen = [{"role": "user", "content": [{"type": "text", "text": "pick up the red mug"}, picture]}]
    stream = client.chat.completions.create(model="m", messages=seen, stream=True, stream_options={"include_usage": True})
    events = list(stream)
    text = "".join(event.choices[0].delta.content or "" for event in events if event.choices)
    assert is_accepted(text) and events[-1].usage.completion_tokens == 20, events
    assert PICTURE in json.dumps(Upstream.heard), "the picture did not reach the model"

    # A reply that does not check goes back to the model with its findings.
    script(WRONG, FETCH)
    reply = client.chat.completions.create(model="m", messages=ask)
    assert is_accepted(reply.choices[0].message.content) and reply.usage.completion_tokens == 40, reply
    assert "moon" in json.dumps(Upstream.heard[1]["messages"][-1])

    script(*[WRONG] * 10)
    try:
        raise AssertionError(client.chat.completions.create(model="m", messages=ask))
    except openai.UnprocessableEntityError as error:
        assert error.code.startswith("M") and error.body["findings"], error.body
    script(*[WRONG] * 10)
    try:
        raise AssertionError(list(client.chat.completions.create(model="m", messages=ask, stream=True)))
    except openai.APIError as error:
        assert "does not check" in str(error), error

    script("Which mug do you mean?")
    reply = client.chat.completions.create(model="m", messages=ask)
    assert reply.choices[0].message.content is None and reply.choices[0].message.refusal == "Which mug do you mean?", reply
    script({"role": "assistant", "content": None, "refusal": "I cannot help with that."})
    try:
        raise AssertionError(client.chat.completions.create(model="m", messages=ask))
    except openai.UnprocessableEntityError as error:
        assert "declines" in str(error) and "cannot help" in str(error), error
    for wrong, why in [({"model": "other"}, openai.NotFoundError), ({"n": 2}, openai.BadRequestError)]:
        try:
            raise AssertionError(client.chat.completions.create(**{"model": "m", "messages": ask} | wrong))
        except why:
            pass


def main():
    upstream = ThreadingHTTPServer(("127.0.0.1", 0), Upstream)
    threading.Thread(target=upstream.serve_forever, daemon=True).start()
    server = f"http://127.0.0.1:{upstream.server_port}"
    line = [MOTET, "serve", "--planner", server, "--model", "m", "--robot", "hsr", "--scene", "kitchen", "--no-geometry"]
    endpoint = subprocess.Popen([*line, "--listen", "127.0.0.1:0"], stdout=subprocess.PIPE, text=True)
    try:
        address = endpoint.stdout.readline().split()[-1]
        talk(openai.OpenAI(base_url=address, api_key=KEY, max_retries=0))
    finally:
        endpoint.terminate()
        assert endpoint.wait(30) in (0, 130), endpoint.returncode
    print(f"openai {openai.__version__}: policies, streams, pictures, repairs, questions, refusals and errors")


main()
