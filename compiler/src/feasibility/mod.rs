//! Stage 4, motion feasibility: an abstract interpretation on sets of possible worlds, in which the motions
//! of a policy are queried.
//!
//! Each world has the robot, the things and the doors at definite poses. A motion that was found leads to the
//! next world. Where more than a few worlds are possible, or where a pose is unknown, motions are deferred:
//! no motion is called feasible without a witness, and none infeasible unless that is proven or its search
//! ended without a result. The engine checks deferred motions at run time.
//!
//! Guarded by `compiler/tests/compiler/feasibility.rs` and `tests/tests/it/dynamic.rs`.

pub(crate) mod diagnostics;
mod domain;
mod geometry;
mod keep;
mod motion;
mod plain_reason;
mod sight;
mod transfer;
mod verdict;
mod world_tracker;

pub use geometry::{Access, Geometry};
pub(crate) use verdict::{MotionVerdict, MotionVerdicts};
pub use world_tracker::{Forecast, WorldTracker};

use motet_syntax::Diagnostic;

use self::domain::MotionChecker;
use crate::analysis::Domain;
use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::Program;
use crate::prove::Proof;

/// Checks the motions of a program that has no errors.
pub(crate) fn check(
    program: &Program,
    proof: &Proof,
    library: &Library,
    environment: &Environment,
    geometry: &Geometry,
) -> (MotionVerdicts, Vec<Diagnostic>) {
    let mut checker = MotionChecker::new(program, proof, library, environment, geometry);
    checker.block(&program.body);
    checker.into_results()
}
