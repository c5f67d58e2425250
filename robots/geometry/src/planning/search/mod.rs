//! Search for paths of the whole robot.

pub(crate) mod arm_candidates;
pub(crate) mod context;
pub(crate) mod goal_search;
pub(crate) mod path;
pub(crate) mod prefilter_arm;
pub(crate) mod retreat;
pub(crate) mod rrt_connect;
pub(crate) mod workspace;
