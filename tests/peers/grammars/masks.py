"""What a mask of xgrammar costs on the exported grammars, over the vocabulary o200k: at each token of the examples.
Times are those of the processor, so that other work on the machine counts little.

    cargo run -q -p motet-tests --bin canonical | target/peers/bin/python tests/peers/grammars/masks.py RANKS

RANKS is the file of o200k_base's ranks, lines of base64 with their numbers.
"""

import base64
import json
import statistics
import sys
import time
from pathlib import Path

import numpy

sys.path.insert(0, str(Path(__file__).parent))

from engines import xgrammar  # noqa: E402

END = 199_999


def vocabulary(path):
    tokens = [b""] * (END + 1)
    for line in Path(path).read_bytes().splitlines():
        token, number = line.split()
        tokens[int(number)] = base64.b64decode(token)
    # What has no bytes needs some, and is never a token of a policy.
    return [token or b"<special %d>" % number for number, token in enumerate(tokens)]


def split(line, numbers, longest):
    """The tokens of a line, each time the longest that fits."""
    data, at = line.encode(), 0
    while at < len(data):
        end = next(end for end in range(min(len(data), at + longest), at, -1) if data[at:end] in numbers)
        yield numbers[data[at:end]]
        at = end


def main():
    tokens = vocabulary(sys.argv[1])
    numbers = {token: number for number, token in enumerate(tokens)}
    longest = 64
    info = xgrammar.TokenizerInfo(tokens, xgrammar.VocabType.RAW, vocab_size=len(tokens), stop_token_ids=[END])
    compiler = xgrammar.GrammarCompiler(info, cache_enabled=False, max_threads=1)
    times, compile_ms = [], []
    for world in json.load(sys.stdin):
        start = time.process_time()
        compiled = compiler.compile_json_schema(
            world["grammars"]["schema"], any_whitespace=False, separators=(",", ":")
        )
        compile_ms.append(1000 * (time.process_time() - start))
        mask = numpy.zeros((1, -(-len(tokens) // 32)), dtype=numpy.int32)
        for policy in world["policies"]:
            matcher = xgrammar.GrammarMatcher(compiled, override_stop_tokens=[END])
            for token in split(policy["json"], numbers, longest):
                start = time.process_time()
                matcher.fill_next_token_bitmask(mask)
                times.append(1e6 * (time.process_time() - start))
                if not matcher.accept_token(token):
                    print(f"{policy['name']} is refused")
                    return 1
    times.sort()
    at = lambda share: times[int((len(times) - 1) * share)]  # noqa: E731
    print(f"xgrammar compiles a schema in {min(compile_ms):.0f} to {max(compile_ms):.0f} ms")
    print(
        f"{len(times)} masks: mean {statistics.mean(times):.1f} µs, p50 {at(0.5):.1f}, p99 {at(0.99):.1f}, max {at(1.0):.1f}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
