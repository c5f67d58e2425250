"""Requests to a model server that ask for a policy: their arguments, and a decoder for each."""

from __future__ import annotations

import json
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from .decoder import Decoder
from .environment import Environment
from .vocabularies import Vocabulary

__all__ = ["KEY", "decoder_for", "read_request"]

#: Name of the argument of a request.
KEY = "motet"
#: Arguments of an environment, and the greatest number of bytes of a policy.
ARGUMENTS = {"robot", "scene", "state", "modifiers", "syntax", "budget"}
BUDGET = 4000


def read_request(params: Mapping[str, Any] | None) -> str | None:
    """The arguments under `motet` in one spelling; None for a request that asks for no policy.

    They are a mapping or its JSON, such as `{"robot": "hsr", "scene": "kitchen", "budget": 999}`; a scene may be a mapping too.
    Names only: no file of the server is read. Raises `ValueError` if they are wrong.
    """
    asked = (params or {}).get(KEY)
    if asked is None:
        return None
    if isinstance(asked, str):
        try:
            asked = json.loads(asked)
        except ValueError as error:
            raise ValueError(f"`{KEY}` is no JSON: {error}") from None
    if not isinstance(asked, Mapping):
        raise ValueError(f"`{KEY}` is an object, such as {{\"robot\": \"hsr\"}}")
    for name in asked:
        if name not in ARGUMENTS:
            raise ValueError(f"`{KEY}` has no `{name}`: {', '.join(sorted(ARGUMENTS))}")
    budget = asked.get("budget", BUDGET)
    if not (isinstance(budget, int) and 0 < budget <= 1 << 20):
        raise ValueError(f"`budget` is a number of bytes up to {1 << 20}, not {budget!r}")
    text = json.dumps(asked, sort_keys=True)
    _try(text)
    return text


@lru_cache(maxsize=64)
def _try(text: str) -> None:
    """Makes a decoder over single bytes: what fails with any vocabulary fails here. Raises `ValueError`."""
    decoder_for(text, Vocabulary.from_tokens([bytes([byte]) for byte in range(256)] + [b""], 256))


@lru_cache(maxsize=64)
def _environment(text: str) -> Environment:
    asked = json.loads(text)
    asked.pop("budget", None)
    if not isinstance(asked.get("robot", ""), str):
        raise ValueError("`robot` is the name of a built-in robot")
    for name in ("robot", "scene", "state"):
        given = asked.get(name)
        # A path would be one of the server, and a request comes from anybody.
        if isinstance(given, str) and not given.replace("_", "").isalnum():
            raise ValueError(f"`{name}` is a built-in name or an object, not `{given[:80]}`")
    try:
        return Environment(**asked)
    except TypeError as error:
        raise ValueError(f"`{KEY}` has an argument of another type: {error}") from None


def decoder_for(text: str, vocabulary: Vocabulary) -> Decoder:
    """A decoder for the arguments that `read_request` has read."""
    budget = json.loads(text).get("budget", BUDGET)
    return Decoder(tokenizer=vocabulary, environment=_environment(text), budget=budget)
