//! Inverse kinematics: joint positions that put a tip at a pose.
//!
//! Which arm has a closed form is read off the axes of its joints, never off names: [`LiftArm`] for a lift, a shoulder
//! and a wrist whose three axes meet in a point, on a base that drives in any direction; [`ParallelArm`] for six turning
//! joints of which the inner three are parallel; [`SevenArm`] for a shoulder, an elbow and a wrist as of the Franka arms. [`numeric`]
//! takes any chain. What is returned is within the limits, and
//! forward kinematics confirms it.

pub mod batch;
pub(crate) mod interval;
mod lift_arm;
pub mod numeric;
mod parallel_arm;
mod screw;
mod seven_arm;
mod subproblem;
mod wide_angles;

pub use lift_arm::{LiftArm, MobileSolution};
pub use parallel_arm::ParallelArm;
pub use seven_arm::SevenArm;

use nalgebra::Isometry3;

use crate::trigonometry::rotation_vector;

/// How far a pose may be from the one that was asked for.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tolerance {
    /// In m.
    pub position: f64,
    /// In rad.
    pub angle: f64,
}

impl Tolerance {
    /// What counts as the same pose: far below what any robot can do, far above rounding.
    pub const EXACT: Self = Self { position: 1e-7, angle: 1e-7 };

    /// Whether two poses in one frame are as near as that.
    #[must_use]
    pub fn covers(self, one: &Isometry3<f64>, other: &Isometry3<f64>) -> bool {
        let metres = (one.translation.vector - other.translation.vector).norm();
        metres <= self.position
            && rotation_vector(&(one.rotation.inverse() * other.rotation)).norm() <= self.angle
    }
}
