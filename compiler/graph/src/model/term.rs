//! Facts, conditions and terms.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::{BindingId, FluentId, MeasureId, Type, Value};

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fact {
    pub fluent: FluentId,
    /// One argument for each parameter of the fluent.
    pub args: Vec<FactArg>,
}

/// An argument of a fluent.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FactArg {
    /// A term whose value is an entity, a case or another value.
    Term(Term),
    /// In an effect every entity, in a condition some entity.
    Any,
}

/// A condition over three values: true, false and unknown (Kleene's strong logic).
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    Literal(bool),
    Fact(Fact),
    Compare(Comparison, Term, Term),
    Not(Box<Condition>),
    /// Conjunction; true if empty.
    All(Vec<Condition>),
    /// Disjunction; false if empty.
    #[serde(rename = "any")]
    AnyOf(Vec<Condition>),
}

/// A comparison. `Equal` and `Unequal` take values of any type, the others numbers.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Comparison {
    Equal,
    Unequal,
    Less,
    AtMost,
    More,
    AtLeast,
}

impl Comparison {
    /// The operator in the text syntax.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Equal => "==",
            Self::Unequal => "!=",
            Self::Less => "<",
            Self::AtMost => "<=",
            Self::More => ">",
            Self::AtLeast => ">=",
        }
    }
}

/// An expression with a value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    Literal(Value),
    Binding(BindingId),
    /// The variable of a quantified entry; only in [`super::CallEffect`], [`super::Unsettled`] and
    /// [`super::Need`].
    Each,
    /// A field of an entity, observed like a measure.
    Field(Box<Term>, SmolStr),
    /// A measure with its arguments.
    Measure(MeasureId, Vec<Term>),
    /// A list whose elements are not all literals.
    List(Vec<Term>),
    /// Arithmetic on numbers.
    Arith(Arithmetic, Box<Term>, Box<Term>),
    /// Number of elements of a list.
    Count(Box<Term>),
    /// First element of a list; an empty list has none.
    First(Box<Term>),
    /// A text with values. A value that stays unknown is said to be.
    Template(Vec<TextPart>),
}

/// Part of a text with values.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TextPart {
    Literal(SmolStr),
    /// A value of a type, which says how it is written.
    Value(Term, Type),
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Arithmetic {
    Add,
    Subtract,
    Multiply,
    Divide,
}

impl Arithmetic {
    /// The operator in the text syntax.
    #[must_use]
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
        }
    }
}
