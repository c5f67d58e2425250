//! The bounded store.

use super::entry::{MemoryEntry, MemoryEvent, RunningStep};
use super::feed::OpenStep;
use crate::time::Time;
use motet_graph::Graph;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Size of an entry beside its texts in bytes.
const ENTRY_BYTES: usize = 64;

/// Limits of a memory.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MemoryLimits {
    /// The most entries. The first instruction and the latest failure are kept beside them.
    pub entries: usize,
    /// The most bytes of all entries, texts and 64 for each.
    pub bytes: usize,
    /// The longest text in bytes; what is longer is cut and ends in `…`.
    pub text_bytes: usize,
    /// The most steps that run at once; the oldest is forgotten.
    pub running: usize,
    /// Primitives that ask a person something; their parameter `question` is what.
    pub questions: Vec<SmolStr>,
}

impl Default for MemoryLimits {
    /// 256 entries of 64 KiB in all, texts of 2 KiB, 128 running steps; `ask` and `choose` are questions.
    fn default() -> Self {
        Self {
            entries: 256,
            bytes: 64 * 1024,
            text_bytes: 2 * 1024,
            running: 128,
            questions: vec![SmolStr::new_static("ask"), SmolStr::new_static("choose")],
        }
    }
}

/// Numbers of entries that were dropped, oldest first, to stay within the limits.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
pub struct DroppedCounts {
    pub instructions: u64,
    /// Steps that did not fail.
    pub steps: u64,
    /// Failures of steps.
    pub failures: u64,
    pub questions: u64,
    pub swaps: u64,
    /// Ends of runs.
    pub endings: u64,
}

/// Bounded memory of a run. See the [module](super).
#[derive(Clone, Debug)]
pub struct Memory {
    pub(super) limits: MemoryLimits,
    pub(super) first: Option<MemoryEntry>,
    pub(super) latest_failure: Option<MemoryEntry>,
    pub(super) entries: VecDeque<MemoryEntry>,
    pub(super) dropped: DroppedCounts,
    pub(super) running: BTreeMap<u64, OpenStep>,
    pub(super) revision: u32,
    pub(super) graph: Option<Arc<Graph>>,
    bytes: usize,
}

impl Memory {
    /// Remembers nothing yet.
    #[must_use]
    pub fn new(limits: MemoryLimits) -> Self {
        Self {
            limits,
            first: None,
            latest_failure: None,
            entries: VecDeque::new(),
            dropped: DroppedCounts::default(),
            running: BTreeMap::new(),
            revision: 0,
            graph: None,
            bytes: 0,
        }
    }

    /// A person said what to do. The first instruction is never dropped.
    pub fn instruct(&mut self, at: Time, text: &str) {
        let text = self.cut(text);
        let entry = self.entry(at, MemoryEvent::Instruction { text });
        if self.first.is_none() {
            self.first = Some(entry.clone());
        }
        self.push(entry);
    }

    /// The entries that are kept, oldest first.
    pub fn entries(&self) -> impl ExactSizeIterator<Item = &MemoryEntry> {
        self.entries.iter()
    }

    /// Numbers of dropped entries.
    #[must_use]
    pub const fn dropped(&self) -> DroppedCounts {
        self.dropped
    }

    /// Bytes that the kept entries count for.
    #[must_use]
    pub const fn bytes(&self) -> usize {
        self.bytes
    }

    /// The first instruction.
    #[must_use]
    pub const fn first_instruction(&self) -> Option<&MemoryEntry> {
        self.first.as_ref()
    }

    /// The latest failure.
    #[must_use]
    pub const fn latest_failure(&self) -> Option<&MemoryEntry> {
        self.latest_failure.as_ref()
    }

    /// Running steps in the order of their starts.
    pub fn running(&self) -> impl Iterator<Item = RunningStep> + '_ {
        self.running.values().map(|open| RunningStep {
            call: open.call.clone(),
            path: open.path.clone(),
            since_secs: open.since.secs(),
        })
    }

    pub(super) fn entry(&self, at: Time, what: MemoryEvent) -> MemoryEntry {
        MemoryEntry { at_secs: at.secs(), revision: self.revision, what }
    }

    pub(super) fn push(&mut self, entry: MemoryEntry) {
        if entry.is_failure() {
            self.latest_failure = Some(entry.clone());
        }
        self.bytes += size(&entry);
        self.entries.push_back(entry);
        while self.entries.len() > self.limits.entries || self.bytes > self.limits.bytes {
            let Some(oldest) = self.entries.pop_front() else { return };
            self.bytes = self.bytes.saturating_sub(size(&oldest));
            self.count(&oldest);
        }
    }

    fn count(&mut self, entry: &MemoryEntry) {
        let counter = match &entry.what {
            MemoryEvent::Instruction { .. } => &mut self.dropped.instructions,
            MemoryEvent::Step { .. } if entry.is_failure() => &mut self.dropped.failures,
            MemoryEvent::Step { .. } => &mut self.dropped.steps,
            MemoryEvent::Stuck { .. } => &mut self.dropped.failures,
            MemoryEvent::Question { .. } => &mut self.dropped.questions,
            MemoryEvent::Swap { .. } => &mut self.dropped.swaps,
            MemoryEvent::Ended { .. } => &mut self.dropped.endings,
        };
        *counter += 1;
    }

    /// A text within the limit.
    pub(super) fn cut(&self, text: &str) -> String {
        const MARK: &str = "…";
        if text.len() <= self.limits.text_bytes {
            return text.to_owned();
        }
        let end = text.floor_char_boundary(self.limits.text_bytes.saturating_sub(MARK.len()));
        let kept = text.get(..end).unwrap_or_default();
        format!("{kept}{MARK}")
    }
}

fn size(entry: &MemoryEntry) -> usize {
    use super::entry::StepEnd;
    let texts = match &entry.what {
        MemoryEvent::Instruction { text } => text.len(),
        MemoryEvent::Step { call, path, ended, .. } => {
            let ended = match ended {
                StepEnd::Success(Some(value)) => crate::json::to_json(value).len(),
                StepEnd::Failure { kind, .. } => kind.len(),
                StepEnd::Success(None) | StepEnd::Interrupted(_) => 0,
            };
            call.len() + path.len() + ended
        }
        MemoryEvent::Stuck { path, kind, .. } => path.len() + kind.len(),
        MemoryEvent::Question { question, answer } => {
            question.len() + answer.as_ref().map_or(0, |answer| answer.len())
        }
        MemoryEvent::Swap { policy } => policy.len(),
        MemoryEvent::Ended { how, .. } => how.len(),
    };
    ENTRY_BYTES + texts
}
