//! The little of rotations that placing things takes. Quaternions have the order x, y, z, w and length 1.

use crate::urdf::Pose;

/// A rotation, order x, y, z, w.
pub type Quaternion = [f64; 4];

/// By an angle in rad about one of the axes 0, 1, 2.
#[must_use]
pub fn from_axis_angle(axis: usize, angle: f64) -> Quaternion {
    let (sin, cos) = libm::sincos(angle / 2.0);
    let part = |at: usize| if at == axis { sin } else { 0.0 };
    [part(0), part(1), part(2), cos]
}

/// First the second, then the first.
#[must_use]
pub fn mul([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion) -> Quaternion {
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

/// The other way round.
#[must_use]
pub fn inverse([x, y, z, w]: Quaternion) -> Quaternion {
    [-x, -y, -z, w]
}

/// A vector turned.
#[must_use]
pub fn rotate(by: Quaternion, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [x, y, z, _] = mul(mul(by, [x, y, z, 0.0]), inverse(by));
    [x, y, z]
}

/// The pose of `c` in `a` from that of `b` in `a` and of `c` in `b`.
#[must_use]
pub fn compose(a_from_b: &Pose, b_from_c: &Pose) -> Pose {
    let [x, y, z] = rotate(a_from_b.quaternion_xyzw, b_from_c.xyz);
    let [dx, dy, dz] = a_from_b.xyz;
    let quaternion_xyzw = mul(a_from_b.quaternion_xyzw, b_from_c.quaternion_xyzw);
    Pose { xyz: [x + dx, y + dy, z + dz], quaternion_xyzw }
}
