//! Source of decisions made from bytes. After the last byte every decision is the first alternative.

use smol_str::SmolStr;

use crate::ast::Name;
use crate::source::Span;

pub(super) struct ByteSource<'b> {
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
    pub(super) fn new(bytes: &'b [u8]) -> Self {
        Self { bytes: bytes.iter() }
    }

    fn byte(&mut self) -> u8 {
        self.bytes.next().copied().unwrap_or(0)
    }

    /// A number below `count`, which is at most 256.
    pub(super) fn below(&mut self, count: usize) -> usize {
        usize::from(self.byte()) % count.max(1)
    }

    pub(super) fn is_heads(&mut self) -> bool {
        self.byte() % 2 == 1
    }

    /// One of a list that is not empty.
    pub(super) fn of<T: Copy>(&mut self, list: &[T], otherwise: T) -> T {
        list.get(self.below(list.len())).copied().unwrap_or(otherwise)
    }

    /// A name that nothing binds.
    pub(super) fn name_text(&mut self) -> SmolStr {
        self.of(NAMES, "a").into()
    }

    pub(super) fn name(&mut self) -> Name {
        named(self.of(NAMES, "a"))
    }

    /// A name for a primitive, a fluent, a parameter.
    pub(super) fn word(&mut self) -> Name {
        named(self.of(WORDS, "pick"))
    }

    /// A name for a binding.
    pub(super) fn bound(&mut self) -> Name {
        named(self.of(BOUND, "b0"))
    }

    /// Any finite number, often a simple one.
    pub(super) fn number(&mut self) -> f64 {
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
    pub(super) fn text(&mut self) -> SmolStr {
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
