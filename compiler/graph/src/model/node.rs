//! Regions and nodes: the control flow of a policy.

use std::collections::BTreeMap;
use std::fmt;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::{
    BindingId, Condition, DurationBounds, Fact, FailureId, KindId, NodeId, PrimitiveId, RegionId, ResourceId,
    Term,
};

/// A list of nodes with one thread of control.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Region {
    /// The node that owns the region; absent for [`super::ROOT`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub owner: Option<NodeId>,
    /// The first node; an empty region succeeds at once.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub entry: Option<NodeId>,
}

/// A step of the policy.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Node {
    /// JSON Pointer to the step in the policy's JSON form, such as `/steps/2/try/0`. Nodes of an inlined
    /// policy have the call's path followed by `:` and the path in that policy.
    pub path: SmolStr,
    /// The region to which the node belongs.
    pub region: RegionId,
    /// The success edge: the next node of the region; without it the region ends in success.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<NodeId>,
    /// Least and greatest duration in seconds, retries included.
    #[schemars(with = "[f64; 2]")]
    pub duration: DurationBounds,
    pub kind: NodeKind,
}

impl Node {
    /// Node that stands for the goal of a policy where a message names a node.
    pub(crate) fn goal() -> Self {
        Self {
            path: SmolStr::new_static("/achieves"),
            region: super::ROOT,
            next: None,
            duration: DurationBounds::default(),
            kind: NodeKind::End { how: Ending::Done, of: None, why: None },
        }
    }
}

/// Kind of a node, with its parts.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NodeKind {
    /// Runs a primitive.
    Call(CallNode),
    /// Binds a name to a value. What is unknown of it is observed first; fails with `timeout` if it stays
    /// unknown.
    Let { binding: BindingId, value: Term },
    /// A named group of steps.
    Sequence { name: SmolStr, body: RegionId },
    /// An inlined sub-policy. `End` nodes may refer to it: `done` ends it in success, `fail` in the failure
    /// `failed`.
    Inline { policy: SmolStr, body: RegionId },
    /// A branch. An unknown condition is observed first, and counts as false if it stays unknown.
    If {
        condition: Condition,
        /// Region for a true condition.
        then: RegionId,
        /// Region for a false condition.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        otherwise: Option<RegionId>,
    },
    /// Blocks until a condition holds; fails with `timeout` after the deadline.
    Wait {
        condition: Condition,
        /// Deadline in seconds.
        #[serde(rename = "within")]
        within_secs: f64,
    },
    /// Blocks for a time.
    Delay {
        /// The time in seconds.
        #[serde(rename = "for")]
        secs: f64,
    },
    /// Runs its body, and after it the cleanup, however the body was left: by its end, by a failure, by an
    /// ending or because something around it was stopped. Then goes on as the body was left. A failure of the
    /// cleanup is reported and changes nothing. The cleanup does not run after a person's stop, an
    /// interruption by the driver, the loss of a goal or a swap.
    Finally { body: RegionId, cleanup: RegionId },
    /// Watches conditions while the body runs. An outer monitor wins over an inner one, an earlier watch over
    /// a later.
    Monitor { watches: Vec<Watch>, body: RegionId },
    /// Handles failures of its body.
    Try {
        body: RegionId,
        /// Failure edges; the first that matches wins.
        handlers: Vec<Handler>,
    },
    /// A bounded loop: the body, then the test. Fails with `exhausted` if the test does not hold after the
    /// last run.
    Repeat {
        /// Greatest number of runs, at least 1.
        times: u32,
        body: RegionId,
        /// Test that ends the loop.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until: Option<Condition>,
    },
    /// A loop over a list. Fails with `exhausted`, before the first item, if the list is longer than
    /// `at_most`.
    Each {
        /// Binding of the item.
        item: BindingId,
        list: Term,
        at_most: u32,
        body: RegionId,
    },
    /// Runs all branches at once; succeeds when all have, and a failing branch interrupts the others.
    Parallel { branches: Vec<RegionId> },
    /// Ends the policy, or the inlined policy `of`.
    End {
        how: Ending,
        /// The [`NodeKind::Inline`] node that ends; absent for the whole policy.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        of: Option<NodeId>,
        /// Reason for people.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<Term>,
    },
}

impl NodeKind {
    /// Seconds that the body has, of a monitor that is a deadline of its body and nothing else.
    #[must_use]
    pub fn deadline_secs(&self) -> Option<f64> {
        let Self::Monitor { watches, .. } = self else { return None };
        let [only] = watches.as_slice() else { return None };
        let is_timeout = matches!(only.reaction, Reaction::Pause { within_secs: 0.0 });
        (is_timeout && only.condition == Condition::Literal(true)).then_some(only.hold_secs)
    }
}

/// Outcome that a policy states itself.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The goal is reached.
    Done,
    /// The policy gives up.
    Fail,
    /// The policy declines what was asked.
    Cannot,
    /// The policy asks for a new policy.
    Replan,
}

/// A watched condition of a monitor, with its reaction.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Watch {
    pub condition: Condition,
    /// Seconds for which the condition must hold without a break.
    #[serde(rename = "hold")]
    pub hold_secs: f64,
    pub reaction: Reaction,
}

/// Reaction of a monitor that fires.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Reaction {
    /// Holds the body until the condition is false again; more than `within_secs` in all is the failure
    /// `timeout`. With no time to pause it comes at once: so a deadline of the body is a watch whose
    /// condition always holds.
    Pause {
        /// The longest pause in seconds, all pauses of one run of the monitor taken together.
        #[serde(rename = "within")]
        within_secs: f64,
    },
    /// Runs the body again from its start, at most `at_most` times; then fails with `exhausted`.
    Restart { at_most: u32 },
    /// Interrupts the body, runs a region and continues from the interrupted step, at most `at_most` times;
    /// then fails with `exhausted`.
    Resume { at_most: u32, body: RegionId },
    /// Ends the policy, or the inlined policy `of`.
    End {
        how: Ending,
        /// The [`NodeKind::Inline`] node that ends; absent for the whole policy.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        of: Option<NodeId>,
        /// Reason for people.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        why: Option<Term>,
    },
}

/// A failure edge.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Handler {
    /// Failures that the handler catches; absent for all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<Vec<FailureId>>,
    /// Bindings of the failure, for the region.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub binds: Option<CaughtFailure>,
    /// Region that then runs.
    pub body: RegionId,
}

/// Bindings of a failure that a handler caught.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaughtFailure {
    /// Binding of its kind, a case.
    pub kind: BindingId,
    /// Binding of its text: what the driver said of it, or else its sentence in [`super::Graph::sentences`].
    pub text: BindingId,
}

/// A call of a primitive.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CallNode {
    pub primitive: PrimitiveId,
    /// One argument for each parameter, in order, defaults filled in.
    pub args: Vec<Term>,
    /// Binding of the result; present exactly if the primitive has a result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub binds: Option<BindingId>,
    /// Manner of the motion; absent for the robot's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manner: Option<Manner>,
    /// Deadline of one attempt in seconds.
    #[serde(rename = "deadline")]
    pub deadline_secs: f64,
    /// Number of further attempts after a failure.
    pub retries: u32,
    /// Preconditions with their verdicts. The deferred ones are the guards, checked before each start.
    pub needs: Vec<Need>,
    /// The motion of the call with its verdict.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// Facts that hold after success, applied in order after all conditions were evaluated.
    pub effects: Vec<CallEffect>,
    /// Facts that become unknown at the start; after a failure also the facts of `effects`.
    pub unsettles: Vec<Unsettled>,
    /// Lifetime of `effects`, of a perception; absent where they last.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lasts: Option<Lifetime>,
}

/// Lifetime of facts that a perception makes. After its end they are unknown.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Lifetime {
    /// Resources whose use ends it, with all that conflict with them.
    pub uses: Vec<ResourceId>,
    /// Entities: an action ends it whose `effects` or `unsettles` have one of them as the first argument.
    pub entities: Vec<Term>,
}

/// Manner of a motion: the parts of the robot's greatest speed and acceleration that it may use.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Manner {
    /// Part of the speed, above 0 and at most 1.
    pub speed: f64,
    /// Part of the acceleration, above 0 and at most 1.
    pub acceleration: f64,
}

impl Manner {
    /// Factor by which a motion takes longer. A motion that takes `k` times as long has speeds divided by `k`
    /// and accelerations divided by `k²`.
    #[must_use]
    pub fn stretch(self) -> f64 {
        (1.0 / self.speed).max(1.0 / self.acceleration.sqrt())
    }
}

impl fmt::Display for Manner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let percent = |part: f64| (part * 1e4).round() / 100.0;
        let (speed, acceleration) = (percent(self.speed), percent(self.acceleration));
        match speed == acceleration {
            true => write!(f, "at {speed} %"),
            false => write!(f, "at {speed} % of the speed and {acceleration} % of the acceleration"),
        }
    }
}

/// Verdict of the compiler on a precondition or a motion.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Holds on every path: nothing is left to check.
    Proven,
    /// Only an observation can decide: the engine checks it before the step starts.
    Deferred,
}

/// A precondition of a call, with its verdict.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Need {
    /// Condition at the start of the step. With `each`, for every entity of that kind that the engine knows.
    pub condition: Condition,
    /// Premise: the condition is required only where this is true; unknown counts as false. May contain
    /// [`Term::Each`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// Kind over which [`Term::Each`] ranges in `condition` and `when`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<KindId>,
    pub verdict: Verdict,
    /// Failure in which the step ends if the guard is refuted.
    pub failure: FailureId,
}

/// A motion that must have a solution.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// The motion query: `go_to`, `stand_at`, `reach`, `reach_at`, `put`, `put_at`, `pull`, `push`, `offer`,
    /// `look` or `posture`.
    pub query: SmolStr,
    pub args: Vec<Term>,
    pub verdict: Verdict,
    /// The solution of a proven motion. If the step can be reached in several worlds, the solution for one of
    /// them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub witness: Option<Box<Witness>>,
    /// Configuration in which a success leaves the robot, of a proven motion, in the same world; absent where
    /// it is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leaves: Option<Box<Configuration>>,
    /// Reason for a deferral, in words, if one is known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<SmolStr>,
}

/// A path that proves a motion feasible in the world that the compiler expects. Lengths in m, angles in rad,
/// poses in the frame `map`.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Witness {
    /// Names of the joints that move; all others keep their positions.
    pub joints: Vec<SmolStr>,
    /// At least one waypoint, from start to end. Between two of them base and joints move together along a
    /// straight line, from rest to rest.
    pub path: Vec<Waypoint>,
    /// Grasp or placement at the end, for queries that ask for one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grasp: Option<Grasp>,
    /// Least clearance along the path in m, at most 1.
    pub clearance: f64,
    /// Distances from obstacles that the whole path was checked to keep.
    #[serde(default, skip_serializing_if = "Clearance::is_none")]
    pub keeps: Clearance,
    /// Distance at the end to the nearest limit of a joint that moved, in m or rad.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// Spare payload of the hand in kg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub payload: Option<f64>,
}

/// Distances from obstacles in m, 0 or more.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Clearance {
    /// Distance of every part that the arm does not move.
    pub base: f64,
    /// Distance of the arm, the hand and the held thing.
    pub arm: f64,
}

impl Clearance {
    fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// A configuration along a path.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Waypoint {
    /// Base pose x, y, yaw in m and rad. Yaw is continuous along a path and may exceed a half turn.
    pub base: [f64; 3],
    /// Positions of [`Witness::joints`] in the same order.
    pub joints: Vec<f64>,
    /// Seconds from the start of the motion, 0 at the first waypoint. They keep the speeds and accelerations
    /// of the robot, in the manner of the step.
    #[serde(default)]
    pub at: f64,
    /// Seconds of even acceleration after the waypoint before, and of even braking before this one; the speed
    /// between them is constant.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub ramp: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde passes a reference")]
fn is_zero(secs: &f64) -> bool {
    *secs == 0.0
}

/// A configuration of the robot, as far as it is known. Lengths in m, angles in rad.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Configuration {
    /// Base pose x, y, yaw in the frame `map`.
    pub base: [f64; 3],
    /// Positions of joints by name; all others keep their positions.
    pub joints: BTreeMap<SmolStr, f64>,
}

/// Pose of the hand at a thing, with the opening of the hand.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grasp {
    /// Position of the hand's tip in m.
    pub xyz: [f64; 3],
    /// Orientation as a unit quaternion in the order x, y, z, w.
    pub quaternion: [f64; 4],
    /// Required opening of the hand in m.
    pub width: f64,
    /// Pose of what the hand then holds, in the frame of its tip.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub object: Option<super::Pose>,
}

/// A change of a fact that a successful call makes.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CallEffect {
    pub fact: Fact,
    /// New truth value.
    pub value: bool,
    /// Condition in the state before the effects; may contain [`Term::Each`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// Kind over which [`Term::Each`] ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<KindId>,
}

/// Facts that a step leaves unknown.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Unsettled {
    pub fact: Fact,
    /// Condition in the state before the step; may contain [`Term::Each`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// Kind over which [`Term::Each`] ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<KindId>,
}
