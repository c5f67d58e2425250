//! Search for paths of the whole robot: goal configurations, and routes to them.

mod arm_candidates;
mod goal_search;
mod path;
mod rrt_connect;
mod workspace;

pub(crate) use arm_candidates::{PLANE, SPACE, part};
pub(crate) use goal_search::{GoalPose, GoalSpec};
pub(crate) use path::LAST;
pub(crate) use workspace::{ReachEnvelope, whole_centimetres};
