//! Regions, nodes, and what they carry.

use smol_str::SmolStr;

use super::{
    BindingId, Condition, DurationBounds, Fact, FailureId, KindId, NodeId, PrimitiveId, RegionId, Term,
};

/// A list of nodes with one thread of control.
#[derive(Clone, PartialEq, Debug)]
pub struct Region {
    /// The node that it belongs to; none for [`ROOT`].
    pub owner: Option<NodeId>,
    /// Its first node; an empty region succeeds at once.
    pub entry: Option<NodeId>,
}

/// A step of the policy.
#[derive(Clone, PartialEq, Debug)]
pub struct Node {
    /// JSON Pointer to the step in the policy's JSON form, such as `/steps/2/try/0`. Nodes of an inlined policy have the
    /// call's path followed by `:` and the path in that policy.
    pub path: SmolStr,
    /// The region that it runs in.
    pub region: RegionId,
    /// The success edge: the next node of the region; none ends the region in success.
    pub next: Option<NodeId>,
    /// Least and greatest duration, retries included.
    pub duration: DurationBounds,
    /// What it does.
    pub kind: NodeKind,
}

/// What a node does.
#[derive(Clone, PartialEq, Debug)]
pub enum NodeKind {
    /// Runs a primitive.
    Call(CallNode),
    /// A named group.
    Sequence {
        /// Its name.
        name: SmolStr,
        /// Its steps.
        body: RegionId,
    },
    /// An inlined sub-policy. `End` nodes may name it: `done` ends it in success, `fail` in the failure `failed`.
    Inline {
        /// The sub-policy's name.
        policy: SmolStr,
        /// Its steps.
        body: RegionId,
    },
    /// A condition; unknown is first observed, and counts as false if it stays unknown.
    If {
        /// The condition.
        condition: Condition,
        /// Where it holds.
        then: RegionId,
        /// Where it does not.
        otherwise: Option<RegionId>,
    },
    /// Blocks until a condition holds, else fails with `timeout`.
    Wait {
        /// What is waited for.
        condition: Condition,
        /// The deadline in seconds.
        within_secs: f64,
    },
    /// Watches conditions while the body runs. An outer monitor wins over an inner one, an earlier watch over a later.
    Monitor {
        /// What is watched.
        watches: Vec<Watch>,
        /// What runs.
        body: RegionId,
    },
    /// Handles failures of its body.
    Try {
        /// What may fail.
        body: RegionId,
        /// The failure edges; the first that fits wins.
        handlers: Vec<Handler>,
    },
    /// A bounded loop: the body, then the test. With a test that never held after the last run: `exhausted`.
    Repeat {
        /// How often at most; at least once.
        times: u32,
        /// The body.
        body: RegionId,
        /// The test.
        until: Option<Condition>,
    },
    /// A loop over a list. A longer list is the failure `exhausted`, before the first item.
    Each {
        /// The loop's binding.
        item: BindingId,
        /// The list.
        list: Term,
        /// The longest list that is taken.
        at_most: u32,
        /// The body.
        body: RegionId,
    },
    /// All branches at once; succeeds when all have, and a failing branch interrupts the others.
    Parallel {
        /// The branches.
        branches: Vec<RegionId>,
    },
    /// Ends the policy, or the inlined policy `of`.
    End {
        /// How.
        how: Ending,
        /// The [`NodeKind::Inline`] node that ends; none for the whole policy.
        of: Option<NodeId>,
        /// The reason.
        why: Option<Term>,
    },
}

/// The ways a policy can end by its own word.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Ending {
    /// It reached what it was for.
    Done,
    /// It gives up.
    Fail,
    /// It asks for a new policy.
    Replan,
}

/// A call of a primitive.
#[derive(Clone, PartialEq, Debug)]
pub struct CallNode {
    /// The primitive.
    pub primitive: PrimitiveId,
    /// An argument for each parameter, in order, defaults filled in.
    pub args: Vec<Term>,
    /// Where the result goes; always given where the primitive has a result.
    pub binds: Option<BindingId>,
    /// The deadline of one attempt in seconds.
    pub deadline_secs: f64,
    /// How often it is tried again after a failure.
    pub retries: u32,
    /// Its preconditions with their verdicts. Those that are deferred are the guards, checked before each start.
    pub needs: Vec<Need>,
    /// Its motion with its verdict.
    pub motion: Option<Motion>,
    /// What is true after success, applied in order after all conditions were evaluated.
    pub effects: Vec<CallEffect>,
    /// Facts that are unknown as soon as it starts; after a failure also those that `effects` name.
    pub unsettles: Vec<Unsettled>,
}

/// Facts that a step leaves unknown.
#[derive(Clone, PartialEq, Debug)]
pub struct Unsettled {
    /// Which.
    pub fact: Fact,
    /// The condition, in the state before the step; [`Term::Each`] may occur in it.
    pub when: Option<Condition>,
    /// The kind over which [`Term::Each`] ranges.
    pub each: Option<KindId>,
}

/// What the prover found.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Verdict {
    /// It holds on every path: nothing is left to check.
    Proven,
    /// Only observation can tell: the engine checks it before the step starts.
    Deferred,
}

/// A precondition.
#[derive(Clone, PartialEq, Debug)]
pub struct Need {
    /// What must hold when the step starts. With `each`, for every entity of that kind that the engine has heard of.
    pub condition: Condition,
    /// Asked only where this is true; unknown counts as false. [`Term::Each`] may occur in it.
    pub when: Option<Condition>,
    /// The kind over which [`Term::Each`] ranges in `condition` and `when`.
    pub each: Option<KindId>,
    /// Whether that is known.
    pub verdict: Verdict,
    /// The failure in which the step ends where the guard is refuted.
    pub failure: FailureId,
}

/// A motion that must have a solution.
#[derive(Clone, PartialEq, Debug)]
pub struct Motion {
    /// The query, one of `go_to`, `reach`, `put`, `pull`, `push`, `offer`, `look`, `posture`.
    pub query: SmolStr,
    /// Its arguments.
    pub args: Vec<Term>,
    /// Whether it is known to have a solution.
    pub verdict: Verdict,
    /// The solution, where the motion is proven; none where it is deferred. Where several worlds may be met it is that of one.
    pub witness: Option<Box<Witness>>,
    /// Why it is deferred, in words, where something is known.
    pub why: Option<SmolStr>,
}

/// A motion that solves a query in the world that the compiler expects. Lengths in m, angles in rad, in the frame `map`.
#[derive(Clone, PartialEq, Debug)]
pub struct Witness {
    /// The joints that move on the way; all others stay as they are.
    pub joints: Vec<SmolStr>,
    /// From where the robot begins to where it ends, at least one; between two the robot moves straight in base and joints.
    pub path: Vec<Waypoint>,
    /// How a thing is held or put, where that was asked for.
    pub grasp: Option<Grasp>,
    /// Least distance on the way to what stands around, at most 1.
    pub clearance: f64,
    /// Room at the end to the nearest limit of a joint that moved, in m or rad.
    pub limit: Option<f64>,
    /// What the hand could carry beyond, in kg.
    pub payload: Option<f64>,
}

/// Where the robot is on its way.
#[derive(Clone, PartialEq, Debug)]
pub struct Waypoint {
    /// x, y and yaw of the base. Along a path yaw goes on beyond a half turn.
    pub base: [f64; 3],
    /// A position for each joint of the witness.
    pub joints: Vec<f64>,
}

/// A pose of the hand at which a thing is held.
#[derive(Clone, PartialEq, Debug)]
pub struct Grasp {
    /// Where the hand's tip is.
    pub xyz: [f64; 3],
    /// How it is turned: a unit quaternion x, y, z, w.
    pub quaternion: [f64; 4],
    /// How wide the hand has to be open.
    pub width: f64,
}

/// A change of what is believed.
#[derive(Clone, PartialEq, Debug)]
pub struct CallEffect {
    /// What changes.
    pub fact: Fact,
    /// Its new value.
    pub value: bool,
    /// The condition, in the state before the effects; [`Term::Each`] may occur in it.
    pub when: Option<Condition>,
    /// The kind over which [`Term::Each`] ranges.
    pub each: Option<KindId>,
}

/// What a monitor watches.
#[derive(Clone, PartialEq, Debug)]
pub struct Watch {
    /// The condition that fires it.
    pub condition: Condition,
    /// Seconds for which it must hold without a break.
    pub hold_secs: f64,
    /// What then happens.
    pub reaction: Reaction,
}

/// What a monitor does when it fires.
#[derive(Clone, PartialEq, Debug)]
pub enum Reaction {
    /// Hold the body until the condition is false again; more than `within_secs` in all is the failure `timeout`.
    Pause {
        /// The longest pause, all pauses of one run of the monitor taken together.
        within_secs: f64,
    },
    /// The body again from its start, at most so often; then the failure `exhausted`.
    Restart {
        /// How often.
        at_most: u32,
    },
    /// Interrupt, run a region, go on from the interrupted step; then the failure `exhausted`.
    Resume {
        /// How often.
        at_most: u32,
        /// What runs in between.
        body: RegionId,
    },
    /// End the policy, or the inlined policy `of`.
    End {
        /// How.
        how: Ending,
        /// The [`NodeKind::Inline`] node that ends; none for the whole policy.
        of: Option<NodeId>,
        /// The reason.
        why: Option<Term>,
    },
}

/// A failure edge.
#[derive(Clone, PartialEq, Debug)]
pub struct Handler {
    /// The failures that it takes; none takes all.
    pub on: Option<Vec<FailureId>>,
    /// What then runs.
    pub body: RegionId,
}
