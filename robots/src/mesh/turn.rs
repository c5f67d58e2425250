//! The little of rotations that placing the pieces of a mesh takes. Quaternions are x, y, z, w and of length 1.

use crate::urdf::Pose;

pub(super) type Quaternion = [f64; 4];

/// By an angle in rad about one of the axes 0, 1, 2.
pub(super) fn about(axis: usize, angle: f64) -> Quaternion {
    let (sin, cos) = libm::sincos(angle / 2.0);
    let part = |at: usize| if at == axis { sin } else { 0.0 };
    [part(0), part(1), part(2), cos]
}

/// First the second, then the first.
pub(super) fn product([ax, ay, az, aw]: Quaternion, [bx, by, bz, bw]: Quaternion) -> Quaternion {
    [
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    ]
}

pub(super) fn inverse([x, y, z, w]: Quaternion) -> Quaternion {
    [-x, -y, -z, w]
}

/// A vector turned.
pub(super) fn turned(by: Quaternion, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [x, y, z, _] = product(product(by, [x, y, z, 0.0]), inverse(by));
    [x, y, z]
}

/// The pose of `c` in `a` from that of `b` in `a` and of `c` in `b`.
pub(super) fn composed(a_from_b: &Pose, b_from_c: &Pose) -> Pose {
    let [x, y, z] = turned(a_from_b.quaternion_xyzw, b_from_c.xyz);
    let [dx, dy, dz] = a_from_b.xyz;
    let quaternion_xyzw = product(a_from_b.quaternion_xyzw, b_from_c.quaternion_xyzw);
    Pose { xyz: [x + dx, y + dy, z + dz], quaternion_xyzw }
}
