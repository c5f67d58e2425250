"""The same in llama.cpp's own server: whatever the weights, what is written under our GBNF, and under the JSON Schema that the
server makes a grammar of by itself, is read, and right in names and types.

    python tests/models/tiny/llamacpp.py LLAMA_SERVER MOTET [MODELS]

`llamacpp.sh` beside this file builds the server. Each model is asked for policies in the text form and in the JSON form under
GBNF, in the JSON form under the JSON Schema of `motet do --dialect llamacpp`, and by `motet do` itself, for two robots.
"""

import json
import socket
import subprocess
import sys
import tempfile
import time
import urllib.error
import urllib.request
from collections import Counter
from contextlib import contextmanager
from pathlib import Path

from convert import write
from judge import WORLDS, carried_out, judge, motet, report, texts
from weights import train

DIRECT = 3
# Longer than any policy that is asked for here, so that a model without an end is cut off and that is seen.
MOST_TOKENS = 2048
CONTEXT = 32768


def asked(url, body):
    """What is written, and why it ended."""
    request = urllib.request.Request(
        f"{url}/v1/chat/completions", json.dumps(body).encode(), {"Content-Type": "application/json"}
    )
    try:
        with urllib.request.urlopen(request, timeout=600) as answer:
            choice = json.load(answer)["choices"][0]
    except urllib.error.HTTPError as error:
        raise SystemExit(f"llama-server: {error.code} {error.read().decode(errors='replace')}") from error
    return choice["message"]["content"] or "", choice["finish_reason"]


@contextmanager
def served(server, path, log):
    """The address of a server with a model."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    flags = ["--host", "127.0.0.1", "--port", str(port), "-c", str(CONTEXT), "-np", "1", "-t", "1", "-n", str(MOST_TOKENS)]
    with log.open("w") as output:
        process = subprocess.Popen([server, "-m", str(path), *flags], stdout=output, stderr=output)
    url = f"http://127.0.0.1:{port}"
    try:
        for _ in range(600):
            if process.poll() is not None:
                raise SystemExit(f"llama-server ended with {process.returncode}:\n{log.read_text()[-3000:]}")
            try:
                urllib.request.urlopen(f"{url}/health", timeout=5).close()
                break
            except OSError:
                time.sleep(0.1)
        yield url
    finally:
        process.terminate()
        process.wait()


def held(binary, world):
    """The fields of a request that hold a model to a policy, by name."""
    robot, scene, request = world
    flags = ["--robot", robot, "--scene", scene, "--depth", "2"]
    of = lambda *more: motet(binary, "grammar", *flags, *more).stdout  # noqa: E731
    whole = json.loads(of("--request", "llamacpp", "--ask", request))
    return {
        "GBNF of the JSON form": {"grammar": of("--format", "gbnf")},
        "GBNF of the text form": {"grammar": of("--format", "gbnf", "--syntax", "text")},
        "JSON Schema": {"response_format": whole["response_format"]},
    }


def main():
    server, binary, models = sys.argv[1], sys.argv[2], int(sys.argv[3]) if len(sys.argv) > 3 else 3
    begun = time.perf_counter()
    tokenizer = train(texts())
    wrong, tally = [], Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for seed in range(models):
            folder = Path(scratch) / f"model_{seed}"
            folder.mkdir()
            parameters = write(folder / "tiny.gguf", seed, tokenizer)
            with served(server, folder / "tiny.gguf", folder / "log.txt") as url:
                for world in WORLDS:
                    messages = [{"role": "user", "content": world[2]}]
                    for name, fields in held(binary, world).items():
                        for _ in range(DIRECT):
                            said, why = asked(url, {"messages": messages, "temperature": 1.0, **fields})
                            tally[f"{name}: ended by {why}"] += 1
                            if why == "stop":
                                judge(binary, world, said, wrong, tally)
                    carried_out(binary, world, url, ("llamacpp", "usual"), folder / world[0], wrong, tally)
    spent = time.perf_counter() - begun
    report(f"{models} models of {parameters} parameters, {tokenizer.get_vocab_size()} tokens: {spent:.0f} s", wrong, tally)


if __name__ == "__main__":
    main()
