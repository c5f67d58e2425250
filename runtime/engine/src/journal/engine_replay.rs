//! Steps an engine through a journal again, and tells where what it does differs.

use super::entry::{JournalEntry, JournalHead, StepEntry, SwapEntry};
use crate::effect::Effect;
use crate::engine::Engine;
use crate::json::to_json;
use crate::swap::PreparedSwap;
use crate::time::Time;
use motet_graph::GraphDocument;
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
