"""
The native part of `motet`.
"""

from _typeshed import SupportsGetItem
from os import PathLike
from typing import Any, Final, SupportsFloat, SupportsIndex, final

__all__ = ["__version__", "Decoder", "Environment", "Findings", "Graph", "Project", "Run", "Vocabulary", "command", "explain", "feasible", "harmless_steps", "replay"]

__version__: Final[str]

@final
class Decoder:
    """
    Follows one policy token by token.
    """
    def accept(self, /, token: SupportsIndex) -> bool:
        """
        Takes a token if it may follow.
        """
    def clone(self, /) -> Decoder:
        """
        Another decoder in the same state.
        """
    def forced(self, /) -> str:
        """
        The text that must come next; empty if there is a choice.
        """
    @property
    def is_accepting(self, /) -> bool:
        """
        Returns `true` if the text so far is a whole policy.
        """
    @property
    def is_wide(self, /) -> bool:
        """
        Returns `true` if the last mask may have tokens that cannot follow.
        """
    def mask(self, /, effort: SupportsIndex | None = None) -> bytes:
        """
        The mask, one bit per token, the lowest first, in 32-bit words of the machine's order.
        """
    def rollback(self, /, tokens: SupportsIndex = 1) -> None:
        """
        Takes back the last tokens.
        """
    @property
    def text(self, /) -> str:
        """
        The text so far.
        """
    def why_not(self, /, text: str) -> str:
        """
        The errors of the checker for a text that may not follow: JSON objects, one a line.
        """

@final
class Environment:
    """
    A robot, a scene and facts, prepared.
    """
    def __new__(cls, /, *, robot: str | None = None, declarations: str | None = None, scene: str | None = None, state: str | None = None, domain: str | None = None, modifiers: bool = False, text: bool = False) -> Environment:
        """
        Takes names of built-in robots and scenes, or texts.
        """
    def check(self, /, policy: str) -> str:
        """
        The diagnostics of a policy in either syntax: JSON objects, one a line.
        """
    def decoder(self, /, vocabulary: Vocabulary, budget: SupportsIndex) -> Decoder:
        """
        Creates a decoder for a policy of at most `budget` bytes.
        """

@final
class Findings:
    """
    Diagnostics of the inputs and of one document, in this order.
    """
    def human(self, /, width: SupportsIndex, color: bool) -> str:
        """
        Text for people with the source around each span, in up to `width` columns.
        """
    def json(self, /) -> str:
        """
        JSON objects, one a line, as `motet check --format json` prints them.
        """
    def llm(self, /) -> str:
        """
        Short sentences for the next prompt of a language model, the most useful first.
        """

@final
class Graph:
    """
    A policy that has passed the check, with its execution graph.
    """
    def dot(self, /) -> str:
        """
        The graph for Graphviz.
        """
    def drive(self, /, *, serve: Any, say: Any, record: str | PathLike[str] | None) -> Run:
        """
        Runs the policy on a driver. `serve` gets the number of a socket and starts to serve it on a thread of
        its own; `say` gets what the driver says to people.
        """
    def json(self, /) -> str:
        """
        The graph in its versioned JSON encoding.
        """
    def mermaid(self, /) -> str:
        """
        The graph as a Mermaid flowchart.
        """
    @property
    def policy(self, /) -> str:
        """
        Name of the policy.
        """
    def policy_as(self, /, syntax: str) -> str:
        """
        The policy as text or as JSON.
        """
    def tree(self, /) -> str:
        """
        The graph as an indented tree with guards, effects and durations.
        """

@final
class Project:
    """
    A robot in a scene, opened from names, paths and JSON.
    """
    def __new__(cls, /, *, robot: str | None, scene: str | None, state: str | PathLike[str] | None, domains: SupportsGetItem[int, str | PathLike[str]], max_duration: SupportsFloat | SupportsIndex | None, effort: SupportsIndex | None, base_m: SupportsFloat | SupportsIndex | None, arm_m: SupportsFloat | SupportsIndex | None) -> Project:
        """
        Takes names, paths or JSON. `effort` is the factor of the search for motions; without one every motion
        is left to the run.
        """
    def check(self, /, name: str, document: bytes | None) -> Findings:
        """
        Findings of a check of a document.
        """
    def check_driver(self, /, name: str, document: bytes | None, policy: str | None, *, serve: Any, patience: SupportsFloat | SupportsIndex | None) -> tuple[list[tuple[str, list[tuple[str, str]], list[str]]] | None, Findings]:
        """
        Leads drivers through the scenes of the conformance suite with the first call of a policy, or of one
        that says something. `serve` gets the number of a socket and serves a fresh driver on it. Gives the
        scenes; none where the check refuses the policy.
        """
    def compile(self, /, name: str, document: bytes | None, policy: str | None) -> tuple[Graph | None, Findings]:
        """
        Compiled policy; `None` if the check refuses it. The findings are those on the document and its
        inputs.
        """
    def fix(self, /, name: str, document: bytes | None, unsafe_fixes: bool) -> tuple[str | None, list[tuple[str, str, bool]], Findings]:
        """
        Document after its fixes, the fixes as code, title and applicability, and the findings on what is
        left. A reply with prose around its policy stays as it is, and so does what is not text.
        """
    def fmt(self, /, name: str, document: bytes | None, to: str | None) -> tuple[str | None, Findings]:
        """
        Document in the canonical layout, or in another syntax; `None` with errors of syntax. The findings are
        those of syntax.
        """
    def plan(self, /, request: str | None, goals: SupportsGetItem[int, str]) -> tuple[str, list[str], Graph, Findings]:
        """
        Policy for a request in English, or for conditions, as its text, the planner's notes and the compiled
        graph.
        """
    def simulate(self, /, name: str, document: bytes | None, policy: str | None, *, seed: SupportsIndex, faults: str | PathLike[str] | None, answers: str | PathLike[str] | None, profile: str, world: str | None, record: str | PathLike[str] | None) -> tuple[tuple[Run, Graph] | None, Findings]:
        """
        Checks a policy and runs it in the simulator, as fast as possible. `faults` and `answers` are JSON or
        paths, `world` is a scene as in a project.
        """

@final
class Run:
    """
    A run that is over.
    """
    def events(self, /) -> str:
        """
        Events as `motet run --format json` prints them, one object a line.
        """
    def replay(self, /, at: SupportsFloat | SupportsIndex | None, entry: SupportsIndex | None) -> tuple[str, str, str]:
        """
        Replay to a time in s, to the entry with a number, or to the end: the verdict and the state for
        people, and a JSON object.
        """

@final
class Vocabulary:
    """
    The tokens of a language model.
    """
    def __len__(self, /) -> int: ...
    @property
    def end(self, /) -> int:
        """
        The token that ends a sequence.
        """
    @staticmethod
    def from_file(file: bytes, end: SupportsIndex | str | None = None) -> Vocabulary:
        """
        Reads tokenizer.json, a list in JSON or lines in base64. `end` is the name or the number of the
        token that ends a sequence; the default is the token with a well-known name.
        """
    @staticmethod
    def from_tokens(tokens: SupportsGetItem[int, SupportsGetItem[int, SupportsIndex]], end: SupportsIndex) -> Vocabulary:
        """
        Tokens as bytes in the order of their numbers; one without bytes is special.
        """
    @staticmethod
    def of_encoding(name: str) -> Vocabulary:
        """
        The vocabulary `cl100k` or `o200k`.
        """
    def token(self, /, token: SupportsIndex) -> bytes:
        """
        The bytes of a token.
        """
    def tokenize(self, /, text: bytes) -> list[int]:
        """
        The tokens of a text, the longest first at each place.
        """

def command(words: SupportsGetItem[int, str | PathLike[str]]) -> int:
    """
    Runs a command line and returns its exit status. `words` begins with the path of the script.
    """

def explain(code: str) -> str | None:
    """
    The page of a diagnostic code in Markdown; `None` if there is no such code.
    """

def feasible(robot: str, scene: str, motions: SupportsGetItem[int, str] | None, *, state: str | PathLike[str] | None, effort: SupportsIndex, base_m: SupportsFloat | SupportsIndex | None, arm_m: SupportsFloat | SupportsIndex | None) -> tuple[list[tuple[str, str]], str, Findings]:
    """
    The verdicts on motions, or on all motions of a scene, as pairs of text and JSON; a drawing as SVG; and
    the findings on the inputs.
    """

def harmless_steps() -> str:
    """
    The steps of a policy whose call harms nothing and nobody.
    """

def replay(folder: str | PathLike[str], at: SupportsFloat | SupportsIndex | None, entry: SupportsIndex | None) -> tuple[str, str, str]:
    """
    Replay of the journal in a folder: the verdict and the state for people, and a JSON object.
    """
