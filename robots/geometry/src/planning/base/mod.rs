//! Map of the floor for a driving base.

mod base_map;
mod constraint_removal;
mod footprint;

pub(crate) use base_map::BaseMap;
