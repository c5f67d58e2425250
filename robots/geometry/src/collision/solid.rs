//! A convex solid somewhere: its shape, its centre and its axes.

use nalgebra::{Isometry3, Vector3};

/// A solid in some frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Solid {
    /// Its centre.
    pub centre: Vector3<f64>,
    /// Directions of its own x, y and z, each of length 1.
    pub axes: [Vector3<f64>; 3],
    /// What it is.
    pub shape: Shape,
}

/// A shape around the origin; lengths in m.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// A box by half of its extents.
    Box(Vector3<f64>),
    /// A cylinder along z.
    Cylinder {
        /// Radius.
        radius: f64,
        /// Half of its height.
        half: f64,
    },
    /// A capsule along z; a sphere where `half` is 0.
    Capsule {
        /// Radius.
        radius: f64,
        /// Half of the length of its tube.
        half: f64,
    },
    /// Everything below z = 0.
    HalfSpace,
}

impl Solid {
    /// A shape at a pose.
    #[must_use]
    pub fn new(pose: &Isometry3<f64>, shape: Shape) -> Self {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis);
        Self { centre: pose.translation.vector, axes, shape }
    }

    /// The floor: everything below the height 0.
    #[must_use]
    pub fn floor() -> Self {
        Self::new(&Isometry3::identity(), Shape::HalfSpace)
    }

    /// The solid moved.
    #[must_use]
    pub fn moved(&self, by: &Isometry3<f64>) -> Self {
        let axes = match self.shape {
            // The other two do not show.
            Shape::Capsule { .. } | Shape::HalfSpace => {
                let [x, y, z] = self.axes;
                [x, y, by.rotation * z]
            }
            Shape::Box(_) | Shape::Cylinder { .. } => self.axes.map(|axis| by.rotation * axis),
        };
        Self { centre: by.rotation * self.centre + by.translation.vector, axes, shape: self.shape }
    }

    /// The radius of the sphere around the centre that holds it; infinite for a half-space.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self.shape {
            Shape::Box(half) => half.norm(),
            Shape::Cylinder { radius, half } => libm::hypot(radius, half),
            Shape::Capsule { radius, half } => radius + half,
            Shape::HalfSpace => f64::INFINITY,
        }
    }

    /// How far it extends from its centre in a direction of length 1; infinite for a half-space.
    #[must_use]
    pub fn extent(&self, direction: &Vector3<f64>) -> f64 {
        let along = self.axes.map(|axis| axis.dot(direction).abs());
        let [_, _, up] = along;
        match self.shape {
            Shape::Box(half) => half.iter().zip(along).map(|(half, part)| half * part).sum(),
            Shape::Cylinder { radius, half } => half * up + radius * (1.0 - up * up).max(0.0).sqrt(),
            Shape::Capsule { radius, half } => half * up + radius,
            Shape::HalfSpace => f64::INFINITY,
        }
    }

    /// How far its core, which is what is left without the round rim of a capsule, extends in a direction of length 1.
    pub(super) fn core_extent(&self, direction: &Vector3<f64>) -> f64 {
        match self.shape {
            Shape::Capsule { half, .. } => {
                let [_, _, z] = &self.axes;
                half * z.dot(direction).abs()
            }
            Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => self.extent(direction),
        }
    }

    /// The point of its core, which is what is left without the round rim of a capsule, that lies farthest in a direction.
    pub(crate) fn support(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        let [x, y, z] = &self.axes;
        match &self.shape {
            Shape::Box(half) => {
                self.axes.iter().zip(half.iter()).fold(self.centre, |point, (axis, half)| {
                    point + axis * half.copysign(axis.dot(direction))
                })
            }
            Shape::Cylinder { radius, half } => {
                // Taken apart by the axes, so that rounding cannot tilt the rim.
                let (a, b) = (x.dot(direction), y.dot(direction));
                let length = libm::hypot(a, b);
                let scale = if length > 1e-300 { radius / length } else { 0.0 };
                self.centre + z * half.copysign(z.dot(direction)) + (x * a + y * b) * scale
            }
            Shape::Capsule { half, .. } => self.centre + z * half.copysign(z.dot(direction)),
            Shape::HalfSpace => self.centre,
        }
    }

    /// The radius of the rim around its core.
    pub(crate) fn rim(&self) -> f64 {
        match self.shape {
            Shape::Capsule { radius, .. } => radius,
            Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => 0.0,
        }
    }
}
