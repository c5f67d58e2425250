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

use pyo3::prelude::*;

/// The native part of `motet`.
#[pymodule]
fn _motet(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<decoder::Vocabulary>()?;
    module.add_class::<decoder::Environment>()?;
    module.add_class::<decoder::Decoder>()?;
    module.add_class::<findings::Findings>()?;
    module.add_class::<graph::Graph>()?;
    module.add_class::<project::Project>()?;
    module.add_class::<run::Run>()?;
    module.add_function(wrap_pyfunction!(conformance::harmless_steps, module)?)?;
    module.add_function(wrap_pyfunction!(command::command, module)?)?;
    module.add_function(wrap_pyfunction!(feasible::feasible, module)?)?;
    module.add_function(wrap_pyfunction!(run::replay, module)?)?;
    module.add_function(wrap_pyfunction!(errors::explain, module)?)
}
