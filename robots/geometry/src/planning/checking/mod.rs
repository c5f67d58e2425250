//! Collision checks of configurations and edges.

pub(crate) mod collision_checker;
pub(crate) mod edge_check;
pub(crate) mod hand_check;
pub(crate) mod margins;
pub(crate) mod motion_bound;
pub(crate) mod prefilter;
