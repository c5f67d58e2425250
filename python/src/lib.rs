//! Native part of the Python package `motet`: checks, runs and decoders over the facade. The classes that
//! people see are in `motet/*.py`; what passes between is text, mostly JSON.

mod command;
mod conformance;
mod decoder;
mod errors;
mod feasible;
mod findings;
mod graph;
mod project;
mod run;

/// The native part of `motet`.
#[pyo3::pymodule]
mod _motet {
    #[pymodule_export]
    use crate::command::command;
    #[pymodule_export]
    use crate::conformance::harmless_steps;
    #[pymodule_export]
    use crate::decoder::{Decoder, Environment, Vocabulary};
    #[pymodule_export]
    use crate::errors::explain;
    #[pymodule_export]
    use crate::feasible::feasible;
    #[pymodule_export]
    use crate::findings::Findings;
    #[pymodule_export]
    use crate::graph::Graph;
    #[pymodule_export]
    use crate::project::Project;
    #[pymodule_export]
    use crate::run::{Run, replay};

    #[pymodule_export]
    #[allow(non_upper_case_globals, reason = "the name is Python's")]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
