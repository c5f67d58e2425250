//! Infeasibility certificates: proofs that no configuration satisfies a motion query.

mod area_cover;
mod deflate;
mod infeasibility;

pub(crate) use area_cover::ExcludedPlaces;
pub(crate) use deflate::{DeflatedPart, inner, resized};
pub(crate) use infeasibility::Certificate;
