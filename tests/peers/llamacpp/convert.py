"""llama.cpp's own converter takes the exported JSON Schemas, and the grammars that it makes accept the examples.

    cargo run -q -p motet-tests --bin surface | target/peers/bin/python tests/peers/llamacpp/convert.py CONVERTER

CONVERTER is `examples/json_schema_to_grammar.py` of llama.cpp, or `llama_cpp/llama_grammar.py` of llama-cpp-python. The
grammars are run by xgrammar, which reads the same notation; the packages are those of `tests/peers/grammars`.
"""

import importlib.util
import json
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "grammars"))

from engines import END, TOKENS, xgrammar, xgrammar_takes  # noqa: E402


def converter(path):
    """The function of a converter from a schema to GBNF."""
    spec = importlib.util.spec_from_file_location("converter", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    order = {}
    if hasattr(module, "json_schema_to_gbnf"):
        return lambda schema: module.json_schema_to_gbnf(json.dumps(schema))

    def convert(schema):
        made = module.SchemaConverter(prop_order=order, allow_fetch=False, dotall=False, raw_pattern=False)
        made.visit(made.resolve_refs(schema, "schema"), "")
        return made.format_grammar()

    return convert


def main():
    convert = converter(sys.argv[1])
    info = xgrammar.TokenizerInfo(TOKENS, xgrammar.VocabType.RAW, vocab_size=len(TOKENS), stop_token_ids=[END])
    accepted = refused = 0
    wrong = []
    for world in json.load(sys.stdin):
        name = f"{world['robot']} in {world['scene']}"
        start = time.perf_counter()
        grammar = convert(json.loads(world["grammars"]["schema"]))
        taken_ms = 1000 * (time.perf_counter() - start)
        # xgrammar has another spelling of nothing at all.
        grammar = grammar.replace("::= |", '::= "" |')
        compiled = xgrammar.GrammarCompiler(info, cache_enabled=False).compile_grammar(grammar)
        print(f"{name}: {len(grammar)} bytes of GBNF in {taken_ms:.0f} ms")
        for policy in world["policies"]:
            taken, at = xgrammar_takes(compiled, policy["json"])
            accepted += taken
            if not taken:
                wrong.append(f"{name}: {policy['name']} is refused at token {at}")
        for miss in world["misses"]:
            taken, _ = xgrammar_takes(compiled, miss["line"])
            refused += not taken
            if taken:
                wrong.append(f"{name}: {miss['what']} is taken")
    print(f"accepted {accepted} lines, refused {refused}")
    for line in wrong:
        print("wrong:", line)
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main())
