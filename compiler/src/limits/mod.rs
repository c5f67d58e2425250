//! Stage 2: what can be said of a resolved policy without following its state: the robot's limits, resources,
//! bounds, and what is written but not meant.

mod capabilities;
pub(crate) mod diagnostics;
mod durations;

pub(crate) use self::capabilities::check_robot_name;
pub(crate) use self::durations::{fill_from as fill_in_bounds, of_block as bounds_of};
use motet_syntax::Diagnostic;

use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::Program;

/// Checks a program against the robot's limits, and returns it with the duration of each step filled in.
pub(crate) fn check(
    mut program: Program,
    library: &Library,
    environment: &Environment,
    max_duration_secs: Option<f64>,
) -> (Program, Vec<Diagnostic>) {
    let mut diagnostics = Vec::new();
    capabilities::check(&program.steps, library, &mut diagnostics);
    capabilities::check_resources(&program, 0, library, &mut diagnostics);
    capabilities::check_cleanups(&program, 0, &mut diagnostics);
    durations::fill_in(&mut program, library, max_duration_secs, &mut diagnostics);
    capabilities::check_descriptions(&program, library, environment, &mut diagnostics);
    (program, diagnostics)
}

/// Checks the steps from `first` on of a policy that is being written: every error of [`check`] but that
/// about the duration of the whole.
pub(crate) fn check_from(program: &Program, first: usize, library: &Library) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    capabilities::check(program.steps.get(first..).unwrap_or_default(), library, &mut diagnostics);
    capabilities::check_resources(program, first, library, &mut diagnostics);
    capabilities::check_cleanups(program, first, &mut diagnostics);
    diagnostics
}
