//! Located documents: values with their byte ranges, the same for JSON and TOML.
//!
//! A document is read in three steps. A parser makes a [`Located`] tree ([`parse_json`]; who reads TOML
//! converts the tree of its library). The tree is deserialized by plain serde, with [`Spanned`] for ranges
//! and [`Lenient`] for parts that may fail alone. Only if that meets a mistake, [`check_schema`] compares the
//! tree with the JSON Schema of the type and reports every [`Mismatch`] at its place; a document without
//! mistakes never pays for it.

mod de;
mod parse;
mod schema;
mod spanned;

use std::borrow::Cow;

pub(crate) use de::{Fault, MIXED, OPEN, deserialize};
pub use parse::{MAX_BRACKETS, parse_json};
pub(crate) use schema::phrase;
pub use schema::{Mismatch, MismatchKind, check_schema};
pub use spanned::{Lenient, Spanned};

use crate::source::Span;

/// A value and its byte range.
#[derive(Clone, PartialEq, Debug)]
pub struct Located<'s> {
    pub value: LocatedValue<'s>,
    /// Range of the value: of a string with its quotes, of an object with its brackets.
    pub span: Span,
}

/// A JSON or TOML value whose parts know their ranges.
#[derive(Clone, PartialEq, Debug)]
pub enum LocatedValue<'s> {
    Null,
    Bool(bool),
    Number(Number),
    /// A string or a key; borrowed where the document has it without escapes.
    Text(Cow<'s, str>),
    /// A date or time, which TOML has and JSON has not.
    Date,
    Array(Vec<Located<'s>>),
    /// Members in the order of the document; each key is a `Text`. A key is there once.
    Object(Vec<(Located<'s>, Located<'s>)>),
}

/// A finite number; whole numbers keep all their digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A whole number from 0.
    Unsigned(u64),
    /// A whole number below 0.
    Signed(i64),
    /// Any other number.
    Float(f64),
}

impl Number {
    /// Number of a finite float; `3.0` and `3e0` are whole, `-0.0` is not.
    #[must_use]
    pub fn new(value: f64) -> Self {
        /// Bound beyond which not every whole number is a float.
        const EXACT: f64 = 9_007_199_254_740_992.0;
        if value.fract() != 0.0 || value.abs() >= EXACT || (value == 0.0 && value.is_sign_negative()) {
            return Self::Float(value);
        }
        #[expect(clippy::cast_possible_truncation, reason = "whole and below 2^53")]
        let whole = value as i64;
        u64::try_from(whole).map_or(Self::Signed(whole), Self::Unsigned)
    }
}

impl std::fmt::Display for Number {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unsigned(value) => write!(f, "{value}"),
            Self::Signed(value) => write!(f, "{value}"),
            Self::Float(value) => write!(f, "{value}"),
        }
    }
}

impl<'s> Located<'s> {
    /// Text of a string or a key; `None` for any other value.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match &self.value {
            LocatedValue::Text(text) => Some(text),
            _ => None,
        }
    }

    /// Members of an object, in order; none of any other value.
    #[must_use]
    pub fn members(&self) -> &[(Located<'s>, Located<'s>)] {
        match &self.value {
            LocatedValue::Object(members) => members,
            _ => &[],
        }
    }

    /// Range that stands for the value in a message: of an object its first key, since a whole object is not
    /// underlined.
    #[must_use]
    pub fn head(&self) -> Span {
        self.members().first().map_or(self.span, |(key, _)| key.span)
    }

    /// JSON Pointer of the innermost value that contains a span, or whose key does. O(members on the way).
    #[must_use]
    pub fn pointer_at(&self, span: Span) -> String {
        let mut pointer = String::new();
        let mut node = self;
        loop {
            node = match &node.value {
                LocatedValue::Object(members) => {
                    let covers = |(key, value): &&(Located<'_>, Located<'_>)| {
                        key.span.contains(span) || value.span.contains(span)
                    };
                    let Some((key, value)) = members.iter().find(covers) else { return pointer };
                    push_token(&mut pointer, key.text().unwrap_or(""));
                    value
                }
                LocatedValue::Array(items) => {
                    let Some(index) = items.iter().position(|item| item.span.contains(span)) else {
                        return pointer;
                    };
                    push_token(&mut pointer, &index.to_string());
                    match items.get(index) {
                        Some(item) => item,
                        None => return pointer,
                    }
                }
                _ => return pointer,
            };
        }
    }
}

/// Appends one reference token to a JSON Pointer (RFC 6901).
pub(crate) fn push_token(pointer: &mut String, token: &str) {
    pointer.push('/');
    for character in token.chars() {
        match character {
            '~' => pointer.push_str("~0"),
            '/' => pointer.push_str("~1"),
            other => pointer.push(other),
        }
    }
}
