"""Constrained decoding of policies for robots: masks of the tokens that a language model may write next.

    decoder = motet.Decoder(robot="hsr", scene="kitchen", tokenizer="tokenizer.json")
    while not decoder.is_over:
        logits[~decoder.allowed()] = -math.inf
        decoder.accept(int(logits.argmax()))
    print(decoder.text)

Whatever the weights, the result is a policy against which `Environment.check` has no error. `motet.transformers` has a logits processor
for Hugging Face transformers.
"""

from ._motet import __version__
from .decoder import Decoder
from .environment import Environment
from .vocabulary import Vocabulary, vocabulary

__all__ = ["Decoder", "Environment", "Vocabulary", "__version__", "vocabulary"]
