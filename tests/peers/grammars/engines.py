"""xgrammar and outlines-core take the exported grammars: each accepts the examples in canonical form, token by token, and
refuses what is nearly right.

Reads what `cargo run -p motet-tests --bin canonical` writes, from standard input. `requirements.txt` has the packages; torch
and transformers, which xgrammar imports and does not need here, are stubs.
"""

import json
import sys
import time
from importlib.metadata import version
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "stubs"))

import xgrammar  # noqa: E402
from outlines_core import Guide, Index, Vocabulary  # noqa: E402
from outlines_core.json_schema import build_regex_from_schema  # noqa: E402

END = 256
# Words of more than one byte, so that tokens end where no word of the grammar does.
WORDS = [b'{"', b'":"', b'","', b'":', b',"', b'"}', b'":[{"', b"steps", b"do", b"to", b"ing", b"user", b" {", b"go(", b") "]
TOKENS = [bytes([byte]) for byte in range(256)] + [b"<end>"] + WORDS


def tokens(line):
    """The longest tokens first."""
    data, found = line.encode(), []
    while data:
        word = max((word for word in WORDS if data.startswith(word)), key=len, default=data[:1])
        found.append(TOKENS.index(word))
        data = data[len(word) :]
    return found


def xgrammar_takes(compiled, line):
    matcher = xgrammar.GrammarMatcher(compiled, override_stop_tokens=[END])
    for at, token in enumerate(tokens(line)):
        if not matcher.accept_token(token):
            return False, at
    return matcher.accept_token(END), None


def leaves(value):
    """The steps without steps of a policy."""
    if isinstance(value, list):
        for item in value:
            yield from leaves(item)
    elif isinstance(value, dict):
        if "do" in value:
            yield value
        for item in value.values():
            yield from leaves(item)


class Outlines:
    """outlines-core turns a schema into one regular expression, with every reference and repetition written out: that of a
    policy is too large. It is held to the definition of each call by itself."""

    def __init__(self, schema):
        schema = json.loads(schema)
        self.defs = schema["$defs"]
        self.vocabulary = Vocabulary(END, {chr(byte): [byte] for byte in range(32, 127)})
        self.indices = {}

    def takes(self, name, line):
        if name not in self.indices:
            schema = json.dumps({**self.defs[name], "$defs": self.defs})
            regex = build_regex_from_schema(schema, whitespace_pattern="")
            self.indices[name] = Index(regex, self.vocabulary)
        guide = Guide(self.indices[name])
        for byte in line.encode():
            if byte not in guide.get_tokens():
                return False
            guide.advance(byte)
        return guide.is_finished() or END in guide.get_tokens()

    def run(self, world, wrong):
        accepted = refused = 0
        for policy in world["policies"]:
            for step in leaves(json.loads(policy["json"])):
                line = json.dumps(step, separators=(",", ":"))
                name = "do_" + step["do"]
                misses = [line[:-1] + ',"_":1}', line.replace('"do":"', '"do":"no_', 1), line[:-1]]
                if self.takes(name, line):
                    accepted += 1
                else:
                    wrong.append(f"outlines-core: {line} is refused")
                for miss in misses:
                    if self.takes(name, miss):
                        wrong.append(f"outlines-core: {miss} is taken")
                    refused += 1
        return accepted, refused


def main():
    info = xgrammar.TokenizerInfo(TOKENS, xgrammar.VocabType.RAW, vocab_size=len(TOKENS), stop_token_ids=[END])
    wrong, accepted, refused, steps, compile_ms = [], 0, 0, (0, 0), []
    for world in json.load(sys.stdin):
        name = f"{world['robot']} in {world['scene']}"
        grammars = world["grammars"]
        compiler = xgrammar.GrammarCompiler(info, cache_enabled=False, max_threads=1)
        start = time.perf_counter()
        schema = compiler.compile_json_schema(grammars["schema"], any_whitespace=False, separators=(",", ":"))
        compile_ms.append(1000 * (time.perf_counter() - start))
        engines = {
            "xgrammar, JSON Schema": (schema, "json"),
            "xgrammar, GBNF": (compiler.compile_grammar(grammars["json_gbnf"]), "json"),
            "xgrammar, GBNF of text": (compiler.compile_grammar(grammars["text_gbnf"]), "text"),
        }
        for engine, (compiled, form) in engines.items():
            for policy in world["policies"]:
                taken, at = xgrammar_takes(compiled, policy[form])
                accepted += taken
                if not taken:
                    wrong.append(f"{engine}: {name}: {policy['name']} is refused at token {at}")
            for miss in world["misses"] if form == "json" else []:
                taken, _ = xgrammar_takes(compiled, miss["line"])
                refused += not taken
                if taken:
                    wrong.append(f"{engine}: {name}: {miss['what']} is taken")
        counts = Outlines(grammars["schema"]).run(world, wrong)
        steps = [sum(pair) for pair in zip(steps, counts)]
    print(f"xgrammar {version('xgrammar')}: accepted {accepted} lines, refused {refused}")
    print(f"outlines-core {version('outlines_core')}: accepted {steps[0]} steps, refused {steps[1]}")
    print(f"xgrammar compiles a schema in {min(compile_ms):.0f} to {max(compile_ms):.0f} ms")
    for line in wrong:
        print("wrong:", line)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
