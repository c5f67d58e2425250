//! After a crash of the host: what a driver that went on, or was started anew, knows of the goals that are
//! open.

use super::driver::RemoteDriver;
use super::link::LinkError;
use super::protocol::GoalStatus;
use motet_runtime::journal::{OpenGoal, OpenGoals};
use motet_runtime::{Driver, DriverEvent, Effect, Event, GoalId, Time};
use std::collections::BTreeMap;

impl RemoteDriver {
    /// Asks what became of the goals that are open by the journal, says again what it was told of those that
    /// have not ended, and gives the events with which the engine goes on. `instance` is the driver's that
    /// the run began with.
    ///
    /// Commands can be said twice, and what was written down last before a crash may never have been said.
    ///
    /// A goal of which the driver has never heard was not started, if it is the same driver and the start was
    /// the last thing that was written down: then it is started now. Any other one is lost, and the engine
    /// has it stopped safely.
    ///
    /// # Errors
    ///
    /// It does not say.
    pub fn catch_up(
        &mut self,
        ledger: &OpenGoals,
        instance: &str,
        now: Time,
    ) -> Result<Vec<Event>, LinkError> {
        let told = self.status(ledger.goals.keys().copied().collect())?;
        let states: BTreeMap<GoalId, GoalStatus> =
            told.goals.into_iter().map(|told| (told.goal, told.state)).collect();
        let is_same = self.welcome().instance == instance;
        let mut events = Vec::new();
        for (&goal, open) in &ledger.goals {
            let just_started = ledger
                .uncertain
                .iter()
                .any(|effect| matches!(effect, Effect::Start { goal: started, .. } if *started == goal));
            match states.get(&goal) {
                Some(GoalStatus::Running) => {
                    events.push(DriverEvent::Acknowledged { goal });
                    self.say_again(now, goal, open);
                }
                Some(GoalStatus::Ended(outcome)) => {
                    let outcome = self.named(outcome.clone());
                    events.push(DriverEvent::Ended { goal, outcome });
                }
                Some(GoalStatus::Refused(failure)) => {
                    events.push(DriverEvent::Refused { goal, failure: self.kind(failure) });
                }
                Some(GoalStatus::Stopped) => events.push(DriverEvent::Stopped { goal }),
                Some(GoalStatus::Unknown) if is_same && just_started => {
                    self.start(now, goal, &open.command);
                }
                // Whoever is asked again for a safe stop brings it about, also for what was started by
                // another.
                Some(GoalStatus::Unknown) | None if matches!(open.told, Some(Effect::SafeStop { .. })) => {
                    self.say_again(now, goal, open);
                }
                Some(GoalStatus::Unknown) | None => events.push(DriverEvent::Lost { goal }),
            }
        }
        for query in &ledger.watches {
            self.watch(now, query);
        }
        for query in &ledger.observations {
            self.observe(now, query);
        }
        Ok(events.into_iter().map(Event::Driver).collect())
    }

    fn say_again(&mut self, now: Time, goal: GoalId, open: &OpenGoal) {
        if open.updated {
            self.update(now, goal, &open.command);
        }
        if let Some(told) = &open.told {
            self.carry_out(now, told);
        }
    }
}
