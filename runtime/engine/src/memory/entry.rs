//! One thing that is remembered.

use crate::trace::EndCause;
use motet_graph::Value;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

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
