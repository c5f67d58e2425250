//! Failures and endings that a region may have.

use std::collections::BTreeSet;

use motet_graph::{Ending, FailureId, NodeId, NodeKind, Reaction, RegionId, TIMEOUT, Verdict, Watch};
use motet_stdlib::lang::failures;
use smol_str::SmolStr;

use super::Exporter;

/// Kinds of failure, by name.
type Kinds = BTreeSet<SmolStr>;

impl Exporter<'_> {
    /// Name of a kind of failure.
    pub(super) fn kind(&self, failure: FailureId) -> SmolStr {
        self.graph.failures.get(failure.index()).cloned().unwrap_or_default()
    }

    /// Kinds of failure in which the steps of a region can end.
    pub(super) fn failures(&self, region: RegionId) -> Kinds {
        let mut kinds = Kinds::new();
        for id in self.nodes_of(region) {
            if let Some(node) = self.node(id) {
                self.add_failures(id, &node.kind, &mut kinds);
            }
        }
        kinds
    }

    fn add_failures(&self, id: NodeId, kind: &NodeKind, kinds: &mut Kinds) {
        let timeout = || self.kind(TIMEOUT);
        match kind {
            NodeKind::Call(call) => {
                let primitive = self.graph.primitives.get(call.primitive.index());
                let fails = primitive.map_or(&[][..], |primitive| &primitive.fails);
                kinds.extend(fails.iter().map(|failure| self.kind(*failure)));
                kinds.insert(timeout());
                let guards = call.needs.iter().filter(|need| need.verdict == Verdict::Deferred);
                kinds.extend(guards.map(|need| self.kind(need.failure)));
            }
            NodeKind::Let { .. } | NodeKind::Wait { .. } => {
                kinds.insert(timeout());
            }
            NodeKind::Delay { .. } | NodeKind::End { .. } => {}
            NodeKind::Sequence { body, .. } => kinds.extend(self.failures(*body)),
            NodeKind::Inline { body, .. } => {
                kinds.extend(self.failures(*body));
                if self.fails_within(*body, id) {
                    kinds.insert(SmolStr::new_static(failures::FAILED));
                }
            }
            NodeKind::If { then, otherwise, .. } => {
                kinds.extend(self.failures(*then));
                kinds.extend(otherwise.iter().flat_map(|region| self.failures(*region)));
            }
            NodeKind::Finally { body, .. } => kinds.extend(self.failures(*body)),
            NodeKind::Monitor { body, watches } => {
                kinds.extend(self.failures(*body));
                if watches.iter().any(|watch| matches!(watch.reaction, Reaction::Pause { .. })) {
                    kinds.insert(timeout());
                }
            }
            NodeKind::Try { body, handlers } => {
                let mut left = self.failures(*body);
                for handler in handlers {
                    kinds.extend(self.failures(handler.body));
                    match &handler.on {
                        None => left.clear(),
                        Some(on) => on.iter().for_each(|kind| {
                            left.remove(&self.kind(*kind));
                        }),
                    }
                }
                kinds.extend(left);
            }
            NodeKind::Repeat { body, until, .. } => {
                kinds.extend(self.failures(*body));
                if until.is_some() {
                    kinds.insert(SmolStr::new_static(failures::EXHAUSTED));
                }
            }
            NodeKind::Each { body, .. } => {
                kinds.extend(self.failures(*body));
                kinds.extend([failures::EXHAUSTED, failures::FAILED].map(SmolStr::new_static));
                kinds.insert(timeout());
            }
            NodeKind::Parallel { branches } => {
                kinds.extend(branches.iter().flat_map(|branch| self.failures(*branch)));
            }
        }
    }

    /// Checks if a step in a region, at any depth, ends the inlined policy as failed.
    fn fails_within(&self, region: RegionId, policy: NodeId) -> bool {
        let ends = |how: &Ending, of: &Option<NodeId>| *how == Ending::Fail && *of == Some(policy);
        self.nodes_of(region).into_iter().filter_map(|id| self.node(id)).any(|node| {
            let inner: Vec<RegionId> = match &node.kind {
                NodeKind::End { how, of, .. } => return ends(how, of),
                NodeKind::Call(_) | NodeKind::Let { .. } | NodeKind::Wait { .. } | NodeKind::Delay { .. } => {
                    Vec::new()
                }
                NodeKind::Sequence { body, .. }
                | NodeKind::Inline { body, .. }
                | NodeKind::Repeat { body, .. }
                | NodeKind::Each { body, .. } => vec![*body],
                NodeKind::Finally { body, cleanup } => vec![*body, *cleanup],
                NodeKind::If { then, otherwise, .. } => std::iter::once(*then).chain(*otherwise).collect(),
                NodeKind::Monitor { watches, body } => {
                    let fires = |watch: &Watch| match &watch.reaction {
                        Reaction::End { how, of, .. } => ends(how, of),
                        Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::Resume { .. } => false,
                    };
                    if watches.iter().any(fires) {
                        return true;
                    }
                    vec![*body]
                }
                NodeKind::Try { body, handlers } => {
                    std::iter::once(*body).chain(handlers.iter().map(|handler| handler.body)).collect()
                }
                NodeKind::Parallel { branches } => branches.clone(),
            };
            inner.into_iter().any(|region| self.fails_within(region, policy))
        })
    }

    /// Nodes of a region, in order.
    fn nodes_of(&self, region: RegionId) -> Vec<NodeId> {
        let mut next = self.graph.regions.get(region.index()).and_then(|region| region.entry);
        let mut nodes = Vec::new();
        while let Some((id, node)) = next.and_then(|id| Some((id, self.node(id)?))) {
            nodes.push(id);
            next = node.next;
        }
        nodes
    }
}
