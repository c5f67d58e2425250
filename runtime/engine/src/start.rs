//! What a host knows when a run begins, beside what stands in the graph.

use crate::query::Query;
use smol_str::SmolStr;

/// What is known at the start. Facts and kinds that the graph does not mention are left out.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct StartState {
    /// Facts with their value, in order: a later one wins. Queries that are no facts are ignored.
    pub facts: Vec<(Query, bool)>,
    /// Entities with the name of their kind. Effects that quantify over a kind range over these and over every entity
    /// that a graph, a result or an observation names.
    pub entities: Vec<(SmolStr, SmolStr)>,
}
