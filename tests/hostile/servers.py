#!/usr/bin/env python3
"""Mutated requests to the HTTP servers of Motet: `servers.py MOTET SECONDS [SEED]`.

Starts `motet mcp --http` and `motet serve`, the latter in front of a model server that answers anything, and sends
each of them mutated requests over connections of their own. A server fails if it ends or panics, answers a complete
request with 500, or takes more than 5 s. Prints a row for each server; exits with 1 if one failed.
"""

import http.server
import json
import os
import random
import socket
import subprocess
import sys
import tempfile
import threading
import time

TOKEN = "0123456789abcdef0123"
SLOW_S = 5
WORDS = [b'"', b"{", b"}", b"[", b"]", b"1e999", b"-1", b"null", b"\xff\xfe", b"\0", b"\r\n", b"\\ud800", b"99999999999999999999",
         b"Content-Length: 5\r\n", b"Transfer-Encoding: chunked\r\n", b"%00", b"../", b"mug_1", b"policy p { "]


def call(method, **params):
    return {"jsonrpc": "2.0", "id": 1, "method": method, "params": params}


def tool(called, **arguments):
    return call("tools/call", name=called, arguments=arguments)


MCP = [
    call("initialize", protocolVersion="2025-06-18", capabilities={}, clientInfo={"name": "c", "version": "1"}),
    call("tools/list"), call("resources/list"), call("resources/read", uri="motet://manual/language"), call("ping"),
    tool("check_policy", policy='policy p { say("x") }'),
    tool("simulate_policy", policy='policy p { say("x") }', seed=1), tool("plan", request="bring me the red mug"),
    tool("feasible", motions=["reach(mug_1)"]), tool("primitives", name="pick"), tool("explain", code="M0501"),
]
CHAT = [
    {"model": "m", "messages": [{"role": "user", "content": "bring me the red mug"}], "stream": stream}
    for stream in (False, True)
]


class Model(http.server.BaseHTTPRequestHandler):
    """A model that writes the same policy whatever it is asked."""

    def do_POST(self):
        self.rfile.read(int(self.headers.get("Content-Length") or 0))
        message = {"role": "assistant", "content": 'policy p { say("x") }'}
        body = json.dumps({"choices": [{"index": 0, "message": message, "finish_reason": "stop"}]}).encode()
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(body)))
        self.end_headers()
        try:
            self.wfile.write(body)
        except OSError:  # The client no longer waits.
            pass

    def log_message(self, *_):
        pass


def free_port():
    with socket.socket() as listener:
        listener.bind(("127.0.0.1", 0))
        return listener.getsockname()[1]


def request(path, body, port, session=""):
    head = (f"POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nAuthorization: Bearer {TOKEN}\r\n"
            "Content-Type: application/json\r\nAccept: application/json, text/event-stream\r\n"
            f"{session}Connection: close\r\nContent-Length: {len(body)}\r\n\r\n")
    return head.encode() + body


def session_of(path, port):
    """Header of a new session, if the server opens one for the first seed of MCP."""
    raw = request(path, json.dumps(MCP[0]).encode(), port)
    with socket.create_connection(("127.0.0.1", port), timeout=SLOW_S) as connection:
        connection.sendall(raw)
        answer = connection.recv(65536)
    lines = [line for line in answer.split(b"\r\n") if line.lower().startswith(b"mcp-session-id:")]
    return lines[0].decode() + "\r\n" if lines else ""


def mutated(dice, seed, path, port, session):
    """A request with a changed body, or changed as a whole, its head included, and if it is complete."""
    body = bytearray(json.dumps(seed).encode())
    whole = dice.random() < 0.3
    case = bytearray(request(path, bytes(body), port, session)) if whole else body
    for _ in range(dice.randint(0, 5)):
        at = dice.randrange(len(case) + 1)
        to = min(len(case), at + dice.randrange(40))
        match dice.randrange(5):
            case 0: case[at:at] = dice.choice(WORDS)
            case 1: del case[at:to]
            case 2: case[at:to] = case[at:to] * dice.randrange(200)
            case 3: case[at:at + 1] = bytes([dice.randrange(256)])
            case _: del case[to:]
        if not case:
            break
    return (bytes(case), False) if whole else (request(path, bytes(case), port, session), True)


def ask(port, raw, is_complete):
    """First line of the answer, and the time it took. After a request that may be half of one nothing more comes."""
    begun = time.monotonic()
    with socket.create_connection(("127.0.0.1", port), timeout=2 * SLOW_S) as connection:
        try:
            connection.sendall(raw)
            if not is_complete:
                connection.shutdown(socket.SHUT_WR)
            answer = b""
            while piece := connection.recv(65536):
                answer += piece
        except TimeoutError:
            raise
        except OSError:  # The server has closed the connection.
            answer = b""
    return answer.split(b"\r\n", 1)[0], time.monotonic() - begun


def fuzz(name, command, path, seeds, seconds, dice):
    port = free_port()
    command = [word.replace("PORT", str(port)) for word in command]
    log = tempfile.TemporaryFile()
    server = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=log,
                              env={**os.environ, "MOTET_TOKEN": TOKEN})
    for _ in range(100):
        try:
            socket.create_connection(("127.0.0.1", port)).close()
            break
        except OSError:
            time.sleep(0.1)
    session = session_of(path, port) if seeds is MCP else ""
    cases, failed, slowest, kinds = 0, [], 0.0, {}
    until = time.monotonic() + seconds
    while time.monotonic() < until and server.poll() is None:
        seed = seeds[cases % len(seeds)]
        is_seed = cases < len(seeds)
        cases += 1
        if is_seed:
            raw, is_complete = request(path, json.dumps(seed).encode(), port, session), True
        else:
            raw, is_complete = mutated(dice, seed, path, port, session)
        try:
            status, took = ask(port, raw, is_complete)
        except OSError as error:
            status, took = str(error).encode(), SLOW_S + 1
        slowest = max(slowest, took)
        code = status.split(b" ")[1].decode(errors="replace") if status.count(b" ") else "none"
        kinds[code] = kinds.get(code, 0) + 1
        if took > SLOW_S or code == "500" and is_complete or is_seed and code != "200":
            failed.append((took, code, raw))
    ended = server.poll()
    server.terminate()
    server.wait()
    log.seek(0)
    errors = log.read().decode(errors="replace")
    if ended is not None or "panicked" in errors:
        failed.append((0, "ended" if ended is not None else "panicked", errors.encode()))
    print(f"{name}: {cases} requests, {len(failed)} failed, the slowest took {slowest:.2f} s, answers {kinds}")
    for took, code, raw in failed[:5]:
        print(f"  {took:.1f} s, {code}: {raw[:600]!r}")
    return bool(failed)


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    motet, seconds, seed = sys.argv[1], float(sys.argv[2]), int((sys.argv[3:] or ["1"])[0])
    model = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Model)
    threading.Thread(target=model.serve_forever, daemon=True).start()
    address = f"http://127.0.0.1:{model.server_address[1]}"
    kitchen = ["--robot", "hsr", "--scene", "kitchen"]
    dice = random.Random(seed)
    servers = [
        ("mcp", [motet, "mcp", *kitchen, "--http", "PORT", "--token-from", "MOTET_TOKEN"], "/mcp", MCP),
        ("serve", [motet, "serve", *kitchen, "--planner", address, "--model", "m", "--dialect", "llamacpp",
                   "--listen", "127.0.0.1:PORT", "--token-from", "MOTET_TOKEN"], "/v1/chat/completions", CHAT),
    ]
    sys.exit(any([fuzz(*server, seconds, dice) for server in servers]))


if __name__ == "__main__":
    main()
