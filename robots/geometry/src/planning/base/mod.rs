//! Map of the floor for a driving base.

pub(crate) mod base_map;
pub(crate) mod constraint_removal;
pub(crate) mod footprint;
