//! Trigonometric functions with the same bits on every machine, and rotations made from them.

use nalgebra::{Isometry3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};

/// Sine and cosine of an angle in rad.
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    libm::sincos(angle)
}

/// Angle of the vector (x, y), in (−π, π].
pub(crate) fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Angle with the cosine nearest to `cosine`, which rounding may put just outside of [−1, 1].
pub(crate) fn acos(cosine: f64) -> f64 {
    libm::acos(cosine.clamp(-1.0, 1.0))
}

/// Rotation by `angle` about `axis`.
pub(crate) fn turn(axis: &Unit<Vector3<f64>>, angle: f64) -> UnitQuaternion<f64> {
    let (sin, cos) = sin_cos(angle / 2.0);
    Unit::new_unchecked(Quaternion::new(cos, axis.x * sin, axis.y * sin, axis.z * sin))
}

/// The pose at `(x, y)` on the floor, turned by `yaw`.
#[must_use]
pub fn planar(x: f64, y: f64, yaw: f64) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(x, y, 0.0), turn(&Vector3::z_axis(), yaw))
}

/// Angle nearest to zero of those that differ from `angle` by full turns.
pub(crate) fn wrapped(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    if (-PI..=PI).contains(&angle) { angle } else { angle - TAU * libm::round(angle / TAU) }
}

/// Rotation vector: the axis times the angle in [0, π].
pub(crate) fn rotation_vector(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let quaternion = rotation.quaternion();
    let (vector, w) = (quaternion.imag(), quaternion.w);
    let (vector, w) = if w < 0.0 { (-vector, -w) } else { (vector, w) };
    let sin = vector.norm();
    // The sine of half a small angle is half the angle.
    let scale = if sin < 1e-9 { 2.0 } else { 2.0 * atan2(sin, w) / sin };
    vector * scale
}
