//! The bounded store.

use crate::cleanup::PendingCleanup;
use crate::time::Time;
use crate::trace::EndCause;
use motet_graph::{Graph, NodeId, Value};
use motet_stdlib::lang;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::collections::{BTreeMap, VecDeque};
use std::fmt;
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
            questions: lang::ASKING.map(SmolStr::new_static).to_vec(),
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
    /// Cleanups of policies that are over, which have not run to their end.
    pub(super) left: Vec<PendingCleanup>,
    /// Cleanups that are due, by revision and step.
    pub(super) due: BTreeMap<(u32, NodeId), PendingCleanup>,
    pub(super) revision: u32,
    /// The graph that runs, if it has cleanups with the values of its names in their place.
    pub(super) graph: Option<Arc<Graph>>,
    pub(super) has_cleanup: bool,
    bytes: usize,
}

/// A goal that has not ended.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct OpenStep {
    /// The policy that it is a step of.
    pub(super) revision: u32,
    pub(super) node: NodeId,
    pub(super) call: String,
    /// The call as a person would write it.
    pub(super) brief: String,
    pub(super) path: String,
    pub(super) since: Time,
    /// Question to a person, for primitives that ask one.
    pub(super) question: Option<String>,
    /// Result that the driver reported.
    pub(super) result: Option<Value>,
    /// The failure that the driver named.
    pub(super) kind: Option<String>,
}

impl Memory {
    /// Remembers nothing yet.
    ///
    /// ```
    /// use motet_runtime::Time;
    /// use motet_runtime::memory::{Memory, MemoryLimits};
    ///
    /// let mut memory = Memory::new(MemoryLimits::default());
    /// memory.instruct(Time::ZERO, "bring me the mug");
    /// assert_eq!(memory.short().to_string(), "request: bring me the mug\n");
    /// ```
    #[must_use]
    pub fn new(limits: MemoryLimits) -> Self {
        Self {
            limits,
            first: None,
            latest_failure: None,
            entries: VecDeque::new(),
            dropped: DroppedCounts::default(),
            running: BTreeMap::new(),
            left: Vec::new(),
            due: BTreeMap::new(),
            revision: 0,
            graph: None,
            has_cleanup: false,
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

    /// Somebody beside the run was asked a question; `answer` is absent if nobody answered.
    pub fn asked(&mut self, at: Time, question: &str, answer: Option<&str>) {
        let (question, answer) = (self.cut(question), answer.map(|answer| self.cut(answer)));
        let entry = self.entry(at, MemoryEvent::Question { question, answer });
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

    /// Cleanups that have not run to their end: first those of policies that are over, until their calls were
    /// carried out after all, then those of the steps that run, in the order of the document.
    pub fn due(&self) -> impl Iterator<Item = &PendingCleanup> {
        self.left.iter().chain(self.due.values())
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
            MemoryEvent::Stuck { .. } | MemoryEvent::Uncleaned { .. } => &mut self.dropped.failures,
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
    use super::store::StepEnd;
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
        MemoryEvent::Uncleaned { path, steps } => path.len() + steps.iter().map(String::len).sum::<usize>(),
        MemoryEvent::Swap { policy } => policy.len(),
        MemoryEvent::Ended { how, .. } => how.len(),
    };
    ENTRY_BYTES + texts
}

/// Something that is remembered.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MemoryEntry {
    /// Time at which it was over, in seconds since the run's origin.
    pub at_secs: f64,
    /// The number of the policy that ran: 0, and one more with each swap.
    pub revision: u32,
    pub what: MemoryEvent,
}

/// Content of a memory entry.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum MemoryEvent {
    /// A person said what to do.
    Instruction {
        /// In their words.
        text: String,
    },
    /// A primitive was carried out, or tried, or could not be started.
    Step {
        /// The call, such as `pick(object: mug_1)`.
        call: String,
        /// JSON Pointer to the step in its policy.
        path: String,
        took_secs: f64,
        ended: StepEnd,
    },
    /// A step that is no call failed by itself: a wait, a loop.
    Stuck {
        /// JSON Pointer to the step in its policy.
        path: String,
        /// The failure kind.
        kind: String,
        cause: EndCause,
    },
    /// A person was asked.
    Question {
        question: String,
        /// The answer; absent if nobody answered.
        answer: Option<String>,
    },
    /// A cleanup did not run to its end.
    Uncleaned {
        /// JSON Pointer to its step in the policy.
        path: String,
        /// Its calls as a person would write them.
        steps: Vec<String>,
    },
    /// A new policy took over.
    Swap { policy: String },
    /// A run ended.
    Ended {
        /// Description of the violation.
        how: String,
        /// True if it reached what it was for.
        done: bool,
    },
}

/// Outcome of a step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum StepEnd {
    /// It did what it was for; with its result where it has one.
    Success(Option<Value>),
    Failure {
        /// The failure kind.
        kind: String,
        cause: EndCause,
    },
    /// It was interrupted.
    Interrupted(EndCause),
}

/// A step that runs now.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunningStep {
    pub call: String,
    /// JSON Pointer to the step in its policy.
    pub path: String,
    /// Since when, in seconds since the run's origin.
    pub since_secs: f64,
}

impl MemoryEntry {
    /// True if it is something that went wrong.
    #[must_use]
    pub const fn is_failure(&self) -> bool {
        match &self.what {
            MemoryEvent::Step { ended: StepEnd::Failure { .. }, .. } | MemoryEvent::Stuck { .. } => true,
            MemoryEvent::Ended { done, .. } => !*done,
            MemoryEvent::Step { ended: StepEnd::Success(_) | StepEnd::Interrupted(_), .. }
            | MemoryEvent::Instruction { .. }
            | MemoryEvent::Question { .. }
            | MemoryEvent::Uncleaned { .. }
            | MemoryEvent::Swap { .. } => false,
        }
    }
}

impl fmt::Display for MemoryEntry {
    /// A line for a prompt, without its time.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.what {
            MemoryEvent::Instruction { text } => write!(f, "instruction: {text}"),
            MemoryEvent::Step { call, ended, .. } => write!(f, "{call}: {ended}"),
            MemoryEvent::Stuck { path, kind, cause } => {
                write!(f, "step {path}: failed with {kind} ({})", cause)
            }
            MemoryEvent::Question { question, answer: Some(answer) } => {
                write!(f, "asked {question:?}: answered {answer:?}")
            }
            MemoryEvent::Question { question, answer: None } => write!(f, "asked {question:?}: no answer"),
            MemoryEvent::Uncleaned { steps, .. } => write!(f, "not cleaned up: {}", steps.join(", ")),
            MemoryEvent::Swap { policy } => write!(f, "new policy `{policy}`"),
            MemoryEvent::Ended { how, .. } => write!(f, "the policy ended: {how}"),
        }
    }
}

impl fmt::Display for StepEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Success(None) => f.write_str("done"),
            Self::Success(Some(value)) => write!(f, "done, gave {}", value),
            Self::Failure { kind, cause } => {
                write!(f, "failed with {kind} ({})", cause)
            }
            Self::Interrupted(cause) => write!(f, "interrupted ({})", cause),
        }
    }
}
