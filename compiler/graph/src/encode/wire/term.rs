//! Values, terms and conditions.

use super::Float;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Value {
    /// A truth value.
    Bool(bool),
    /// A whole number.
    Int(i64),
    /// A number in SI units.
    Number(Float),
    /// Text.
    Text(String),
    /// An entity's id.
    Entity(String),
    /// A case of an enumeration.
    Case(String),
    /// A pose.
    Pose {
        /// Position in metres.
        xyz: [Float; 3],
        /// Unit quaternion x, y, z, w.
        quaternion: [Float; 4],
    },
    /// A list.
    List(Vec<Value>),
}

/// A fluent applied to arguments.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fact {
    /// The index of the fluent.
    pub fluent: u32,
    /// Its arguments.
    pub args: Vec<FactArg>,
}

/// An argument of a fluent.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FactArg {
    /// In an effect every entity, in a condition some entity.
    Any,
    /// A term.
    Term(Term),
}

/// A condition.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Condition {
    /// A literal.
    Literal(bool),
    /// A fluent.
    Fact(Fact),
    /// A comparison of two terms.
    Compare(Comparison, Term, Term),
    /// Negation.
    Not(Box<Condition>),
    /// All hold.
    All(Vec<Condition>),
    /// At least one holds.
    Any(Vec<Condition>),
}

/// A comparison.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Comparison {
    /// `==`
    Equal,
    /// `!=`
    Unequal,
    /// `<`
    Less,
    /// `<=`
    AtMost,
    /// `>`
    More,
    /// `>=`
    AtLeast,
}

/// Something that has a value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    /// The variable of a quantified entry.
    Each,
    /// A literal.
    Literal(Value),
    /// The index of a binding.
    Binding(u32),
    /// A field of an entity.
    Field(Box<Term>, String),
    /// A measure by its index, with its arguments.
    Measure(u32, Vec<Term>),
    /// A list.
    List(Vec<Term>),
    /// Arithmetic.
    Arith(Arithmetic, Box<Term>, Box<Term>),
}

/// An arithmetic operation.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Arithmetic {
    /// `+`
    Add,
    /// `-`
    Subtract,
    /// `*`
    Multiply,
    /// `/`
    Divide,
}
