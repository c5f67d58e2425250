//! Geoms of a MuJoCo model: solids with their type, size and pose.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::element::{numbers, pose};
use crate::collision::{Shape, Solid};

/// Least size of a geom in m.
const LEAST: f64 = 1e-4;

/// Attributes of a solid: type, size and pose.
pub(super) fn geom(solid: &Solid) -> Vec<(&'static str, String)> {
    let sizes = |sizes: &[f64]| numbers(sizes.iter().map(|size| size.max(LEAST)));
    let (kind, size) = match solid.shape {
        Shape::Box(half) => ("box", sizes(half.as_slice())),
        Shape::Cylinder { radius, half } => ("cylinder", sizes(&[radius, half])),
        Shape::Capsule { radius, half: 0.0 } => ("sphere", sizes(&[radius])),
        Shape::Capsule { radius, half } => ("capsule", sizes(&[radius, half])),
        // No entity and no link is one.
        Shape::HalfSpace => ("plane", "0 0 0.05".to_owned()),
    };
    let mut attributes = vec![("type", kind.to_owned()), ("size", size)];
    attributes.extend(pose(&placed(solid)));
    attributes
}

/// Pose of a solid. Of a capsule only its z axis counts.
fn placed(solid: &Solid) -> Isometry3<f64> {
    let [x, y, z] = solid.axes;
    let rotation =
        match solid.shape {
            Shape::Capsule { half: 0.0, .. } => UnitQuaternion::identity(),
            Shape::Capsule { .. } | Shape::HalfSpace => UnitQuaternion::rotation_between(&Vector3::z(), &z)
                .unwrap_or_else(|| UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI)),
            Shape::Box(_) | Shape::Cylinder { .. } => UnitQuaternion::from_rotation_matrix(
                &Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, y, z])),
            ),
        };
    Isometry3::from_parts(Translation3::from(solid.centre), rotation)
}

/// Volume of a solid in m³; 0 for a half-space.
pub(super) fn volume(solid: &Solid) -> f64 {
    use std::f64::consts::PI;
    match solid.shape {
        Shape::Box(half) => 8.0 * half.x * half.y * half.z,
        Shape::Cylinder { radius, half } => PI * radius * radius * 2.0 * half,
        Shape::Capsule { radius, half } => PI * radius * radius * (2.0 * half + 4.0 / 3.0 * radius),
        Shape::HalfSpace => 0.0,
    }
}
