//! Entries of a journal.

use crate::driver::Capabilities;
use crate::effect::Effect;
use crate::event::Event;
use crate::start::{EngineSettings, StartState};
use crate::time::Time;
use motet_graph::GraphDocument;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An entry of a journal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum JournalEntry {
    /// The first: what the engine was made from.
    Head(Box<JournalHead>),
    /// An event and the effects that followed.
    Step(StepEntry),
    /// The policy was replaced.
    Swap(Box<SwapEntry>),
    /// Nothing was left to wait for: the engine gave up. No event stands here.
    GaveUp(StepEntry),
    /// The process ended before the run did, and another one went on. The engine took no part in it.
    Resumed(ResumeEntry),
}

/// Configuration of an engine at the beginning of a run.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JournalHead {
    /// The version of the journal, 1.
    pub motet_journal: u32,
    /// The version of the wire forms, 1.
    pub wire: u32,
    /// Time at which the run began by the host's clock, in ns since 1970; for people and tools, the engine
    /// does not know it.
    pub began_unix_ns: u64,
    /// The engine's time then.
    pub from: Time,
    /// Id of the run, which its driver hears; absent in older journals.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub run: String,
    /// The operator's request, word for word.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instruction: Option<String>,
    pub graph: GraphDocument,
    pub start: StartState,
    /// Time limits and budgets of the engine.
    pub settings: EngineSettings,
    /// Abilities of the driver, as the host stated them.
    pub capabilities: Capabilities,
    /// Data with which the host finds the same driver again, in a form of its own.
    pub driver: serde_json::Value,
}

/// An event and the effects that followed.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StepEntry {
    /// The engine's time.
    pub at: Time,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub event: Option<Event>,
    pub effects: Vec<Effect>,
}

/// A replacement of the policy.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SwapEntry {
    /// The engine's time.
    pub at: Time,
    /// The new graph.
    pub graph: GraphDocument,
    pub effects: Vec<Effect>,
}

/// Another process went on.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ResumeEntry {
    /// Time on the host's clock in ns since 1970.
    pub unix_ns: u64,
    /// Bytes of a line that was not written to its end and was cut off.
    pub cut_bytes: u64,
}

impl JournalEntry {
    /// The engine's time, and what it gave out; none where it took no part.
    #[must_use]
    pub fn happened(&self) -> Option<(Time, &[Effect])> {
        match self {
            Self::Head(head) => Some((head.from, &[])),
            Self::Step(step) | Self::GaveUp(step) => Some((step.at, &step.effects)),
            Self::Swap(swap) => Some((swap.at, &swap.effects)),
            Self::Resumed(_) => None,
        }
    }
}

impl JournalHead {
    /// The head of a run of a graph that begins at time 0, with the engine's own settings and nothing known
    /// beside what the graph says.
    #[must_use]
    pub fn new(graph: &motet_graph::Graph) -> Self {
        Self {
            motet_journal: super::VERSION,
            wire: super::WIRE_VERSION,
            began_unix_ns: 0,
            from: Time::ZERO,
            run: String::new(),
            instruction: None,
            graph: motet_graph::encode::document(graph),
            start: StartState::default(),
            settings: EngineSettings::default(),
            capabilities: Capabilities::default(),
            driver: serde_json::Value::Null,
        }
    }
}
