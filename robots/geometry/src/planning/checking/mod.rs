//! Collision checks of configurations and edges.

mod collision_checker;
mod edge_check;
mod hand_check;
mod margins;
mod prefilter;

pub(crate) use collision_checker::{CollisionChecker, NearObstacle, is_nearer};
pub(crate) use edge_check::MotionBound;
pub(crate) use hand_check::HandChecker;
