//! Events: the engine's only source of knowledge about the world.

use crate::ids::{CheckId, GoalId};
use crate::query::{Answer, Query};
use motet_graph::{Configuration, Value, Witness};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::fmt;

/// Input of the engine.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Event {
    /// The run begins. Events before it are ignored, and so is a second one.
    Begin,
    /// Nothing but time has passed.
    Tick,
    /// The driver reports.
    Driver(DriverEvent),
    /// The verdict on a motion, to [`crate::Effect::Verify`].
    Verified { check: CheckId, verdict: Verification },
    /// The host concludes a fact from what the driver detected. It counts as an observation.
    Noticed { query: Query, answer: Answer },
    /// A person wants everything to keep still until [`Event::Proceed`], or until another policy takes over.
    Hold,
    /// A person lets everything go on after [`Event::Hold`].
    Proceed,
    /// A person stops the run: everything is interrupted, and the run ends as [`crate::RunEnd::Interrupted`].
    Stop,
}

/// Report of a driver. Events about a goal that is not live are ignored.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum DriverEvent {
    /// The goal was accepted and runs.
    Acknowledged { goal: GoalId },
    /// The goal was not accepted; nothing has moved. It ends in this failure.
    Refused { goal: GoalId, failure: FailureReport },
    /// The goal has ended and holds none of its resources any longer. Without an acknowledgement before it,
    /// it counts as one too.
    Ended {
        goal: GoalId,
        /// A cancelled goal may still end in success or failure, and that is respected.
        outcome: Outcome,
    },
    /// The driver cannot hold this goal: the engine cancels it and starts it again later.
    NotHeld { goal: GoalId },
    /// Progress of the goal in words for people; without effect on the run.
    Feedback {
        goal: GoalId,
        text: SmolStr,
        /// Set where the driver planned a motion itself and does not follow the witness of the command.
        #[serde(default, skip_serializing_if = "std::ops::Not::not")]
        own_motion: bool,
    },
    /// Everything that the goal used stands still and is safe: the answer to a safe stop. The goal has ended.
    Stopped { goal: GoalId },
    /// The driver does not know what became of the goal: a start or a cancel was never answered, or what
    /// carries it out went silent. It may have moved, and may still. The engine asks for a safe stop; until
    /// that is acknowledged by [`DriverEvent::Stopped`], nobody else gets its resources.
    Lost { goal: GoalId },
    /// The driver itself is gone or speaks nonsense: every goal that is live is lost.
    DriverLost,
    /// The driver is gone for good: nobody will ever acknowledge a safe stop. The run ends with
    /// [`crate::Fault::NotStopped`] if a goal is live.
    DriverGone,
    /// An answer to an observation or a watch, or something noticed in passing. It is true at the event's
    /// time.
    Observed { query: Query, answer: Answer },
}

impl DriverEvent {
    /// The goal that it is about; none where it is about none or all.
    #[must_use]
    pub const fn goal(&self) -> Option<GoalId> {
        match self {
            Self::Acknowledged { goal } | Self::Refused { goal, .. } | Self::Ended { goal, .. } => {
                Some(*goal)
            }
            Self::NotHeld { goal }
            | Self::Feedback { goal, .. }
            | Self::Stopped { goal }
            | Self::Lost { goal } => Some(*goal),
            Self::DriverLost | Self::DriverGone | Self::Observed { .. } => None,
        }
    }
}

/// Words before the feedback of a driver that does not follow the witness.
pub const OWN_MOTION: &str = "a motion of its own: ";

/// Outcome of a goal.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Outcome {
    /// It did what it was for; with its result where its primitive has one.
    Success(Option<Value>),
    /// It failed in this way. One of the kinds that its primitive lists, or `timeout`.
    Failure(FailureReport),
    /// It was cancelled, or somebody at the robot stopped it.
    Interrupted,
}

impl fmt::Display for DriverEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Acknowledged { goal } => write!(f, "acknowledged {goal}"),
            Self::Refused { goal, failure } => write!(f, "refused {goal}: {failure}"),
            Self::Ended { goal, outcome } => write!(f, "ended {goal}: {outcome}"),
            Self::NotHeld { goal } => write!(f, "not held {goal}"),
            Self::Feedback { goal, text, own_motion } => {
                write!(f, "feedback of {goal}: {}{text}", if *own_motion { OWN_MOTION } else { "" })
            }
            Self::Stopped { goal } => write!(f, "stopped {goal}"),
            Self::Lost { goal } => write!(f, "lost {goal}"),
            Self::DriverLost => f.write_str("driver lost"),
            Self::DriverGone => f.write_str("driver gone"),
            Self::Observed { query, answer } => write!(f, "observed {query} = {answer}"),
        }
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Success(None) => f.write_str("success"),
            Self::Success(Some(value)) => write!(f, "success {value}"),
            Self::Failure(failure) => write!(f, "failure {failure}"),
            Self::Interrupted => f.write_str("interrupted"),
        }
    }
}

/// Failure of a goal as its driver reports it. In JSON its kind, or an object where it has a text.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(from = "FailureForm", into = "FailureForm")]
#[schemars(with = "FailureForm")]
pub struct FailureReport {
    /// The failure kind.
    pub kind: SmolStr,
    /// Cause in words, for people; a clause such as "the mug is wet".
    pub text: Option<SmolStr>,
}

/// JSON form of a [`FailureReport`].
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
enum FailureForm {
    Kind(SmolStr),
    Told(ToldFailure),
}

/// A failure kind with a cause in words.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ToldFailure {
    kind: SmolStr,
    text: SmolStr,
}

impl From<FailureForm> for FailureReport {
    fn from(form: FailureForm) -> Self {
        match form {
            FailureForm::Kind(kind) => Self { kind, text: None },
            FailureForm::Told(ToldFailure { kind, text }) => Self { kind, text: Some(text) },
        }
    }
}

impl From<FailureReport> for FailureForm {
    fn from(FailureReport { kind, text }: FailureReport) -> Self {
        match text {
            None => Self::Kind(kind),
            Some(text) => Self::Told(ToldFailure { kind, text }),
        }
    }
}

impl From<SmolStr> for FailureReport {
    fn from(kind: SmolStr) -> Self {
        Self { kind, text: None }
    }
}

impl From<&str> for FailureReport {
    fn from(kind: &str) -> Self {
        SmolStr::new(kind).into()
    }
}

impl fmt::Display for FailureReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.kind)?;
        self.text.as_ref().map_or(Ok(()), |text| write!(f, ": {text}"))
    }
}

/// The verdict on a motion.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Verification {
    /// It has a solution.
    Feasible {
        /// A path that begins where the robot stands now, if one is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        witness: Option<Box<Witness>>,
        /// Configuration in which a success leaves the robot, if it is known.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        leaves: Option<Box<Configuration>>,
    },
    /// It has none: the step ends in this failure, without moving.
    Infeasible {
        /// One of the failures of the call's primitive, such as `unreachable`.
        failure: SmolStr,
        /// Reason in words and numbers.
        why: SmolStr,
    },
    /// Nobody can tell: it starts, and the driver will see.
    Unknown { why: SmolStr },
}

impl Verification {
    /// The same verdict without its path, for traces: the path is in the event.
    pub(crate) fn without_witness(&self) -> Self {
        match self {
            Self::Feasible { .. } => Self::Feasible { witness: None, leaves: None },
            Self::Infeasible { .. } | Self::Unknown { .. } => self.clone(),
        }
    }
}

impl fmt::Display for Verification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Feasible { .. } => f.write_str("feasible"),
            Self::Infeasible { failure, why } => write!(f, "{failure}: {why}"),
            Self::Unknown { why } => write!(f, "unknown: {why}"),
        }
    }
}
