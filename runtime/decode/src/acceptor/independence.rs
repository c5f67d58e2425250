//! Independence of concurrent steps.
//!
//! Branches that run at once, and reactions that may run at any moment, are proved together. If two of them
//! touch different fluents neither can refute the other, and no proof is needed.

use super::event_log::{Event, Id};
use super::machine::Machine;
use super::open_node::{OpenNode, OpenNodes, Reacts};
use crate::grammar::NodeKind;

/// Number of the last events that are read anew for each question: those that candidates differ in.
const READ_ANEW: usize = 8;

impl Machine {
    /// Nothing concurrent to the place behind `event` depends on `more` standing there.
    pub(crate) fn is_independent(&mut self, event: Id, more: &[Event]) -> bool {
        let open = self.open_nodes(event, more);
        let cleanup = open.iter().find(|frame| frame.kind == NodeKind::Finally);
        if cleanup.is_some_and(|cleanup| cleanup.fluents & self.goal(event) != 0) {
            return false;
        }
        open.windows(2).all(|pair| match pair {
            [outer, inner] => match (outer.kind, inner.kind) {
                (NodeKind::Parallel, NodeKind::Block) => inner.fluents & outer.beside == 0,
                (NodeKind::Monitor, NodeKind::Block) => match outer.reacts {
                    // A condition may not become certain by a step of the body.
                    Reacts::Outside => inner.fluents & outer.watched == 0,
                    Reacts::Inside => inner.fluents & (outer.beside | outer.watched) == 0,
                    Reacts::Again => inner.fluents == 0,
                },
                // A reaction may run again in the state that it left.
                (NodeKind::Resume, NodeKind::Block) => inner.fluents == 0,
                _ => true,
            },
            _ => true,
        })
    }

    /// The resources held by branches concurrent to an event.
    pub(crate) fn resources_taken(&mut self, event: Id) -> u64 {
        let open = self.open_nodes(event, &[]);
        let parallel = open.iter().filter(|frame| frame.kind == NodeKind::Parallel);
        parallel.fold(0, |taken, frame| taken | frame.taken)
    }

    /// The open nodes behind `event` and `more`, the outermost first.
    fn open_nodes(&mut self, last: Id, more: &[Event]) -> Vec<OpenNode> {
        let before = self.arenas.entry(last).map_or(0, |said| said.before);
        let (mut open, mut unread, mut at) = (Vec::new(), Vec::new(), last);
        while at > before {
            let Some(said) = self.arenas.entry(at) else { break };
            if said.hash == self.open.hash {
                open.clone_from(&self.open.nodes);
                break;
            }
            unread.push((said.event, said.hash));
            at = said.below;
        }
        for (left, (event, hash)) in unread.iter().enumerate().rev() {
            self.read(&mut open, *event, last);
            if left == READ_ANEW && unread.len() > 2 * READ_ANEW {
                self.open = OpenNodes { hash: *hash, nodes: open.clone() };
            }
        }
        for event in more {
            self.read(&mut open, *event, last);
        }
        open
    }

    /// Reads an event of the log up to `last`, or one that may follow it.
    fn read(&self, open: &mut Vec<OpenNode>, event: Event, last: Id) {
        let automaton = &self.context.automaton;
        match event {
            Event::Open(kind) => {
                open.push(OpenNode {
                    kind,
                    fluents: 0,
                    beside: 0,
                    watched: 0,
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
                    _ => return,
                };
                for node in open {
                    node.fluents |= fluents;
                    node.uses |= uses;
                }
            }
            Event::Close => {
                let Some(closed) = open.pop() else { return };
                let Some(outer) = open.last_mut() else { return };
                match (closed.kind, outer.kind) {
                    (NodeKind::Block, NodeKind::Parallel) => {
                        outer.beside |= closed.fluents;
                        outer.taken |= closed.uses;
                    }
                    (NodeKind::Restart, NodeKind::When) => outer.reacts = Reacts::Again,
                    (NodeKind::Resume, NodeKind::When) => outer.reacts = Reacts::Inside,
                    (NodeKind::Done, NodeKind::When) => {
                        outer.reacts = Reacts::Inside;
                        // `done` asks for the goal.
                        outer.fluents |= self.goal(last);
                    }
                    (NodeKind::When, NodeKind::Monitor) => {
                        outer.reacts = outer.reacts.max(closed.reacts);
                        outer.watched |= closed.fluents;
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

    /// The fluents of the goal, as bits.
    pub(super) fn goal(&self, event: Id) -> u64 {
        let automaton = &self.context.automaton;
        let asked = self.arenas.back(event).filter_map(|said| match (said.before, said.event) {
            (0, Event::Open(NodeKind::Is(fluent))) => Some(usize::from(fluent)),
            _ => None,
        });
        asked.fold(0, |bits, fluent| bits | automaton.fluent_bits.get(fluent).copied().unwrap_or(u64::MAX))
    }
}
