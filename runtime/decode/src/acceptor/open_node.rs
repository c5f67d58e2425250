//! Nodes of the log that are still open, and the fluents and resources that they mention.

use crate::grammar::NodeKind;

/// The open nodes at a place of the log, kept for the questions about the candidates behind it.
#[derive(Clone, Default, Debug)]
pub(super) struct OpenNodes {
    /// The hash of the log up to the place.
    pub(super) hash: u64,
    pub(super) nodes: Vec<OpenNode>,
}

/// A node that is still open.
#[derive(Clone, Copy, Debug)]
pub(super) struct OpenNode {
    pub(super) kind: NodeKind,
    /// The fluents that it mentions, as bits; several may share one.
    pub(super) fluents: u64,
    /// Of a `parallel`, the fluents of its finished branches; of a monitor, those of its finished
    /// reactions.
    pub(super) beside: u64,
    /// Of a monitor, the fluents of its conditions and reactions.
    pub(super) watched: u64,
    /// Of a `parallel`, the resources of its finished branches.
    pub(super) taken: u64,
    /// The resources that it uses.
    pub(super) uses: u64,
    /// Of a monitor or one of its conditions: the effect of its reaction.
    pub(super) reacts: Reacts,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) enum Reacts {
    /// Leaves the policy, or only waits.
    Outside,
    /// Runs steps, or is done.
    Inside,
    /// Restarts the body.
    Again,
}
