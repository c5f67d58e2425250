//! The canonical subset: the part of the language that a constrained model writes, with one spelling for
//! each policy. Nothing is left open that decides nothing: no white space, no order of keys, no optional
//! key.
//!
//! Both syntaxes have the same tree; `docs/decoding.md` shows them side by side. Outside of the subset are
//! parameters of the policy, calculations, comparisons of two measures, conditions that are names or
//! literals, texts outside printable ASCII or with `"` or `\`, and whatever exceeds the bounds below.

mod number;

pub(crate) use number::{Decimal, Digits, NumberRange};

use motet_syntax::Syntax;

/// The most characters of a name that a policy gives: its own, of a binding, of a sequence.
pub const MAX_NAME_CHARS: usize = 32;
/// The most characters of a text.
pub const MAX_TEXT_CHARS: usize = 200;
/// The most steps of one block.
pub const MAX_STEPS: usize = 64;
/// The most branches of a `parallel`, conditions of a `monitor`, handlers of a `try`, kinds of failure of a
/// handler.
pub const MAX_MEMBERS: usize = 4;
/// The most values of a list that is written out.
pub const MAX_ITEMS: usize = 8;
/// The greatest nesting depth of `not`, `all` and `any`.
pub const MAX_CONDITION_DEPTH: usize = 2;
/// The greatest count of a loop or of a reaction; the least is 1.
pub const MAX_COUNT: u32 = 99;
/// The most retries of a step.
pub const MAX_RETRIES: u32 = 9;
/// The default nesting depth of blocks below the policy's own.
pub const DEFAULT_DEPTH: usize = 4;

/// The choice of a canonical subset: syntax, modifiers and nesting depth.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Subset {
    /// The syntax: JSON or text.
    pub syntax: Syntax,
    /// Manners, deadlines and retries.
    pub modifiers: Modifiers,
    /// The nesting depth of blocks below the policy's own; with 0 no step has steps.
    pub depth: usize,
}

/// The treatment of modifiers: the manner of a step that moves, `within` of a step, of a `wait` and of a
/// `pause`, and `retry`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Modifiers {
    /// Modifiers are left to their defaults and cannot be written.
    #[default]
    Default,
    /// Modifiers can be written; in JSON their keys are always there, and `null` is the default.
    Written,
}

impl Default for Subset {
    fn default() -> Self {
        Self { syntax: Syntax::Json, modifiers: Modifiers::Default, depth: DEFAULT_DEPTH }
    }
}

/// The character may stand in a text: printable ASCII that JSON does not escape.
#[must_use]
pub fn is_text_char(character: char) -> bool {
    matches!(character, ' '..='~') && !matches!(character, '"' | '\\')
}

/// The character begins or ends a value in a text; two of them are one brace.
#[must_use]
pub(crate) fn is_brace(byte: u8) -> bool {
    matches!(byte, b'{' | b'}')
}

/// The text is in the subset, with each of its braces written twice: short enough, and without a character
/// that needs an escape. An empty text, and one that begins with `$`, which in JSON is a binding, is not.
#[must_use]
pub fn is_text(text: &str) -> bool {
    (1..=MAX_TEXT_CHARS).contains(&text.len()) && text.chars().all(is_text_char) && !text.starts_with('$')
}

/// A policy may give the name: a letter or `_`, then letters, digits or `_`. It must also not be the name
/// of an entity, nor in the text syntax a word of the language or a case, which it would hide.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let mut bytes = name.bytes();
    name.len() <= MAX_NAME_CHARS
        && bytes.next().is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}
