//! Questions about the world and their answers.

use super::Value;
use crate::query as m;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A question about the world.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Query {
    /// Whether a fluent holds; the answer is a truth.
    Fact {
        /// The fluent.
        fluent: String,
        /// Its arguments.
        args: Vec<Pattern>,
    },
    /// What a measure reads; the answer is a value.
    Measure {
        /// The measure.
        measure: String,
        /// Its arguments.
        args: Vec<Value>,
    },
    /// What an entity's field reads; the answer is a value.
    Field {
        /// The entity's id.
        entity: String,
        /// The field.
        field: String,
    },
}

/// An argument of a fluent.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Pattern {
    /// This value.
    Is(Value),
    /// Some entity.
    Any,
}

/// The answer to a question.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Answer {
    /// It cannot be told now.
    Unknown,
    /// To a fact: whether it holds.
    Truth(bool),
    /// To a measure or a field: what it reads, in SI units.
    Value(Value),
}

impl From<&m::Query> for Query {
    fn from(query: &m::Query) -> Self {
        match query {
            m::Query::Fact { fluent, args } => {
                Self::Fact { fluent: fluent.to_string(), args: args.iter().map(Pattern::from).collect() }
            }
            m::Query::Measure { measure, args } => {
                Self::Measure { measure: measure.to_string(), args: args.iter().map(Value::from).collect() }
            }
            m::Query::Field { entity, field } => {
                Self::Field { entity: entity.to_string(), field: field.to_string() }
            }
        }
    }
}

impl From<Query> for m::Query {
    fn from(query: Query) -> Self {
        match query {
            Query::Fact { fluent, args } => {
                Self::Fact { fluent: fluent.into(), args: args.into_iter().map(m::Pattern::from).collect() }
            }
            Query::Measure { measure, args } => Self::Measure {
                measure: measure.into(),
                args: args.into_iter().map(motet_graph::Value::from).collect(),
            },
            Query::Field { entity, field } => Self::Field { entity: entity.into(), field: field.into() },
        }
    }
}

impl From<&m::Pattern> for Pattern {
    fn from(pattern: &m::Pattern) -> Self {
        match pattern {
            m::Pattern::Is(value) => Self::Is(value.into()),
            m::Pattern::Any => Self::Any,
        }
    }
}

impl From<Pattern> for m::Pattern {
    fn from(pattern: Pattern) -> Self {
        match pattern {
            Pattern::Is(value) => Self::Is(value.into()),
            Pattern::Any => Self::Any,
        }
    }
}

impl From<&m::Answer> for Answer {
    fn from(answer: &m::Answer) -> Self {
        match answer {
            m::Answer::Unknown => Self::Unknown,
            m::Answer::Truth(truth) => Self::Truth(*truth),
            m::Answer::Value(value) => Self::Value(value.into()),
        }
    }
}

impl From<Answer> for m::Answer {
    fn from(answer: Answer) -> Self {
        match answer {
            Answer::Unknown => Self::Unknown,
            Answer::Truth(truth) => Self::Truth(truth),
            Answer::Value(value) => Self::Value(value.into()),
        }
    }
}
