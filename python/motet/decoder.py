"""Decoders: token masks for one policy that is being written."""

from .environment import Environment, _objects
from .vocabularies import vocabulary as _vocabulary

__all__ = ["Decoder"]


class Decoder:
    """Follows a policy of at most `budget` bytes token by token, and computes token masks.

    A token has at least one byte: with a budget below the number of tokens that a model may write, every policy comes to its
    end in time. `environment` is an `Environment`; without it one is opened from `robot`, `scene`, `state`, `domain`,
    `modifiers` and `syntax`. `tokenizer` and `end` are the arguments of `vocabulary`.
    """

    def __init__(self, *, tokenizer, environment=None, end=None, budget=4000, **of_environment):
        if environment is not None and of_environment:
            raise TypeError("give either an environment or its arguments")
        self.environment = Environment(**of_environment) if environment is None else environment
        self.vocabulary = _vocabulary(tokenizer, end)
        self._decoder = self.environment._decoder(self.vocabulary, budget)
        self._tokens = []

    def mask(self):
        """The mask of the tokens that may follow, one bit per token, the lowest first: a `memoryview` of 32-bit words, which
        `numpy.asarray` takes as it is. Empty after the end."""
        return memoryview(self._decoder.mask()).cast("I")

    def allowed(self):
        """The mask as an array of numpy, one `bool` per token."""
        import numpy

        words = numpy.asarray(self.mask()).astype("<u4", copy=False)
        bits = numpy.unpackbits(words.view("u1"), bitorder="little")
        return bits[: len(self.vocabulary)].astype(bool)

    def accept(self, token):
        """Takes a token if it may follow; otherwise returns `False`, and nothing changes."""
        taken = 0 <= token < len(self.vocabulary) and self._decoder.accept(token)
        if taken:
            self._tokens.append(token)
        return taken

    def rollback(self, tokens=1):
        """Takes back the last tokens, or all if there are fewer."""
        self._decoder.rollback(tokens)
        del self._tokens[max(0, len(self._tokens) - tokens) :]

    def forced(self):
        """The text that must come next whatever the model means; empty if there is a choice."""
        return self._decoder.forced()

    def why_not(self, text):
        """The errors of the checker for a text that may not follow: a list of dictionaries; empty if the text may follow, or if
        only its spelling is refused."""
        return _objects(self._decoder.why_not(text))

    def check(self, policy):
        """The diagnostics of a whole policy."""
        return self.environment.check(policy)

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
        """True if the text so far is a whole policy: then, and only then, the end of the sequence may follow."""
        return self._decoder.is_accepting

    @property
    def is_over(self):
        """True if the sequence has ended."""
        return bool(self._tokens) and self._tokens[-1] == self.vocabulary.end

    def clone(self):
        """Another decoder in the same state."""
        other = object.__new__(Decoder)
        other.environment, other.vocabulary = self.environment, self.vocabulary
        other._decoder, other._tokens = self._decoder.clone(), list(self._tokens)
        return other

    __copy__ = clone
