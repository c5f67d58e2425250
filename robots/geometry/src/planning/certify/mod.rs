//! Infeasibility certificates: proofs that no configuration satisfies a motion query.

mod area_cover;
mod deflate;
mod infeasibility;

pub(crate) use deflate::{DeflatedPart, inner, resized};
pub(crate) use infeasibility::Certificate;
