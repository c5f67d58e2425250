"""A custom logit processor for SGLang, started with `--enable-custom-logit-processor`.

A request sends the processor and its arguments:

    {"text": prompt, "custom_logit_processor": MotetLogitProcessor.to_str(),
     "sampling_params": {"custom_params": {"motet": {"robot": "hsr", "scene": "kitchen"}}}}

The package has to be installed where SGLang runs.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .masks import follow, masked, row_of
from .request import decoder_for, read_request
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

        SGLang gives the parameters of each row, with the request under `__req__`: its `output_ids` are the tokens so far.
        Raises `ValueError` if the arguments of a request are wrong.
        """
        for index, params in enumerate(custom_param_list or ()):
            if params is not None and (decoder := _decoder(params)) is not None:
                logits[index] = masked(logits[index], row_of(decoder, int(logits.shape[-1])))
        return logits


def _decoder(params: dict[str, Any]) -> Decoder | None:
    """The decoder of a request after its output; None if it asks for no policy. It is kept beside the parameters."""
    request = params.get("__req__")
    kept: Decoder | None = params.get("__motet__")
    if kept is None:
        asked = read_request(_own(params))
        if asked is None or request is None:
            return None
        kept = decoder_for(asked, _tokens(request.tokenizer))
    output = [int(token) for token in request.output_ids]  # type: ignore[union-attr]
    params["__motet__"] = decoder = kept if kept.tokens == output else follow([kept], output)
    return decoder


def _own(params: Mapping[str, Any]) -> Mapping[str, Any]:
    return {name: value for name, value in params.items() if not name.startswith("__")}


def _tokens(tokenizer: Any) -> Vocabulary:
    known = _VOCABULARIES.get(id(tokenizer))
    if known is None or known[0] is not tokenizer:
        known = _VOCABULARIES[id(tokenizer)] = (tokenizer, vocabulary(tokenizer))
    return known[1]
