//! Wrappers for deserialized values: [`Spanned`] keeps the byte range, [`Lenient`] survives mistakes.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Deref;

use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::source::{FileId, Span};

/// Newtype name by which [`super::de`] knows [`Spanned`].
pub(crate) const SPANNED: &str = "$spanned";
/// Newtype name by which [`super::de`] knows [`Lenient`].
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
pub struct Lenient<T>(pub Option<T>);

impl<T> From<T> for Lenient<T> {
    fn from(value: T) -> Self {
        Self(Some(value))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Lenient<T> {
    #[inline]
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct(LENIENT, LenientVisitor(PhantomData))
    }
}

struct LenientVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for LenientVisitor<T> {
    type Value = Lenient<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }

    fn visit_newtype_struct<D: Deserializer<'de>>(self, deserializer: D) -> Result<Lenient<T>, D::Error> {
        T::deserialize(deserializer).map(Lenient::from)
    }

    #[inline]
    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Lenient<T>, A::Error> {
        access.next_element_seed(PhantomData::<T>).map(Lenient)
    }
}

impl<T: Serialize> Serialize for Lenient<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.0.serialize(serializer)
    }
}

impl<T: JsonSchema> JsonSchema for Lenient<T> {
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
