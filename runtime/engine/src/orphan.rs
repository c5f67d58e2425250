//! Goals that the present graph has no step for: a policy that was replaced started them, and they have not
//! ended.

use crate::effect::Command;
use crate::ids::GoalId;
use crate::prepared_graph::PreparedGraph;
use crate::state::{GoalIntent, Phase};
use crate::time::Time;
use motet_graph::{Graph, NodeId, Value};
use std::sync::Arc;

/// A goal without a step. It holds its resources until it has ended.
#[derive(Clone, Debug)]
pub(crate) struct OrphanGoal {
    pub(crate) goal: GoalId,
    pub(crate) command: Arc<Command>,
    pub(crate) phase: Phase,
    pub(crate) wish: GoalIntent,
    /// Time at which its cancel or its safe stop will have taken too long.
    pub(crate) due: Time,
    /// Its resources, as bits of the present graph.
    pub(crate) uses: u128,
    /// The number of the graph that started it.
    pub(crate) revision: u32,
    /// Its step in that graph.
    pub(crate) node: NodeId,
    pub(crate) plan: Arc<PreparedGraph>,
    /// Bindings at the time when that graph was replaced.
    pub(crate) bindings: Arc<Vec<Option<Value>>>,
}

impl OrphanGoal {
    /// True if it may go on for a step of the new graph: nothing has been said against it.
    pub(crate) fn is_free(&self) -> bool {
        matches!(self.wish, GoalIntent::None | GoalIntent::Hold)
            && matches!(self.phase, Phase::Starting | Phase::Running | Phase::Held)
    }

    /// Its resources as bits of another graph. Of one that the other does not know, what it contains and what
    /// contains it counts: rather too much than too little.
    pub(crate) fn uses_in(&self, graph: &Graph) -> u128 {
        let own = &self.plan.graph.resources;
        let bit = |name: &str| {
            let index = graph.resources.iter().position(|resource| resource.name == name);
            index.and_then(|index| 1_u128.checked_shl(index as u32)).unwrap_or(0)
        };
        self.command.uses.iter().fold(0, |bits, name| {
            let same = bit(name);
            if same != 0 {
                return bits | same;
            }
            let Some(place) = own.iter().position(|resource| resource.name == *name) else { return bits };
            let related = own.iter().enumerate().filter(|(index, other)| {
                other.contains.iter().any(|inner| inner.index() == place)
                    || own
                        .get(place)
                        .is_some_and(|used| used.contains.iter().any(|inner| inner.index() == *index))
            });
            related.fold(bits, |bits, (_, other)| bits | bit(&other.name))
        })
    }
}
