//! Transitions that are still to be made, in document order.

use crate::state::NodeExit;
use motet_graph::{NodeId, RegionId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A transition to make.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Transition {
    /// Enter a step.
    Enter(NodeId),
    /// Get a call's resources and start it.
    Acquire(NodeId),
    /// Judge a step that awaits observations.
    Judge(NodeId),
    /// A step is over.
    NodeEnded(NodeId, NodeExit),
    /// A region is over.
    RegionEnded(RegionId, NodeExit),
}

/// A transition with its rank: first by place in the document, then in order of arrival.
#[derive(Clone, Copy, Debug)]
struct Entry {
    place: u32,
    order: u64,
    micro: Transition,
}

impl Entry {
    fn rank(&self) -> (u32, u64) {
        (self.place, self.order)
    }
}

impl PartialEq for Entry {
    fn eq(&self, other: &Self) -> bool {
        self.rank() == other.rank()
    }
}
impl Eq for Entry {}
impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Entry {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.rank().cmp(&other.rank())
    }
}

/// The work list. With a single thread of control it holds one entry at most, so that one has a place of its
/// own.
#[derive(Clone, Debug, Default)]
pub(crate) struct WorkList {
    /// The first of all, if it is known.
    first: Option<Entry>,
    rest: BinaryHeap<Reverse<Entry>>,
    orders: u64,
}

impl WorkList {
    /// Adds a transition at a place in the document.
    #[inline]
    pub(crate) fn push(&mut self, place: u32, micro: Transition) {
        self.orders += 1;
        let entry = Entry { place, order: self.orders, micro };
        match &mut self.first {
            None if self.rest.is_empty() => self.first = Some(entry),
            Some(first) if entry < *first => {
                let later = std::mem::replace(first, entry);
                self.rest.push(Reverse(later));
            }
            None | Some(_) => self.rest.push(Reverse(entry)),
        }
    }

    /// True if there is none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.first.is_none() && self.rest.is_empty()
    }

    /// Takes the first transition.
    #[inline]
    pub(crate) fn pop(&mut self) -> Option<Transition> {
        if let Some(first) = self.first.take() {
            return Some(first.micro);
        }
        self.rest.pop().map(|Reverse(entry)| entry.micro)
    }
}
