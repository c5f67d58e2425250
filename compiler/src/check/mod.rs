//! Stage 2: what can be said of a resolved policy without following its state: the robot's limits, resources, bounds,
//! and what is written but not meant.

mod bounds;
mod descriptions;
pub(crate) mod errors;
mod resources;
mod robot;

pub(crate) use bounds::of_block as bounds_of;
use motet_syntax::Diagnostic;

use crate::ir::Program;
use crate::library::Library;
use crate::world::World;

/// Checks a program and fills in how long its steps take.
pub(crate) fn check(
    program: &mut Program,
    library: &Library,
    world: &World,
    max_duration_secs: Option<f64>,
) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    robot::check(&program.steps, library, &mut diagnostics);
    resources::check(program, 0, library, &mut diagnostics);
    bounds::check(program, library, max_duration_secs, &mut diagnostics);
    descriptions::check(program, library, world, &mut diagnostics);
    diagnostics
}

/// What is wrong with the steps from `first` on of a policy that is being written: all that [`check`] says as an error, but
/// for the duration of the whole.
pub(crate) fn check_from(program: &Program, first: usize, library: &Library) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    robot::check(program.steps.get(first..).unwrap_or_default(), library, &mut diagnostics);
    resources::check(program, first, library, &mut diagnostics);
    diagnostics
}
