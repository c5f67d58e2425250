//! What an engine is made from beside its graph.

use super::{Named, Query, Truth};
use crate::driver as d;
use crate::settings as s;
use crate::start as m;
use crate::time::Time;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::collections::BTreeSet;

/// What is known at the start.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StartState {
    /// Facts, in order; a later one wins.
    pub facts: Vec<Fact>,
    /// Facts with `any` that hold of some entity.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub some: Vec<Query>,
    /// Entities.
    pub entities: Vec<Entity>,
    /// Values of names that the graph is to be given.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bindings: Vec<Named>,
}

/// A fact with its value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fact {
    /// Which.
    pub fact: Query,
    /// What is known of it.
    pub truth: Truth,
}

/// An entity.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Entity {
    /// Its id.
    pub id: String,
    /// The name of its kind.
    pub kind: String,
}

/// How patient the engine is. Spans are whole nanoseconds.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// How long a cancel may go unanswered.
    pub cancel_within: u64,
    /// How long a safe stop may go unanswered.
    pub safe_stop_within: u64,
    /// The least time for which a watched condition may be unknown.
    pub unknown_for: u64,
    /// How long a deferred motion may go without a verdict; nothing where nobody verifies.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verify_within: Option<u64>,
    /// The most transitions at one instant.
    pub step_budget: u32,
}

impl From<&m::StartState> for StartState {
    fn from(start: &m::StartState) -> Self {
        Self {
            facts: start.facts.iter().map(Fact::from).collect(),
            some: start.some.iter().map(Query::from).collect(),
            entities: start.entities.iter().map(Entity::from).collect(),
            bindings: start.bindings.iter().map(Named::from).collect(),
        }
    }
}

impl From<StartState> for m::StartState {
    fn from(start: StartState) -> Self {
        Self {
            facts: start.facts.into_iter().map(|fact| (fact.fact.into(), fact.truth.into())).collect(),
            some: start.some.into_iter().map(Into::into).collect(),
            entities: start
                .entities
                .into_iter()
                .map(|entity| (entity.id.into(), entity.kind.into()))
                .collect(),
            bindings: start
                .bindings
                .into_iter()
                .map(|named| (named.name.into(), named.value.into()))
                .collect(),
        }
    }
}

impl From<&(crate::Query, crate::Truth)> for Fact {
    fn from((fact, truth): &(crate::Query, crate::Truth)) -> Self {
        Self { fact: fact.into(), truth: (*truth).into() }
    }
}

impl From<&(SmolStr, SmolStr)> for Entity {
    fn from((id, kind): &(SmolStr, SmolStr)) -> Self {
        Self { id: id.to_string(), kind: kind.to_string() }
    }
}

/// What a driver can do beside starting and ending goals.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Capabilities {
    /// Primitives whose goals it can hold and let go on.
    pub hold: Primitives,
    /// Primitives whose goals take new arguments while they run.
    pub update: Primitives,
}

/// A choice of primitives.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Primitives {
    /// Every one.
    All,
    /// Those of these names.
    Only(BTreeSet<String>),
}

impl From<&d::Capabilities> for Capabilities {
    fn from(capabilities: &d::Capabilities) -> Self {
        Self { hold: (&capabilities.hold).into(), update: (&capabilities.update).into() }
    }
}

impl From<Capabilities> for d::Capabilities {
    fn from(capabilities: Capabilities) -> Self {
        Self { hold: capabilities.hold.into(), update: capabilities.update.into() }
    }
}

impl From<&d::PrimitiveSet> for Primitives {
    fn from(primitives: &d::PrimitiveSet) -> Self {
        match primitives {
            d::PrimitiveSet::All => Self::All,
            d::PrimitiveSet::Only(names) => Self::Only(names.iter().map(ToString::to_string).collect()),
        }
    }
}

impl From<Primitives> for d::PrimitiveSet {
    fn from(primitives: Primitives) -> Self {
        match primitives {
            Primitives::All => Self::All,
            Primitives::Only(names) => Self::Only(names.into_iter().map(SmolStr::from).collect()),
        }
    }
}

impl From<s::EngineSettings> for Settings {
    fn from(settings: s::EngineSettings) -> Self {
        Self {
            cancel_within: settings.cancel_within.nanos(),
            safe_stop_within: settings.safe_stop_within.nanos(),
            unknown_for: settings.unknown_for.nanos(),
            verify_within: settings.verify_within.map(Time::nanos),
            step_budget: settings.step_budget,
        }
    }
}

impl From<Settings> for s::EngineSettings {
    fn from(settings: Settings) -> Self {
        Self {
            cancel_within: Time::from_nanos(settings.cancel_within),
            safe_stop_within: Time::from_nanos(settings.safe_stop_within),
            unknown_for: Time::from_nanos(settings.unknown_for),
            verify_within: settings.verify_within.map(Time::from_nanos),
            step_budget: settings.step_budget,
        }
    }
}
