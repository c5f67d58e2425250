//! Replays of a journal: an engine is stepped through it again, and so is a driver that is deterministic and
//! has forgotten everything, as a simulator has whose process ended.

use super::entry::{JournalEntry, JournalHead, StepEntry, SwapEntry};
use crate::driver::Driver;
use crate::effect::Effect;
use crate::engine::Engine;
use crate::event::{DriverEvent, Event};
use crate::json::to_json;
use crate::swap::PreparedSwap;
use crate::time::Time;
use motet_graph::GraphDocument;
use std::fmt;
use thiserror::Error;

/// An engine on its way through a journal.
#[derive(Clone, Debug)]
pub struct EngineReplay {
    engine: Engine,
    now: Time,
    out: Vec<Effect>,
}

/// Error that stops a replay.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum ReplayError {
    /// The graph in the journal was changed, or is of another version.
    #[error("the graph in the journal cannot be read: {0}")]
    Graph(String),
    /// The graph is not valid.
    #[error("the graph in the journal is not valid: {0}")]
    Invalid(String),
    /// A swap that was accepted then is refused now.
    #[error("the engine refuses the policy that took over: {0}")]
    Refused(String),
}

/// First difference between a replay and its journal.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct EffectMismatch {
    /// The place of the first effect that differs, from 0.
    pub index: usize,
    /// The effect in the journal, as JSON; none where the replay has more.
    pub journal: Option<String>,
    /// The effect of the replay; none where the journal has more.
    pub replay: Option<String>,
}

impl EngineReplay {
    /// An engine made from a head.
    ///
    /// # Errors
    ///
    /// The graph cannot be used.
    pub fn new(head: &JournalHead) -> Result<Self, ReplayError> {
        let graph = graph(&head.graph)?;
        let engine = Engine::new(graph, &head.start).map_err(|wrong| {
            ReplayError::Invalid(wrong.first().map_or_else(String::new, ToString::to_string))
        })?;
        let engine = engine.with_settings(head.settings).with_capabilities(head.capabilities.clone());
        Ok(Self { engine, now: head.from, out: Vec::new() })
    }

    /// Takes an entry in. Gives the first difference between the effects in it and those of the engine, as
    /// bytes.
    ///
    /// # Errors
    ///
    /// It is a swap that the engine refuses.
    pub fn take(&mut self, entry: &JournalEntry) -> Result<Option<EffectMismatch>, ReplayError> {
        self.out.clear();
        match entry {
            JournalEntry::Head(_) | JournalEntry::Resumed(_) => Ok(None),
            JournalEntry::Step(step) | JournalEntry::GaveUp(step) => {
                self.step(step);
                Ok(self.compare(&step.effects))
            }
            JournalEntry::Swap(swap) => {
                self.swap(swap)?;
                Ok(self.compare(&swap.effects))
            }
        }
    }

    /// The engine as it is now.
    #[must_use]
    pub const fn engine(&self) -> &Engine {
        &self.engine
    }

    /// The time of the last entry.
    #[must_use]
    pub const fn now(&self) -> Time {
        self.now
    }

    /// The effects of the last entry.
    #[must_use]
    pub fn effects(&self) -> &[Effect] {
        &self.out
    }

    /// The engine, to go on with.
    #[must_use]
    pub fn into_engine(self) -> Engine {
        self.engine
    }

    fn step(&mut self, step: &StepEntry) {
        self.now = step.at;
        match &step.event {
            Some(event) => self.engine.handle(self.now, event.clone(), &mut self.out),
            None => self.engine.give_up(&mut self.out),
        }
    }

    fn swap(&mut self, swap: &SwapEntry) -> Result<(), ReplayError> {
        self.now = swap.at;
        let prepared = PreparedSwap::new(graph(&swap.graph)?, &self.engine.running());
        let result = prepared.and_then(|prepared| self.engine.swap(self.now, prepared, &mut self.out));
        result.map(drop).map_err(|refusal| ReplayError::Refused(refusal.to_string()))
    }

    fn compare(&self, journal: &[Effect]) -> Option<EffectMismatch> {
        let length = journal.len().max(self.out.len());
        (0..length).find_map(|index| {
            let was = journal.get(index).map(to_json);
            let is = self.out.get(index).map(to_json);
            (was != is).then_some(EffectMismatch { index, journal: was, replay: is })
        })
    }
}

fn graph(document: &GraphDocument) -> Result<motet_graph::Graph, ReplayError> {
    motet_graph::encode::from_document(document.clone())
        .map_err(|error| ReplayError::Graph(error.to_string()))
}

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
            // Verdicts and conclusions of the host are none of the driver's affair.
            Some(Event::Begin | Event::Tick | Event::Verified { .. } | Event::Noticed { .. }) | None => {}
            Some(Event::Hold | Event::Proceed | Event::Stop) => {}
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
