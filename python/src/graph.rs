//! Compiled policies with their graphs, in the encodings and drawings of `motet compile`.

use std::sync::Arc;

use motet::ProjectSession;
use motet::document;
use motet::graph::draw;
use motet_syntax::{Parsed, Syntax};
use pyo3::prelude::*;

use crate::errors::wrong;

/// Session of one robot, which documents share.
pub(crate) type Opened = Arc<ProjectSession>;

/// A policy that has passed the check, with its execution graph.
#[pyclass(frozen, module = "motet._motet")]
pub(crate) struct Graph {
    pub(crate) graph: motet::Graph,
    pub(crate) parsed: Parsed,
    pub(crate) opened: Opened,
    /// Policy that was chosen by name, of several in the document.
    pub(crate) chosen: Option<String>,
}

#[pymethods]
impl Graph {
    /// Name of the policy.
    #[getter]
    fn policy(&self) -> &str {
        &self.graph.policy
    }

    /// The graph in its versioned JSON encoding.
    fn json(&self, py: Python<'_>) -> String {
        py.detach(|| motet::graph::encode(&self.graph))
    }

    /// The graph as an indented tree with guards, effects and durations.
    fn tree(&self, py: Python<'_>) -> String {
        py.detach(|| draw::text(&self.graph))
    }

    /// The graph as a Mermaid flowchart.
    fn mermaid(&self, py: Python<'_>) -> String {
        py.detach(|| draw::mermaid(&self.graph))
    }

    /// The graph for Graphviz.
    fn dot(&self, py: Python<'_>) -> String {
        py.detach(|| draw::dot(&self.graph))
    }

    /// The policy as text or as JSON.
    fn policy_as(&self, py: Python<'_>, syntax: &str) -> PyResult<String> {
        let (library, syntax) = (self.opened.session.library(), syntax_of(syntax)?);
        let written = py.detach(|| document::write(&self.parsed, self.chosen.as_deref(), library, syntax));
        written.map_err(wrong)
    }
}

/// Syntax of this name.
pub(crate) fn syntax_of(name: &str) -> PyResult<Syntax> {
    match name {
        "json" => Ok(Syntax::Json),
        "text" => Ok(Syntax::Text),
        other => Err(wrong(format!("there is no syntax `{other}`: json or text"))),
    }
}
