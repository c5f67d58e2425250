//! Joint axes of a chain at position 0, in the frame of the base: the chain as a product of exponentials
//! (Brockett 1984). With them the three rotation subproblems of closed-form inverse kinematics (Paden 1986;
//! Kahan 1983), and their solutions within limits.

use std::f64::consts::TAU;

use nalgebra::{Isometry3, Unit, UnitQuaternion, Vector3};

use crate::kinematics::{Dof, KinematicChain};
use crate::trigonometry::{acos, atan2, turn};

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

/// Tolerance for a cosine outside of [−1, 1]: at the ends of a range two solutions become one.
const ROUNDING: f64 = 1e-9;

/// Rotates `vector` by `angle` about the unit vector `axis`.
pub(super) fn turned(axis: &Vector3<f64>, angle: f64, vector: &Vector3<f64>) -> Vector3<f64> {
    turn(&Unit::new_unchecked(*axis), angle) * vector
}

/// Angle about `axis` that brings `from` nearest to `to`; 0 if every angle does.
pub(super) fn angle_between(axis: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    let (sin, cos) = (axis.dot(&from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
    if sin.abs() + cos.abs() < 1e-12 { 0.0 } else { atan2(sin, cos) }
}

/// Solves `a cos q + b sin q = c`: no angle, or two, which may be equal.
pub(super) fn sum_of_waves(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let size = libm::hypot(a, b);
    let cosine = if size > 0.0 { c / size } else { return None };
    if cosine.abs() > 1.0 + ROUNDING {
        return None;
    }
    let (middle, half) = (atan2(b, a), acos(cosine));
    Some([middle - half, middle + half])
}

/// Angles about `axis` for which the rotated `vector` has the component `wanted` along the unit vector
/// `along`.
pub(super) fn component(
    axis: &Vector3<f64>,
    vector: &Vector3<f64>,
    along: &Vector3<f64>,
    wanted: f64,
) -> Option<[f64; 2]> {
    let still = axis.dot(vector) * axis.dot(along);
    sum_of_waves(vector.dot(along) - still, along.dot(&axis.cross(vector)), wanted - still)
}

/// Value nearest to `to` within the limits, of those that differ from `angle` by full turns; `None` if there
/// is none. A value outside by less than 1e-9 rad, as rounding may put it, becomes the limit. Without limits
/// the value is in [−π, π) around `to`.
pub(super) fn within(dof: &Dof, angle: f64, to: f64) -> Option<f64> {
    let Some((lower, upper)) = dof.limits else {
        return Some(angle + TAU * libm::floor((to - angle) / TAU + 0.5));
    };
    let least = libm::ceil((lower - 1e-9 - angle) / TAU);
    let most = libm::floor((upper + 1e-9 - angle) / TAU);
    let turns = libm::floor((to - angle) / TAU + 0.5);
    (least <= most).then(|| (angle + TAU * turns.clamp(least, most)).clamp(lower, upper))
}

/// Angles about three axes, each perpendicular to the next, that make up a rotation: two branches in a fixed
/// order. If the outer axes coincide only their sum counts, and the first angle is 0.
pub(super) fn wrist(axes: &[Vector3<f64>; 3], rotation: &UnitQuaternion<f64>) -> Vec<[f64; 3]> {
    let [one, two, three] = axes;
    let pointing = rotation * three;
    let Some(middles) = component(two, three, one, one.dot(&pointing)) else { return vec![] };
    let ways = middles.into_iter().map(|middle| {
        let bent = turned(two, middle, three);
        let first = angle_between(one, &bent, &pointing);
        // The remaining rotation is about the third axis; a vector perpendicular to that axis shows its
        // angle.
        let rest =
            turn(&Unit::new_unchecked(*two), -middle) * turn(&Unit::new_unchecked(*one), -first) * rotation;
        let last = angle_between(three, two, &(rest * two));
        [first, middle, last]
    });
    ways.collect()
}
