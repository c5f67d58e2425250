//! What the engine wants done.

use super::{Query, Record, Value};
use crate::effect as m;
use crate::event::GoalId;
use crate::time::Time;
use crate::verifier::{CheckId, DeferredMotion};
use motet_graph::NodeId;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// An effect.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Effect {
    /// Start a primitive.
    Start(Start),
    /// End a goal early.
    Cancel {
        /// Which.
        goal: u64,
    },
    /// Give a running goal new arguments, for the step that it is for from now on.
    Update(Start),
    /// Keep still without ending.
    Hold {
        /// Which.
        goal: u64,
    },
    /// Go on after a hold.
    Proceed {
        /// Which.
        goal: u64,
    },
    /// Bring everything that the goal uses to a safe stop.
    SafeStop {
        /// Which.
        goal: u64,
    },
    /// Answer once.
    Observe {
        /// What.
        query: Query,
    },
    /// Answer now and whenever the answer changes.
    Watch {
        /// What.
        query: Query,
    },
    /// No longer watch.
    Unwatch {
        /// What.
        query: Query,
    },
    /// Say whether a motion has a solution.
    Verify(Verify),
    /// Something happened in the run.
    Report(Record),
    /// The run is over.
    Finished(RunEnd),
}

/// The start of a primitive, or what a goal does from now on.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Start {
    /// The goal; at a start a new one.
    pub goal: u64,
    /// The index of the step that it is for.
    pub node: u32,
    /// What to do.
    pub command: Command,
    /// When the engine will cancel it.
    pub deadline: u64,
}

/// A question for a motion.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Verify {
    /// The question.
    pub check: u64,
    /// The index of the step that waits for the verdict.
    pub node: u32,
    /// The name of the motion.
    pub query: String,
    /// Its arguments.
    pub args: Vec<Value>,
    /// The call that it is for.
    pub command: Command,
}

/// A primitive with its arguments.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Command {
    /// The primitive's name.
    pub primitive: String,
    /// All its parameters in the order of its signature, each as `[name, value]`.
    pub args: Vec<Arg>,
    /// Names of the resources that it may use until it has ended.
    pub uses: Vec<String>,
    /// Seconds after which the engine cancels it.
    pub deadline_secs: f64,
}

/// A parameter and its value.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
pub struct Arg(pub String, pub Value);

/// How a run ended.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RunEnd {
    /// The policy reached `done`, or its end.
    Done {
        /// What `done` said.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
    },
    /// The policy failed.
    Failed {
        /// The failure kind.
        kind: String,
        /// What `fail` said.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
        /// The index of the step in which it arose.
        node: u32,
    },
    /// The policy asks for a new policy.
    Replan {
        /// What for.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
    },
    /// A person stopped it.
    Interrupted,
    /// The engine could not go on.
    Fault(Fault),
}

/// Why the engine could not go on.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Fault {
    /// Too many transitions at one instant.
    StepBudget {
        /// The budget.
        steps: u32,
    },
    /// The driver answered neither a cancel nor a safe stop.
    NotStopped {
        /// The index of the step whose goal is still live.
        node: u32,
        /// The number of the graph that the step belongs to.
        #[serde(default)]
        revision: u32,
    },
    /// Nothing is left to wait for.
    Stalled,
}

impl From<&m::Effect> for Effect {
    fn from(effect: &m::Effect) -> Self {
        match effect {
            m::Effect::Start { goal, node, command, deadline } => {
                Self::Start(start(*goal, *node, command, *deadline))
            }
            m::Effect::Update { goal, node, command, deadline } => {
                Self::Update(start(*goal, *node, command, *deadline))
            }
            m::Effect::Cancel { goal } => Self::Cancel { goal: goal.number() },
            m::Effect::Hold { goal } => Self::Hold { goal: goal.number() },
            m::Effect::Proceed { goal } => Self::Proceed { goal: goal.number() },
            m::Effect::SafeStop { goal } => Self::SafeStop { goal: goal.number() },
            m::Effect::Observe { query } => Self::Observe { query: (&**query).into() },
            m::Effect::Watch { query } => Self::Watch { query: (&**query).into() },
            m::Effect::Unwatch { query } => Self::Unwatch { query: (&**query).into() },
            m::Effect::Verify { check, node, motion } => Self::Verify(Verify {
                check: check.number(),
                node: node.0,
                query: motion.query.to_string(),
                args: motion.args.iter().map(Value::from).collect(),
                command: (&*motion.command).into(),
            }),
            m::Effect::Report(record) => Self::Report(record.into()),
            m::Effect::Finished(end) => Self::Finished((&**end).into()),
        }
    }
}

fn start(goal: GoalId, node: NodeId, command: &m::Command, deadline: Time) -> Start {
    Start { goal: goal.number(), node: node.0, command: command.into(), deadline: deadline.nanos() }
}

impl From<Effect> for m::Effect {
    fn from(effect: Effect) -> Self {
        let id = GoalId::from_number;
        match effect {
            Effect::Start(start) => Self::Start {
                goal: id(start.goal),
                node: NodeId(start.node),
                command: Arc::new(start.command.into()),
                deadline: Time::from_nanos(start.deadline),
            },
            Effect::Update(start) => Self::Update {
                goal: id(start.goal),
                node: NodeId(start.node),
                command: Arc::new(start.command.into()),
                deadline: Time::from_nanos(start.deadline),
            },
            Effect::Cancel { goal } => Self::Cancel { goal: id(goal) },
            Effect::Hold { goal } => Self::Hold { goal: id(goal) },
            Effect::Proceed { goal } => Self::Proceed { goal: id(goal) },
            Effect::SafeStop { goal } => Self::SafeStop { goal: id(goal) },
            Effect::Observe { query } => Self::Observe { query: Arc::new(query.into()) },
            Effect::Watch { query } => Self::Watch { query: Arc::new(query.into()) },
            Effect::Unwatch { query } => Self::Unwatch { query: Arc::new(query.into()) },
            Effect::Verify(verify) => Self::Verify {
                check: CheckId::from_number(verify.check),
                node: NodeId(verify.node),
                motion: Arc::new(DeferredMotion {
                    query: verify.query.into(),
                    args: verify.args.into_iter().map(motet_graph::Value::from).collect(),
                    command: Arc::new(verify.command.into()),
                }),
            },
            Effect::Report(record) => Self::Report(record.into()),
            Effect::Finished(end) => Self::Finished(Box::new(end.into())),
        }
    }
}

impl From<&m::Command> for Command {
    fn from(command: &m::Command) -> Self {
        Self {
            primitive: command.primitive.to_string(),
            args: command.args.iter().map(|(name, value)| Arg(name.to_string(), value.into())).collect(),
            uses: command.uses.iter().map(ToString::to_string).collect(),
            deadline_secs: command.deadline_secs,
        }
    }
}

impl From<Command> for m::Command {
    fn from(command: Command) -> Self {
        Self {
            primitive: command.primitive.into(),
            args: command.args.into_iter().map(|Arg(name, value)| (name.into(), value.into())).collect(),
            uses: command.uses.into_iter().map(smol_str::SmolStr::from).collect(),
            deadline_secs: command.deadline_secs,
        }
    }
}

impl From<&m::RunEnd> for RunEnd {
    fn from(end: &m::RunEnd) -> Self {
        match end {
            m::RunEnd::Done { why } => Self::Done { why: why.clone() },
            m::RunEnd::Failed { kind, why, node } => {
                Self::Failed { kind: kind.to_string(), why: why.clone(), node: node.0 }
            }
            m::RunEnd::Replan { why } => Self::Replan { why: why.clone() },
            m::RunEnd::Interrupted => Self::Interrupted,
            m::RunEnd::Fault(fault) => Self::Fault(match fault {
                m::Fault::StepBudget { steps } => Fault::StepBudget { steps: *steps },
                m::Fault::NotStopped { node, revision } => {
                    Fault::NotStopped { node: node.0, revision: *revision }
                }
                m::Fault::Stalled => Fault::Stalled,
            }),
        }
    }
}

impl From<RunEnd> for m::RunEnd {
    fn from(end: RunEnd) -> Self {
        match end {
            RunEnd::Done { why } => Self::Done { why },
            RunEnd::Failed { kind, why, node } => Self::Failed { kind: kind.into(), why, node: NodeId(node) },
            RunEnd::Replan { why } => Self::Replan { why },
            RunEnd::Interrupted => Self::Interrupted,
            RunEnd::Fault(fault) => Self::Fault(match fault {
                Fault::StepBudget { steps } => m::Fault::StepBudget { steps },
                Fault::NotStopped { node, revision } => m::Fault::NotStopped { node: NodeId(node), revision },
                Fault::Stalled => m::Fault::Stalled,
            }),
        }
    }
}
