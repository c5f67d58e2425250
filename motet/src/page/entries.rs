//! Entries of the journal that a run would write, from the calls of its observer.

use std::sync::Arc;

use motet_graph::Graph;
use motet_runtime::journal::{JournalEntry, StepEntry, SwapEntry};
use motet_runtime::{Effect, Event, Time};

/// Entries of a run after its head, in order.
#[derive(Debug)]
pub struct EntryTracker {
    /// Number of the next entry.
    next: u64,
    cause: Option<Cause>,
}

/// Cause of the next effects.
#[derive(Debug)]
enum Cause {
    Event(Event),
    Swap(Arc<Graph>),
    /// Nothing follows from it.
    RefusedSwap,
}

impl EntryTracker {
    /// Tracker of a run whose next entry has this number; the head has number 0.
    #[must_use]
    pub const fn from(next: u64) -> Self {
        Self { next, cause: None }
    }

    /// Takes an event that is about to be handled.
    pub fn event(&mut self, event: &Event) {
        self.cause = Some(Cause::Event(event.clone()));
    }

    /// Takes the result of a swap.
    pub fn swapped(&mut self, graph: &Arc<Graph>, is_taken: bool) {
        self.cause = Some(if is_taken { Cause::Swap(Arc::clone(graph)) } else { Cause::RefusedSwap });
    }

    /// Entry of the effects that are about to be carried out, with its number; `None` after a refused swap.
    pub fn commit(&mut self, now: Time, effects: &[Effect]) -> Option<(u64, JournalEntry)> {
        let effects = effects.to_vec();
        let entry = match self.cause.take() {
            Some(Cause::RefusedSwap) => return None,
            Some(Cause::Swap(graph)) => {
                let graph = motet_graph::encode::document(&graph);
                JournalEntry::Swap(Box::new(SwapEntry { at: now, graph, effects }))
            }
            Some(Cause::Event(event)) => {
                JournalEntry::Step(StepEntry { at: now, event: Some(event), effects })
            }
            None => JournalEntry::GaveUp(StepEntry { at: now, event: None, effects }),
        };
        let number = self.next;
        self.next += 1;
        Some((number, entry))
    }
}
