//! Wire types of calls, conditions and terms in JSON, as they are read, written and described.
//! [`super::wire`] builds on them.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use schemars::JsonSchema;
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use smol_str::SmolStr;

use super::Spanned;
use crate::located::{MIXED, Number};

/// A literal, a binding, or a form.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Term {
    Bool(bool),
    /// `0.5`: a number, in SI units where a quantity is meant.
    Number(f64),
    /// `"$mug"`, `"mug_1"`, `"20 cm"`; where a text is expected, `"red mug"`
    Text(SmolStr),
    /// A list: `["$a", "$b"]`.
    List(Vec<Spanned<Term>>),
    /// An object: `{"get": "distance", "to": "user"}`.
    Form(Box<Form>),
}

/// An object that is a condition or a term; its key says which.
#[derive(Clone, PartialEq, Debug, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Form {
    /// The condition does not hold.
    Not(Condition),
    /// All conditions hold.
    All(Vec<Condition>),
    /// One condition at least holds.
    Any(Vec<Condition>),
    /// The left side is less: `<`.
    Less(Pair),
    /// The left side is at most the right: `<=`.
    AtMost(Pair),
    /// Both sides are equal: `==`.
    Equal(Pair),
    /// The left side is more: `>`.
    More(Pair),
    /// The left side is at least the right: `>=`.
    AtLeast(Pair),
    /// The sides are not equal: `!=`.
    Unequal(Pair),
    /// The sum: `+`.
    Add(Pair),
    /// The difference: `-`.
    Subtract(Pair),
    /// The product: `*`.
    Multiply(Pair),
    /// The quotient: `/`.
    Divide(Pair),
    /// A pose in the map: x, y and yaw, or x, y, z and yaw.
    Pose(Vec<Spanned<Term>>),
    /// A text, where a plain string could be a name or a quantity.
    Literal(Spanned<SmolStr>),
    /// A fluent that holds.
    #[schemars(untagged)]
    Is(Is),
    /// Value of a measure.
    #[schemars(untagged)]
    Get(Get),
    /// A field of an entity.
    #[schemars(untagged)]
    Field(Field),
}

/// Runs one primitive or sub-policy. Every other key is an argument, under the name of its parameter.
#[derive(Clone, PartialEq, Debug, Serialize, JsonSchema)]
pub(crate) struct Do {
    /// The primitive or sub-policy.
    pub(crate) r#do: Spanned<SmolStr>,
    /// Arguments by parameter.
    #[serde(flatten)]
    pub(crate) args: Args,
    /// Manner of its motion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) manner: Option<Box<Manner>>,
    /// Deadline of the call.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) within: Option<Box<Duration>>,
    /// Number of retries after a failure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) retry: Option<Box<Count>>,
    /// The name that its result is bound to; `"$name"` stands for it afterwards.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) r#as: Option<Box<Spanned<SmolStr>>>,
}

/// The two sides of a comparison or a calculation.
pub(crate) type Pair = [Spanned<Term>; 2];

/// A fluent holds. Every other key is an argument; `"any"` stands for some entity.
#[derive(Clone, PartialEq, Debug, Serialize, JsonSchema)]
pub(crate) struct Is {
    /// Name of the fluent.
    pub(crate) is: Spanned<SmolStr>,
    /// Arguments by parameter.
    #[serde(flatten)]
    pub(crate) args: Args,
}

/// The value of a measure. Every other key is an argument. With `is` and `than` it is a condition: a
/// comparison.
#[derive(Clone, PartialEq, Debug, Serialize, JsonSchema)]
pub(crate) struct Get {
    /// Name of the measure.
    pub(crate) get: Spanned<SmolStr>,
    /// Arguments by parameter.
    #[serde(flatten)]
    pub(crate) args: Args,
    /// Operator of the comparison.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) is: Option<Box<Spanned<Relation>>>,
    /// Right side of the comparison.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) than: Option<Box<Spanned<Term>>>,
}

/// The value of a field of an entity. With `is` and `than` it is a condition: a comparison.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Field {
    /// Name of the field.
    pub(crate) field: Spanned<SmolStr>,
    /// Entity that has the field.
    pub(crate) of: Spanned<Term>,
    /// Operator of the comparison.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) is: Option<Box<Spanned<Relation>>>,
    /// Right side of the comparison.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) than: Option<Box<Spanned<Term>>>,
}

/// Operator of a comparison that is written in one object: `{"get": "distance", "to": "user", "is":
/// "less", "than": 0.5}`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Relation {
    /// The left side is less: `<`.
    Less,
    /// The left side is at most the right: `<=`.
    AtMost,
    /// Both sides are equal: `==`.
    Equal,
    /// The left side is more: `>`.
    More,
    /// The left side is at least the right: `>=`.
    AtLeast,
    /// The sides are not equal: `!=`.
    Unequal,
}

/// Arguments by the names of their parameters, in the order written.
#[derive(Clone, PartialEq, Debug, Default)]
pub(crate) struct Args(pub(crate) Vec<(Spanned<SmolStr>, Spanned<Term>)>);

/// A condition; a string is read as the text syntax.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Condition(pub(crate) Spanned<Term>);

/// A condition, or a duration.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Awaited(pub(crate) Spanned<Term>);

/// A duration: a number of seconds, or a string with a unit such as `"200 ms"`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Duration(pub(crate) Spanned<Term>);

/// A manner: `"slowly"`, `"gently"`, or a part of the robot's speed and acceleration, such as `"30 %"` or
/// `0.3`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Manner(pub(crate) Spanned<Term>);

/// A whole number.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct Count(pub(crate) Spanned<Term>);

impl<'de> Deserialize<'de> for Term {
    #[inline]
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_newtype_struct(MIXED, TermVisitor)
    }
}

struct TermVisitor;

impl<'de> Visitor<'de> for TermVisitor {
    type Value = Term;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a string, a number, `true`, `false`, an array or an object")
    }
    fn visit_bool<E>(self, value: bool) -> Result<Term, E> {
        Ok(Term::Bool(value))
    }
    #[expect(clippy::cast_precision_loss, reason = "numbers of policies are floats")]
    fn visit_u64<E>(self, value: u64) -> Result<Term, E> {
        Ok(Term::Number(value as f64))
    }
    #[expect(clippy::cast_precision_loss, reason = "numbers of policies are floats")]
    fn visit_i64<E>(self, value: i64) -> Result<Term, E> {
        Ok(Term::Number(value as f64))
    }
    fn visit_f64<E>(self, value: f64) -> Result<Term, E> {
        Ok(Term::Number(value))
    }
    fn visit_str<E>(self, value: &str) -> Result<Term, E> {
        Ok(Term::Text(SmolStr::new(value)))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Term, A::Error> {
        let mut members = Vec::with_capacity(access.size_hint().unwrap_or(0));
        while let Some(member) = access.next_element()? {
            members.push(member);
        }
        Ok(Term::List(members))
    }
    fn visit_newtype_struct<D: Deserializer<'de>>(self, deserializer: D) -> Result<Term, D::Error> {
        Form::deserialize(deserializer).map(|form| Term::Form(Box::new(form)))
    }
}

impl Serialize for Term {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Bool(value) => serializer.serialize_bool(*value),
            Self::Number(value) => match Number::new(*value) {
                Number::Unsigned(whole) => serializer.serialize_u64(whole),
                Number::Signed(whole) => serializer.serialize_i64(whole),
                Number::Float(value) => serializer.serialize_f64(value),
            },
            Self::Text(text) => serializer.serialize_str(text),
            Self::List(members) => members.serialize(serializer),
            Self::Form(form) => form.serialize(serializer),
        }
    }
}

impl Serialize for Form {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        fn one<S: Serializer>(serializer: S, key: &str, value: &impl Serialize) -> Result<S::Ok, S::Error> {
            let mut map = serializer.serialize_map(Some(1))?;
            map.serialize_entry(key, value)?;
            map.end()
        }
        match self {
            Self::Is(form) => form.serialize(serializer),
            Self::Get(form) => form.serialize(serializer),
            Self::Field(form) => form.serialize(serializer),
            Self::Not(inner) => one(serializer, "not", inner),
            Self::All(inner) => one(serializer, "all", inner),
            Self::Any(inner) => one(serializer, "any", inner),
            Self::Less(pair) => one(serializer, "less", pair),
            Self::AtMost(pair) => one(serializer, "at_most", pair),
            Self::Equal(pair) => one(serializer, "equal", pair),
            Self::More(pair) => one(serializer, "more", pair),
            Self::AtLeast(pair) => one(serializer, "at_least", pair),
            Self::Unequal(pair) => one(serializer, "unequal", pair),
            Self::Add(pair) => one(serializer, "add", pair),
            Self::Subtract(pair) => one(serializer, "subtract", pair),
            Self::Multiply(pair) => one(serializer, "multiply", pair),
            Self::Divide(pair) => one(serializer, "divide", pair),
            Self::Pose(numbers) => one(serializer, "pose", numbers),
            Self::Literal(text) => one(serializer, "literal", text),
        }
    }
}

impl Serialize for Args {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name.as_str(), value)))
    }
}

/// Target type of an object with arguments among its keys.
trait WithArguments: Sized {
    /// The keys that are no arguments, the one that names what is called first, and [`crate::located::OPEN`].
    const KEYS: &'static [&'static str];
    /// One key that is no argument.
    fn take<'de, A: MapAccess<'de>>(
        parts: &mut CallParts,
        key: &str,
        access: &mut A,
    ) -> Result<bool, A::Error>;
    /// All parts together.
    fn make(name: Spanned<SmolStr>, parts: CallParts) -> Self;
}

/// The parts of a call, as they come.
#[derive(Default)]
struct CallParts {
    name: Option<Spanned<SmolStr>>,
    args: Vec<(Spanned<SmolStr>, Spanned<Term>)>,
    manner: Option<Box<Manner>>,
    within: Option<Box<Duration>>,
    retry: Option<Box<Count>>,
    bind: Option<Box<Spanned<SmolStr>>>,
    is: Option<Box<Spanned<Relation>>>,
    than: Option<Box<Spanned<Term>>>,
}

/// A key, copied only where it has escapes: most of them only have to be told apart.
#[derive(Deserialize)]
#[serde(transparent)]
struct Key<'s>(#[serde(borrow)] Cow<'s, str>);

struct WithArgumentsVisitor<T>(PhantomData<T>);

impl<'de, T: WithArguments> Visitor<'de> for WithArgumentsVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("an object")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<T, A::Error> {
        let head = T::KEYS.first().copied().unwrap_or("");
        let mut parts = CallParts::default();
        while let Some(Spanned { value: Key(key), span }) =
            access.next_key_seed(PhantomData::<Spanned<Key<'de>>>)?
        {
            if key == head {
                parts.name = Some(access.next_value()?);
            } else if !T::take(&mut parts, &key, &mut access)? {
                if parts.args.capacity() == 0 {
                    parts.args = Vec::with_capacity(access.size_hint().unwrap_or(1));
                }
                parts.args.push((Spanned::new(SmolStr::new(key), span), access.next_value()?));
            }
        }
        match parts.name.take() {
            Some(name) => Ok(T::make(name, parts)),
            None => Err(A::Error::missing_field(head)),
        }
    }
}

impl WithArguments for Do {
    const KEYS: &'static [&'static str] = &["do", "as", "manner", "within", "retry", crate::located::OPEN];

    fn take<'de, A: MapAccess<'de>>(
        parts: &mut CallParts,
        key: &str,
        access: &mut A,
    ) -> Result<bool, A::Error> {
        match key {
            "as" => parts.bind = access.next_value()?,
            "manner" => parts.manner = access.next_value()?,
            "within" => parts.within = access.next_value()?,
            "retry" => parts.retry = access.next_value()?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn make(name: Spanned<SmolStr>, parts: CallParts) -> Self {
        let CallParts { args, manner, within, retry, bind, .. } = parts;
        Self { r#do: name, args: Args(args), manner, within, retry, r#as: bind }
    }
}

impl WithArguments for Is {
    const KEYS: &'static [&'static str] = &["is", crate::located::OPEN];
    fn take<'de, A: MapAccess<'de>>(_: &mut CallParts, _: &str, _: &mut A) -> Result<bool, A::Error> {
        Ok(false)
    }
    fn make(name: Spanned<SmolStr>, parts: CallParts) -> Self {
        Self { is: name, args: Args(parts.args) }
    }
}

impl WithArguments for Get {
    const KEYS: &'static [&'static str] = &["get", "is", "than", crate::located::OPEN];

    fn take<'de, A: MapAccess<'de>>(
        parts: &mut CallParts,
        key: &str,
        access: &mut A,
    ) -> Result<bool, A::Error> {
        match key {
            "is" => parts.is = access.next_value()?,
            // Without `is` before it, it is an argument like any other.
            "than" if parts.is.is_some() => parts.than = access.next_value()?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    fn make(name: Spanned<SmolStr>, parts: CallParts) -> Self {
        let CallParts { args, is, than, .. } = parts;
        Self { get: name, args: Args(args), is, than }
    }
}

macro_rules! deserialize_with_arguments {
    ($($name:ident)*) => {$(
        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let visitor = WithArgumentsVisitor::<Self>(PhantomData);
                deserializer.deserialize_struct(stringify!($name), <Self as WithArguments>::KEYS, visitor)
            }
        }
    )*};
}

deserialize_with_arguments!(Do Is Get);
