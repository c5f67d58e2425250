//! Regions and nodes: the control flow of a policy.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

use super::{BindingId, CallNode, Condition, DurationBounds, FailureId, NodeId, RegionId, Term};

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

/// Kind of a node, with its parts.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum NodeKind {
    /// Runs a primitive.
    Call(CallNode),
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

/// Outcome that a policy states itself.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Ending {
    /// The goal is reached.
    Done,
    /// The policy gives up.
    Fail,
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
    /// `timeout`.
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
    /// Region that then runs.
    pub body: RegionId,
}
