//! Inverse kinematics: joint values that put a tip at a pose.
//!
//! The closed form for an arm is chosen by the axes of its joints, never by names: [`LiftArm`] for a lift, a
//! shoulder and a spherical wrist on a base that drives in any direction; [`ParallelArm`] for six revolute
//! joints of which three inner ones are parallel; [`SevenArm`] for shoulder, elbow and wrist as in the Franka
//! arms. [`numeric`] solves any chain. All solutions are within the limits and confirmed by forward
//! kinematics.

pub mod batch;
pub(crate) mod interval;
mod lift_arm;
pub mod numeric;
mod parallel_arm;
mod screw;
mod seven_arm;

use nalgebra::Isometry3;

use crate::trigonometry::rotation_vector;

pub use lift_arm::{LiftArm, MobileSolution};
pub use parallel_arm::ParallelArm;
pub use seven_arm::SevenArm;

/// Greatest deviation of a pose from the requested one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Tolerance {
    /// Distance of the origins, in m.
    pub position: f64,
    /// Angle of the relative rotation, in rad.
    pub angle: f64,
}

impl Tolerance {
    /// Tolerance for equal poses: far below the accuracy of a robot, far above rounding.
    pub const EXACT: Self = Self { position: 1e-7, angle: 1e-7 };

    /// Checks whether two poses in one frame differ by no more than the tolerance.
    #[must_use]
    pub fn covers(self, one: &Isometry3<f64>, other: &Isometry3<f64>) -> bool {
        let metres = (one.translation.vector - other.translation.vector).norm();
        metres <= self.position
            && rotation_vector(&(one.rotation.inverse() * other.rotation)).norm() <= self.angle
    }
}
