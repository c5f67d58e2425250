"""Decoders: token masks for one policy that is being written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from .environment import Environment, _objects
from .vocabularies import Vocabulary
from .vocabularies import vocabulary as _vocabulary

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

    import numpy
    import numpy.typing

__all__ = ["Decoder"]


class Decoder:
    """Follows a policy of at most `budget` bytes token by token, and computes token masks.

    A token has at least one byte: with a budget below the number of tokens that a model may write, every policy comes to its
    end in time. `environment` is an `Environment`; without it one is opened from `robot`, `scene`, `state`, `domain`,
    `modifiers` and `syntax`. `tokenizer` and `end` are the arguments of `vocabulary`. Raises `ValueError` if an argument is
    wrong, or no policy has at most `budget` bytes.
    """

    def __init__(
        self,
        *,
        tokenizer: Any,
        environment: Environment | None = None,
        end: int | str | None = None,
        budget: int = 4000,
        robot: str | os.PathLike[str] | None = None,
        scene: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        state: str | os.PathLike[str] | Mapping[str, Any] | None = None,
        domain: str | os.PathLike[str] | None = None,
        modifiers: bool = False,
        syntax: Literal["json", "text"] = "json",
    ) -> None:
        if environment is None:
            environment = Environment(robot, scene, state, domain, modifiers, syntax)
        elif (robot, scene, state, domain, modifiers, syntax) != (None, None, None, None, False, "json"):
            raise TypeError("give either an environment or its arguments")
        self.environment: Environment = environment
        self.vocabulary: Vocabulary = _vocabulary(tokenizer, end)
        self._decoder = self.environment._decoder(self.vocabulary, budget)
        self._tokens: list[int] = []

    def mask(self, effort: int | None = None) -> memoryview:
        """The mask of the tokens that may follow, one bit per token, the lowest first: a `memoryview` of 32-bit words, which
        `numpy.asarray` takes as it is. Empty after the end.

        `effort` limits what the checker may look at (0 or more; 20,000 take about half a millisecond). Where that is not enough,
        `is_wide` is true, and the mask also has tokens that only names and types allow. Where `accept` refuses the chosen
        one, take the mask again, which lacks it, and choose another."""
        return memoryview(self._decoder.mask(effort)).cast("I")

    @property
    def is_wide(self) -> bool:
        """True if the last mask may have tokens that cannot follow."""
        return self._decoder.is_wide

    def allowed(self, effort: int | None = None) -> numpy.typing.NDArray[numpy.bool_]:
        """The mask as an array of numpy, one `bool` per token: shape (number of tokens,). `effort` is that of `mask`."""
        import numpy

        words = numpy.asarray(self.mask(effort)).astype("<u4", copy=False)
        bits = numpy.unpackbits(words.view("u1"), bitorder="little")
        return bits[: len(self.vocabulary)].astype(bool)

    def accept(self, token: int) -> bool:
        """Takes a token if it may follow; otherwise returns `False`, and nothing changes."""
        taken = 0 <= token < len(self.vocabulary) and self._decoder.accept(token)
        if taken:
            self._tokens.append(token)
        return taken

    def rollback(self, tokens: int = 1) -> None:
        """Takes back the last tokens, or all if there are fewer."""
        self._decoder.rollback(tokens)
        del self._tokens[max(0, len(self._tokens) - tokens) :]

    def forced(self) -> str:
        """The text that must come next whatever the model means; empty if there is a choice."""
        return self._decoder.forced()

    def why_not(self, text: str) -> list[dict[str, Any]]:
        """The errors of the checker for a text that may not follow: a list of dictionaries; empty if the text may follow, or if
        only its spelling is refused."""
        return _objects(self._decoder.why_not(text))

    def check(self, policy: str) -> list[dict[str, Any]]:
        """The diagnostics of a whole policy."""
        return self.environment.check(policy)

    @property
    def text(self) -> str:
        """The text so far."""
        return self._decoder.text

    @property
    def tokens(self) -> list[int]:
        """The tokens so far."""
        return list(self._tokens)

    @property
    def is_accepting(self) -> bool:
        """True if the text so far is a whole policy: then, and only then, the end of the sequence may follow."""
        return self._decoder.is_accepting

    @property
    def is_over(self) -> bool:
        """True if the sequence has ended."""
        return bool(self._tokens) and self._tokens[-1] == self.vocabulary.end

    def clone(self) -> Decoder:
        """Another decoder in the same state."""
        other = object.__new__(Decoder)
        other.environment, other.vocabulary = self.environment, self.vocabulary
        other._decoder, other._tokens = self._decoder.clone(), list(self._tokens)
        return other

    __copy__ = clone
