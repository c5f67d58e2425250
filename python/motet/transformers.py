"""A logits processor for Hugging Face transformers.

    processor = MotetLogitsProcessor(motet.Decoder(robot="hsr", scene="kitchen", tokenizer=tokenizer, budget=999))
    model.generate(**inputs, max_new_tokens=1000, logits_processor=[processor])

Neither transformers nor torch is imported here: scores may be tensors of torch or arrays of numpy.
"""

import numpy

__all__ = ["MotetLogitsProcessor"]


class MotetLogitsProcessor:
    """Constrains the text after the prompt to a policy that checks: one policy per row, also in batches and beams.

    Make one for each call of `generate`: its first scores tell the length of the prompt. The decoder is not changed.
    """

    def __init__(self, decoder):
        self._start = decoder
        self._decoders = None
        self._prompt = None

    def __call__(self, input_ids, scores):
        if self._prompt is None:
            self._prompt = input_ids.shape[1]
            self._decoders = [self._start.clone() for _ in range(input_ids.shape[0])]
        written = [[int(token) for token in row[self._prompt :]] for row in input_ids]
        self._decoders = [self._at(tokens) for tokens in written]
        # A model may have more logits than its tokenizer has tokens; those are never allowed.
        allowed = numpy.zeros(tuple(scores.shape), dtype=bool)
        for row, decoder in zip(allowed, self._decoders):
            if decoder.is_over:
                # The padding of a row that has ended is not ours to choose.
                row[:] = True
            else:
                of_row = decoder.allowed()[: len(row)]
                row[: len(of_row)] = of_row
        if hasattr(scores, "masked_fill"):
            import torch

            return scores.masked_fill(~torch.from_numpy(allowed).to(scores.device), -torch.inf)
        return numpy.where(allowed, scores, -numpy.inf)

    def _at(self, tokens):
        """A decoder that has taken these tokens, made from the one with most of them: beams may have changed places."""
        nearest = max(self._decoders, key=lambda decoder: _common(decoder.tokens, tokens))
        common = _common(nearest.tokens, tokens)
        decoder = nearest.clone()
        decoder.rollback(len(decoder.tokens) - common)
        for token in tokens[common:]:
            if decoder.is_over:
                break
            if not decoder.accept(token):
                raise ValueError(f"token {token} does not follow {decoder.text!r}")
        return decoder


def _common(one, other):
    """The length of the common beginning of two lists of tokens."""
    pairs = enumerate(zip(one, other))
    return next((at for at, (left, right) in pairs if left != right), min(len(one), len(other)))
