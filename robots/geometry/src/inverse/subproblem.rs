//! The three questions about rotations that closed forms come down to (Paden 1986; Kahan 1983), and their answers
//! within limits.

use std::f64::consts::TAU;

use nalgebra::{Unit, Vector3};

use crate::kinematics::Dof;
use crate::trigonometry::{acos, atan2, turn};

/// How far a cosine may be outside of [−1, 1] and still be rounding: at the ends of a range two solutions become one.
const ROUNDING: f64 = 1e-9;

/// `vector`, turned by `angle` about the unit vector `axis`.
pub(super) fn turned(axis: &Vector3<f64>, angle: f64, vector: &Vector3<f64>) -> Vector3<f64> {
    turn(&Unit::new_unchecked(*axis), angle) * vector
}

/// The angle about `axis` that brings `from` nearest to `to`; 0 where it does not matter.
pub(super) fn angle_between(axis: &Vector3<f64>, from: &Vector3<f64>, to: &Vector3<f64>) -> f64 {
    let (sin, cos) = (axis.dot(&from.cross(to)), from.dot(to) - axis.dot(from) * axis.dot(to));
    if sin.abs() + cos.abs() < 1e-12 { 0.0 } else { atan2(sin, cos) }
}

/// The angles `q` with `a cos q + b sin q = c`: none, or two, which may be the same.
pub(super) fn sum_of_waves(a: f64, b: f64, c: f64) -> Option<[f64; 2]> {
    let size = libm::hypot(a, b);
    let cosine = if size > 0.0 { c / size } else { return None };
    if cosine.abs() > 1.0 + ROUNDING {
        return None;
    }
    let (middle, half) = (atan2(b, a), acos(cosine));
    Some([middle - half, middle + half])
}

/// The angles about `axis` that give the turned `vector` the component `wanted` along the unit vector `along`.
pub(super) fn component(
    axis: &Vector3<f64>,
    vector: &Vector3<f64>,
    along: &Vector3<f64>,
    wanted: f64,
) -> Option<[f64; 2]> {
    let still = axis.dot(vector) * axis.dot(along);
    sum_of_waves(vector.dot(along) - still, along.dot(&axis.cross(vector)), wanted - still)
}

/// Of the values of a variable that differ from `angle` by full turns the nearest to `to` within its limits; `None` where there is none. A
/// value that rounding put outside by less than 1e-9 rad is the limit itself. Without limits it is in [−π, π) from `to`.
pub(super) fn within(dof: &Dof, angle: f64, to: f64) -> Option<f64> {
    let Some((lower, upper)) = dof.limits else {
        return Some(angle + TAU * libm::floor((to - angle) / TAU + 0.5));
    };
    let least = libm::ceil((lower - 1e-9 - angle) / TAU);
    let most = libm::floor((upper + 1e-9 - angle) / TAU);
    let turns = libm::floor((to - angle) / TAU + 0.5);
    (least <= most).then(|| (angle + TAU * turns.clamp(least, most)).clamp(lower, upper))
}
