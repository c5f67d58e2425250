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

/// Composes poses: the pose of `c` in `a` from that of `b` in `a` and that of `c` in `b`.
#[must_use]
pub fn compose(a_from_b: &Pose, b_from_c: &Pose) -> Pose {
    let [x, y, z] = rotate(a_from_b.quaternion_xyzw, b_from_c.xyz);
    let [dx, dy, dz] = a_from_b.xyz;
    let quaternion_xyzw = mul(a_from_b.quaternion_xyzw, b_from_c.quaternion_xyzw);
    Pose { xyz: [x + dx, y + dy, z + dz], quaternion_xyzw }
}
