//! Graphs for people: an indented tree, a Mermaid flowchart, a Graphviz digraph. The same graph gives the
//! same text.
//!
//! Any graph can be drawn, a valid one or not; what an id does not name is shown as `?`. How deep a drawing
//! goes is bounded.

mod dot;
mod mermaid;
mod names;
mod quantity;
mod text;

pub use dot::dot;
pub use mermaid::mermaid;
pub use names::Names;
pub use text::text;

use crate::model::{Graph, NodeId, NodeKind, Reaction, RegionId};

/// The deepest level that is drawn: below it an invalid graph could go round in circles.
const DEEPEST: usize = crate::validate::MAX_DEPTH + 1;

/// The regions of a node with what each is for.
fn parts(graph: &Graph, kind: &NodeKind) -> Vec<(String, RegionId)> {
    let names = Names(graph);
    match kind {
        NodeKind::Call(_) | NodeKind::Wait { .. } | NodeKind::End { .. } => Vec::new(),
        NodeKind::Sequence { body, .. }
        | NodeKind::Inline { body, .. }
        | NodeKind::Repeat { body, .. }
        | NodeKind::Each { body, .. } => vec![(String::new(), *body)],
        NodeKind::If { then, otherwise, .. } => {
            let otherwise = otherwise.map(|region| ("else".to_owned(), region));
            std::iter::once(("then".to_owned(), *then)).chain(otherwise).collect()
        }
        NodeKind::Monitor { watches, body } => {
            let blocks = watches.iter().filter_map(|watch| match &watch.reaction {
                Reaction::Resume { body, .. } => Some((names.watch(watch), *body)),
                Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End { .. } => None,
            });
            std::iter::once(("during".to_owned(), *body)).chain(blocks).collect()
        }
        NodeKind::Try { body, handlers } => {
            let handlers = handlers.iter().map(|handler| (names.handler(handler), handler.body));
            std::iter::once(("try".to_owned(), *body)).chain(handlers).collect()
        }
        NodeKind::Parallel { branches } => {
            let branches = branches.iter().enumerate();
            branches.map(|(index, region)| (format!("branch {}", index + 1), *region)).collect()
        }
    }
}

/// The nodes of a region in order.
fn chain(graph: &Graph, region: RegionId) -> Vec<NodeId> {
    let mut chain = Vec::new();
    let mut at = graph.regions.get(region.index()).and_then(|region| region.entry);
    while let Some(id) = at {
        chain.push(id);
        let next = graph.nodes.get(id.index()).and_then(|node| node.next);
        // Only forward, so that a chain ends in any graph.
        at = next.filter(|next| *next > id);
    }
    chain
}
