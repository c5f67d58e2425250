//! The model subset: what a language model writes. It is a subset of the two forms of the language with one spelling for
//! each policy, so that nothing is left open that decides nothing: no white space, no order of keys, no optional key.
//!
//! Both forms have the same tree, [`Document`]; `docs/decoding.md` has both spellings side by side. What is not in it has no
//! canonical spelling: parameters of the policy, calculations, comparisons of two measures, conditions that are names or
//! literals, texts outside printable ASCII or with `"` or `\`, and what is beyond the bounds below.

mod decimal;
mod number;
mod tree;

pub use decimal::Decimal;
pub use number::NumberRange;
pub use tree::{Call, Catch, Condition, Document, End, Reaction, Relation, Step, Subject, Value, When};

use motet_syntax::Syntax;

/// The most characters of a name that a policy gives: its own, of a binding, of a sequence.
pub const MAX_NAME_CHARS: usize = 32;
/// The most characters of a text.
pub const MAX_TEXT_CHARS: usize = 200;
/// The most steps of one block.
pub const MAX_STEPS: usize = 64;
/// The most branches of a `parallel`, conditions of a `monitor`, handlers of a `try`, kinds of failure of a handler.
pub const MAX_MEMBERS: usize = 4;
/// The most values of a list that is written out.
pub const MAX_ITEMS: usize = 8;
/// How many times `not`, `all` and `any` may stand in one another.
pub const MAX_CONDITION_DEPTH: usize = 2;
/// The greatest count of a loop or of a reaction; the least is 1.
pub const MAX_COUNT: u32 = 99;
/// The most retries of a step.
pub const MAX_RETRIES: u32 = 9;
/// How many blocks may stand in one another below the policy's own, where nothing else is asked for.
pub const DEFAULT_DEPTH: usize = 4;

/// Which model subset.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub struct Subset {
    /// JSON or text.
    pub syntax: Syntax,
    /// Whether deadlines and retries are written.
    pub modifiers: Modifiers,
    /// How many blocks may stand in one another below the policy's own: with 0 no step has steps.
    pub depth: usize,
}

/// Whether a policy says deadlines and retries: `within` of a step, of a `wait` and of a `pause`, and `retry`.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Modifiers {
    /// They are left to their defaults and have no place.
    #[default]
    Default,
    /// They have a place; in JSON their keys are always there, and `null` is the default.
    Written,
}

impl Default for Subset {
    fn default() -> Self {
        Self { syntax: Syntax::Json, modifiers: Modifiers::Default, depth: DEFAULT_DEPTH }
    }
}

/// Whether a character may stand in a text: printable ASCII without what JSON escapes.
#[must_use]
pub fn is_text_char(character: char) -> bool {
    matches!(character, ' '..='~') && !matches!(character, '"' | '\\')
}

/// Whether a text can be written: short enough, and without a character that needs an escape. One that is empty or that
/// begins with `$`, which in JSON is a binding, cannot.
#[must_use]
pub fn is_text(text: &str) -> bool {
    (1..=MAX_TEXT_CHARS).contains(&text.len()) && text.chars().all(is_text_char) && !text.starts_with('$')
}

/// Whether a name that a policy gives can be written: a letter or `_`, then letters, digits or `_`. It is also no name of
/// an entity, and in the text form no word of the language and no case, which it would hide.
#[must_use]
pub fn is_name(name: &str) -> bool {
    let mut bytes = name.bytes();
    name.len() <= MAX_NAME_CHARS
        && bytes.next().is_some_and(|first| first.is_ascii_alphabetic() || first == b'_')
        && bytes.all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
}
