//! The `motet` command, for the script that the wheel puts on the path.

use std::path::PathBuf;

use pyo3::prelude::*;

/// Runs a command line and returns its exit status. `words` begins with the path of the script.
#[pyfunction]
pub(crate) fn command(py: Python<'_>, words: Vec<PathBuf>) -> u8 {
    let program = words.first().and_then(|script| std::path::absolute(script).ok());
    py.detach(|| motet_cli::run(words.into_iter().map(PathBuf::into_os_string), program))
}
