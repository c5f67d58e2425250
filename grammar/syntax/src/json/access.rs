//! How the deserializer hands out the parts of a value: elements, members, fields, variants, places and faults.

use serde::de::value::{StrDeserializer, U128Deserializer};
use serde::de::{self, DeserializeSeed, Deserializer, IntoDeserializer, Visitor};

use super::de::{Context, OPEN, Value};
use super::fault::{Fault, Reason};

/// The elements of an array.
pub(crate) struct Elements<'c, 's> {
    context: &'c Context<'s>,
    at: u32,
    end: u32,
}

impl<'c, 's> Elements<'c, 's> {
    pub(crate) fn new(context: &'c Context<'s>, array: u32) -> Self {
        Self { context, at: array + 1, end: context.tree.next(array) }
    }
}

impl<'de> de::SeqAccess<'de> for Elements<'_, 'de> {
    type Error = Fault;

    #[inline]
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        if self.at >= self.end {
            return Ok(None);
        }
        let at = self.at;
        self.at = self.context.tree.next(at);
        seed.deserialize(Value { context: self.context, at }).map(Some)
    }

    #[inline]
    fn size_hint(&self) -> Option<usize> {
        let next = |at: &u32| Some(self.context.tree.next(*at));
        Some(std::iter::successors(Some(self.at), next).take_while(|at| *at < self.end).count())
    }
}

/// The members of an object that is read as a map.
pub(crate) struct Members<'c, 's> {
    context: &'c Context<'s>,
    at: u32,
    end: u32,
}

impl<'c, 's> Members<'c, 's> {
    pub(crate) fn new(context: &'c Context<'s>, object: u32) -> Self {
        Self { context, at: object + 1, end: context.tree.next(object) }
    }
}

impl<'de> de::MapAccess<'de> for Members<'_, 'de> {
    type Error = Fault;

    #[inline]
    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        if self.at >= self.end {
            return Ok(None);
        }
        seed.deserialize(Value { context: self.context, at: self.at }).map(Some)
    }

    #[inline]
    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        let at = self.at + 1;
        self.at = self.context.tree.next(at);
        seed.deserialize(Value { context: self.context, at })
    }

    /// Members that are left; one whose value is next is among them.
    #[inline]
    fn size_hint(&self) -> Option<usize> {
        let next = |key: &u32| Some(self.context.tree.next(key + 1));
        Some(std::iter::successors(Some(self.at), next).take_while(|key| *key < self.end).count())
    }
}

/// The members of an object that is read as a struct: keys that are no fields are reported and stepped over.
pub(crate) struct Fields<'c, 's> {
    members: Members<'c, 's>,
    fields: &'static [&'static str],
    is_open: bool,
}

impl<'c, 's> Fields<'c, 's> {
    pub(crate) fn new(context: &'c Context<'s>, object: u32, fields: &'static [&'static str]) -> Self {
        Self { members: Members::new(context, object), fields, is_open: fields.contains(&OPEN) }
    }
}

impl<'de> de::MapAccess<'de> for Fields<'_, 'de> {
    type Error = Fault;

    #[inline]
    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        let Context { tree, sink } = self.members.context;
        while !self.is_open && self.members.at < self.members.end {
            let key = tree.text(self.members.at);
            if self.fields.contains(&key) {
                break;
            }
            let reason = Reason::UnknownKey { key: key.into(), expected: self.fields };
            sink.borrow_mut().push(Fault::new(reason, self.members.at));
            self.members.at = tree.next(self.members.at + 1);
        }
        self.members.next_key_seed(seed)
    }

    #[inline]
    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        self.members.next_value_seed(seed)
    }

    #[inline]
    fn size_hint(&self) -> Option<usize> {
        self.members.size_hint()
    }
}

/// A variant that is named by a key of an object.
///
/// Where the variant's content is a struct that has the key among its fields, the struct is the whole object, as in
/// `{"repeat": 3, "steps": […]}`; otherwise the content is the value of the key, as in `{"box": [1, 2, 3]}`, and the
/// object has no other key.
pub(crate) struct Variant<'c, 's> {
    pub(crate) context: &'c Context<'s>,
    pub(crate) object: u32,
    pub(crate) key: u32,
    pub(crate) variants: &'static [&'static str],
}

impl<'c, 's> Variant<'c, 's> {
    /// The value of the key, provided that the object has no other key.
    #[inline]
    fn content(&self) -> Result<Value<'c, 's>, Fault> {
        let tree = &self.context.tree;
        for other in tree.keys(self.object).filter(|other| *other != self.key) {
            let reason = if self.variants.contains(&tree.text(other)) {
                Reason::TwoForms { first: self.key, second: other }
            } else {
                Reason::UnknownKey { key: tree.text(other).into(), expected: &[] }
            };
            self.context.sink.borrow_mut().push(Fault::new(reason, other));
        }
        Ok(Value { context: self.context, at: self.key + 1 })
    }

    /// The whole object, if its only form is this variant or the struct has the other keys as fields.
    #[inline]
    fn whole(&self, fields: &[&str]) -> Result<Value<'c, 's>, Fault> {
        let tree = &self.context.tree;
        let clash = |key: &u32| {
            let text = tree.text(*key);
            !fields.contains(&text) && self.variants.contains(&text)
        };
        let is_open = fields.contains(&OPEN);
        match tree.keys(self.object).filter(|key| !is_open && *key != self.key).find(clash) {
            Some(second) => Err(Fault::new(Reason::TwoForms { first: self.key, second }, second)),
            None => Ok(Value { context: self.context, at: self.object }),
        }
    }
}

impl<'c, 'de> de::EnumAccess<'de> for Variant<'c, 'de> {
    type Error = Fault;
    type Variant = Self;

    #[inline]
    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let name: StrDeserializer<'_, Fault> = self.context.tree.text(self.key).into_deserializer();
        seed.deserialize(name).map(|name| (name, self))
    }
}

impl<'de> de::VariantAccess<'de> for Variant<'_, 'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        de::Deserialize::deserialize(self.content()?)
    }

    #[inline]
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self)
    }

    fn tuple_variant<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_tuple(length, visitor)
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.deserialize_struct("", fields, visitor)
    }
}

/// The content of a newtype variant: what it is depends on the type that asks.
impl<'de> Deserializer<'de> for Variant<'_, 'de> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_any(visitor)
    }

    #[inline]
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let is_whole = fields.contains(&self.context.tree.text(self.key));
        let value = if is_whole { self.whole(fields)? } else { self.content()? };
        value.deserialize_struct(name, fields, visitor)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.content()?.deserialize_newtype_struct(name, visitor)
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_option(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.content()?.deserialize_enum(name, variants, visitor)
    }

    fn deserialize_tuple<V: Visitor<'de>>(self, length: usize, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_tuple(length, visitor)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.content()?.deserialize_tuple_struct(name, length, visitor)
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq map
        identifier ignored_any
    }
}

/// A value and its place, for [`super::Spanned`]: the value, then the span as one number.
pub(crate) struct Place<'c, 's> {
    value: Value<'c, 's>,
    has_value: bool,
}

impl<'c, 's> Place<'c, 's> {
    pub(crate) fn new(value: Value<'c, 's>) -> Self {
        Self { value, has_value: false }
    }
}

impl<'de> de::SeqAccess<'de> for Place<'_, 'de> {
    type Error = Fault;

    #[inline(always)]
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        if !self.has_value {
            self.has_value = true;
            return seed.deserialize(self.value).map(Some);
        }
        let number = super::spanned::pack(self.value.context.tree.span(self.value.at));
        seed.deserialize(U128Deserializer::<Fault>::new(number)).map(Some)
    }
}

/// A value for [`super::Lenient`]: one element, or none where it has a fault, which goes to the sink.
pub(crate) struct Recovery<'c, 's> {
    value: Value<'c, 's>,
}

impl<'c, 's> Recovery<'c, 's> {
    pub(crate) fn new(value: Value<'c, 's>) -> Self {
        Self { value }
    }
}

impl<'de> de::SeqAccess<'de> for Recovery<'_, 'de> {
    type Error = Fault;

    #[inline(always)]
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        match seed.deserialize(self.value) {
            Ok(value) => Ok(Some(value)),
            Err(fault) => {
                self.value.context.sink.borrow_mut().push(fault.or_at(self.value.at));
                Ok(None)
            }
        }
    }
}
