"""A custom logit processor for SGLang, started with `--enable-custom-logit-processor`.

A request sends the processor and its arguments:

    {"text": prompt, "custom_logit_processor": MotetLogitProcessor.to_str(),
     "sampling_params": {"custom_params": {"motet": {"robot": "hsr", "scene": "kitchen"}}}}

The package has to be installed where SGLang runs.
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

from .masks import follow, masked, row_of
from .request import KEY, decoder_for, read_request
from .vocabularies import Vocabulary, vocabulary

if TYPE_CHECKING:
    from .decoder import Decoder

    Base = object
else:
    try:
        from sglang.srt.sampling.custom_logit_processor import CustomLogitProcessor as Base
    except ImportError:
        Base = object

__all__ = ["MotetLogitProcessor"]

#: Vocabularies by the identity of their tokenizers, which the server keeps.
_VOCABULARIES: dict[int, tuple[Any, Vocabulary]] = {}


class MotetLogitProcessor(Base):
    """Constrains the rows of a batch whose requests ask for a policy."""

    def __call__(self, logits: Any, custom_param_list: Sequence[dict[str, Any] | None] | None = None) -> Any:
        """The logits, of shape (rows, tokens), with -inf for tokens that may not follow.

        SGLang gives the parameters of each row, with the request under `__req__`: its `output_ids` are the tokens so far. A
        request with wrong arguments may only end at once, which the log explains: an exception would stop the whole server.
        """
        width = int(logits.shape[-1])
        for index, params in enumerate(custom_param_list or ()):
            if params is None or params.get("__req__") is None or KEY not in params:
                continue
            try:
                allowed = row_of(_decoder(params), width)
            except ValueError as error:
                logging.getLogger(__name__).error("the request is ended: %s", error)
                allowed = numpy.arange(width) == _tokens(params["__req__"].tokenizer).end
            logits[index] = masked(logits[index], allowed)
        return logits


def _decoder(params: dict[str, Any]) -> Decoder:
    """The decoder of a request after its output. It is kept beside the parameters. Raises `ValueError` if they are wrong."""
    request = params["__req__"]
    kept: Decoder | None = params.get("__motet__")
    if kept is None:
        asked = read_request({KEY: params[KEY]})
        if asked is None:
            raise ValueError(f"`{KEY}` is null")
        kept = decoder_for(asked, _tokens(request.tokenizer))
    output = [int(token) for token in request.output_ids]
    params["__motet__"] = decoder = kept if kept.tokens == output else follow([kept], output)
    return decoder


def _tokens(tokenizer: Any) -> Vocabulary:
    known = _VOCABULARIES.get(id(tokenizer))
    if known is None or known[0] is not tokenizer:
        known = _VOCABULARIES[id(tokenizer)] = (tokenizer, vocabulary(tokenizer))
    return known[1]
