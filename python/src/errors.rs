//! Errors of the facade as exceptions of Python.

use motet::ProjectError;
use motet_syntax::render;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// `ValueError` with a message.
pub(crate) fn wrong(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// `motet.InputError` with advice and the diagnostics of a file, as JSON objects, one a line.
pub(crate) fn input_error(py: Python<'_>, error: &motet::Error) -> PyErr {
    let (help, json) = match error {
        motet::Error::Project(error) => (error.help().map(str::to_owned), diagnostics(error)),
        _ => (None, String::new()),
    };
    raised(py, "InputError", (error.to_string(), help, json))
}

/// Exception of a class of `motet.errors`.
pub(crate) fn raised<'py, A: pyo3::call::PyCallArgs<'py>>(py: Python<'py>, class: &str, args: A) -> PyErr {
    let made = py.import("motet.errors").and_then(|module| module.getattr(class)?.call1(args));
    made.map_or_else(|error| error, PyErr::from_value)
}

fn diagnostics(error: &ProjectError) -> String {
    match error {
        ProjectError::Invalid { diagnostics, sources, .. } => render::json(diagnostics, sources),
        _ => String::new(),
    }
}

/// The page of a diagnostic code in Markdown; `None` if there is no such code.
#[pyfunction]
pub(crate) fn explain(code: &str) -> Option<&'static str> {
    motet::compiler::explain_pages::page(code).map(|page| page.text)
}
