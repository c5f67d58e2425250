//! Queries to the world, their answers, and the truth values that conditions have.

use motet_graph::Value;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::fmt;

use crate::time::Time;

/// A question about the world with all names resolved. Two equal queries are the same question.
///
/// ```
/// use motet_graph::Value;
/// use motet_runtime::{Pattern, Query};
///
/// let held = Query::Fact { fluent: "holding".into(), args: vec![Pattern::Any] };
/// assert_eq!(held.to_string(), "holding(any)");
/// let near = Query::Measure { measure: "distance".into(), args: vec![Value::Entity("user".into())] };
/// assert_eq!(near.to_string(), "distance(user)");
/// ```
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Query {
    /// Truth value of a fluent. The answer is an [`Answer::Truth`].
    Fact {
        fluent: SmolStr,
        /// Its arguments; with [`Pattern::Any`]: whether it holds of some entity.
        args: Vec<Pattern>,
    },
    /// Reading of a measure. The answer is an [`Answer::Value`].
    Measure { measure: SmolStr, args: Vec<Value> },
    /// Reading of an entity's field. The answer is an [`Answer::Value`].
    Field {
        /// The entity's id.
        entity: SmolStr,
        field: SmolStr,
    },
}

/// An argument of a fluent in a query.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Pattern {
    Is(Value),
    Any,
}

/// The answer to a query.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Answer {
    /// It cannot be told now: nothing in view, no reading.
    Unknown,
    /// To a fact: whether it holds.
    Truth(bool),
    /// To a measure or a field: its value, numbers in SI units. A number that is not finite counts as
    /// unknown.
    Value(Value),
}

impl fmt::Display for Query {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fact { fluent, args } => {
                write!(f, "{fluent}(")?;
                for (index, arg) in args.iter().enumerate() {
                    if index > 0 {
                        f.write_str(", ")?;
                    }
                    match arg {
                        Pattern::Is(value) => write!(f, "{value}")?,
                        Pattern::Any => f.write_str("any")?,
                    }
                }
                f.write_str(")")
            }
            Self::Measure { measure, args } => {
                write!(f, "{measure}(")?;
                for (index, arg) in args.iter().enumerate() {
                    if index > 0 {
                        f.write_str(", ")?;
                    }
                    write!(f, "{arg}")?;
                }
                f.write_str(")")
            }
            Self::Field { entity, field } => write!(f, "{entity}.{field}"),
        }
    }
}

impl fmt::Display for Answer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown => f.write_str("unknown"),
            Self::Truth(truth) => write!(f, "{truth}"),
            Self::Value(value) => write!(f, "{value}"),
        }
    }
}

/// Truth value of a statement.
///
/// ```
/// use motet_runtime::Truth;
///
/// assert_eq!(Truth::True.and(Truth::Unknown), Truth::Unknown);
/// assert_eq!(Truth::True.or(Truth::Unknown), Truth::True);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Truth {
    True,
    /// It does not hold.
    False,
    /// It may or may not hold.
    Unknown,
}

impl Truth {
    /// Conjunction in three-valued logic.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::False, _) | (_, Self::False) => Self::False,
            (Self::True, Self::True) => Self::True,
            (Self::Unknown, Self::True | Self::Unknown) | (Self::True, Self::Unknown) => Self::Unknown,
        }
    }

    /// At least one.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        self.negated().and(other.negated()).negated()
    }

    /// Negation in three-valued logic: unknown stays unknown.
    #[must_use]
    pub const fn negated(self) -> Self {
        match self {
            Self::True => Self::False,
            Self::False => Self::True,
            Self::Unknown => Self::Unknown,
        }
    }

    /// Join of two truth values: equal values stay, others become unknown.
    #[must_use]
    pub fn joined(self, other: Self) -> Self {
        if self == other { self } else { Self::Unknown }
    }
}

impl From<bool> for Truth {
    fn from(value: bool) -> Self {
        if value { Self::True } else { Self::False }
    }
}

impl fmt::Display for Truth {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::True => "true",
            Self::False => "false",
            Self::Unknown => "unknown",
        })
    }
}

/// The last reading of a measure or a field.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    pub query: Query,
    pub value: Value,
    /// Time of the observation.
    pub at: Time,
}
