//! What a driver was asked for and has not answered yet, at the end of a journal: what to ask it about after a crash.

use super::entry::Entry;
use crate::wire::{DriverEvent, Effect, Event, Query, Start};
use std::collections::BTreeMap;

/// What is open between the engine and its driver.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Ledger {
    /// Goals that have not ended, by number.
    pub goals: BTreeMap<u64, Open>,
    /// What is watched, in order.
    pub watches: Vec<Query>,
    /// Observations that were not answered, in order.
    pub observations: Vec<Query>,
    /// Commands of the last entry. Whether they reached the driver, the journal cannot know.
    pub uncertain: Vec<Effect>,
    /// Whether the run is over.
    pub is_over: bool,
}

/// A goal that has not ended.
#[derive(Clone, PartialEq, Debug)]
pub struct Open {
    /// What it does.
    pub start: Start,
    /// Whether the driver said that it runs.
    pub acknowledged: bool,
    /// Whether it was told to hold.
    pub held: bool,
    /// Whether it was told to end early.
    pub cancelled: bool,
    /// Whether it was told to stop safely.
    pub stopping: bool,
}

impl Ledger {
    /// Takes an entry in.
    pub fn take(&mut self, entry: &Entry) {
        match entry {
            Entry::Head(_) | Entry::Resumed(_) => {}
            Entry::Step(step) | Entry::GaveUp(step) => {
                if let Some(Event::Driver(event)) = &step.event {
                    self.event(event);
                }
                self.uncertain.clear();
                step.effects.iter().for_each(|effect| self.effect(effect));
            }
            Entry::Swap(swap) => {
                self.uncertain.clear();
                swap.effects.iter().for_each(|effect| self.effect(effect));
            }
        }
    }

    fn event(&mut self, event: &DriverEvent) {
        match event {
            DriverEvent::Acknowledged { goal } => {
                self.with(*goal, |open| open.acknowledged = true);
            }
            DriverEvent::Refused { goal, .. }
            | DriverEvent::Ended { goal, .. }
            | DriverEvent::Stopped { goal } => {
                self.goals.remove(goal);
            }
            DriverEvent::NotHeld { goal } => self.with(*goal, |open| open.held = false),
            DriverEvent::Observed { query, .. } => self.observations.retain(|asked| asked != query),
            DriverEvent::Lost { .. } | DriverEvent::DriverLost => {}
        }
    }

    fn effect(&mut self, effect: &Effect) {
        match effect {
            Effect::Start(start) => {
                let (acknowledged, held, cancelled, stopping) = (false, false, false, false);
                let open = Open { start: start.clone(), acknowledged, held, cancelled, stopping };
                self.goals.insert(start.goal, open);
            }
            Effect::Update(start) => self.with(start.goal, |open| open.start = start.clone()),
            Effect::Cancel { goal } => self.with(*goal, |open| open.cancelled = true),
            Effect::Hold { goal } => self.with(*goal, |open| open.held = true),
            Effect::Proceed { goal } => self.with(*goal, |open| open.held = false),
            Effect::SafeStop { goal } => self.with(*goal, |open| open.stopping = true),
            Effect::Observe { query } => self.observations.push(query.clone()),
            Effect::Watch { query } => {
                if !self.watches.contains(query) {
                    self.watches.push(query.clone());
                }
            }
            Effect::Unwatch { query } => self.watches.retain(|watched| watched != query),
            Effect::Finished(_) => self.is_over = true,
            Effect::Verify(_) | Effect::Report(_) => return,
        }
        if !self.is_over {
            self.uncertain.push(effect.clone());
        }
    }

    fn with(&mut self, goal: u64, change: impl FnOnce(&mut Open)) {
        if let Some(open) = self.goals.get_mut(&goal) {
            change(open);
        }
    }
}
