//! Distances between a capsule and another shape.

use nalgebra::{Isometry3, Point3, Vector3};

/// All points within `radius` of a segment, in m; a sphere where both ends are one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Capsule {
    /// The segment's ends.
    pub ends: [Point3<f64>; 2],
    /// The radius.
    pub radius: f64,
}

/// Something that stands in the way.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Obstacle {
    /// Pose of its centre.
    pub map_from_shape: Isometry3<f64>,
    /// What it is.
    pub shape: ObstacleShape,
}

/// The shape of an obstacle, centred at its origin; lengths in m.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ObstacleShape {
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
    /// Everything below z = 0: the floor.
    HalfSpace,
}

impl Capsule {
    /// The capsule moved.
    #[must_use]
    pub fn moved(&self, by: &Isometry3<f64>) -> Self {
        Self { ends: self.ends.map(|end| by * end), radius: self.radius }
    }

    /// Distance to another capsule; where they overlap, minus how far their segments are too near.
    #[must_use]
    pub fn to_capsule(&self, other: &Self) -> f64 {
        segments(&self.ends, &other.ends) - self.radius - other.radius
    }

    /// Distance to an obstacle. Where they overlap it is negative, and not below minus the radius however deep.
    #[must_use]
    pub fn to_obstacle(&self, obstacle: &Obstacle) -> f64 {
        let ends = self.ends.map(|end| obstacle.map_from_shape.inverse_transform_point(&end));
        let distance = match obstacle.shape {
            ObstacleShape::Box(half) => to_box(&ends, &half),
            ObstacleShape::Cylinder { radius, half } => to_cylinder(&ends, radius, half),
            ObstacleShape::Capsule { radius, half } => {
                let axis = [Point3::new(0.0, 0.0, -half), Point3::new(0.0, 0.0, half)];
                segments(&ends, &axis) - radius
            }
            ObstacleShape::HalfSpace => {
                let [one, other] = ends;
                one.z.min(other.z)
            }
        };
        distance - self.radius
    }
}

/// The distance between two segments (Ericson 2005, 5.1.9).
fn segments([p1, q1]: &[Point3<f64>; 2], [p2, q2]: &[Point3<f64>; 2]) -> f64 {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let tiny = 1e-18;
    let (s, t) = if a <= tiny && e <= tiny {
        (0.0, 0.0)
    } else if a <= tiny {
        (0.0, (f / e).clamp(0.0, 1.0))
    } else {
        let c = d1.dot(&r);
        if e <= tiny {
            ((-c / a).clamp(0.0, 1.0), 0.0)
        } else {
            let b = d1.dot(&d2);
            let determinant = a * e - b * b;
            let s = if determinant > 1e-12 * a * e {
                ((b * f - c * e) / determinant).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let t = (b * s + f) / e;
            if t < 0.0 {
                ((-c / a).clamp(0.0, 1.0), 0.0)
            } else if t > 1.0 {
                (((b - c) / a).clamp(0.0, 1.0), 1.0)
            } else {
                (s, t)
            }
        }
    };
    (r + d1 * s - d2 * t).norm()
}

/// The distance between a segment and a box around the origin. Its square is convex along the segment and quadratic
/// between the planes of the box's faces, so its slope is searched for the zero.
fn to_box([start, end]: &[Point3<f64>; 2], half: &Vector3<f64>) -> f64 {
    let way = end - start;
    let outside = |t: f64| {
        let point = start.coords + way * t;
        Vector3::from_fn(|at, _| {
            let (value, half) = (point.get(at).copied().unwrap_or(0.0), half.get(at).copied().unwrap_or(0.0));
            value - value.clamp(-half, half)
        })
    };
    let slope = |t: f64| outside(t).dot(&way);
    let mut times = vec![0.0, 1.0];
    for ((start, way), half) in start.coords.iter().zip(way.iter()).zip(half.iter()) {
        if *way != 0.0 {
            times.extend(
                [(-half - start) / way, (half - start) / way].into_iter().filter(|t| (0.0..1.0).contains(t)),
            );
        }
    }
    times.sort_by(f64::total_cmp);
    let mut before: Option<(f64, f64)> = None;
    for t in times {
        let now = slope(t);
        if now >= 0.0 {
            let nearest = match before {
                Some((earlier, was)) if now > was => earlier + (t - earlier) * (-was / (now - was)),
                Some(_) | None => t,
            };
            return outside(nearest).norm();
        }
        before = Some((t, now));
    }
    outside(1.0).norm()
}

/// The distance between a segment and a cylinder along z around the origin: convex along the segment, so a search in
/// thirds ends at its least value.
fn to_cylinder([start, end]: &[Point3<f64>; 2], radius: f64, half: f64) -> f64 {
    let way = end - start;
    let distance = |t: f64| {
        let point = start.coords + way * t;
        let (aside, above) = (libm::hypot(point.x, point.y) - radius, point.z.abs() - half);
        libm::hypot(aside.max(0.0), above.max(0.0))
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..90 {
        let third = (high - low) / 3.0;
        if distance(low + third) <= distance(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    distance(low).min(distance(high)).min(distance(0.0)).min(distance(1.0))
}
