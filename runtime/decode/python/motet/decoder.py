"""Decoders: what may follow in one policy that is being written."""

from .vocabulary import vocabulary as _vocabulary
from .world import World, _objects

__all__ = ["Decoder"]


class Decoder:
    """What may follow, token by token, in a policy of at most `budget` bytes.

    A token has at least one byte: with a budget below the number of tokens that a model may write, every policy comes to its
    end in time. `world` is a `World`, or is opened with `robot`, `scene`, `state`, `domain`, `modifiers` and `surface` as it takes them.
    `tokenizer` and `end` are as `vocabulary` takes them.
    """

    def __init__(self, *, tokenizer, world=None, end=None, budget=4000, **of_world):
        if world is not None and of_world:
            raise TypeError("either a world or what to open it with")
        self.world = World(**of_world) if world is None else world
        self.vocabulary = _vocabulary(tokenizer, end)
        self._decoder = self.world._decoder(self.vocabulary, budget)
        self._tokens = []

    def mask(self):
        """Which tokens may follow, a bit a token, the lowest first: a `memoryview` of 32-bit words, which `numpy.asarray` takes
        as it is. After the end none may."""
        return memoryview(self._decoder.mask()).cast("I")

    def allowed(self):
        """The same as an array of numpy, a `bool` a token."""
        import numpy

        words = numpy.asarray(self.mask()).astype("<u4", copy=False)
        bits = numpy.unpackbits(words.view("u1"), bitorder="little")
        return bits[: len(self.vocabulary)].astype(bool)

    def accept(self, token):
        """Takes a token; `False`, and nothing has changed, where it may not follow."""
        taken = 0 <= token < len(self.vocabulary) and self._decoder.accept(token)
        if taken:
            self._tokens.append(token)
        return taken

    def rollback(self, tokens=1):
        """Takes back the last tokens; all of them where there are not so many."""
        self._decoder.rollback(tokens)
        del self._tokens[max(0, len(self._tokens) - tokens) :]

    def forced(self):
        """The text that must come next, whatever is meant; empty where there is a choice."""
        return self._decoder.forced()

    def why_not(self, text):
        """What the checker says of a text that may not follow: a list of dictionaries; empty where it may, or where only its
        spelling is refused."""
        return _objects(self._decoder.why_not(text))

    def check(self, policy):
        """What the checker says of a whole policy."""
        return self.world.check(policy)

    @property
    def text(self):
        """The text so far."""
        return self._decoder.text

    @property
    def tokens(self):
        """The tokens so far."""
        return list(self._tokens)

    @property
    def is_accepting(self):
        """Whether the text so far is a whole policy: then, and only then, the end of the sequence may follow."""
        return self._decoder.is_accepting

    @property
    def is_over(self):
        """Whether the sequence has ended."""
        return bool(self._tokens) and self._tokens[-1] == self.vocabulary.end

    def clone(self):
        """Another decoder in the same state."""
        other = object.__new__(Decoder)
        other.world, other.vocabulary = self.world, self.vocabulary
        other._decoder, other._tokens = self._decoder.clone(), list(self._tokens)
        return other

    __copy__ = clone
