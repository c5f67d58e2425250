"""What a language model may write next in a policy for a robot.

    decoder = motet.Decoder(robot="hsr", scene="kitchen", tokenizer="tokenizer.json")
    while not decoder.is_over:
        logits[~decoder.allowed()] = -math.inf
        decoder.accept(int(logits.argmax()))
    print(decoder.text)

From any weights at all, what is written is a policy that `World.check` has no error against. `motet.transformers` has a logits
processor for Hugging Face transformers.
"""

from ._motet import __version__
from .decoder import Decoder
from .vocabulary import Vocabulary, vocabulary
from .world import World

__all__ = ["Decoder", "Vocabulary", "World", "__version__", "vocabulary"]
