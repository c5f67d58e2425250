//! Infeasibility certificates.

pub(crate) mod area_cover;
pub(crate) mod deflate;
pub(crate) mod infeasibility;
