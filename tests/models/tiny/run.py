"""Whatever its weights, a model that is held to an exported grammar writes policies that are read, and right in names and types.

    python tests/models/tiny/run.py target/debug/motet [MODELS]

makes so many models with weights at random, 3 where nothing is said, and has each write policies under the Lark grammar and
under the JSON Schema of two robots. `motet check` may find fault with what no grammar can follow, and with nothing else; and
`motet do` comes to an end with each model, with a policy or with the reason why there is none.
"""

import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from judge import WORLDS, carried_out, judge, motet, report, texts
from server import Model, serve
from weights import train, write

DIRECT = 3
# Dialects and carriers of `motet do`: the first two in each world, the others in the first. One model speaks each dialect once.
DIALECTS = [
    ("none", "usual"),
    ("vllm", "usual"),
    ("mistralrs", "usual"),
    ("mistralrs", "lark"),
    ("openai-responses", "usual"),
    ("openai-responses", "lark"),
    ("anthropic", "usual"),
    ("anthropic", "tool"),
]


def main():
    binary, models = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 3
    begun = time.perf_counter()
    tokenizer = train(texts())
    wrong, tally = [], Counter()
    with tempfile.TemporaryDirectory() as scratch:
        for seed in range(models):
            folder = Path(scratch) / f"model_{seed}"
            parameters = write(folder, seed, tokenizer)
            for world in WORLDS:
                robot, scene, request = world
                flags = ["--robot", robot, "--scene", scene, "--depth", "2"]
                lark = motet(binary, "grammar", *flags, "--format", "lark", "--llguidance").stdout
                model, log = Model(folder, lark), []
                server, url = serve(model, log)
                for _ in range(DIRECT):
                    said, why = "", None
                    for piece, why in model.pieces([{"role": "user", "content": request}]):
                        said += piece
                    if why != "stop":
                        tally[f"ended by {why}"] += 1
                        continue
                    judge(binary, world, said, wrong, tally)
                first, other = (DIALECTS, DIALECTS[:2]) if models > 1 else (DIALECTS[1::2], DIALECTS[:1])
                dialects = first if world == WORLDS[0] else other
                for dialect, carrier in dialects:
                    kept = folder / f"{robot}_{dialect}_{carrier}"
                    carried_out(binary, world, url, (dialect, carrier), kept, wrong, tally)
                server.shutdown()
                for reply in log:
                    tally[f"held to {reply['held']} at {reply['path']}"] += 1
                    # The schema for Anthropic leaves out the bounds of numbers, which the check then refuses.
                    if reply["why"] == "stop" and reply["path"] != "/v1/messages":
                        judge(binary, world, reply["said"], wrong, tally)
                    elif reply["why"] != "stop":
                        tally[f"ended by {reply['why']}"] += 1
    spent = time.perf_counter() - begun
    report(f"{models} models of {parameters} parameters, {tokenizer.get_vocab_size()} tokens: {spent:.0f} s", wrong, tally)


if __name__ == "__main__":
    main()
