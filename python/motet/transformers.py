"""A logits processor for Hugging Face transformers.

    processor = MotetLogitsProcessor(motet.Decoder(robot="hsr", scene="kitchen", tokenizer=tokenizer, budget=999))
    model.generate(**inputs, max_new_tokens=1000, logits_processor=[processor])

Neither transformers nor torch is imported here: scores may be tensors of torch or arrays of numpy.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy

from .masks import follow, masked, row_of

if TYPE_CHECKING:
    from .decoder import Decoder

__all__ = ["MotetLogitsProcessor"]


class MotetLogitsProcessor:
    """Constrains the text after the prompt to a policy that checks: one policy per row, also in batches and beams.

    Make one for each call of `generate`: its first scores tell the length of the prompt. The decoder is not changed.
    """

    def __init__(self, decoder: Decoder) -> None:
        self._start = decoder
        self._decoders: list[Decoder] = []
        self._prompt: int | None = None

    def __call__(self, input_ids: Any, scores: Any) -> Any:
        """The scores, of shape (rows, logits), with -inf for all tokens that may not follow `input_ids`, (rows, tokens)."""
        if self._prompt is None:
            self._prompt = int(input_ids.shape[1])
            self._decoders = [self._start.clone() for _ in range(input_ids.shape[0])]
        written = [[int(token) for token in row[self._prompt :]] for row in input_ids]
        # Beams may have changed places.
        self._decoders = [follow(self._decoders, tokens) for tokens in written]
        rows = [row_of(decoder, int(scores.shape[-1])) for decoder in self._decoders]
        return masked(scores, numpy.stack(rows))
