//! Stage 4: geometry. It answers each motion of a policy in the world after the steps before it.
//!
//! The policy is walked with the worlds that may be met, each with the robot, the things and the doors at definite places: a
//! motion that is answered leads to the next world. Where more than a few worlds may be met, or where something is no longer at
//! a known place, motions are deferred: nothing is called feasible without a witness, and nothing infeasible that was not
//! searched to its end. What is not known to this stage is left to the run.

mod access;
mod after;
mod course;
pub(crate) mod errors;
mod geometry;
mod meaning;
mod story;
mod walk;
mod ways;
mod witness;

pub use access::Access;
pub use course::{Course, Prospect};
pub use geometry::Geometry;

use motet_graph::Witness;
use motet_syntax::Diagnostic;
use smol_str::SmolStr;

use crate::ir::Program;
use crate::library::Library;
use crate::prove::Proof;
use crate::world::World;

/// What was found of a motion that is not refused.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Verdict {
    /// It can be done in every world that may be met; in one of them like this.
    Feasible(Box<Witness>),
    /// It is left to the run, for this reason where one is known.
    Deferred(Option<SmolStr>),
}

/// The verdict on every motion: none for a step without one, or where no geometry is computed.
pub(crate) type Placed = Vec<Option<Verdict>>;

/// Answers the motions of a program that has no errors.
pub(crate) fn place(
    program: &Program,
    proof: &Proof,
    library: &Library,
    world: &World,
    geometry: &Geometry,
) -> (Placed, Vec<Diagnostic>) {
    let mut walk = walk::Walk::new(program, proof, library, world, geometry);
    walk.policy();
    walk.told()
}
