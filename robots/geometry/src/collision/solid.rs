//! Convex solids with a pose: shape, centre and axes.

use nalgebra::{Isometry3, Vector3};

/// Convex solid with a pose in some frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Solid {
    pub centre: Vector3<f64>,
    /// Unit vectors of its own x, y and z axes.
    pub axes: [Vector3<f64>; 3],
    pub shape: Shape,
}

/// Convex shape centred at the origin; lengths in m.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Shape {
    /// Box with half extents along x, y and z.
    Box(Vector3<f64>),
    /// Cylinder along z.
    Cylinder {
        radius: f64,
        /// Half of the height.
        half: f64,
    },
    /// Capsule along z; a sphere if `half` is 0.
    Capsule {
        radius: f64,
        /// Half of the length of the tube.
        half: f64,
    },
    /// Half-space below z = 0.
    HalfSpace,
}

impl Solid {
    /// Places a shape at a pose.
    #[must_use]
    pub fn new(pose: &Isometry3<f64>, shape: Shape) -> Self {
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| pose.rotation * axis);
        Self { centre: pose.translation.vector, axes, shape }
    }

    /// The floor: the half-space below height 0.
    #[must_use]
    pub fn floor() -> Self {
        Self::new(&Isometry3::identity(), Shape::HalfSpace)
    }

    /// Moves the solid by a rigid transform.
    #[must_use]
    pub fn moved(&self, by: &Isometry3<f64>) -> Self {
        let axes = match self.shape {
            // The other two axes have no effect on the shape.
            Shape::Capsule { .. } | Shape::HalfSpace => {
                let [x, y, z] = self.axes;
                [x, y, by.rotation * z]
            }
            Shape::Box(_) | Shape::Cylinder { .. } => self.axes.map(|axis| by.rotation * axis),
        };
        Self { centre: by.rotation * self.centre + by.translation.vector, axes, shape: self.shape }
    }

    /// Radius of the bounding sphere around the centre, in m; infinite for a half-space.
    #[must_use]
    pub fn reach(&self) -> f64 {
        match self.shape {
            Shape::Box(half) => half.norm(),
            Shape::Cylinder { radius, half } => libm::hypot(radius, half),
            Shape::Capsule { radius, half } => radius + half,
            Shape::HalfSpace => f64::INFINITY,
        }
    }

    /// Extent from the centre along a unit vector, in m; infinite for a half-space.
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

    /// Extent of the core along a unit vector, in m. The core of a capsule is its axis, without the round
    /// rim.
    pub(super) fn core_extent(&self, direction: &Vector3<f64>) -> f64 {
        match self.shape {
            Shape::Capsule { half, .. } => {
                let [_, _, z] = &self.axes;
                half * z.dot(direction).abs()
            }
            Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => self.extent(direction),
        }
    }

    /// Support point of the core: the point farthest in a direction. The core of a capsule is its axis.
    pub(crate) fn support(&self, direction: &Vector3<f64>) -> Vector3<f64> {
        let [x, y, z] = &self.axes;
        match &self.shape {
            Shape::Box(half) => {
                self.axes.iter().zip(half.iter()).fold(self.centre, |point, (axis, half)| {
                    point + axis * half.copysign(axis.dot(direction))
                })
            }
            Shape::Cylinder { radius, half } => {
                // Resolved along the axes, so that rounding cannot tilt the rim.
                let (a, b) = (x.dot(direction), y.dot(direction));
                let length = libm::hypot(a, b);
                let scale = if length > 1e-300 { radius / length } else { 0.0 };
                self.centre + z * half.copysign(z.dot(direction)) + (x * a + y * b) * scale
            }
            Shape::Capsule { half, .. } => self.centre + z * half.copysign(z.dot(direction)),
            Shape::HalfSpace => self.centre,
        }
    }

    /// Radius of the rim around the core: that of a capsule, else 0.
    pub(crate) fn rim(&self) -> f64 {
        match self.shape {
            Shape::Capsule { radius, .. } => radius,
            Shape::Box(_) | Shape::Cylinder { .. } | Shape::HalfSpace => 0.0,
        }
    }
}
