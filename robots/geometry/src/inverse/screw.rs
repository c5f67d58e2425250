//! The axes of a chain with every joint at position 0, in the base's frame: the chain as a product of exponentials
//! (Brockett 1984).

use nalgebra::{Isometry3, Vector3};

use crate::kinematics::KinematicChain;

/// How far directions and points of a URDF may be off what is meant: its numbers are often rounded to six digits.
pub(super) const ROUNDED: f64 = 1e-6;

/// An axis: a direction of length 1, and a point on it (for a joint that slides, of no meaning).
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Screw {
    pub(super) direction: Vector3<f64>,
    pub(super) point: Vector3<f64>,
}

impl Screw {
    pub(super) fn is_parallel(&self, other: &Self) -> bool {
        self.direction.cross(&other.direction).norm() < ROUNDED
    }

    /// The point where two axes meet; `None` where they are parallel or pass each other.
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

/// The axes of all joints, and the tip's pose.
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

/// Whether each joint has a variable of its own, of which a turn is a turn of the joint.
pub(super) fn drives_each(chain: &KinematicChain) -> bool {
    chain.dofs.len() == chain.joints.len()
        && chain.joints.iter().zip(0..).all(|(joint, at)| {
            let size = joint.coupling.multiplier.abs();
            joint.coupling.dof == at
                && size > ROUNDED
                && (joint.is_prismatic || (size - 1.0).abs() <= f64::EPSILON)
        })
}
