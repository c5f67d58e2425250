//! Outline of a solid from above: for drawings, not for collision checking.

use super::solid::{Shape, Solid};

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
