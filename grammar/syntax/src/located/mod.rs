//! Located documents: values with their byte ranges, the same for JSON and TOML.
//!
//! A document is read in three steps. A parser makes a [`Located`] tree ([`parse_json`]; who reads TOML
//! converts the tree of its library). The tree is deserialized by plain serde, with [`Spanned`] for ranges
//! and [`Fallible`] for parts that may fail alone. Only if that meets a mistake, [`check_schema`] compares
//! the tree with the JSON Schema of the type and reports every [`Mismatch`] at its place; a document without
//! mistakes never pays for it.

mod de;
mod parse;
mod schema;

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;

pub(crate) use de::{Fault, MIXED, OPEN, deserialize};
pub use parse::{MAX_BRACKETS, parse_json};
pub(crate) use schema::{Leaf, SchemaView, form_key, phrase};
pub use schema::{Mismatch, MismatchKind, check_schema};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::source::{FileId, Span};

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

    /// The same value with its own strings.
    #[must_use]
    pub fn into_owned(self) -> Located<'static> {
        let value = match self.value {
            LocatedValue::Null => LocatedValue::Null,
            LocatedValue::Bool(value) => LocatedValue::Bool(value),
            LocatedValue::Number(value) => LocatedValue::Number(value),
            LocatedValue::Text(text) => LocatedValue::Text(Cow::Owned(text.into_owned())),
            LocatedValue::Date => LocatedValue::Date,
            LocatedValue::Array(items) => {
                LocatedValue::Array(items.into_iter().map(Located::into_owned).collect())
            }
            LocatedValue::Object(members) => {
                let owned = members.into_iter().map(|(key, value)| (key.into_owned(), value.into_owned()));
                LocatedValue::Object(owned.collect())
            }
        };
        Located { value, span: self.span }
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

    /// JSON Pointer of the innermost value that contains a span, or whose key does. O(depth · log members)
    /// where the parts stand in order, as those of JSON do, and O(members on the way) elsewhere.
    #[must_use]
    pub fn pointer_at(&self, span: Span) -> String {
        let mut pointer = String::new();
        let mut node = self;
        loop {
            node = match &node.value {
                LocatedValue::Object(members) => {
                    let covers = |(key, value): &(Located<'_>, Located<'_>)| {
                        key.span.contains(span) || value.span.contains(span)
                    };
                    let first = members.partition_point(|(_, value)| value.span.end < span.end);
                    let near = members.get(first).filter(|member| covers(member));
                    let Some((key, value)) = near.or_else(|| members.iter().find(|member| covers(member)))
                    else {
                        return pointer;
                    };
                    push_token(&mut pointer, key.text().unwrap_or(""));
                    value
                }
                LocatedValue::Array(items) => {
                    let first = items.partition_point(|item| item.span.end < span.end);
                    let is_near = items.get(first).is_some_and(|item| item.span.contains(span));
                    let all = || items.iter().position(|item| item.span.contains(span));
                    let Some(index) = is_near.then_some(first).or_else(all) else { return pointer };
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

/// Newtype name by which [`de`] knows [`Spanned`].
pub(crate) const SPANNED: &str = "$spanned";
/// Newtype name by which [`de`] knows [`Fallible`].
pub(crate) const LENIENT: &str = "$lenient_value";

/// A value and its byte range in the document. Read by [`crate::json::read`] it has its span; by any other
/// deserializer, or made by hand, an empty one. It is written, and described in a schema, as the value alone;
/// equality ignores the span.
#[derive(Clone, Copy, Debug, Default)]
pub struct Spanned<T> {
    pub value: T,
    /// Range of the value: of a string with its quotes, of an object with its brackets.
    pub span: Span,
}

impl<T> Spanned<T> {
    /// Pairs a value with its range.
    pub fn new(value: T, span: Span) -> Self {
        Self { value, span }
    }

    /// Drops the range.
    pub fn into_inner(self) -> T {
        self.value
    }
}

impl<T> From<T> for Spanned<T> {
    fn from(value: T) -> Self {
        Self { value, span: Span::default() }
    }
}

impl<T> Deref for Spanned<T> {
    type Target = T;
    fn deref(&self) -> &T {
        &self.value
    }
}

impl<T: PartialEq> PartialEq for Spanned<T> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<T: Eq> Eq for Spanned<T> {}

impl<T: std::hash::Hash> std::hash::Hash for Spanned<T> {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.value.hash(state);
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Spanned<T> {
    #[inline]
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct(SPANNED, SpannedVisitor(PhantomData))
    }
}

struct SpannedVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for SpannedVisitor<T> {
    type Value = Spanned<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, deserializer: D) -> Result<Spanned<T>, D::Error> {
        T::deserialize(deserializer).map(Spanned::from)
    }

    #[inline]
    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Spanned<T>, A::Error> {
        let Some(value) = access.next_element_seed(PhantomData::<T>)? else {
            return Err(serde::de::Error::invalid_length(0, &self));
        };
        let span = access.next_element_seed(PhantomData::<u128>)?.map(unpack).unwrap_or_default();
        Ok(Spanned { value, span })
    }
}

/// Packs a span into one number, in which form it passes through serde.
#[inline]
pub(crate) fn pack(span: Span) -> u128 {
    (u128::from(span.file.0) << 64) | (u128::from(span.start) << 32) | u128::from(span.end)
}

#[inline]
fn unpack(packed: u128) -> Span {
    let bits = |shift: u32| u32::try_from((packed >> shift) & u128::from(u32::MAX)).unwrap_or_default();
    Span { file: FileId(u16::try_from(bits(64)).unwrap_or_default()), start: bits(32), end: bits(0) }
}

impl<T: Serialize> Serialize for Spanned<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.value.serialize(serializer)
    }
}

impl<T: JsonSchema> JsonSchema for Spanned<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// A value, or `None` where it could not be read: then [`crate::json::read`] has an error for it, and the
/// mistake does not hide those of its neighbours. By any other deserializer it is as strict as `T`. It is
/// written, and described in a schema, as `T`; `None` is written as `null`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Fallible<T>(pub Option<T>);

impl<T> From<T> for Fallible<T> {
    fn from(value: T) -> Self {
        Self(Some(value))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Fallible<T> {
    #[inline]
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct(LENIENT, LenientVisitor(PhantomData))
    }
}

struct LenientVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for LenientVisitor<T> {
    type Value = Fallible<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, deserializer: D) -> Result<Fallible<T>, D::Error> {
        T::deserialize(deserializer).map(Fallible::from)
    }

    #[inline]
    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Fallible<T>, A::Error> {
        access.next_element_seed(PhantomData::<T>).map(Fallible)
    }
}

impl<T: Serialize> Serialize for Fallible<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<T: JsonSchema> JsonSchema for Fallible<T> {
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn schema_id() -> Cow<'static, str> {
        T::schema_id()
    }
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// One past the bracket that closes the object or list at `start`; `None` where it is not closed.
pub(crate) fn end_of_value(text: &str, start: usize) -> Option<usize> {
    let (mut depth, mut in_text, mut is_escaped) = (0_usize, false, false);
    for (offset, byte) in text.get(start..)?.bytes().enumerate() {
        match byte {
            _ if is_escaped => is_escaped = false,
            b'\\' if in_text => is_escaped = true,
            b'"' => in_text = !in_text,
            b'{' | b'[' if !in_text => depth += 1,
            b'}' | b']' if !in_text => {
                depth = depth.saturating_sub(1);
                if depth == 0 {
                    return Some(start + offset + 1);
                }
            }
            _ => {}
        }
    }
    None
}
