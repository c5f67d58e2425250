//! Stage 4: geometry. It answers each motion of a policy in the world after the steps before it.
//!
//! The policy is walked with the worlds that may be met, each with the robot, the things and the doors at definite places: a
//! motion that is answered leads to the next world. Where more than a few worlds may be met, or where something is no longer at
//! a known place, motions are deferred: nothing is called feasible without a witness, and nothing infeasible that was not
//! searched to its end. What is not known to this stage is left to the run.

mod access;
pub(crate) mod errors;
mod explanation;
mod geometry;
mod motion;
mod transfer;
mod walk;
mod witness;
mod world_tracker;
mod worlds;

pub use access::Access;
pub use geometry::Geometry;
pub use world_tracker::{Forecast, WorldTracker};

use motet_graph::Witness;
use motet_syntax::Diagnostic;
use smol_str::SmolStr;

use crate::declare::Library;
use crate::environment::Environment;
use crate::ir::Program;
use crate::prove::Proof;

/// What was found of a motion that is not refused.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum MotionVerdict {
    /// It can be done in every world that may be met; in one of them like this.
    Feasible(Box<Witness>),
    /// It is left to the run, for this reason where one is known.
    Deferred(Option<SmolStr>),
}

/// The verdict on every motion: none for a step without one, or where no geometry is computed.
pub(crate) type MotionVerdicts = Vec<Option<MotionVerdict>>;

/// Answers the motions of a program that has no errors.
pub(crate) fn check(
    program: &Program,
    proof: &Proof,
    library: &Library,
    environment: &Environment,
    geometry: &Geometry,
) -> (MotionVerdicts, Vec<Diagnostic>) {
    let mut walk = walk::Walk::new(program, proof, library, environment, geometry);
    walk.policy();
    walk.into_results()
}
