//! Trace events: the transitions of a run, for journals and for people.

use crate::event::Verification;
use crate::ids::GoalId;
use crate::query::Truth;
use crate::time::Time;
use motet_graph::{BindingId, FailureId, NodeId, Value};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something that happened in a run.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TraceEvent {
    pub at: Time,
    /// The number of the graph that its ids belong to: 0, and one more with each swap.
    pub revision: u32,
    pub what: TraceEventKind,
}

/// Kind of a trace event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum TraceEventKind {
    /// A step was entered.
    Entered { node: NodeId },
    /// A step ended.
    Ended { node: NodeId, ending: NodeEnding, cause: EndCause },
    /// A call was started, for the first time, after a failure, or after an interruption.
    Started {
        node: NodeId,
        /// The new goal.
        goal: GoalId,
        /// 1 for the first attempt, one more with each retry.
        attempt: u32,
    },
    /// A goal ended without ending its step: it failed and is tried again, or was interrupted and goes on
    /// later.
    GoalEnded { node: NodeId, goal: GoalId, ending: NodeEnding, cause: EndCause },
    /// A guard was checked.
    Guard {
        node: NodeId,
        /// Its place in the call's `needs`.
        need: u32,
        /// Result; unknown counts as false.
        truth: Truth,
    },
    /// The verdict on a call's motion came, which the compiler had left to the run.
    Verified { node: NodeId, verdict: Box<Verification> },
    /// The test of an `if` or an `until` came out.
    Tested {
        node: NodeId,
        /// Result; unknown counts as false.
        truth: Truth,
    },
    /// The goal of the policy was observed, before the run ended as done.
    GoalObserved {
        /// False if a part of it is false, unknown if a part of it is unknown and none is false.
        truth: Truth,
    },
    /// A cleanup failed. What it stands behind ends as it would have otherwise.
    CleanupFailed { node: NodeId, failure: FailureId },
    /// A cleanup does not run, or not to its end: a person stopped the run, or the driver interrupted or lost
    /// what it did.
    CleanupSkipped { node: NodeId },
    /// A monitor fired.
    Fired {
        node: NodeId,
        /// The place of the watch in the monitor.
        watch: u32,
        /// True if the condition held; unknown if it was unknown for too long.
        truth: Truth,
    },
    /// The body of a monitor continues after a hold or an interruption.
    WentOn {
        node: NodeId,
        /// The place of the watch in the monitor.
        watch: u32,
    },
    /// A new policy has taken over. Its ids are those of this record's revision.
    Swapped { policy: Box<str> },
    /// A goal that the old policy started goes on for a step of the new one, untouched.
    Kept {
        /// The call in the new policy.
        node: NodeId,
        goal: GoalId,
    },
    /// A goal that the old policy started goes on for a step of the new one, with new arguments.
    Updated {
        /// The call in the new policy.
        node: NodeId,
        goal: GoalId,
    },
    /// A name was bound.
    Bound { binding: BindingId, value: Box<Value> },
}

/// Outcome of a step or a goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NodeEnding {
    /// It did what it was for.
    Success,
    /// It failed; [`crate::Engine::failure`] names the kind.
    Failure(FailureId),
    /// It was interrupted: neither a success nor a failure.
    Interrupted,
}

/// Cause of an end.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EndCause {
    /// It ran to its end.
    Completed,
    /// The primitive failed, or something within failed and was not caught.
    Failed,
    /// The driver did not accept it.
    Refused,
    /// A guard did not hold, or could not be known.
    GuardRefuted,
    /// It took too long.
    Deadline,
    /// A bound on a loop or a monitor was reached.
    Exhausted,
    /// A result does not fit its declared type, or a required value could not be observed.
    BadValue,
    /// A monitor fired.
    Monitor,
    /// Another branch of its parallel failed.
    SiblingFailed,
    /// The policy or sub-policy that it belongs to has ended.
    ParentEnded,
    /// A person stopped the run.
    Person,
    /// The driver interrupted it of its own accord.
    Driver,
    /// The policy was replaced.
    Swap,
    /// The driver lost it, and stopped safely what it may have moved.
    Lost,
}

impl std::fmt::Display for EndCause {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Completed => "completed",
            Self::Failed => "failed",
            Self::Refused => "refused by the driver",
            Self::GuardRefuted => "guard refuted",
            Self::Deadline => "deadline",
            Self::Exhausted => "bound reached",
            Self::BadValue => "bad or missing value",
            Self::Monitor => "monitor",
            Self::SiblingFailed => "another branch failed",
            Self::ParentEnded => "the policy ended",
            Self::Person => "a person",
            Self::Driver => "the driver",
            Self::Swap => "a new policy",
            Self::Lost => "lost by the driver",
        })
    }
}
