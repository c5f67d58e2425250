//! Whether what is being written can matter to what stands beside it. What runs at once, and what a monitor's reaction
//! may do at any moment, is proved together; where the two speak of different fluents neither can refute the other, and
//! that is seen without a proof.

use super::event_log::{Event, Id};
use super::machine::Machine;
use crate::automaton::NodeKind;

/// Something with parts, as far as it was said.
struct OpenNode {
    kind: NodeKind,
    /// The fluents that it speaks of, as bits; several may share one.
    fluents: u64,
    /// Of a `parallel` the fluents of its whole branches; of a monitor those of its whole reactions.
    beside: u64,
    /// Of a `parallel` what its whole branches use.
    taken: u64,
    /// What it uses.
    uses: u64,
    /// Of a condition of a monitor, or of the monitor itself: what its reaction does.
    reacts: Reacts,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
enum Reacts {
    /// It leaves the policy, or only waits.
    Outside,
    /// It runs something, or is done.
    Inside,
    /// It begins the body again.
    Again,
}

impl Machine {
    /// Whether nothing that stands beside the place behind `event` can tell that `more` stands there.
    pub(crate) fn is_independent(&self, event: Id, more: &[Event]) -> bool {
        let open = self.frames(event, more);
        open.windows(2).all(|pair| match pair {
            [outer, inner] => match (outer.kind, inner.kind) {
                (NodeKind::Parallel, NodeKind::Block) => inner.fluents & outer.beside == 0,
                (NodeKind::Monitor, NodeKind::Block) => match outer.reacts {
                    Reacts::Outside => true,
                    Reacts::Inside => inner.fluents & outer.beside == 0,
                    Reacts::Again => inner.fluents == 0,
                },
                // A reaction may run again in what it left.
                (NodeKind::Resume, NodeKind::Block) => inner.fluents == 0,
                _ => true,
            },
            _ => true,
        })
    }

    /// What the branches use that stand beside those around an event.
    pub(crate) fn resources_taken(&self, event: Id) -> u64 {
        let open = self.frames(event, &[]);
        let parallel = open.iter().filter(|frame| frame.kind == NodeKind::Parallel);
        parallel.fold(0, |taken, frame| taken | frame.taken)
    }

    /// All that is open behind `event` and `more`, the outermost first.
    fn frames(&self, last: Id, more: &[Event]) -> Vec<OpenNode> {
        let automaton = &self.context.automaton;
        let before = self.arenas.entry(last).map_or(0, |said| said.before);
        let mut open: Vec<OpenNode> = Vec::new();
        for event in self.arenas.between(before, last).into_iter().chain(more.iter().copied()) {
            match event {
                Event::Open(kind) => {
                    open.push(OpenNode {
                        kind,
                        fluents: 0,
                        beside: 0,
                        taken: 0,
                        uses: 0,
                        reacts: Reacts::Outside,
                    });
                    let (fluents, uses) = match kind {
                        NodeKind::Do(callable) => automaton
                            .callables
                            .get(usize::from(callable))
                            .map_or((u64::MAX, 0), |callable| (callable.fluents, callable.uses)),
                        NodeKind::Is(fluent) => {
                            (automaton.fluent_bits.get(usize::from(fluent)).copied().unwrap_or(u64::MAX), 0)
                        }
                        _ => (0, 0),
                    };
                    for frame in &mut open {
                        frame.fluents |= fluents;
                        frame.uses |= uses;
                    }
                }
                Event::Close => {
                    let Some(closed) = open.pop() else { continue };
                    let Some(outer) = open.last_mut() else { continue };
                    match (closed.kind, outer.kind) {
                        (NodeKind::Block, NodeKind::Parallel) => {
                            outer.beside |= closed.fluents;
                            outer.taken |= closed.uses;
                        }
                        (NodeKind::Restart, NodeKind::When) => outer.reacts = Reacts::Again,
                        (NodeKind::Resume, NodeKind::When) => outer.reacts = Reacts::Inside,
                        (NodeKind::Done, NodeKind::When) => {
                            outer.reacts = Reacts::Inside;
                            // The goal is asked for there.
                            outer.fluents |= self.goal(last);
                        }
                        (NodeKind::When, NodeKind::Monitor) => {
                            outer.reacts = outer.reacts.max(closed.reacts);
                            if closed.reacts != Reacts::Outside {
                                outer.beside |= closed.fluents;
                            }
                        }
                        _ => {}
                    }
                }
                _ => {}
            }
        }
        open
    }

    /// The fluents of the goal.
    fn goal(&self, event: Id) -> u64 {
        let automaton = &self.context.automaton;
        let (mut at, mut fluents) = (event, 0);
        while let Some(said) = self.arenas.entry(at).filter(|_| at > 0) {
            if let (0, Event::Open(NodeKind::Is(fluent))) = (said.before, said.event) {
                fluents |= automaton.fluent_bits.get(usize::from(fluent)).copied().unwrap_or(u64::MAX);
            }
            at = said.below;
        }
        fluents
    }
}
