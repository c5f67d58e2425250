//! Messages of Motet's topics.

use motet_graph::GraphDocument;
use motet_runtime::{Effect, Event, Snapshot, Time};
use schemars::JsonSchema;
use serde::Serialize;

#[derive(Serialize, JsonSchema)]
pub(super) struct EventMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The engine's time in ns.
    pub(super) at: Time,
    /// The event; absent if the engine gave up.
    pub(super) event: Option<Event>,
}

#[derive(Serialize, JsonSchema)]
pub(super) struct EffectMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The place among the entry's effects.
    pub(super) index: u32,
    /// The engine's time in ns.
    pub(super) at: Time,
    pub(super) effect: Effect,
}

/// On `/motet/graph`: at the beginning and at every swap.
#[derive(Serialize, JsonSchema)]
pub(super) struct GraphMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The number of the graph.
    pub(super) revision: u32,
    pub(super) graph: GraphDocument,
}

/// On `/motet/state`: whenever what is believed, bound or running has changed.
#[derive(Serialize, JsonSchema)]
pub(super) struct StateMessage {
    /// The number of the journal's entry.
    pub(super) seq: u64,
    /// The state after it.
    pub(super) state: Snapshot,
}
