//! Queries: ground questions about the world, and their answers.

use motet_graph::Value;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::fmt;

/// A question about the world with all names resolved. Two equal queries are the same question.
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
