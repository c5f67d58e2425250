//! What the commands ask of a graph.

use motet_graph::{Graph, NodeKind, Verdict};

/// How many motions nobody has found a solution for yet.
#[must_use]
pub(crate) fn deferred_motions(graph: &Graph) -> usize {
    let is_deferred = |kind: &NodeKind| match kind {
        NodeKind::Call(call) => {
            call.motion.as_ref().is_some_and(|motion| motion.verdict == Verdict::Deferred)
        }
        NodeKind::Sequence { .. }
        | NodeKind::Inline { .. }
        | NodeKind::If { .. }
        | NodeKind::Wait { .. }
        | NodeKind::Monitor { .. }
        | NodeKind::Try { .. }
        | NodeKind::Repeat { .. }
        | NodeKind::Each { .. }
        | NodeKind::Parallel { .. }
        | NodeKind::End { .. } => false,
    };
    graph.nodes.iter().filter(|node| is_deferred(&node.kind)).count()
}
