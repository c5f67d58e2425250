//! Faults of the actions of a run, counted from its journal.

use std::collections::BTreeMap;

use motet_runtime::journal::JournalEntry;
use motet_runtime::{DriverEvent, Effect, Event, GoalId, Outcome};
use motet_stdlib::lang::primitives;
use serde::{Deserialize, Serialize};

/// Calls that change what the hand or a door does: the same one again without another between is one too
/// many.
const ACTS: [&str; 5] = [primitives::PICK, "place", "handover", "open", "close"];

/// Faults of the actions of a run.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct ActionFaults {
    /// Calls of which the driver never said that it took or refused them.
    pub dropped: Vec<String>,
    /// Calls that were started although the same one ran or had just been done, or that ended twice.
    pub doubled: Vec<String>,
    /// Calls that had not ended when their run had.
    pub orphaned: Vec<String>,
}

impl ActionFaults {
    /// True without a fault.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.dropped.is_empty() && self.doubled.is_empty() && self.orphaned.is_empty()
    }

    /// Adds those of another run.
    pub fn extend(&mut self, other: Self) {
        self.dropped.extend(other.dropped);
        self.doubled.extend(other.doubled);
        self.orphaned.extend(other.orphaned);
    }
}

/// Calls of a run on the way through its journal.
#[derive(Debug, Default)]
pub struct ActionLedger {
    calls: BTreeMap<GoalId, LedgerCall>,
    /// The last act that was done.
    done: Option<String>,
    faults: ActionFaults,
}

#[derive(Debug)]
struct LedgerCall {
    text: String,
    is_act: bool,
    is_answered: bool,
    is_over: bool,
}

impl ActionLedger {
    /// Takes an entry in.
    pub fn take(&mut self, entry: &JournalEntry) {
        if let JournalEntry::Step(step) = entry
            && let Some(Event::Driver(event)) = &step.event
        {
            self.event(event);
        }
        if let Some((_, effects)) = entry.happened() {
            effects.iter().for_each(|effect| self.effect(effect));
        }
    }

    /// The faults, at the end of the journal.
    #[must_use]
    pub fn finish(mut self) -> ActionFaults {
        for call in self.calls.into_values().filter(|call| !call.is_over) {
            let of = if call.is_answered { &mut self.faults.orphaned } else { &mut self.faults.dropped };
            of.push(call.text);
        }
        self.faults
    }

    fn event(&mut self, event: &DriverEvent) {
        let Some(call) = event.goal().and_then(|goal| self.calls.get_mut(&goal)) else { return };
        call.is_answered = true;
        let is_success = match event {
            DriverEvent::Ended { outcome, .. } => matches!(outcome, Outcome::Success(_)),
            DriverEvent::Refused { .. } | DriverEvent::Stopped { .. } => false,
            _ => return,
        };
        let is_second = std::mem::replace(&mut call.is_over, true);
        // A safe stop of what has ended is answered, too.
        if is_second && !matches!(event, DriverEvent::Stopped { .. }) {
            self.faults.doubled.push(format!("{} ends twice", call.text));
        } else if is_success && call.is_act {
            self.done = Some(call.text.clone());
        }
    }

    fn effect(&mut self, effect: &Effect) {
        let (Effect::Start { goal, command, .. } | Effect::Update { goal, command, .. }) = effect else {
            return;
        };
        let text = command.to_string();
        let runs =
            |(other, call): (&GoalId, &LedgerCall)| other != goal && !call.is_over && call.text == text;
        if self.calls.iter().any(runs) || self.done.as_ref() == Some(&text) {
            self.faults.doubled.push(text.clone());
        }
        let is_act = ACTS.contains(&command.primitive.as_str());
        let before = self.calls.get(goal).is_some_and(|call| call.is_answered);
        self.calls.insert(*goal, LedgerCall { text, is_act, is_answered: before, is_over: false });
    }
}
