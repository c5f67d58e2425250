//! The graph in memory: tables of declarations, nodes in an arena, regions that chain them.
//!
//! A **region** is a list of nodes that run one after the other with a single thread of control: the policy's body, a
//! branch, a handler. A **node** belongs to one region; its success edge leads to the next node of the region, or
//! ends the region in success. A node's failure ends its region in that failure, which fails the region's owner; a
//! [`NodeKind::Try`] owner has failure edges, its handlers. Ids are indices: stable for one graph, in document order.

use smol_str::SmolStr;

mod decl;
mod node;
mod term;

pub use decl::*;
pub use node::*;
pub use term::*;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
        pub struct $name(pub u32);
        impl $name {
            /// The index into its table.
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
#[derive(Clone, PartialEq, Debug)]
pub struct Graph {
    /// The policy's name.
    pub policy: SmolStr,
    /// The robot that it was compiled for; empty for a domain without a robot.
    pub robot: SmolStr,
    /// Entity kinds that the tables below name, parents before children.
    pub kinds: Vec<Kind>,
    /// Fluents that the graph uses.
    pub fluents: Vec<Fluent>,
    /// Measures that the graph uses.
    pub measures: Vec<Measure>,
    /// Primitives that the graph calls.
    pub primitives: Vec<Primitive>,
    /// Failure kinds that can occur or are caught. `timeout` is always the first.
    pub failures: Vec<SmolStr>,
    /// The robot's exclusive resources that the graph uses.
    pub resources: Vec<Resource>,
    /// Named results.
    pub bindings: Vec<Binding>,
    /// The nodes, in document order: a parent before its children.
    pub nodes: Vec<Node>,
    /// The regions; the first is the policy's body.
    pub regions: Vec<Region>,
    /// What the compiler was told of the state at the start, in order: facts with their value.
    pub initial: Vec<(Fact, bool)>,
    /// Seconds that one observation may take.
    pub observe_within_secs: f64,
    /// Least and greatest duration of the whole policy.
    pub duration: DurationBounds,
}

/// The policy's own region.
pub const ROOT: RegionId = RegionId(0);
/// The failure that every primitive can end in.
pub const TIMEOUT: FailureId = FailureId(0);

/// Least and greatest duration in seconds; `0 <= least <= greatest`, both finite.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct DurationBounds {
    /// Least.
    pub least_secs: f64,
    /// Greatest.
    pub greatest_secs: f64,
}
