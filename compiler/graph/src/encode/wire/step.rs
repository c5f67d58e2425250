//! Steps and all that they hold.

use super::{Condition, Fact, Term};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A step.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Node {
    /// JSON Pointer to the step in the policy.
    pub path: String,
    /// The region that it runs in.
    pub region: u32,
    /// The next node of the region.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub next: Option<u32>,
    /// Least and greatest duration in seconds.
    pub duration: [f64; 2],
    /// What it does.
    pub kind: NodeKind,
}

/// What a step does.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NodeKind {
    /// Runs a primitive.
    Call(Box<Call>),
    /// A named group.
    Sequence {
        /// Its name.
        name: String,
        /// Its region.
        body: u32,
    },
    /// An inlined sub-policy.
    Inline {
        /// Its name.
        policy: String,
        /// Its region.
        body: u32,
    },
    /// A branch.
    If {
        /// The condition.
        condition: Condition,
        /// The region where it holds.
        then: u32,
        /// The region where it does not.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        otherwise: Option<u32>,
    },
    /// A wait.
    Wait {
        /// The condition.
        condition: Condition,
        /// The deadline in seconds.
        within: f64,
    },
    /// A monitor.
    Monitor {
        /// What is watched.
        watches: Vec<Watch>,
        /// The region that it watches over.
        body: u32,
    },
    /// A body with handlers.
    Try {
        /// The body's region.
        body: u32,
        /// The handlers.
        handlers: Vec<Handler>,
    },
    /// A bounded loop.
    Repeat {
        /// How often at most.
        times: u32,
        /// The body's region.
        body: u32,
        /// The test.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        until: Option<Condition>,
    },
    /// A loop over a list.
    Each {
        /// The loop's binding.
        item: u32,
        /// The list.
        list: Term,
        /// The longest list.
        at_most: u32,
        /// The body's region.
        body: u32,
    },
    /// Branches at once.
    Parallel {
        /// Their regions.
        branches: Vec<u32>,
    },
    /// An ending.
    End(End),
}

/// An ending.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct End {
    /// How.
    pub how: Ending,
    /// The node of the inlined policy that ends.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<u32>,
    /// The reason.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<Term>,
}

/// The ways to end.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It asks for a new policy.
    Replan,
}

/// A call.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Call {
    /// The index of the primitive.
    pub primitive: u32,
    /// An argument for each parameter.
    pub args: Vec<Term>,
    /// Where the result goes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub binds: Option<u32>,
    /// The deadline of one attempt in seconds.
    pub deadline: f64,
    /// How often it is tried again.
    pub retries: u32,
    /// Its preconditions.
    pub needs: Vec<Need>,
    /// Its motion.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// What is true after success.
    pub effects: Vec<Effect>,
    /// What is unknown as soon as it starts.
    pub unsettles: Vec<Unsettled>,
}

/// What the prover found.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds on every path.
    Proven,
    /// It is checked before the step starts.
    Deferred,
}

/// A precondition.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Need {
    /// What must hold.
    pub condition: Condition,
    /// Where it is asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// The kind over which it ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<u32>,
    /// Whether it is known.
    pub verdict: Verdict,
    /// The failure where it does not hold.
    pub failure: u32,
}

/// A motion.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Motion {
    /// The query.
    pub query: String,
    /// Its arguments.
    pub args: Vec<Term>,
    /// Whether it is known to have a solution.
    pub verdict: Verdict,
    /// The solution of a motion that is proven.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub witness: Option<Box<Witness>>,
    /// Why it is deferred.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub why: Option<String>,
}

/// A motion that solves a query. Lengths in m, angles in rad.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Witness {
    /// The joints that move.
    pub joints: Vec<String>,
    /// From where the robot begins to where it ends.
    pub path: Vec<Waypoint>,
    /// How a thing is held or put.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grasp: Option<Grasp>,
    /// Least distance to what stands around.
    pub clearance: f64,
    /// Room to the nearest limit of a joint that moved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limit: Option<f64>,
    /// What the hand could carry beyond, in kg.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub payload: Option<f64>,
}

/// Where the robot is on its way.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Waypoint {
    /// x, y and yaw of the base.
    pub base: [f64; 3],
    /// A position for each joint of the witness.
    pub joints: Vec<f64>,
}

/// A pose of the hand at which a thing is held.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Grasp {
    /// Where the hand's tip is.
    pub xyz: [f64; 3],
    /// A unit quaternion x, y, z, w.
    pub quaternion: [f64; 4],
    /// How wide the hand has to be open.
    pub width: f64,
}

/// A change of what is believed.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Effect {
    /// What changes.
    pub fact: Fact,
    /// Its new value.
    pub value: bool,
    /// Under which condition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// The kind over which it ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<u32>,
}

/// Facts that a step leaves unknown.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Unsettled {
    /// Which.
    pub fact: Fact,
    /// Under which condition.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub when: Option<Condition>,
    /// The kind over which it ranges.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub each: Option<u32>,
}

/// What a monitor watches.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Watch {
    /// The condition.
    pub condition: Condition,
    /// Seconds for which it must hold.
    pub hold: f64,
    /// What then happens.
    pub reaction: Reaction,
}

/// What a monitor does.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Reaction {
    /// Holds the body.
    Pause {
        /// For so many seconds at most.
        within: f64,
    },
    /// Starts the body again.
    Restart {
        /// So often at most.
        at_most: u32,
    },
    /// Interrupts the body, runs a region, goes on.
    Resume {
        /// So often at most.
        at_most: u32,
        /// The region.
        body: u32,
    },
    /// Ends.
    End(End),
}

/// A failure edge.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Handler {
    /// The failures that it takes; without it, all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<Vec<u32>>,
    /// The region that then runs.
    pub body: u32,
}
