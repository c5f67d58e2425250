//! The three questions about rotations that closed forms come down to (Paden 1986; Kahan 1983), and their answers
//! within limits.

use std::f64::consts::TAU;

use nalgebra::{Unit, Vector3};

use crate::kinematics::Variable;
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

/// The values of a variable that differ from `angle` by full turns and are within its limits, least first; one in
/// [−π, π) where it has none. A value that rounding put outside by less than 1e-9 rad is the limit itself.
pub(super) fn within(variable: &Variable, angle: f64) -> impl Iterator<Item = f64> + use<> {
    // "Unlimited" is often written as 1e16, where full turns are below the rounding.
    let limits = variable.limits.filter(|(lower, upper)| lower.abs().max(upper.abs()) < 1000.0 * TAU);
    let (lower, upper) = limits.unwrap_or((-TAU / 2.0, TAU / 2.0 - 1e-8));
    let first = angle + TAU * libm::ceil((lower - 1e-9 - angle) / TAU);
    // No arm needs more than a few turns of one joint.
    let turns = libm::floor((upper + 1e-9 - first) / TAU).clamp(-1.0, 8.0) as i32;
    (0..=turns).map(move |turn| (first + TAU * f64::from(turn)).clamp(lower, upper))
}
