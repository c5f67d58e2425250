//! The graph: tables of declarations, nodes in an arena, and regions that chain them.
//!
//! A **region** is a list of nodes that run one after the other with a single thread of control: the policy's
//! body, a branch, a handler. A **node** belongs to one region; its success edge leads to the next node of
//! the region, or ends the region in success. A node's failure ends its region in that failure, which fails
//! the region's owner; a [`NodeKind::Try`] owner has failure edges, its handlers. Ids are indices: stable for
//! one graph, in document order.
//!
//! The types derive their JSON form. Explicit names stand where JSON and Rust differ; [`crate::encode`] adds
//! the version and the hash. Nothing here is checked: that is the task of [`crate::validate()`].

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;

mod declaration;
mod node;
mod number;
mod term;
mod value;

pub use declaration::*;
pub use node::*;
pub use term::*;
pub use value::*;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
        #[derive(Serialize, Deserialize, JsonSchema)]
        #[serde(transparent)]
        pub struct $name(pub u32);
        impl $name {
            /// Position in the table.
            #[must_use]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }
    )*};
}

ids! {
    /// Index into [`Graph::nodes`].
    NodeId
    /// Index into [`Graph::regions`].
    RegionId
    /// Index into [`Graph::bindings`].
    BindingId
    /// Index into [`Graph::kinds`].
    KindId
    /// Index into [`Graph::fluents`].
    FluentId
    /// Index into [`Graph::measures`].
    MeasureId
    /// Index into [`Graph::primitives`].
    PrimitiveId
    /// Index into [`Graph::failures`].
    FailureId
    /// Index into [`Graph::resources`].
    ResourceId
}

/// A compiled policy.
///
/// ```
/// let text = motet_graph::encode(&motet_graph::Graph::empty("tidy_up", "hsr"));
/// let graph = motet_graph::decode(&text)?;
/// assert_eq!((graph.policy.as_str(), graph.nodes.len()), ("tidy_up", 0));
/// # Ok::<(), motet_graph::DecodeError>(())
/// ```
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Graph {
    /// Name of the policy.
    pub policy: SmolStr,
    /// Name of the robot that the policy was compiled for; empty for a domain without a robot.
    pub robot: SmolStr,
    /// Entity kinds that the other tables refer to, parents before children.
    pub kinds: Vec<Kind>,
    /// Fluents that the graph uses.
    pub fluents: Vec<Fluent>,
    /// Measures that the graph uses.
    pub measures: Vec<Measure>,
    /// Primitives that the graph calls.
    pub primitives: Vec<Primitive>,
    /// Failure kinds that can occur or are caught; the first is always `timeout`.
    pub failures: Vec<SmolStr>,
    /// Exclusive resources of the robot that the graph uses.
    pub resources: Vec<Resource>,
    pub bindings: Vec<Binding>,
    /// Entities that documents declare, where a need or an effect is about each entity of a kind. Those of
    /// the scene are not among them: the host names them at the start of a run.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub entities: Vec<DeclaredEntity>,
    /// What people call the entities that a text may name; any other is called by its id.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<EntityName>,
    /// Sentences for kinds of failure, where a handler names its failure; any other is called by its kind.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sentences: Vec<FailureSentence>,
    /// Binding of the result, of a policy that gives one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub result: Option<BindingId>,
    /// Parts of the goal that the robot can observe. The engine observes them when the policy is done: the
    /// run fails if one of them is false.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub goal: Vec<Condition>,
    /// Tests of an `if` that look again at what a hand holds: it may have dropped.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub hands: Vec<NodeId>,
    /// Regions; the first is the policy's body.
    pub regions: Vec<Region>,
    /// Nodes in document order: a parent before its children.
    pub nodes: Vec<Node>,
    /// Facts from which the policy was proved, in order; a later one overrides an earlier one.
    pub initial: Vec<InitialFact>,
    /// Seconds that one observation may take.
    #[serde(rename = "observe_within")]
    pub observe_within_secs: f64,
    /// Least and greatest duration of the whole policy in seconds.
    #[schemars(with = "[f64; 2]")]
    pub duration: DurationBounds,
}

impl Graph {
    /// Name of a type as the language writes it: `Object`, `Length`, `List<Text>`.
    #[must_use]
    pub fn type_name(&self, ty: &Type) -> String {
        match ty {
            Type::Bool => "Bool".to_owned(),
            Type::Int => "Int".to_owned(),
            Type::Number => "Number".to_owned(),
            Type::Text => "Text".to_owned(),
            Type::Pose => "Pose".to_owned(),
            Type::Quantity(name) | Type::Case(name) => name.to_string(),
            Type::Entity(kind) => {
                self.kinds.get(kind.index()).map(|kind| kind.name.to_string()).unwrap_or_default()
            }
            Type::List(inner) => format!("List<{}>", self.type_name(inner)),
        }
    }

    /// Number of motions that the compiler left to the run.
    #[must_use]
    pub fn deferred_motions(&self) -> usize {
        let is_deferred = |kind: &NodeKind| {
            let NodeKind::Call(call) = kind else { return false };
            call.motion.as_ref().is_some_and(|motion| motion.verdict == Verdict::Deferred)
        };
        self.nodes.iter().filter(|node| is_deferred(&node.kind)).count()
    }

    /// A valid graph without steps, which succeeds at once.
    #[must_use]
    pub fn empty(policy: &str, robot: &str) -> Self {
        Self {
            policy: policy.into(),
            robot: robot.into(),
            kinds: Vec::new(),
            fluents: Vec::new(),
            measures: Vec::new(),
            primitives: Vec::new(),
            failures: vec![SmolStr::new_static("timeout")],
            resources: Vec::new(),
            bindings: Vec::new(),
            names: Vec::new(),
            entities: Vec::new(),
            sentences: Vec::new(),
            result: None,
            goal: Vec::new(),
            hands: Vec::new(),
            regions: vec![Region { owner: None, entry: None }],
            nodes: Vec::new(),
            initial: Vec::new(),
            observe_within_secs: 0.5,
            duration: DurationBounds::default(),
        }
    }
}

/// The region of the policy's body.
pub const ROOT: RegionId = RegionId(0);
/// The failure in which every primitive can end.
pub const TIMEOUT: FailureId = FailureId(0);

/// Least and greatest duration in seconds; `0 <= least <= greatest`, both finite. In JSON a pair of numbers.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(from = "[f64; 2]", into = "[f64; 2]")]
pub struct DurationBounds {
    pub least_secs: f64,
    pub greatest_secs: f64,
}

impl From<[f64; 2]> for DurationBounds {
    fn from([least_secs, greatest_secs]: [f64; 2]) -> Self {
        Self { least_secs, greatest_secs }
    }
}

impl From<DurationBounds> for [f64; 2] {
    fn from(bounds: DurationBounds) -> Self {
        [bounds.least_secs, bounds.greatest_secs]
    }
}
