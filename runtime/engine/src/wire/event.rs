//! What the engine takes in.

use super::{Answer, Query, Value};
use crate::event as m;
use crate::verifier as v;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// An event.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Event {
    /// The run begins.
    Begin,
    /// Time has passed.
    Tick,
    /// The driver reports.
    Driver(DriverEvent),
    /// The verdict on a motion.
    Verified {
        /// The question.
        check: u64,
        /// The verdict.
        verdict: Verification,
    },
    /// A person stops the run.
    Stop,
}

/// The verdict on a motion.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Verification {
    /// It has a solution.
    Feasible,
    /// It has none.
    Infeasible {
        /// The failure in which the step ends.
        failure: String,
        /// Why, in words and numbers.
        why: String,
    },
    /// Nobody can tell.
    Unknown {
        /// Why not.
        why: String,
    },
}

/// What a driver reports.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum DriverEvent {
    /// The goal was accepted and runs.
    Acknowledged {
        /// Which.
        goal: u64,
    },
    /// The goal was not accepted.
    Refused {
        /// Which.
        goal: u64,
        /// The failure in which it ends.
        failure: String,
    },
    /// The goal has ended.
    Ended {
        /// Which.
        goal: u64,
        /// How.
        outcome: Outcome,
    },
    /// The goal cannot be held.
    NotHeld {
        /// Which.
        goal: u64,
    },
    /// How the goal is getting on, for people.
    Feedback {
        /// Which.
        goal: u64,
        /// In words.
        text: String,
    },
    /// Everything that the goal used stands still.
    Stopped {
        /// Which.
        goal: u64,
    },
    /// The driver does not know what became of the goal.
    Lost {
        /// Which.
        goal: u64,
    },
    /// The driver is gone: every live goal is lost.
    DriverLost,
    /// Something was observed.
    Observed {
        /// What was asked.
        query: Query,
        /// The answer.
        answer: Answer,
    },
}

/// How a goal ended.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Outcome {
    /// It did what it was for; with its result where its primitive has one.
    Success(Option<Value>),
    /// It failed in this way.
    Failure(String),
    /// It was cancelled or stopped.
    Interrupted,
}

impl From<&m::Event> for Event {
    fn from(event: &m::Event) -> Self {
        match event {
            m::Event::Begin => Self::Begin,
            m::Event::Tick => Self::Tick,
            m::Event::Driver(event) => Self::Driver(event.into()),
            m::Event::Verified { check, verdict } => {
                Self::Verified { check: check.number(), verdict: verdict.into() }
            }
            m::Event::Stop => Self::Stop,
        }
    }
}

impl From<Event> for m::Event {
    fn from(event: Event) -> Self {
        match event {
            Event::Begin => Self::Begin,
            Event::Tick => Self::Tick,
            Event::Driver(event) => Self::Driver(event.into()),
            Event::Verified { check, verdict } => {
                Self::Verified { check: v::CheckId::from_number(check), verdict: verdict.into() }
            }
            Event::Stop => Self::Stop,
        }
    }
}

impl From<&v::Verification> for Verification {
    fn from(verdict: &v::Verification) -> Self {
        match verdict {
            v::Verification::Feasible => Self::Feasible,
            v::Verification::Infeasible { failure, why } => {
                Self::Infeasible { failure: failure.to_string(), why: why.to_string() }
            }
            v::Verification::Unknown { why } => Self::Unknown { why: why.to_string() },
        }
    }
}

impl From<Verification> for v::Verification {
    fn from(verdict: Verification) -> Self {
        match verdict {
            Verification::Feasible => Self::Feasible,
            Verification::Infeasible { failure, why } => {
                Self::Infeasible { failure: failure.into(), why: why.into() }
            }
            Verification::Unknown { why } => Self::Unknown { why: why.into() },
        }
    }
}

impl From<&m::DriverEvent> for DriverEvent {
    fn from(event: &m::DriverEvent) -> Self {
        match event {
            m::DriverEvent::Acknowledged { goal } => Self::Acknowledged { goal: goal.number() },
            m::DriverEvent::Refused { goal, failure } => {
                Self::Refused { goal: goal.number(), failure: failure.to_string() }
            }
            m::DriverEvent::Ended { goal, outcome } => {
                Self::Ended { goal: goal.number(), outcome: outcome.into() }
            }
            m::DriverEvent::NotHeld { goal } => Self::NotHeld { goal: goal.number() },
            m::DriverEvent::Feedback { goal, text } => {
                Self::Feedback { goal: goal.number(), text: text.to_string() }
            }
            m::DriverEvent::Stopped { goal } => Self::Stopped { goal: goal.number() },
            m::DriverEvent::Lost { goal } => Self::Lost { goal: goal.number() },
            m::DriverEvent::DriverLost => Self::DriverLost,
            m::DriverEvent::Observed { query, answer } => {
                Self::Observed { query: query.into(), answer: answer.into() }
            }
        }
    }
}

impl From<DriverEvent> for m::DriverEvent {
    fn from(event: DriverEvent) -> Self {
        let id = m::GoalId::from_number;
        match event {
            DriverEvent::Acknowledged { goal } => Self::Acknowledged { goal: id(goal) },
            DriverEvent::Refused { goal, failure } => {
                Self::Refused { goal: id(goal), failure: failure.into() }
            }
            DriverEvent::Ended { goal, outcome } => Self::Ended { goal: id(goal), outcome: outcome.into() },
            DriverEvent::NotHeld { goal } => Self::NotHeld { goal: id(goal) },
            DriverEvent::Feedback { goal, text } => Self::Feedback { goal: id(goal), text: text.into() },
            DriverEvent::Stopped { goal } => Self::Stopped { goal: id(goal) },
            DriverEvent::Lost { goal } => Self::Lost { goal: id(goal) },
            DriverEvent::DriverLost => Self::DriverLost,
            DriverEvent::Observed { query, answer } => {
                Self::Observed { query: query.into(), answer: answer.into() }
            }
        }
    }
}

impl From<&m::Outcome> for Outcome {
    fn from(outcome: &m::Outcome) -> Self {
        match outcome {
            m::Outcome::Success(value) => Self::Success(value.as_ref().map(Value::from)),
            m::Outcome::Failure(kind) => Self::Failure(kind.to_string()),
            m::Outcome::Interrupted => Self::Interrupted,
        }
    }
}

impl From<Outcome> for m::Outcome {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Outcome::Success(value) => Self::Success(value.map(motet_graph::Value::from)),
            Outcome::Failure(kind) => Self::Failure(kind.into()),
            Outcome::Interrupted => Self::Interrupted,
        }
    }
}
