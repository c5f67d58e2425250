"""Vocabularies from encodings, files and tokenizers of other libraries."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

from ._motet import Vocabulary

__all__ = ["Vocabulary", "vocabulary"]

ENCODINGS = ("cl100k", "o200k")


def vocabulary(tokenizer: Any, end: int | str | None = None) -> Vocabulary:
    """The vocabulary of a tokenizer: `cl100k` or `o200k`, the path of a tokenizer.json, of a list in JSON or of lines in
    base64, a tokenizer of `transformers` or of `tokenizers`, or a `Vocabulary` as it is.

    `end` is the name or the number of the token that ends a sequence. The default is the end token of the tokenizer; of a file,
    the token with a well-known name. Raises `ValueError` if the tokenizer cannot be used.
    """
    if isinstance(tokenizer, Vocabulary):
        return tokenizer
    if isinstance(tokenizer, str) and tokenizer.removesuffix("_base") in ENCODINGS:
        return Vocabulary.of_encoding(tokenizer)
    if isinstance(tokenizer, (str, os.PathLike)):
        return Vocabulary.from_file(Path(tokenizer).read_bytes(), end)
    # `transformers` has the tokenizer of `tokenizers` inside.
    backend = getattr(tokenizer, "backend_tokenizer", tokenizer)
    if not hasattr(backend, "to_str"):
        raise ValueError(f"no tokenizer: {type(tokenizer).__name__}")
    if end is None:
        end = getattr(tokenizer, "eos_token_id", None)
    return Vocabulary.from_file(backend.to_str().encode(), end)
