//! Cleanups that an ended or replaced policy has left behind.

use motet_graph::draw::Names;
use motet_graph::{Graph, Node, NodeId, NodeKind, RegionId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

/// A cleanup that has not run to its end.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PendingCleanup {
    /// The path of the step that it belongs to.
    pub path: SmolStr,
    /// Its calls as a person would write them, in the order of the document.
    pub steps: Vec<String>,
}

impl PendingCleanup {
    /// The cleanup of a step; `None` if it has none.
    pub(crate) fn of(graph: &Graph, node: NodeId) -> Option<Self> {
        let step = graph.nodes.get(node.index())?;
        let NodeKind::Finally { cleanup, .. } = &step.kind else { return None };
        let owner = |region: RegionId| graph.regions.get(region.index())?.owner;
        let is_inside = |step: &Node| {
            let mut region = step.region;
            while region != *cleanup {
                let around = owner(region).filter(|owner| *owner > node);
                let Some(around) = around.and_then(|owner| graph.nodes.get(owner.index())) else {
                    return false;
                };
                region = around.region;
            }
            true
        };
        let calls =
            graph.nodes.iter().skip(node.index()).filter(|step| matches!(step.kind, NodeKind::Call(_)));
        let calls = calls.filter(|step| is_inside(step));
        let steps = calls.map(|step| Names(graph).brief(&step.kind)).collect();
        Some(Self { path: step.path.clone(), steps })
    }
}

impl std::fmt::Display for PendingCleanup {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.steps.join(", "))
    }
}

/// Strikes a call that was carried out off the cleanups that are left.
pub(crate) fn strike(left: &mut Vec<PendingCleanup>, done: &str) {
    for pending in left.iter_mut() {
        let is_it = |step: &String| {
            let call = step.strip_prefix("let ").and_then(|bound| bound.split_once(" = "));
            call.map_or(step.as_str(), |(_, call)| call) == done
        };
        if let Some(index) = pending.steps.iter().position(is_it) {
            pending.steps.remove(index);
        }
    }
    left.retain(|pending| !pending.steps.is_empty());
}
