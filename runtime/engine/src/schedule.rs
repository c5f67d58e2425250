//! Schedule of a run: the instants at which the engine wants to be woken, and the transitions that are still
//! to be made at one instant, in document order.

use crate::time::Time;
use crate::trace::{EndCause, NodeEnding};
use motet_graph::{NodeId, RegionId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Instants by key, at most one each. Setting, clearing and taking the next cost the logarithm of how many
/// are set, amortised.
///
/// An entry of the heap is stale where it is not its key's present instant. The first is never stale.
#[derive(Clone, Debug)]
pub(crate) struct Timers {
    heap: BinaryHeap<Reverse<(Time, u32)>>,
    due: Vec<Option<Time>>,
}

impl Timers {
    /// None set; keys are below `keys`.
    pub(crate) fn new(keys: usize) -> Self {
        Self { heap: BinaryHeap::new(), due: vec![None; keys] }
    }

    /// The earliest instant; of equal ones that of the smallest key.
    #[inline]
    pub(crate) fn next(&self) -> Option<(Time, u32)> {
        self.heap.peek().map(|Reverse(first)| *first)
    }

    /// A key's instant.
    #[inline]
    pub(crate) fn get(&self, key: u32) -> Option<Time> {
        self.due.get(key as usize).copied().flatten()
    }

    /// Sets a key's instant, in place of an earlier one.
    #[inline]
    pub(crate) fn set(&mut self, key: u32, at: Time) {
        let Some(due) = self.due.get_mut(key as usize) else { return };
        *due = Some(at);
        self.heap.push(Reverse((at, key)));
        self.drop_stale();
    }

    /// Forgets a key's instant.
    #[inline]
    pub(crate) fn clear(&mut self, key: u32) {
        if self.due.get_mut(key as usize).and_then(Option::take).is_some() {
            self.drop_stale();
        }
    }

    fn drop_stale(&mut self) {
        while let Some((at, key)) = self.next()
            && self.get(key) != Some(at)
        {
            self.heap.pop();
        }
        // Instants that are far off and change often would pile up behind the first.
        if self.heap.len() > 2 * self.due.len() {
            self.heap.clear();
            let set = self.due.iter().zip(0..).filter_map(|(due, key)| Some(Reverse(((*due)?, key))));
            self.heap.extend(set);
        }
    }
}

/// Outcome of a node or region, with its cause and origin.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct NodeExit {
    pub(crate) ending: NodeEnding,
    pub(crate) cause: EndCause,
    /// The step in which a failure arose.
    pub(crate) origin: NodeId,
}

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

#[cfg(test)]
mod tests {
    use super::*;
    use rand_xoshiro::SplitMix64;
    use rand_xoshiro::rand_core::{Rng as _, SeedableRng as _};

    #[test]
    fn timers_give_the_least_of_all_that_are_set() {
        let mut random = SplitMix64::seed_from_u64(1);
        let mut below = |count: u64| random.next_u64() % count;
        let (mut timers, mut plain) = (Timers::new(5), [None; 5]);
        for _ in 0..5_000 {
            let (key, at) = (below(5) as usize, Time::from_nanos(below(20)));
            if below(3) == 0 {
                timers.clear(key as u32);
                plain[key] = None;
            } else {
                timers.set(key as u32, at);
                plain[key] = Some(at);
            }
            let least = plain.iter().zip(0..).filter_map(|(at, key)| Some(((*at)?, key))).min();
            assert_eq!(timers.next(), least);
            assert_eq!(timers.get(key as u32), plain[key]);
            assert!(timers.heap.len() <= 10);
        }
    }
}
