//! What lies within a step: its regions, with a heading where there are several.

use motet_graph::draw::Names;
use motet_graph::{Graph, NodeId, NodeKind, Reaction, RegionId};

/// What is still to be laid out, on a stack.
pub(super) enum Open {
    /// A step at a depth.
    Node(NodeId, usize),
    /// The steps of a region.
    Region(RegionId, usize),
    /// A line of its own.
    Heading(String, usize),
}

/// The regions of a node with their headings, in the order of the document.
pub(super) fn branches(graph: &Graph, kind: &NodeKind, depth: usize, open: &mut Vec<Open>) {
    let inner = depth + 1;
    match kind {
        NodeKind::Call(_) | NodeKind::Wait { .. } | NodeKind::End { .. } => {}
        NodeKind::Sequence { body, .. }
        | NodeKind::Inline { body, .. }
        | NodeKind::Repeat { body, .. }
        | NodeKind::Each { body, .. } => open.push(Open::Region(*body, inner)),
        NodeKind::If { then, otherwise, .. } => {
            open.push(Open::Region(*then, inner));
            if let Some(otherwise) = otherwise {
                open.push(Open::Heading("else".to_owned(), depth));
                open.push(Open::Region(*otherwise, inner));
            }
        }
        NodeKind::Monitor { watches, body } => {
            open.push(Open::Region(*body, inner));
            for watch in watches {
                if let Reaction::Resume { body, .. } = &watch.reaction {
                    let test = Names(graph).condition(&watch.condition);
                    open.push(Open::Heading(format!("when {test}"), depth));
                    open.push(Open::Region(*body, inner));
                }
            }
        }
        NodeKind::Try { body, handlers } => {
            open.push(Open::Region(*body, inner));
            for handler in handlers {
                let names = handler.on.as_ref().map_or_else(
                    || "any".to_owned(),
                    |on| on.iter().map(|id| Names(graph).failure(*id)).collect::<Vec<_>>().join(", "),
                );
                open.push(Open::Heading(format!("catch {names}"), depth));
                open.push(Open::Region(handler.body, inner));
            }
        }
        NodeKind::Parallel { branches } => {
            for (index, branch) in branches.iter().enumerate() {
                open.push(Open::Heading(format!("branch {}", index + 1), inner));
                open.push(Open::Region(*branch, inner + 1));
            }
        }
    }
}
