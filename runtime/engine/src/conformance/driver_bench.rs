//! A driver under test: calls it, hears it, and checks what holds of every report.

use super::law::{Law, LawViolation};
use crate::driver::Driver;
use crate::effect::Command;
use crate::event::DriverEvent;
use crate::ids::GoalId;
use crate::time::Time;
use std::collections::{BTreeMap, BTreeSet};

/// The most reports in one scene; a driver that says more does not get anywhere.
const MAX_REPORTS: usize = 10_000;

pub(super) struct DriverBench {
    pub(super) driver: Box<dyn Driver>,
    pub(super) now: Time,
    pub(super) log: Vec<(Time, DriverEvent)>,
    pub(super) breaches: BTreeSet<LawViolation>,
    goals: BTreeMap<GoalId, GoalLog>,
}

/// Reports of a goal so far.
#[derive(Clone, Copy, Debug, Default)]
struct GoalLog {
    acknowledged: bool,
    ended: bool,
    /// Safe stops that are not answered.
    stops: u32,
}

impl DriverBench {
    pub(super) fn new(driver: Box<dyn Driver>) -> Self {
        let (log, breaches) = (Vec::new(), BTreeSet::new());
        Self { driver, now: Time::ZERO, log, breaches, goals: BTreeMap::new() }
    }

    pub(super) fn start(&mut self, command: &Command) -> GoalId {
        let goal = self.unheard_of();
        self.driver.start(self.now, goal, command);
        goal
    }

    /// A goal that was never started.
    pub(super) fn unheard_of(&mut self) -> GoalId {
        let goal = GoalId::from_number((self.goals.len() as u64 + 1) << crate::ids::SLOT_BITS);
        self.goals.insert(goal, GoalLog::default());
        goal
    }

    pub(super) fn safe_stop(&mut self, goal: GoalId) {
        if let Some(said) = self.goals.get_mut(&goal) {
            said.stops += 1;
        }
        self.driver.safe_stop(self.now, goal);
    }

    /// Hears reports for a span, or until one is such.
    pub(super) fn until(&mut self, span: Time, wanted: impl Fn(&DriverEvent) -> bool) -> Option<DriverEvent> {
        let end = self.now.after(span);
        while self.log.len() < MAX_REPORTS {
            let Some((at, event)) = self.driver.advance(end) else { break };
            if at < self.now || at > end {
                self.breach(Law::Time, format!("`{event}` at {at}, not between {} and {end}", self.now));
            }
            self.now = at.max(self.now).min(end);
            self.log.push((at, event.clone()));
            self.judge(&event);
            if wanted(&event) {
                return Some(event);
            }
        }
        self.now = end;
        None
    }

    /// True if a goal is acknowledged within a span. It is a breach where there is no answer.
    pub(super) fn runs(&mut self, goal: GoalId, span: Time) -> bool {
        match self.until(span, |event| matters(event, goal)) {
            Some(DriverEvent::Acknowledged { .. }) => true,
            Some(_) => false,
            None => {
                self.breach(Law::Answered, format!("goal {goal} is neither after {span}"));
                false
            }
        }
    }

    pub(super) fn has_ended(&self, goal: GoalId) -> bool {
        self.goals.get(&goal).is_some_and(|said| said.ended)
    }

    pub(super) fn breach(&mut self, law: Law, told: String) {
        self.breaches.insert(LawViolation { law, told });
    }

    fn judge(&mut self, event: &DriverEvent) {
        let Some(said) = of(event).and_then(|goal| self.goals.get_mut(&goal)) else { return };
        let before = *said;
        let (mut is_stop, mut is_end) = (false, false);
        match event {
            DriverEvent::Acknowledged { .. } => said.acknowledged = true,
            DriverEvent::Refused { .. } | DriverEvent::Ended { .. } => {
                said.ended = true;
                is_end = true;
            }
            DriverEvent::Stopped { .. } => {
                is_stop = said.stops > 0;
                said.stops = said.stops.saturating_sub(1);
                said.ended = true;
            }
            DriverEvent::NotHeld { .. } | DriverEvent::Feedback { .. } | DriverEvent::Lost { .. } => {}
            DriverEvent::DriverLost | DriverEvent::Observed { .. } => {}
        }
        if before.ended && !is_stop {
            let law = if is_end { Law::EndsOnce } else { Law::SilentAfterEnd };
            self.breach(law, format!("`{event}` after its end"));
        } else if before.acknowledged
            && matches!(event, DriverEvent::Refused { .. } | DriverEvent::Acknowledged { .. })
        {
            self.breach(Law::Answered, format!("`{event}` though it was acknowledged"));
        }
    }
}

/// The goal that an event is about.
pub(super) const fn of(event: &DriverEvent) -> Option<GoalId> {
    match event {
        DriverEvent::Acknowledged { goal }
        | DriverEvent::Refused { goal, .. }
        | DriverEvent::Ended { goal, .. }
        | DriverEvent::NotHeld { goal }
        | DriverEvent::Feedback { goal, .. }
        | DriverEvent::Stopped { goal }
        | DriverEvent::Lost { goal } => Some(*goal),
        DriverEvent::DriverLost | DriverEvent::Observed { .. } => None,
    }
}

/// True if an event says something of a goal that is more than words.
pub(super) fn matters(event: &DriverEvent, goal: GoalId) -> bool {
    of(event) == Some(goal) && !matches!(event, DriverEvent::Feedback { .. })
}

/// True if an event ends a goal.
pub(super) fn ends(event: &DriverEvent, goal: GoalId) -> bool {
    let is_end = match event {
        DriverEvent::Ended { .. } | DriverEvent::Stopped { .. } | DriverEvent::Refused { .. } => true,
        DriverEvent::Acknowledged { .. } | DriverEvent::NotHeld { .. } | DriverEvent::Lost { .. } => false,
        DriverEvent::Feedback { .. } | DriverEvent::DriverLost | DriverEvent::Observed { .. } => false,
    };
    is_end && of(event) == Some(goal)
}
