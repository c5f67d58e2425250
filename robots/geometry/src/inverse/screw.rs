//! Joint axes of a chain at position 0, in the frame of the base: the chain as a product of exponentials
//! (Brockett 1984).

use nalgebra::{Isometry3, Vector3};

use crate::kinematics::KinematicChain;

/// Tolerance for axes of a URDF, whose numbers are often rounded to six digits.
pub(super) const ROUNDED: f64 = 1e-6;

/// Axis of a joint: a unit vector and a point on the axis (without meaning for a prismatic joint).
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Screw {
    pub(super) direction: Vector3<f64>,
    pub(super) point: Vector3<f64>,
}

impl Screw {
    pub(super) fn is_parallel(&self, other: &Self) -> bool {
        self.direction.cross(&other.direction).norm() < ROUNDED
    }

    /// Intersection of two axes; `None` if they are parallel or skew.
    pub(super) fn meeting(&self, other: &Self) -> Option<Vector3<f64>> {
        let normal = self.direction.cross(&other.direction);
        let square = normal.norm_squared();
        if square < 1e-6 {
            return None;
        }
        let between = other.point - self.point;
        if (between.dot(&normal) / square.sqrt()).abs() > ROUNDED {
            return None;
        }
        Some(self.point + self.direction * (between.cross(&other.direction).dot(&normal) / square))
    }

    pub(super) fn contains(&self, point: &Vector3<f64>) -> bool {
        (point - self.point).cross(&self.direction).norm() < ROUNDED
    }
}

/// Axes of all joints, and the pose of the tip, at position 0.
pub(super) fn screws(chain: &KinematicChain) -> (Vec<Screw>, Isometry3<f64>) {
    let mut base_from_joint = Isometry3::identity();
    let screws = chain.joints.iter().map(|joint| {
        base_from_joint *= joint.before;
        Screw {
            direction: base_from_joint * joint.axis.into_inner(),
            point: base_from_joint.translation.vector,
        }
    });
    let screws = screws.collect();
    (screws, base_from_joint * chain.last_from_tip)
}

/// Checks that each joint has a degree of freedom of its own, and that full turns of both coincide.
pub(super) fn drives_each(chain: &KinematicChain) -> bool {
    chain.dofs.len() == chain.joints.len()
        && chain.joints.iter().zip(0..).all(|(joint, at)| {
            let size = joint.coupling.multiplier.abs();
            joint.coupling.dof == at
                && size > ROUNDED
                && (joint.is_prismatic || (size - 1.0).abs() <= f64::EPSILON)
        })
}
