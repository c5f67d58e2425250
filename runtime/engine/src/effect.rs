//! Effects: the engine's only way to act on the world.

use crate::ids::{CheckId, GoalId};
use crate::query::Query;
use crate::time::Time;
use crate::trace::TraceEvent;
use motet_graph::draw::Names;
use motet_graph::{Configuration, Graph, Manner, Motion, NodeId, Value, Verdict, Witness};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::fmt;
use std::sync::Arc;

/// One thing that the engine wants done. The effects of one event go out together, in order. The order of
/// commands to a driver is the order in which they take effect.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Effect {
    /// Start a primitive.
    Start {
        /// The new goal.
        goal: GoalId,
        /// The step that it is for.
        node: NodeId,
        command: Arc<Command>,
        /// Time at which the engine will cancel it.
        deadline: Time,
    },
    /// End a goal early. Sent at most once a goal, never before it was acknowledged.
    Cancel { goal: GoalId },
    /// Do this instead: the goal goes on under its old number with new arguments of the same primitive. Sent
    /// only for primitives that the driver says it can update ([`crate::Capabilities`]), and only while the
    /// goal runs. Not acknowledged; a driver that cannot after all ends the goal in a failure.
    Update {
        goal: GoalId,
        /// The step that it is for from now on.
        node: NodeId,
        command: Arc<Command>,
        /// Time at which the engine will cancel it.
        deadline: Time,
    },
    /// Keep still without ending, until [`Effect::Proceed`]. Not acknowledged; a driver that cannot says
    /// [`crate::DriverEvent::NotHeld`].
    Hold { goal: GoalId },
    /// Go on after [`Effect::Hold`].
    Proceed { goal: GoalId },
    /// A cancel was not answered in time: bring everything that the goal uses to a safe stop by whatever
    /// means, and say [`crate::DriverEvent::Stopped`].
    SafeStop { goal: GoalId },
    /// Answer once, at once if possible.
    Observe { query: Arc<Query> },
    /// Answer now, and again whenever the answer changes.
    Watch { query: Arc<Query> },
    /// No longer watch.
    Unwatch { query: Arc<Query> },
    /// Say whether a motion has a solution, by [`crate::Event::Verified`]. Asked just before its step starts,
    /// and only where [`crate::EngineSettings::verify_within`] says that somebody will answer.
    #[serde(with = "verification")]
    #[schemars(with = "verification::Verify")]
    Verify {
        check: CheckId,
        /// The step that waits for the verdict.
        node: NodeId,
        motion: Arc<DeferredMotion>,
    },
    /// A trace event, for people, traces and journals.
    Report(TraceEvent),
    /// The run is over; the last effect of a run.
    Finished(Box<RunEnd>),
}

/// JSON form of [`Effect::Verify`]: the motion is written flat.
mod verification {
    use super::{Arc, CheckId, Command, DeferredMotion, NodeId, SmolStr, Value};
    use schemars::JsonSchema;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize, JsonSchema)]
    #[serde(deny_unknown_fields)]
    pub(super) struct Verify {
        check: CheckId,
        node: NodeId,
        query: SmolStr,
        args: Vec<Value>,
        command: Arc<Command>,
    }

    pub(super) fn serialize<S: Serializer>(
        check: &CheckId,
        node: &NodeId,
        motion: &Arc<DeferredMotion>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let DeferredMotion { query, args, command } = DeferredMotion::clone(motion);
        Verify { check: *check, node: *node, query, args, command }.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<(CheckId, NodeId, Arc<DeferredMotion>), D::Error> {
        let Verify { check, node, query, args, command } = Verify::deserialize(deserializer)?;
        Ok((check, node, Arc::new(DeferredMotion { query, args, command })))
    }
}

/// A primitive with its arguments. Two commands are equal if they ask for the same, whatever motions were
/// found for them.
#[derive(Clone, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Command {
    /// The primitive's name.
    pub primitive: SmolStr,
    /// All its parameters, in the order of its signature, with their values.
    pub args: Vec<(SmolStr, Value)>,
    /// Names of the resources that it may use until it has ended.
    pub uses: Arc<[SmolStr]>,
    /// Manner of its motion; absent for the robot's own speed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manner: Option<Manner>,
    /// Seconds after which the engine cancels it.
    pub deadline_secs: f64,
    /// Motions that carry it out, in order, as far as geometry found them. A driver may follow their
    /// witnesses or plan motions of its own. Empty if the primitive has no motion.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub motions: Vec<Arc<PlannedMotion>>,
    /// Configuration in which a success leaves the robot: where the motions after this one begin. Absent
    /// where it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leaves: Option<Arc<Configuration>>,
}

impl PartialEq for Command {
    fn eq(&self, other: &Self) -> bool {
        self.primitive == other.primitive
            && self.args == other.args
            && self.uses == other.uses
            && self.manner == other.manner
            && self.deadline_secs == other.deadline_secs
    }
}

/// Motion of a command, with the answer of geometry.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlannedMotion {
    /// Name of the motion query, such as `reach`.
    pub query: SmolStr,
    pub args: Vec<Value>,
    pub verdict: MotionVerdict,
    /// A path that carries the motion out. The compiler's paths begin where it expects the robot, so a driver
    /// follows one only if the robot stands there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub witness: Option<Box<Witness>>,
    /// Reason for an open verdict, in words, if one is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<SmolStr>,
}

/// Verdict on the motion of a command that starts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MotionVerdict {
    /// The compiler found it.
    Proven,
    /// The run found it just before the start ([`crate::Verifier`]).
    Verified,
    /// Nobody has found it, and nobody has excluded it.
    Open,
}

impl PlannedMotion {
    /// A motion of a graph with these arguments, as the compiler answered it.
    pub(crate) fn compiled(motion: &Motion, args: Vec<Value>) -> Self {
        Self {
            query: motion.query.clone(),
            args,
            verdict: match motion.verdict {
                Verdict::Proven => MotionVerdict::Proven,
                Verdict::Deferred => MotionVerdict::Open,
            },
            witness: motion.witness.clone(),
            why: motion.why.clone(),
        }
    }
}

impl Command {
    /// The call as a person would write it: arguments by position.
    pub(crate) fn brief(&self, graph: &Graph) -> String {
        Names(graph).command(&self.primitive, self.args.iter().map(|(_, value)| value), self.manner)
    }

    /// The value of a parameter.
    #[must_use]
    pub fn arg(&self, name: &str) -> Option<&Value> {
        self.args.iter().find(|(param, _)| param == name).map(|(_, value)| value)
    }
}

/// Outcome of a run.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum RunEnd {
    /// The policy reached `done`, or its end, and no part of its goal was observed to be false.
    Done {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
        /// The result, of a policy that gives one.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        result: Option<Value>,
    },
    /// The policy failed: by `fail`, or by a failure that nothing caught.
    Failed {
        /// The failure kind; `failed` for `fail`.
        kind: SmolStr,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
        /// The step in which it arose.
        node: NodeId,
    },
    /// The policy declined what was asked, by `cannot`.
    Declined {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
    },
    /// The policy asks for a new policy.
    Replan {
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<String>,
    },
    /// A person stopped it.
    Interrupted,
    /// The engine could not go on.
    Fault(Fault),
}

/// Fault that ends a run early. Every live goal was told to stop safely before.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Fault {
    /// More transitions at one instant than the budget allows.
    StepBudget { steps: u32 },
    /// The driver answered neither a cancel nor a safe stop in time, or is gone for good.
    NotStopped {
        /// The step whose goal is still live.
        node: NodeId,
        /// The number of the graph that the step belongs to.
        #[serde(default)]
        revision: u32,
    },
    /// The run is not over, and neither the engine nor its driver has anything left to wait for.
    Stalled,
}

impl fmt::Display for Command {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(", self.primitive)?;
        for (index, (name, value)) in self.args.iter().enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}{name}: {value}")?;
        }
        f.write_str(")")?;
        self.manner.map_or(Ok(()), |manner| write!(f, " {manner}"))
    }
}

impl fmt::Display for RunEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (what, why) = match self {
            Self::Done { why, result } => {
                f.write_str("done")?;
                result.as_ref().map_or(Ok(()), |result| write!(f, ", gave {result}"))?;
                ("", why)
            }
            Self::Failed { kind, why, .. } => {
                write!(f, "failed with `{kind}`")?;
                ("", why)
            }
            Self::Declined { why } => ("declined", why),
            Self::Replan { why } => ("asks for a new plan", why),
            Self::Interrupted => ("interrupted", &None),
            Self::Fault(fault) => return write!(f, "fault: {fault}"),
        };
        f.write_str(what)?;
        why.as_ref().map_or(Ok(()), |why| write!(f, ": {why}"))
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StepBudget { steps } => write!(f, "more than {steps} transitions at one instant"),
            Self::NotStopped { .. } => {
                f.write_str("the driver confirmed neither a cancel nor a safe stop; the robot may still move")
            }
            Self::Stalled => f.write_str("nothing is left to wait for, but the policy has not ended"),
        }
    }
}

/// A motion that was left to the run.
#[derive(Clone, PartialEq, Debug)]
pub struct DeferredMotion {
    /// The name of the query, `reach`.
    pub query: SmolStr,
    pub args: Vec<Value>,
    /// The call that it is for.
    pub command: Arc<Command>,
}

impl DeferredMotion {
    /// The command with its motion, as it was answered.
    pub(crate) fn answered(
        &self,
        verdict: MotionVerdict,
        (witness, leaves): (Option<Box<Witness>>, Option<&Configuration>),
        why: Option<SmolStr>,
    ) -> Arc<Command> {
        let Self { query, args, command } = self;
        let motion = PlannedMotion { query: query.clone(), args: args.clone(), verdict, witness, why };
        Arc::new(Command::clone(command).with_motion(motion, leaves))
    }
}

impl Command {
    /// The same command with its motion, and where it leaves the robot.
    pub(crate) fn with_motion(self, motion: PlannedMotion, leaves: Option<&Configuration>) -> Self {
        Self { motions: vec![Arc::new(motion)], leaves: leaves.cloned().map(Arc::new), ..self }
    }
}

impl fmt::Display for DeferredMotion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}(", self.query)?;
        for (index, arg) in self.args.iter().enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}{arg}")?;
        }
        f.write_str(")")
    }
}
