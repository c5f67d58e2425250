//! Grasps of an object: candidates for a search, and the manifold of all of them for a proof.

pub(crate) mod candidates;
pub(crate) mod manifold;
