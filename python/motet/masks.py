"""Decoders that follow rows of tokens, and their masks over logits of torch or numpy."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

if TYPE_CHECKING:
    import numpy.typing

    from .decoder import Decoder

__all__ = ["follow", "masked", "row_of"]


def follow(decoders: Sequence[Decoder], tokens: Sequence[int]) -> Decoder:
    """A decoder that has taken these tokens, made from the one with most of them. Raises `ValueError` if one may not follow."""
    nearest = max(decoders, key=lambda decoder: _common(decoder.tokens, tokens))
    common = _common(nearest.tokens, tokens)
    decoder = nearest.clone()
    decoder.rollback(len(decoder.tokens) - common)
    for token in tokens[common:]:
        if decoder.is_over:
            break
        if not decoder.accept(token):
            raise ValueError(f"token {token} does not follow {decoder.text!r}")
    return decoder


def row_of(decoder: Decoder, width: int) -> numpy.typing.NDArray[numpy.bool_]:
    """The tokens that may follow, of shape (width,). After the end all may: the padding of a row is not ours to choose."""
    if decoder.is_over:
        return numpy.ones(width, dtype=bool)
    # A model may have more logits than its tokenizer has tokens; those are never allowed.
    allowed = numpy.zeros(width, dtype=bool)
    known = decoder.allowed()[:width]
    allowed[: len(known)] = known
    return allowed


def masked(scores: Any, allowed: numpy.typing.NDArray[numpy.bool_]) -> Any:
    """The scores, with -inf where the mask of the same shape is False. Tensors of torch stay on their device."""
    if hasattr(scores, "masked_fill"):
        import torch

        return scores.masked_fill(~torch.from_numpy(allowed).to(scores.device), -torch.inf)
    return numpy.where(allowed, scores, -numpy.inf)


def _common(one: Sequence[int], other: Sequence[int]) -> int:
    """The length of the common beginning of two lists of tokens."""
    pairs = enumerate(zip(one, other))
    return next((at for at, (left, right) in pairs if left != right), min(len(one), len(other)))
