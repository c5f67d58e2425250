//! The state of a run between two events.

use super::{Command, Entity, Fact, Query, Value};
use crate::snapshot as m;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

/// A state. It is written only: an engine is rebuilt from its events, not from this.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    /// Of when.
    pub at: u64,
    /// The number of the graph that runs.
    pub revision: u32,
    /// The policy that runs.
    pub policy: String,
    /// The robot that it is for.
    pub robot: String,
    /// What is believed, in order; a later one wins.
    pub facts: Vec<Fact>,
    /// Facts with `any` that hold of some entity.
    pub some: Vec<Query>,
    /// The last readings of measures and fields.
    pub readings: Vec<Reading>,
    /// Entities that the engine has heard of.
    pub entities: Vec<Entity>,
    /// Names that are bound.
    pub bindings: Vec<Named>,
    /// What runs.
    pub goals: Vec<LiveGoal>,
}

/// A reading.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// Of what.
    pub query: Query,
    /// The value.
    pub value: Value,
    /// Of when.
    pub at: u64,
}

/// A name and its value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Named {
    /// The name.
    pub name: String,
    /// The value.
    pub value: Value,
}

/// A goal that has not ended.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LiveGoal {
    /// Its number.
    pub goal: u64,
    /// What it does.
    pub command: Command,
    /// The path of the step that started it.
    pub path: String,
}

impl From<&(SmolStr, motet_graph::Value)> for Named {
    fn from((name, value): &(SmolStr, motet_graph::Value)) -> Self {
        Self { name: name.to_string(), value: value.into() }
    }
}

impl From<&m::Snapshot> for Snapshot {
    fn from(state: &m::Snapshot) -> Self {
        Self {
            at: state.at.nanos(),
            revision: state.revision,
            policy: state.policy.to_string(),
            robot: state.robot.to_string(),
            facts: state.facts.iter().map(Fact::from).collect(),
            some: state.some.iter().map(Query::from).collect(),
            readings: state
                .readings
                .iter()
                .map(|(query, value, at)| Reading {
                    query: query.into(),
                    value: value.into(),
                    at: at.nanos(),
                })
                .collect(),
            entities: state.entities.iter().map(Entity::from).collect(),
            bindings: state.bindings.iter().map(Named::from).collect(),
            goals: state
                .goals
                .iter()
                .map(|live| LiveGoal {
                    goal: live.goal.number(),
                    command: (&*live.command).into(),
                    path: live.path.to_string(),
                })
                .collect(),
        }
    }
}
