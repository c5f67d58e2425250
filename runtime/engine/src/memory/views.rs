//! Views of a memory. Each view is data for a program and, by `Display`, lines for a prompt.

use super::store::{DroppedCounts, Memory, MemoryEntry, MemoryEvent, RunningStep};
use crate::cleanup::PendingCleanup;
use crate::snapshot::Snapshot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The short history: the first request and the latest failure.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct ShortHistory {
    pub request: Option<String>,
    pub failure: Option<MemoryEntry>,
}

/// The working memory: the state, and what was done so far.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct WorkingMemory {
    pub request: Option<String>,
    /// Facts that hold (`true`), do not hold (`false`), or are unknown although a related fact is known
    /// (`null`).
    pub state: Vec<(String, Option<bool>)>,
    /// Names that are bound, with their values as the language writes them.
    pub bindings: Vec<(String, String)>,
    /// Steps that are over, questions and new policies, oldest first.
    pub done: Vec<MemoryEntry>,
    /// Number of dropped entries before the first.
    pub dropped: u64,
    pub doing: Vec<RunningStep>,
    /// Cleanups that have not run to their end and would still be due.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pending: Vec<PendingCleanup>,
}

/// Everything that is remembered.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct FullMemory {
    pub first_instruction: Option<MemoryEntry>,
    pub latest_failure: Option<MemoryEntry>,
    /// All entries that are kept, oldest first.
    pub entries: Vec<MemoryEntry>,
    /// Numbers of dropped entries.
    pub dropped: DroppedCounts,
    pub doing: Vec<RunningStep>,
    /// The engine's state.
    pub state: Snapshot,
}

impl Memory {
    /// The first request and the latest failure.
    #[must_use]
    pub fn short(&self) -> ShortHistory {
        ShortHistory {
            request: self.first.as_ref().and_then(instruction),
            failure: self.latest_failure.clone(),
        }
    }

    /// The state and the executed steps. The state is the engine's ([`crate::Engine::snapshot`]).
    #[must_use]
    pub fn working(&self, state: &Snapshot) -> WorkingMemory {
        let is_done = |entry: &&MemoryEntry| !matches!(entry.what, MemoryEvent::Instruction { .. });
        let latest = self.entries.iter().rev().find_map(instruction);
        let DroppedCounts { instructions: _, steps, failures, questions, swaps, endings } = self.dropped;
        WorkingMemory {
            request: latest.or_else(|| self.first.as_ref().and_then(instruction)),
            state: state.state(),
            bindings: state
                .bindings
                .iter()
                .map(|(name, value)| (name.to_string(), self.cut(&value.to_string())))
                .collect(),
            done: self.entries.iter().filter(is_done).cloned().collect(),
            dropped: steps + failures + questions + swaps + endings,
            doing: self.running().collect(),
            pending: state.pending.clone(),
        }
    }

    /// Everything, with the engine's state.
    #[must_use]
    pub fn whole(&self, state: &Snapshot) -> FullMemory {
        FullMemory {
            first_instruction: self.first.clone(),
            latest_failure: self.latest_failure.clone(),
            entries: self.entries.iter().cloned().collect(),
            dropped: self.dropped,
            doing: self.running().collect(),
            state: state.clone(),
        }
    }
}

fn instruction(entry: &MemoryEntry) -> Option<String> {
    match &entry.what {
        MemoryEvent::Instruction { text } => Some(text.clone()),
        MemoryEvent::Step { .. } | MemoryEvent::Stuck { .. } | MemoryEvent::Question { .. } => None,
        MemoryEvent::Uncleaned { .. } | MemoryEvent::Swap { .. } | MemoryEvent::Ended { .. } => None,
    }
}

impl fmt::Display for ShortHistory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(request) = &self.request {
            writeln!(f, "request: {request}")?;
        }
        if let Some(failure) = &self.failure {
            writeln!(f, "latest failure: {failure}")?;
        }
        Ok(())
    }
}

impl fmt::Display for WorkingMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(request) = &self.request {
            writeln!(f, "request: {request}")?;
        }
        for (fact, holds) in &self.state {
            let word = match holds {
                Some(true) => "true",
                Some(false) => "false",
                None => "unknown",
            };
            writeln!(f, "state: {fact} is {word}")?;
        }
        for (name, value) in &self.bindings {
            writeln!(f, "bound: {name} = {value}")?;
        }
        if self.dropped > 0 {
            writeln!(f, "done: {} earlier entries are left out", self.dropped)?;
        }
        for entry in &self.done {
            writeln!(f, "done: {entry}")?;
        }
        for doing in &self.doing {
            writeln!(f, "doing: {}", doing.call)?;
        }
        for pending in &self.pending {
            writeln!(f, "to clean up: {pending}")?;
        }
        Ok(())
    }
}
