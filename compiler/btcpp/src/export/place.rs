//! Steps around the one that is written: whether an ending can leave them.

use motet_graph::{Node, NodeId};

/// A step around others.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) owner: NodeId,
    /// True if nothing comes behind the step in its region.
    pub(super) is_last: bool,
    pub(super) around: Around,
}

/// Use of the outcome of the steps inside.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Around {
    /// Success and failure are those of the step.
    Passes,
    /// A failure is that of the step, a success leads on.
    Loops,
    /// A failure leads to a handler; true if one of them asks for its kind.
    Catches { by_kind: bool },
}

impl Place {
    pub(super) fn new(owner: NodeId, node: &Node, around: Around) -> Self {
        Self { owner, is_last: node.next.is_none(), around }
    }
}

/// The places that an ending of `of`, or of the whole policy, leaves.
pub(super) fn left(places: &[Place], of: Option<NodeId>) -> &[Place] {
    let inner = of.and_then(|of| places.iter().rposition(|place| place.owner == of));
    places.get(inner.map_or(0, |index| index + 1)..).unwrap_or_default()
}
