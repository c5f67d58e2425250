//! Grasps of an object: candidates for a search, and the manifold of all of them for a proof.

mod candidates;
mod held;
mod manifold;

pub(crate) use candidates::{GraspCandidate, grasp_candidates, in_order};
pub(crate) use manifold::{GraspManifold, GraspPatch, widest};
