//! Infeasibility certificates: proofs that no configuration satisfies a motion query.

pub(crate) mod area_cover;
pub(crate) mod deflate;
pub(crate) mod infeasibility;
