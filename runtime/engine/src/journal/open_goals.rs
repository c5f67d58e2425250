//! Open goals: commands that a driver has not answered at the end of a journal, to be clarified after a
//! crash.

use super::entry::JournalEntry;
use crate::effect::{Command, Effect};
use crate::event::{DriverEvent, Event};
use crate::ids::GoalId;
use crate::query::Query;
use std::collections::BTreeMap;
use std::sync::Arc;

/// Unanswered commands between the engine and its driver.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct OpenGoals {
    /// Goals that have not ended, by number.
    pub goals: BTreeMap<GoalId, OpenGoal>,
    /// Watched queries in order.
    pub watches: Vec<Query>,
    /// Observations that were not answered, in order.
    pub observations: Vec<Query>,
    /// Commands of the last entry. Whether they reached the driver, the journal cannot know.
    pub uncertain: Vec<Effect>,
    /// True if the run is over.
    pub is_over: bool,
}

/// A goal that has not ended.
#[derive(Clone, PartialEq, Debug)]
pub struct OpenGoal {
    pub command: Arc<Command>,
    /// True if it was given new arguments since.
    pub updated: bool,
    /// Last command about its progress: hold, proceed, cancel or safe stop.
    pub told: Option<Effect>,
}

impl OpenGoals {
    /// Takes an entry in.
    pub fn take(&mut self, entry: &JournalEntry) {
        match entry {
            JournalEntry::Head(_) | JournalEntry::Resumed(_) => {}
            JournalEntry::Step(step) | JournalEntry::GaveUp(step) => {
                if let Some(Event::Driver(event)) = &step.event {
                    self.event(event);
                }
                self.uncertain.clear();
                step.effects.iter().for_each(|effect| self.effect(effect));
            }
            JournalEntry::Swap(swap) => {
                self.uncertain.clear();
                swap.effects.iter().for_each(|effect| self.effect(effect));
            }
        }
    }

    fn event(&mut self, event: &DriverEvent) {
        match event {
            DriverEvent::Refused { goal, .. }
            | DriverEvent::Ended { goal, .. }
            | DriverEvent::Stopped { goal } => {
                self.goals.remove(goal);
            }
            DriverEvent::NotHeld { goal } => self.with(*goal, |open| open.told = None),
            DriverEvent::Observed { query, .. } => self.observations.retain(|asked| asked != query),
            DriverEvent::Acknowledged { .. } | DriverEvent::Feedback { .. } => {}
            DriverEvent::Lost { .. } | DriverEvent::DriverLost => {}
        }
    }

    fn effect(&mut self, effect: &Effect) {
        match effect {
            Effect::Start { goal, command, .. } => {
                let open = OpenGoal { command: Arc::clone(command), updated: false, told: None };
                self.goals.insert(*goal, open);
            }
            Effect::Update { goal, command, .. } => {
                self.with(*goal, |open| (open.command, open.updated) = (Arc::clone(command), true));
            }
            Effect::Cancel { goal }
            | Effect::Hold { goal }
            | Effect::Proceed { goal }
            | Effect::SafeStop { goal } => self.with(*goal, |open| open.told = Some(effect.clone())),
            Effect::Observe { query } => self.observations.push(Query::clone(query)),
            Effect::Watch { query } => {
                if !self.watches.contains(query) {
                    self.watches.push(Query::clone(query));
                }
            }
            Effect::Unwatch { query } => self.watches.retain(|watched| *watched != **query),
            Effect::Finished(_) => self.is_over = true,
            Effect::Verify { .. } | Effect::Report(_) => return,
        }
        if !self.is_over {
            self.uncertain.push(effect.clone());
        }
    }

    fn with(&mut self, goal: GoalId, change: impl FnOnce(&mut OpenGoal)) {
        if let Some(open) = self.goals.get_mut(&goal) {
            change(open);
        }
    }
}
