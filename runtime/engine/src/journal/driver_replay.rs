//! Leads a driver through a journal again: for one that is deterministic and has forgotten everything, as a
//! simulator has whose process ended.

use super::entry::{JournalEntry, StepEntry};
use crate::driver::Driver;
use crate::effect::Effect;
use crate::event::{DriverEvent, Event};
use crate::json::to_json;
use crate::time::Time;
use std::fmt;

/// Gives a driver the commands of a journal at their times, and compares what it reports with what it
/// reported then.
#[derive(Clone, Debug, Default)]
pub struct DriverReplay {
    now: Time,
}

/// The driver reports something else than it did then.
#[derive(Clone, PartialEq, Debug)]
pub struct ReplayMismatch {
    pub at: Time,
    /// Report in the journal; absent if nothing happened.
    pub journal: Option<DriverEvent>,
    /// Report of the driver now, with its time.
    pub driver: Option<(Time, DriverEvent)>,
}

impl fmt::Display for ReplayMismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "at {} the driver ", self.at)?;
        match &self.driver {
            Some((at, event)) => write!(f, "reports at {at} `{event}`")?,
            None => f.write_str("reports nothing")?,
        }
        match &self.journal {
            Some(event) => write!(f, ", and reported `{event}`"),
            None => f.write_str(", and reported nothing"),
        }
    }
}

impl DriverReplay {
    /// Takes an entry in.
    ///
    /// # Errors
    ///
    /// The driver does not do the same again.
    pub fn take(&mut self, driver: &mut dyn Driver, entry: &JournalEntry) -> Result<(), Box<ReplayMismatch>> {
        match entry {
            JournalEntry::Head(head) => {
                self.now = head.from;
                Ok(())
            }
            JournalEntry::Step(step) | JournalEntry::GaveUp(step) => self.step(driver, step),
            JournalEntry::Swap(swap) => {
                self.carry_out(driver, swap.at, &swap.effects);
                Ok(())
            }
            JournalEntry::Resumed(_) => Ok(()),
        }
    }

    fn step(&mut self, driver: &mut dyn Driver, step: &StepEntry) -> Result<(), Box<ReplayMismatch>> {
        let at = step.at;
        match &step.event {
            Some(Event::Driver(event)) => {
                let journal = event.clone();
                let report = driver.advance(at);
                // Bytes, because a NaN is not equal to itself.
                let same = |(_, now): &(Time, DriverEvent)| to_json(now) == to_json(event);
                if !report.as_ref().is_some_and(same) {
                    return Err(Box::new(ReplayMismatch { at, journal: Some(journal), driver: report }));
                }
            }
            Some(Event::Tick) if at > self.now => {
                if let Some(report) = driver.advance(at) {
                    return Err(Box::new(ReplayMismatch { at, journal: None, driver: Some(report) }));
                }
            }
            // Verdicts are none of the driver's affair.
            Some(Event::Begin | Event::Tick | Event::Verified { .. } | Event::Stop) | None => {}
        }
        self.carry_out(driver, step.at, &step.effects);
        Ok(())
    }

    fn carry_out(&mut self, driver: &mut dyn Driver, at: Time, effects: &[Effect]) {
        self.now = self.now.max(at);
        for effect in effects {
            driver.carry_out(at, effect);
        }
    }
}
