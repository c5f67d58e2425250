//! A running primitive: stages of driving and of work, one after the other.

use crate::body::BasePose;
use crate::command::SimCommand;
use crate::motion::BaseMotion;
use motet_runtime::{FailureReport, GoalId, Outcome, Time};
use smol_str::SmolStr;
use std::sync::Arc;

/// A goal that runs.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Task {
    pub(crate) goal: GoalId,
    pub(crate) command: SimCommand,
    /// Stances along the path that was found for its drive, from its start; empty without one.
    pub(crate) path: Vec<BasePose>,
    /// Number of its call in the run.
    pub(crate) occasion: u64,
    pub(crate) uses: Arc<[SmolStr]>,
    /// Seconds that its work takes, driving aside.
    pub(crate) work_secs: f64,
    /// Factor on all durations.
    pub(crate) slower: f64,
    /// Factor of the manner on the time of a drive; the time of the work follows the deadline.
    pub(crate) stretch: f64,
    /// Ends in this failure, whatever else.
    pub(crate) fails: Option<FailureReport>,
    pub(crate) stage: TaskStage,
    /// Stages that are over.
    pub(crate) step: u32,
    /// Result of `search` so far.
    pub(crate) found: Option<SmolStr>,
}

/// Stage of a running task.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum TaskStage {
    /// The base moves, which ends then.
    Driving(Time),
    /// Everything else, which ends then.
    Working(Time),
    /// It keeps still; what was left of the motion.
    HeldDriving(BaseMotion),
    /// It keeps still; what was left of the work.
    HeldWorking(Time),
}

impl TaskStage {
    /// Time at which something happens.
    pub(crate) const fn due(&self) -> Time {
        match self {
            Self::Driving(at) | Self::Working(at) => *at,
            Self::HeldDriving(_) | Self::HeldWorking(_) => Time::NEVER,
        }
    }
}

/// Next stage of a task.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum NextStage {
    Drive(BasePose),
    /// Drives through stances one after the other.
    Follow(Vec<BasePose>),
    Turn(f64),
    Work,
    End(Outcome),
}
