//! What stands in a document. Field by field the same as the model, with ids as plain numbers.

mod float;
mod step;
mod table;
mod term;

pub use float::Float;
pub use step::*;
pub use table::*;
pub use term::*;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A graph.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// The version of the encoding, 2.
    pub motet_graph: u32,
    /// `sha256:` and the hash of the document without white space and with an empty hash.
    pub hash: String,
    /// The policy's name.
    pub policy: String,
    /// The robot's name; empty without one.
    pub robot: String,
    /// Entity kinds, parents before children.
    pub kinds: Vec<Kind>,
    /// Fluents.
    pub fluents: Vec<Fluent>,
    /// Measures.
    pub measures: Vec<Measure>,
    /// Primitives.
    pub primitives: Vec<Primitive>,
    /// Failure kinds; the first is `timeout`.
    pub failures: Vec<String>,
    /// Exclusive resources.
    pub resources: Vec<Resource>,
    /// Named results.
    pub bindings: Vec<Binding>,
    /// Regions; the first is the policy's body.
    pub regions: Vec<Region>,
    /// Nodes in document order.
    pub nodes: Vec<Node>,
    /// Facts that were known at the start.
    pub initial: Vec<Known>,
    /// Seconds that one observation may take.
    pub observe_within: f64,
    /// Least and greatest duration of the policy in seconds.
    pub duration: [f64; 2],
}
