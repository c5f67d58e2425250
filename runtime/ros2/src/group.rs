//! The table of a binding for MoveGroup.

use serde::Deserialize;

/// MoveGroup of MoveIt, which moves the arm where no certified path exists.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct MoveGroup {
    /// Action of `moveit_msgs/MoveGroup`.
    #[serde(default = "move_action")]
    pub(crate) action: String,
    /// Planning group whose joints it moves.
    pub(crate) group: String,
    /// Link that the grasps place; its pose is a goal. Without one only joints are goals.
    #[serde(default)]
    pub(crate) link: Option<String>,
    /// Poses of the link in the frame of the thing; any of them is a goal.
    #[serde(default)]
    pub(crate) grasps: Vec<GraspPose>,
    /// Frame of the goals; that of the base without one.
    #[serde(default)]
    pub(crate) frame: Option<String>,
    #[serde(default)]
    pub(crate) pipeline: String,
    #[serde(default)]
    pub(crate) planner: String,
    #[serde(default = "five")]
    pub(crate) planning_secs: f64,
    #[serde(default = "few")]
    pub(crate) attempts: u32,
    /// Shares of the greatest speed and acceleration, from 0 to 1.
    #[serde(default = "slow")]
    pub(crate) speed: f64,
    #[serde(default = "slow")]
    pub(crate) acceleration: f64,
    /// Errors of a goal in m and rad.
    #[serde(default = "near")]
    pub(crate) position: f64,
    #[serde(default = "near")]
    pub(crate) rotation: f64,
}

/// Pose of the hand at a thing.
#[derive(Clone, Copy, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GraspPose {
    /// Position in m.
    pub(crate) xyz: [f64; 3],
    /// Roll, pitch and yaw in rad.
    #[serde(default)]
    pub(crate) rpy: [f64; 3],
}

fn move_action() -> String {
    "/move_action".to_owned()
}

const fn five() -> f64 {
    5.0
}

const fn few() -> u32 {
    5
}

const fn slow() -> f64 {
    0.3
}

const fn near() -> f64 {
    0.01
}
