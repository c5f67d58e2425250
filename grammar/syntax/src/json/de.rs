//! A [`serde::Deserializer`] over [`Tree`]: ordinary derived types are read with it, and every fault has its place.
//!
//! It differs from `serde_json` in four ways. Structs are closed: a key that is no field is reported, stepped over, and
//! the reading goes on, unless the list of fields holds [`OPEN`]. [`super::Spanned`] learns its place. A
//! [`super::Lenient`] keeps a fault to itself. And an enum may be written as an object that has the variant's name among
//! its keys (see [`super::access::Variant`]).

use std::cell::RefCell;

use serde::Deserializer;
use serde::de::SeqAccess as _;
use serde::de::{Error as _, IntoDeserializer};
use serde::de::{Unexpected, Visitor};

use super::access::{Elements, Fields, Members, Place, Recovery, Variant};
use super::fault::{Fault, Reason};
use super::tree::{Kind, Number, Tree};
use super::{lenient, spanned, term};

/// In a struct's list of fields: any other key is welcome too.
pub(crate) const OPEN: &str = "*";

/// An enum whose name begins so is always an object, and is called by its name where it is none.
pub(crate) const OBJECT: &str = "an object";

/// What all deserializers of one document share.
pub(crate) struct Context<'s> {
    pub(crate) tree: Tree<'s>,
    /// Faults after which the reading went on.
    pub(crate) sink: RefCell<Vec<Fault>>,
}

/// The deserializer of one value.
#[derive(Clone, Copy)]
pub(crate) struct Value<'c, 's> {
    pub(crate) context: &'c Context<'s>,
    pub(crate) at: u32,
}

impl<'s> Value<'_, 's> {
    #[inline]
    fn kind(&self) -> Option<&Kind<'s>> {
        self.context.tree.get(self.at).map(|node| &node.kind)
    }

    /// How the value is called where another was expected.
    #[cold]
    fn wrong<T>(self, expected: &str) -> Result<T, Fault> {
        let found = match self.kind() {
            Some(Kind::Null) | None => "`null`",
            Some(Kind::Bool(true)) => "`true`",
            Some(Kind::Bool(false)) => "`false`",
            Some(Kind::Number(_)) => "a number",
            Some(Kind::Text(_)) => "a string",
            Some(Kind::Array) => "an array",
            Some(Kind::Object) => "an object",
        };
        Err(Fault::new(Reason::Type { found: found.into(), expected: expected.into() }, self.at))
    }
}

impl<'de> Deserializer<'de> for Value<'_, 'de> {
    type Error = Fault;

    #[inline]
    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let Some(node) = self.context.tree.get(self.at) else {
            return Err(Fault::invalid_type(Unexpected::Unit, &visitor));
        };
        let result = match &node.kind {
            Kind::Null => visitor.visit_unit(),
            Kind::Bool(value) => visitor.visit_bool(*value),
            Kind::Number(Number::Unsigned(value)) => visitor.visit_u64(*value),
            Kind::Number(Number::Signed(value)) => visitor.visit_i64(*value),
            Kind::Number(Number::Float(value)) => visitor.visit_f64(*value),
            Kind::Text(std::borrow::Cow::Borrowed(text)) => visitor.visit_borrowed_str(text),
            Kind::Text(std::borrow::Cow::Owned(text)) => visitor.visit_str(text),
            Kind::Array => visitor.visit_seq(Elements::new(self.context, self.at)),
            Kind::Object => visitor.visit_map(Members::new(self.context, self.at)),
        };
        result.map_err(|fault| fault.or_at(self.at))
    }

    #[inline]
    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Null) => visitor.visit_none(),
            Some(_) | None => visitor.visit_some(self),
        }
        .map_err(|fault| fault.or_at(self.at))
    }

    #[inline]
    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match name {
            spanned::NAME => visitor.visit_seq(Place::new(self)),
            lenient::NAME => visitor.visit_seq(Recovery::new(self)),
            term::MIXED if !matches!(self.kind(), Some(Kind::Object)) => {
                return self.deserialize_any(visitor);
            }
            _ => visitor.visit_newtype_struct(self),
        }
        .map_err(|fault| fault.or_at(self.at))
    }

    #[inline]
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Object) => visitor
                .visit_map(Fields::new(self.context, self.at, fields))
                .map_err(|fault| fault.or_at(self.at)),
            Some(_) | None => self.wrong("an object"),
        }
    }

    #[inline]
    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match self.kind() {
            Some(Kind::Object) => {
                let keys = || self.context.tree.keys(self.at);
                let is_form = |key: &u32| variants.contains(&self.context.tree.text(*key));
                let Some(key) = keys().find(is_form) else {
                    return Err(Fault::new(Reason::NoForm(variants), self.at));
                };
                visitor.visit_enum(Variant { context: self.context, object: self.at, key, variants })
            }
            Some(_) if name.starts_with(OBJECT) => return self.wrong(name),
            Some(Kind::Text(text)) => visitor.visit_enum(text.as_ref().into_deserializer()),
            Some(_) | None => return self.wrong("a string or an object"),
        }
        .map_err(|fault| fault.or_at(self.at))
    }

    /// An array of a fixed length has as many elements: a visitor would take the first of more.
    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        if matches!(self.kind(), Some(Kind::Array)) {
            let found = Elements::new(self.context, self.at).size_hint().unwrap_or(0);
            if found != length {
                return Err(Fault::invalid_length(found, &visitor).or_at(self.at));
            }
        }
        self.deserialize_any(visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_tuple(length, visitor)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq map
        identifier ignored_any
    }
}
