//! Diagnostics with the sources of their spans.

use std::sync::Arc;

use motet::project::DiagnosticSink;
use motet_syntax::render::{self, ColorChoice};
use motet_syntax::{Diagnostic, Sources};
use pyo3::prelude::*;

/// Diagnostics of the inputs and of one document, in this order.
#[pyclass(frozen, module = "motet._motet")]
#[derive(Clone, Default)]
pub(crate) struct Findings(Vec<Arc<(Vec<Diagnostic>, Sources)>>);

impl Findings {
    /// Adds all of other findings.
    pub(crate) fn extend(&mut self, others: &Self) {
        self.0.extend(others.0.iter().cloned());
    }

    /// JSON objects, one a line, as `motet check --format json` prints them.
    pub(crate) fn lines(&self) -> String {
        self.rendered(render::json).concat()
    }

    fn rendered(&self, one: impl Fn(&[Diagnostic], &Sources) -> String) -> Vec<String> {
        self.0.iter().map(|part| one(&part.0, &part.1)).collect()
    }
}

impl DiagnosticSink for Findings {
    fn report(&mut self, diagnostics: &[Diagnostic], sources: &Sources) {
        if !diagnostics.is_empty() {
            self.0.push(Arc::new((diagnostics.to_vec(), sources.clone())));
        }
    }
}

#[pymethods]
impl Findings {
    /// JSON objects, one a line, as `motet check --format json` prints them.
    fn json(&self, py: Python<'_>) -> String {
        py.detach(|| self.lines())
    }

    /// Text for people with the source around each span, in up to `width` columns.
    fn human(&self, py: Python<'_>, width: usize, color: bool) -> String {
        let color = if color { ColorChoice::On } else { ColorChoice::Off };
        let text = |found: &[Diagnostic], sources: &Sources| render::human(found, sources, color, width);
        py.detach(|| self.rendered(text).join("\n"))
    }

    /// Short sentences for the next prompt of a language model, the most useful first.
    fn llm(&self, py: Python<'_>) -> String {
        py.detach(|| self.rendered(render::llm).concat())
    }
}
