//! [`serde::Deserializer`] over a [`Located`] tree: ordinary derived types are read with it.
//!
//! It differs from `serde_json` in four points. An unknown key is stepped over and noted, unless the list of
//! fields holds [`OPEN`]. [`super::Spanned`] gets its range. A [`super::Fallible`] absorbs a mistake and
//! notes it. And an enum may be written as an object with the variant's name among its keys: where the
//! variant's struct has that key as a field, it is the whole object, as in `{"repeat": 3, "steps": […]}`;
//! otherwise it is the value of the key, as in `{"box": [1, 2, 3]}`.

use std::cell::RefCell;
use std::fmt::{self, Display};

use serde::de::value::{MapDeserializer, SeqDeserializer, U128Deserializer};
use serde::de::{
    self, Deserialize, DeserializeSeed, Deserializer, Expected, IntoDeserializer, Unexpected, Visitor,
};

use super::{LENIENT, Located, LocatedValue, Number, SPANNED};
use crate::ast::MAX_MISTAKES;
use crate::source::Span;
use crate::words::DEADLINE;

/// Entry in a struct's list of fields: any other key is welcome too.
pub(crate) const OPEN: &str = "*";

/// Name of a newtype that is an enum as an object and a literal otherwise.
pub(crate) const MIXED: &str = "$mixed";

/// Deserializes a tree. Returns the value, and the mistakes that were met; a value may come with mistakes, no
/// value never comes without one.
pub(crate) fn deserialize<'s, T: Deserialize<'s>>(tree: &Located<'s>) -> (Option<T>, Vec<Fault>) {
    let faults = RefCell::default();
    let value = T::deserialize(Reader { node: tree, variant: None, faults: &faults });
    let mut faults = faults.into_inner();
    let value = value.map_err(|fault| faults.push(fault)).ok();
    (value, faults)
}

/// A mistake that serde met.
#[derive(Debug)]
pub(crate) struct Fault {
    /// Range of the innermost value that is wrong, once it is known.
    pub(crate) span: Option<Span>,
    pub(crate) message: String,
    /// True for a mistake that no schema shows: a type's own check refused the value.
    pub(crate) is_custom: bool,
}

impl Fault {
    /// A mistake that a schema shows as well.
    fn of_shape(message: impl Display) -> Self {
        Self { span: None, message: message.to_string(), is_custom: false }
    }

    /// The same mistake at `node`, unless a deeper value has claimed it.
    fn or_at(mut self, node: &Located<'_>) -> Self {
        self.span.get_or_insert(node.span);
        self
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: Display>(message: T) -> Self {
        Self { is_custom: true, ..Self::of_shape(message) }
    }
    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::of_shape(format_args!("expected {expected}, found {found}"))
    }
    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::of_shape(format_args!("expected {expected}, found {found}"))
    }
    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::of_shape(format_args!("expected {expected}, found {length}"))
    }
    fn unknown_variant(variant: &str, _: &'static [&'static str]) -> Self {
        Self::of_shape(format_args!("`{variant}` is not known here"))
    }
    fn unknown_field(field: &str, _: &'static [&'static str]) -> Self {
        Self::of_shape(format_args!("unknown key `{field}`"))
    }
    fn missing_field(field: &'static str) -> Self {
        Self::of_shape(format_args!("the key `{field}` is missing here"))
    }
}

/// Deserializer of one value.
#[derive(Clone, Copy)]
struct Reader<'t, 's> {
    node: &'t Located<'s>,
    /// The member of `node` whose key names the variant that is read.
    variant: Option<&'t (Located<'s>, Located<'s>)>,
    faults: &'t RefCell<Vec<Fault>>,
}

impl<'t, 's> Reader<'t, 's> {
    fn at(self, node: &'t Located<'s>) -> Self {
        Self { node, variant: None, ..self }
    }

    fn note(self, node: &Located<'_>, message: &str) {
        self.refuse(node, || Fault::of_shape(message));
    }

    /// Keeps a mistake at a node, unless there are more than are told.
    fn refuse(self, node: &Located<'_>, fault: impl FnOnce() -> Fault) {
        let mut faults = self.faults.borrow_mut();
        if faults.len() <= MAX_MISTAKES {
            faults.push(fault().or_at(node));
        }
    }

    /// The value itself; of a variant the value of its key, beside which there is no other key.
    fn content(self) -> &'t Located<'s> {
        let Some((key, value)) = self.variant else { return self.node };
        if self.node.members().len() > 1 {
            self.note(key, "no other key belongs here");
        }
        value
    }
}

impl<'s> IntoDeserializer<'s, Fault> for Reader<'_, 's> {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for Reader<'_, 'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let node = self.content();
        match &node.value {
            LocatedValue::Null => visitor.visit_unit(),
            LocatedValue::Bool(value) => visitor.visit_bool(*value),
            LocatedValue::Number(Number::Unsigned(value)) => visitor.visit_u64(*value),
            LocatedValue::Number(Number::Signed(value)) => visitor.visit_i64(*value),
            LocatedValue::Number(Number::Float(value)) => visitor.visit_f64(*value),
            LocatedValue::Text(std::borrow::Cow::Borrowed(text)) => visitor.visit_borrowed_str(text),
            LocatedValue::Text(std::borrow::Cow::Owned(text)) => visitor.visit_str(text),
            LocatedValue::Date => Err(de::Error::invalid_type(Unexpected::Other("a date"), &visitor)),
            LocatedValue::Array(items) => {
                let is_told = |_: &&Located<'_>| self.faults.borrow().len() <= MAX_MISTAKES;
                let items = items.iter().take_while(is_told).map(|item| self.at(item));
                visitor.visit_seq(SeqDeserializer::new(items))
            }
            LocatedValue::Object(members) => visitor.visit_map(MapDeserializer::new(
                members.iter().map(|(key, value)| (self.at(key), self.at(value))),
            )),
        }
        .map_err(|fault| fault.or_at(node))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let node = self.content();
        match node.value {
            LocatedValue::Null => visitor.visit_none(),
            _ => visitor.visit_some(self.at(node)),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let inner = self.at(self.content());
        match name {
            SPANNED => visitor.visit_seq(Wrapped { reader: inner, is_lenient: false, is_read: false }),
            LENIENT => visitor.visit_seq(Wrapped { reader: inner, is_lenient: true, is_read: false }),
            MIXED if !matches!(inner.node.value, LocatedValue::Object(_)) => inner.deserialize_any(visitor),
            _ => visitor.visit_newtype_struct(inner),
        }
    }

    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let is_field = |key: &Located<'_>| key.text().is_some_and(|key| fields.contains(&key));
        let is_whole = self.variant.is_none_or(|(key, _)| is_field(key));
        let node = if is_whole { self.node } else { self.content() };
        let LocatedValue::Object(members) = &node.value else {
            return Err(Fault::of_shape("expected an object").or_at(node));
        };
        let is_open = fields.contains(&OPEN);
        let known = members.iter().filter(|(key, _)| {
            let is_known = is_open || is_field(key);
            if !is_known {
                self.note(key, "unknown key");
            }
            is_known
        });
        let members = known.map(|(key, value)| (self.at(key), self.at(value)));
        visitor.visit_map(MapDeserializer::new(members)).map_err(|fault| fault.or_at(node))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let node = self.content();
        match &node.value {
            LocatedValue::Object(members) => {
                let names = |key: &Located<'_>| key.text().is_some_and(|key| variants.contains(&key));
                let mut named = members.iter().filter(|(key, _)| names(key));
                let decides = |key: &Located<'_>| key.text() != Some(DEADLINE);
                let variant = named.clone().find(|(key, _)| decides(key)).or_else(|| named.next());
                let Some(variant) = variant else {
                    return Err(Fault::of_shape("no key says what this object is").or_at(node));
                };
                visitor.visit_enum(Reader { node, variant: Some(variant), ..self })
            }
            LocatedValue::Text(text) => visitor.visit_enum(text.as_ref().into_deserializer()),
            _ => Err(Fault::of_shape("expected a string or an object")),
        }
        .map_err(|fault| fault.or_at(node))
    }

    /// An array of a fixed length has as many elements: a visitor would take the first of more.
    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        let node = self.content();
        match &node.value {
            LocatedValue::Array(items) if items.len() != length => {
                Err(<Fault as de::Error>::invalid_length(items.len(), &visitor).or_at(node))
            }
            _ => self.at(node).deserialize_any(visitor),
        }
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
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct
        seq map identifier ignored_any
    }
}

impl<'s> de::EnumAccess<'s> for Reader<'_, 's> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'s>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let name = self.variant.and_then(|(key, _)| key.text()).unwrap_or("");
        let name: de::value::StrDeserializer<'_, Fault> = name.into_deserializer();
        seed.deserialize(name).map(|name| (name, self))
    }
}

impl<'s> de::VariantAccess<'s> for Reader<'_, 's> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        Deserialize::deserialize(self)
    }

    fn newtype_variant_seed<T: DeserializeSeed<'s>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'s>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        self.deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'s>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_struct("", fields, visitor)
    }
}

/// Content of [`super::Spanned`], a value and its range as one number, or of [`super::Fallible`], a value or
/// nothing.
struct Wrapped<'t, 's> {
    reader: Reader<'t, 's>,
    is_lenient: bool,
    is_read: bool,
}

impl<'s> de::SeqAccess<'s> for Wrapped<'_, 's> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'s>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        if self.is_read {
            let number = super::pack(self.reader.node.span);
            return seed.deserialize(U128Deserializer::<Fault>::new(number)).map(Some);
        }
        self.is_read = true;
        match seed.deserialize(self.reader) {
            Err(fault) if self.is_lenient => {
                self.reader.refuse(self.reader.node, || fault);
                Ok(None)
            }
            result => result.map(Some),
        }
    }
}
