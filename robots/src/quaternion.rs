//! Unit quaternions, order x, y, z, w, for placing shapes and links.
//!
//! Only what the readers need; `motet-geometry` computes with `nalgebra`.

use crate::urdf::Pose;

/// Rotation as a unit quaternion, order x, y, z, w.
pub type Quaternion = [f64; 4];

/// Rotation by an angle in rad about one of the axes 0 (x), 1 (y), 2 (z).
///
/// ```
/// use motet_robots::quaternion::{from_axis_angle, rotate};
///
/// let quarter = from_axis_angle(2, std::f64::consts::FRAC_PI_2);
/// let [x, y, _] = rotate(quarter, [1.0, 0.0, 0.0]);
/// assert!(x.abs() < 1e-12 && (y - 1.0).abs() < 1e-12);
/// ```
#[must_use]
pub fn from_axis_angle(axis: usize, angle: f64) -> Quaternion {
    let (sin, cos) = libm::sincos(angle / 2.0);
    let part = |at: usize| if at == axis { sin } else { 0.0 };
    [part(0), part(1), part(2), cos]
}

/// Hamilton product `a * b`: applies `b`, then `a`.
#[must_use]
pub fn mul([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion) -> Quaternion {
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

/// Inverse rotation: the conjugate.
#[must_use]
pub fn inverse([x, y, z, w]: Quaternion) -> Quaternion {
    [-x, -y, -z, w]
}

/// Rotates a vector.
#[must_use]
pub fn rotate(by: Quaternion, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [x, y, z, _] = mul(mul(by, [x, y, z, 0.0]), inverse(by));
    [x, y, z]
}

/// Roll, pitch and yaw in rad about fixed axes, of a unit quaternion. Where the pitch is a right angle, only
/// the sum or the difference of the others counts, and the roll is 0.
///
/// ```
/// use motet_robots::quaternion::{from_axis_angle, to_rpy};
///
/// let [roll, pitch, yaw] = to_rpy(from_axis_angle(2, 0.5));
/// assert!(roll == 0.0 && pitch == 0.0 && (yaw - 0.5).abs() < 1e-12);
/// ```
#[must_use]
pub fn to_rpy([x, y, z, w]: Quaternion) -> [f64; 3] {
    let sin = 2.0 * (w * y - z * x);
    if sin.abs() > 1.0 - 1e-12 {
        let yaw = -2.0 * sin.signum() * libm::atan2(x, w);
        return [0.0, sin.signum() * std::f64::consts::FRAC_PI_2, yaw];
    }
    let roll = libm::atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y));
    let yaw = libm::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z));
    [roll, libm::asin(sin), yaw]
}

/// Unit quaternion of roll, pitch and yaw in rad about fixed axes.
#[must_use]
pub fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> Quaternion {
    mul(from_axis_angle(2, yaw), mul(from_axis_angle(1, pitch), from_axis_angle(0, roll)))
}

/// Composes poses: the pose of `c` in `a` from that of `b` in `a` and that of `c` in `b`.
#[must_use]
pub fn compose(a_from_b: &Pose, b_from_c: &Pose) -> Pose {
    let [x, y, z] = rotate(a_from_b.quaternion_xyzw, b_from_c.xyz);
    let [dx, dy, dz] = a_from_b.xyz;
    let quaternion_xyzw = mul(a_from_b.quaternion_xyzw, b_from_c.quaternion_xyzw);
    Pose { xyz: [x + dx, y + dy, z + dz], quaternion_xyzw }
}
