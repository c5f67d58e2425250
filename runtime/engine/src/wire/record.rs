//! What happened in a run.

use super::{Value, Verification};
use crate::event::GoalId;
use crate::time::Time;
use crate::trace as m;
use motet_graph::{BindingId, FailureId, NodeId};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Something that happened.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// When.
    pub at: u64,
    /// The number of the graph that the ids belong to.
    pub revision: u32,
    /// What.
    pub what: Happening,
}

/// What happened.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Happening {
    /// A step was entered.
    Entered {
        /// Which.
        node: u32,
    },
    /// A step ended.
    Ended {
        /// Which.
        node: u32,
        /// How.
        ending: NodeEnding,
        /// Why.
        cause: Cause,
    },
    /// A call was started.
    Started {
        /// The call.
        node: u32,
        /// The new goal.
        goal: u64,
        /// 1 for the first attempt.
        attempt: u32,
    },
    /// A goal ended without ending its step.
    GoalEnded {
        /// The call.
        node: u32,
        /// The goal.
        goal: u64,
        /// How.
        ending: NodeEnding,
        /// Why.
        cause: Cause,
    },
    /// A guard was checked.
    Guard {
        /// The call.
        node: u32,
        /// Its place in the call's needs.
        need: u32,
        /// What came out.
        truth: Truth,
    },
    /// The verdict on a call's motion came.
    Verified {
        /// The call.
        node: u32,
        /// The verdict.
        verdict: Verification,
    },
    /// A test came out.
    Tested {
        /// The step.
        node: u32,
        /// What came out.
        truth: Truth,
    },
    /// A monitor fired.
    Fired {
        /// The monitor.
        node: u32,
        /// The place of the watch.
        watch: u32,
        /// Whether its condition held or was unknown for too long.
        truth: Truth,
    },
    /// What a monitor held or interrupted goes on.
    WentOn {
        /// The monitor.
        node: u32,
        /// The place of the watch.
        watch: u32,
    },
    /// A new policy has taken over.
    Swapped {
        /// Its name.
        policy: String,
    },
    /// A goal goes on for a step of the new policy.
    Kept {
        /// The call in the new policy.
        node: u32,
        /// The goal.
        goal: u64,
    },
    /// A goal goes on for a step of the new policy with new arguments.
    Updated {
        /// The call in the new policy.
        node: u32,
        /// The goal.
        goal: u64,
    },
    /// A name was bound.
    Bound {
        /// The index of the binding.
        binding: u32,
        /// To what.
        value: Value,
    },
}

/// How something ended.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NodeEnding {
    /// It did what it was for.
    Success,
    /// It failed: the index of the kind, in the graph's table, then in the order in which drivers made them up.
    Failure(u32),
    /// It was interrupted.
    Interrupted,
}

/// A truth value.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Truth {
    /// It holds.
    True,
    /// It does not hold.
    False,
    /// It may or may not hold.
    Unknown,
}

macro_rules! causes {
    ($($(#[$doc:meta])* $name:ident)*) => {
        /// Why something ended.
        #[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
        #[serde(rename_all = "snake_case")]
        pub enum Cause {
            $($(#[$doc])* $name,)*
        }

        impl From<m::EndCause> for Cause {
            fn from(cause: m::EndCause) -> Self {
                match cause {
                    $(m::EndCause::$name => Self::$name,)*
                }
            }
        }

        impl From<Cause> for m::EndCause {
            fn from(cause: Cause) -> Self {
                match cause {
                    $(Cause::$name => Self::$name,)*
                }
            }
        }
    };
}

causes! {
    /// It ran to its end.
    Completed
    /// It failed, or something within it did.
    Failed
    /// The driver did not accept it.
    Refused
    /// A guard did not hold.
    GuardRefuted
    /// It took too long.
    Deadline
    /// A bound was reached.
    Exhausted
    /// A value was missing or of the wrong type.
    BadValue
    /// A monitor fired.
    Monitor
    /// Another branch failed.
    SiblingFailed
    /// What it belongs to has ended.
    ParentEnded
    /// A person stopped the run.
    Person
    /// The driver interrupted it.
    Driver
    /// The policy was replaced.
    Swap
    /// The driver lost it.
    Lost
}

impl From<crate::Truth> for Truth {
    fn from(truth: crate::Truth) -> Self {
        match truth {
            crate::Truth::True => Self::True,
            crate::Truth::False => Self::False,
            crate::Truth::Unknown => Self::Unknown,
        }
    }
}

impl From<Truth> for crate::Truth {
    fn from(truth: Truth) -> Self {
        match truth {
            Truth::True => Self::True,
            Truth::False => Self::False,
            Truth::Unknown => Self::Unknown,
        }
    }
}

impl From<m::NodeEnding> for NodeEnding {
    fn from(ending: m::NodeEnding) -> Self {
        match ending {
            m::NodeEnding::Success => Self::Success,
            m::NodeEnding::Failure(kind) => Self::Failure(kind.0),
            m::NodeEnding::Interrupted => Self::Interrupted,
        }
    }
}

impl From<NodeEnding> for m::NodeEnding {
    fn from(ending: NodeEnding) -> Self {
        match ending {
            NodeEnding::Success => Self::Success,
            NodeEnding::Failure(kind) => Self::Failure(FailureId(kind)),
            NodeEnding::Interrupted => Self::Interrupted,
        }
    }
}

impl From<&m::TraceEvent> for Record {
    fn from(record: &m::TraceEvent) -> Self {
        Self { at: record.at.nanos(), revision: record.revision, what: (&record.what).into() }
    }
}

impl From<Record> for m::TraceEvent {
    fn from(record: Record) -> Self {
        Self { at: Time::from_nanos(record.at), revision: record.revision, what: record.what.into() }
    }
}

impl From<&m::TraceEventKind> for Happening {
    fn from(what: &m::TraceEventKind) -> Self {
        match what {
            m::TraceEventKind::Entered { node } => Self::Entered { node: node.0 },
            m::TraceEventKind::Ended { node, ending, cause } => {
                Self::Ended { node: node.0, ending: (*ending).into(), cause: (*cause).into() }
            }
            m::TraceEventKind::Started { node, goal, attempt } => {
                Self::Started { node: node.0, goal: goal.number(), attempt: *attempt }
            }
            m::TraceEventKind::GoalEnded { node, goal, ending, cause } => Self::GoalEnded {
                node: node.0,
                goal: goal.number(),
                ending: (*ending).into(),
                cause: (*cause).into(),
            },
            m::TraceEventKind::Guard { node, need, truth } => {
                Self::Guard { node: node.0, need: *need, truth: (*truth).into() }
            }
            m::TraceEventKind::Verified { node, verdict } => {
                Self::Verified { node: node.0, verdict: (&**verdict).into() }
            }
            m::TraceEventKind::Tested { node, truth } => {
                Self::Tested { node: node.0, truth: (*truth).into() }
            }
            m::TraceEventKind::Fired { node, watch, truth } => {
                Self::Fired { node: node.0, watch: *watch, truth: (*truth).into() }
            }
            m::TraceEventKind::WentOn { node, watch } => Self::WentOn { node: node.0, watch: *watch },
            m::TraceEventKind::Swapped { policy } => Self::Swapped { policy: policy.to_string() },
            m::TraceEventKind::Kept { node, goal } => Self::Kept { node: node.0, goal: goal.number() },
            m::TraceEventKind::Updated { node, goal } => Self::Updated { node: node.0, goal: goal.number() },
            m::TraceEventKind::Bound { binding, value } => {
                Self::Bound { binding: binding.0, value: (&**value).into() }
            }
        }
    }
}

impl From<Happening> for m::TraceEventKind {
    fn from(what: Happening) -> Self {
        match what {
            Happening::Entered { node } => Self::Entered { node: NodeId(node) },
            Happening::Ended { node, ending, cause } => {
                Self::Ended { node: NodeId(node), ending: ending.into(), cause: cause.into() }
            }
            Happening::Started { node, goal, attempt } => {
                Self::Started { node: NodeId(node), goal: GoalId::from_number(goal), attempt }
            }
            Happening::GoalEnded { node, goal, ending, cause } => Self::GoalEnded {
                node: NodeId(node),
                goal: GoalId::from_number(goal),
                ending: ending.into(),
                cause: cause.into(),
            },
            Happening::Guard { node, need, truth } => {
                Self::Guard { node: NodeId(node), need, truth: truth.into() }
            }
            Happening::Verified { node, verdict } => {
                Self::Verified { node: NodeId(node), verdict: Box::new(verdict.into()) }
            }
            Happening::Tested { node, truth } => Self::Tested { node: NodeId(node), truth: truth.into() },
            Happening::Fired { node, watch, truth } => {
                Self::Fired { node: NodeId(node), watch, truth: truth.into() }
            }
            Happening::WentOn { node, watch } => Self::WentOn { node: NodeId(node), watch },
            Happening::Swapped { policy } => Self::Swapped { policy: policy.into() },
            Happening::Kept { node, goal } => {
                Self::Kept { node: NodeId(node), goal: GoalId::from_number(goal) }
            }
            Happening::Updated { node, goal } => {
                Self::Updated { node: NodeId(node), goal: GoalId::from_number(goal) }
            }
            Happening::Bound { binding, value } => {
                Self::Bound { binding: BindingId(binding), value: Box::new(value.into()) }
            }
        }
    }
}
