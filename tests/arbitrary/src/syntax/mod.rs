//! Trees made from bytes, for property tests and fuzzing: every sequence of bytes is a tree, shorter
//! sequences are smaller trees, so what shrinks bytes shrinks trees. Every node kind comes up. The trees mean
//! nothing: names are not declared and types do not fit.

mod declaration;
mod expr;

use smol_str::SmolStr;

use motet_syntax::ast::{File, Name, Policy};
use motet_syntax::source::Span;

/// Syntax that a tree looks as if it was read from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flavor {
    /// Names are names.
    Text,
    /// Names are bindings or plain strings, arguments have names, a bare number is a duration in seconds.
    Json,
}

/// A tree as the text front end makes it: the printed text reads back as the same tree.
#[must_use]
pub fn file(bytes: &[u8]) -> File {
    TreeGenerator::new(bytes, Flavor::Text).file()
}

/// A policy as the JSON front end makes it: without parameters, every argument named, every binding in scope.
/// The printed JSON reads back as the same tree, also by way of the text syntax.
#[must_use]
pub fn json_policy(bytes: &[u8]) -> Policy {
    TreeGenerator::new(bytes, Flavor::Json).policy()
}

/// Depth of blocks and expressions in a generated tree.
const DEPTH: usize = 5;

struct TreeGenerator<'b> {
    choice: ByteSource<'b>,
    flavor: Flavor,
    /// Names bound at the current point.
    scope: Vec<SmolStr>,
}

impl<'b> TreeGenerator<'b> {
    fn new(bytes: &'b [u8], flavor: Flavor) -> Self {
        Self { choice: ByteSource::new(bytes), flavor, scope: Vec::new() }
    }

    /// Between `least` and three more of something; fewer when the bytes run out.
    fn some<T>(&mut self, least: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let count = least + self.choice.below(4);
        (0..count).map(|_| make(self)).collect()
    }

    fn maybe<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.choice.is_heads() { Some(make(self)) } else { None }
    }

    fn span(&self) -> Span {
        Span::default()
    }
}

/// Source of decisions made from bytes. After the last byte every decision is the first alternative.
struct ByteSource<'b> {
    bytes: std::slice::Iter<'b, u8>,
}

/// Names that the generator uses; the bound ones are apart, so that a plain string is never taken for a
/// binding.
const NAMES: &[&str] = &[
    "a",
    "mug_1",
    "table",
    "on",
    "at",
    "in",
    "within",
    "most",
    "world",
    "List",
    "needs",
    "policy",
    "7up",
    "not",
    "done",
    "red mug",
    "tasse à café",
    "x-1",
    "m",
    "s",
    "e5",
    "_",
    "arg1",
];
const BOUND: &[&str] = &["b0", "b1", "retry", "until", "b 4", "entity"];
const WORDS: &[&str] = &["pick", "holding", "open", "kind", "go", "if", "t 5", "at"];

impl<'b> ByteSource<'b> {
    fn new(bytes: &'b [u8]) -> Self {
        Self { bytes: bytes.iter() }
    }

    fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }

    /// A number below `count`, which is at most 256.
    fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count.max(1)
    }

    fn is_heads(&mut self) -> bool {
        self.byte() % 2 == 1
    }

    /// One of a list that is not empty.
    fn of<T: Copy>(&mut self, list: &[T], otherwise: T) -> T {
        list.get(self.below(list.len())).copied().unwrap_or(otherwise)
    }

    /// A name that nothing binds.
    fn name_text(&mut self) -> SmolStr {
        self.of(NAMES, "a").into()
    }

    fn name(&mut self) -> Name {
        named(self.of(NAMES, "a"))
    }

    /// A name for a primitive, a fluent, a parameter.
    fn word(&mut self) -> Name {
        named(self.of(WORDS, "pick"))
    }

    /// A name for a binding.
    fn bound(&mut self) -> Name {
        named(self.of(BOUND, "b0"))
    }

    /// Any finite number, often a simple one.
    fn number(&mut self) -> f64 {
        match self.below(6) {
            0 => f64::from(self.byte()),
            1 => f64::from(self.byte()) / 8.0,
            2 => -f64::from(self.byte()),
            3 => f64::from(self.byte()) * 1e-9,
            4 => -0.0,
            _ => {
                let bits = (0..8).fold(0_u64, |bits, _| (bits << 8) | u64::from(self.byte()));
                Some(f64::from_bits(bits)).filter(|value| value.is_finite()).unwrap_or(1.5e300)
            }
        }
    }

    /// A text with whatever may be hard to quote.
    fn text(&mut self) -> SmolStr {
        const PIECES: &[&str] = &[
            "red mug", "\"", "\\", "\n", "\t", "\r", "\u{0}", "é🤖", "$", "//", "`", "{", "20", " ",
            "\u{7f}", "\\n",
        ];
        let count = 1 + self.below(3);
        (0..count).map(|_| self.of(PIECES, "x")).collect::<String>().into()
    }
}

fn named(text: &str) -> Name {
    Name { text: text.into(), span: Span::default() }
}
