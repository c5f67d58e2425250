//! Validation of graphs: checks, once, every property on which an engine relies.
//!
//! In three passes: [`structure`] (tables, regions, edges), then, where that is sound, [`types`] (arguments
//! and conditions), [`bound`] (names before they are bound) and resources (calls that run at once).

mod bound;
mod invalid;
mod structure;
mod tables;
mod types;

pub use invalid::{InvalidGraph, InvalidReason, MAX_DEPTH, MAX_NODES, MAX_RESOURCES, MAX_TERM_DEPTH};

use crate::model::{Graph, Node};
use smol_str::SmolStr;

/// Checks a graph. Costs its size.
///
/// ```
/// use motet_graph::{Graph, validate};
///
/// let mut graph = Graph::empty("tidy_up", "hsr");
/// assert_eq!(validate(&graph), Ok(()));
/// graph.failures.clear();
/// let errors = validate(&graph).expect_err("the first failure is `timeout`");
/// assert_eq!(errors[0].at, "failure 0");
/// ```
///
/// # Errors
///
/// Everything that was found, in document order within each pass. A graph whose structure is unsound is not
/// looked at further.
pub fn validate(graph: &Graph) -> Result<(), Vec<InvalidGraph>> {
    let mut findings = Findings::default();
    tables::check(graph, &mut findings);
    structure::check(graph, &mut findings);
    if !findings.list.is_empty() {
        return Err(findings.list);
    }
    tables::check_numbers(graph, &mut findings);
    types::check(graph, &mut findings);
    bound::check(graph, &mut findings);
    structure::check_resources(graph, &mut findings);
    if findings.list.is_empty() { Ok(()) } else { Err(findings.list) }
}

/// Errors found so far.
#[derive(Debug, Default)]
struct Findings {
    list: Vec<InvalidGraph>,
}

impl Findings {
    /// A finding about a table.
    fn table(&mut self, table: &str, index: usize, reason: InvalidReason) {
        self.add(SmolStr::from(format!("{table} {index}")), reason);
    }

    /// A finding about a node.
    fn node(&mut self, node: &Node, reason: InvalidReason) {
        self.add(node.path.clone(), reason);
    }

    /// A graph with many mistakes does not give a list without end.
    fn add(&mut self, at: SmolStr, reason: InvalidReason) {
        if self.list.len() < invalid::MAX_FINDINGS {
            self.list.push(InvalidGraph { at, reason });
        }
    }
}
