//! Convex solids with a pose: shape, centre and axes. With their outline from above, for drawings.

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
    ///
    /// ```
    /// use motet_geometry::collision::{Shape, Solid};
    /// use nalgebra::{Isometry3, Vector3};
    ///
    /// let cup = Solid::new(&Isometry3::identity(), Shape::Cylinder { radius: 0.04, half: 0.05 });
    /// assert_eq!(cup.extent(&Vector3::z()), 0.05);
    /// assert_eq!(cup.extent(&Vector3::x()), 0.04);
    /// ```
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

/// Number of corners of a polygon that stands for a circle.
const AROUND: u32 = 24;

impl Solid {
    /// Corners of the outline from above, in m, counter-clockwise; circles become polygons of 24 corners.
    /// Empty for a half-space.
    #[must_use]
    pub fn outline(&self) -> Vec<[f64; 2]> {
        let [x, y, z] = self.axes;
        let mut points: Vec<[f64; 2]> = Vec::new();
        match self.shape {
            Shape::HalfSpace => {}
            Shape::Box(half) => {
                for (a, b, c) in [(1.0, 1.0, 1.0), (1.0, 1.0, -1.0), (1.0, -1.0, 1.0), (1.0, -1.0, -1.0)] {
                    let off = x * (half.x * a) + y * (half.y * b) + z * (half.z * c);
                    points.extend([self.centre + off, self.centre - off].map(|point| [point.x, point.y]));
                }
            }
            Shape::Capsule { radius, half } | Shape::Cylinder { radius, half } => {
                for end in [self.centre + z * half, self.centre - z * half] {
                    for step in 0..AROUND {
                        let (sin, cos) =
                            libm::sincos(std::f64::consts::TAU * f64::from(step) / f64::from(AROUND));
                        // Exact for an upright cylinder; for a lying one slightly larger than the cylinder.
                        points.push([end.x + radius * cos, end.y + radius * sin]);
                    }
                }
            }
        }
        hull(points)
    }
}

/// Convex hull (Andrew 1979).
fn hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|[ax, ay], [bx, by]| ax.total_cmp(bx).then(ay.total_cmp(by)));
    let chain = |points: &mut dyn Iterator<Item = &[f64; 2]>| {
        let mut chain: Vec<[f64; 2]> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice() {
                if (b[0] - a[0]) * (point[1] - a[1]) - (b[1] - a[1]) * (point[0] - a[0]) > 0.0 {
                    break;
                }
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut corners = chain(&mut points.iter());
    corners.extend(chain(&mut points.iter().rev()));
    corners
}
