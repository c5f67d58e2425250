//! Cover of a mesh: a few boxes, cylinders and capsules that contain the mesh and all that it encloses.
//!
//! The mesh is cut by planes perpendicular to two axes of a frame, and each part of its surface is enclosed
//! by itself. A line along the third axis stays in one part. Through a point inside of a closed surface it
//! meets the surface on both sides, so the point is between two points of that part, and any convex solid
//! that contains these contains it too. Cuts perpendicular to all three axes could miss points deep inside.

use super::triangle::Triangle;
use crate::quaternion::{Quaternion, from_axis_angle, inverse, mul, rotate};
use crate::urdf::{LinkShape, Pose, UrdfShape};

/// Greatest number of solids of one mesh.
const PIECES: usize = 6;
/// Greatest fraction of the total volume that a cut may leave.
const WORTH: f64 = 0.88;
/// Margin of every solid, in m: more than rounding.
const SLACK: f64 = 1e-6;
/// Positions of cuts, as fractions of the extent of a part.
const CUTS: [f64; 3] = [0.5, 0.25, 0.75];
/// Angles about each axis at which the frame is tried, in degrees.
const ANGLES: [f64; 5] = [15.0, 30.0, 45.0, 60.0, 75.0];

/// Convex polygons of the surface of a part.
type Polygons = Vec<Vec<[f64; 3]>>;

/// Part of the surface with its enclosing solid.
struct Part {
    polygons: Polygons,
    piece: Piece,
}

/// Solid in the frame of the cuts.
#[derive(Clone, Copy)]
struct Piece {
    centre: [f64; 3],
    /// Axis of the frame along the z axis of the shape.
    along: usize,
    shape: Form,
    volume: f64,
}

#[derive(Clone, Copy)]
enum Form {
    Box([f64; 3]),
    Cylinder { radius: f64, length: f64 },
    Capsule { radius: f64, length: f64 },
}

/// Covers a mesh by at most six solids in the frame of the mesh: every point of the mesh, and every point
/// that it encloses, is in one of them. `scale` is applied to the mesh first. Empty without triangles.
/// O(triangles).
///
/// ```
/// use motet_robots::mesh;
///
/// let text = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\nf 1 3 4\nf 2 3 4\n";
/// let tetrahedron = mesh::read("solid.obj", text).unwrap();
/// assert!((1..=6).contains(&mesh::cover(&tetrahedron, [1.0; 3]).len()));
/// ```
#[must_use]
pub fn cover(mesh: &[Triangle], scale: [f64; 3]) -> Vec<LinkShape> {
    let scaled = |[x, y, z]: [f64; 3]| [x * scale[0], y * scale[1], z * scale[2]];
    let mesh: Vec<Triangle> = mesh.iter().map(|triangle| triangle.map(scaled)).collect();
    let Some(mesh_from_frame) = best_frame(&mesh) else { return vec![] };
    let back = inverse(mesh_from_frame);
    let whole: Polygons =
        mesh.iter().map(|triangle| triangle.map(|corner| rotate(back, corner)).to_vec()).collect();
    let Some(first) = Part::new(whole) else { return vec![] };
    let axes = longest_two(&first.polygons);
    let with_cut = |part: Part| {
        let cut = part.cut(axes);
        (part, cut)
    };
    let mut parts = vec![with_cut(first)];
    while parts.len() < PIECES {
        let total: f64 = parts.iter().map(|(part, _)| part.piece.volume).sum();
        let saved = parts.iter().zip(0..).filter_map(|((part, cut), at)| {
            let [one, other] = cut.as_ref()?;
            Some((at, part.piece.volume - one.piece.volume - other.piece.volume))
        });
        let best = saved.reduce(|best, next| if next.1 > best.1 { next } else { best });
        let Some((at, _)) = best.filter(|(_, saved)| total - saved <= WORTH * total) else { break };
        if let (_, Some(halves)) = parts.swap_remove(at) {
            parts.extend(halves.map(with_cut));
        }
    }
    parts.iter().map(|(part, _)| part.piece.placed(mesh_from_frame)).collect()
}

/// Of the frame of the mesh and those rotated about one axis, the one with the smallest bounding box.
fn best_frame(mesh: &[Triangle]) -> Option<Quaternion> {
    let turns = (0..3).flat_map(|axis| ANGLES.map(|angle| from_axis_angle(axis, angle.to_radians())));
    let frames = std::iter::once([0.0, 0.0, 0.0, 1.0]).chain(turns);
    let sized = frames.filter_map(|frame| {
        let back = inverse(frame);
        let (low, high) = bounds(mesh.iter().flatten().map(|corner| rotate(back, *corner)))?;
        let volume: f64 = low.iter().zip(high).map(|(low, high)| high - low + SLACK).product();
        Some((frame, volume))
    });
    // A rotation must be worth it: faces tend to follow the frame of the mesh.
    sized.reduce(|best, next| if next.1 < 0.99 * best.1 { next } else { best }).map(|(frame, _)| frame)
}

fn bounds(points: impl Iterator<Item = [f64; 3]>) -> Option<([f64; 3], [f64; 3])> {
    points.map(|point| (point, point)).reduce(|(low, high), (point, _)| {
        let by = |keep: fn(f64, f64) -> f64, one: [f64; 3]| {
            let ([a, b, c], [x, y, z]) = (one, point);
            [keep(a, x), keep(b, y), keep(c, z)]
        };
        (by(f64::min, low), by(f64::max, high))
    })
}

/// The two axes along which polygons extend farthest.
fn longest_two(polygons: &Polygons) -> [usize; 2] {
    let (low, high) = bounds(polygons.iter().flatten().copied()).unwrap_or_default();
    let [x, y, z] = [0, 1, 2].map(|at| part(high, at) - part(low, at));
    if x <= y && x <= z {
        [1, 2]
    } else if y <= z {
        [0, 2]
    } else {
        [0, 1]
    }
}

fn part([x, y, z]: [f64; 3], axis: usize) -> f64 {
    match axis {
        0 => x,
        1 => y,
        _ => z,
    }
}

impl Part {
    fn new(polygons: Polygons) -> Option<Self> {
        let piece = Piece::around(&polygons)?;
        Some(Self { polygons, piece })
    }

    /// Finds the cut that leaves the least volume.
    fn cut(&self, axes: [usize; 2]) -> Option<[Self; 2]> {
        let (low, high) = bounds(self.polygons.iter().flatten().copied())?;
        let cuts = axes.into_iter().flat_map(|axis| CUTS.map(|share| (axis, share)));
        let halves = cuts.filter_map(|(axis, share)| {
            let (low, high) = (part(low, axis), part(high, axis));
            let at = low + (high - low) * share;
            Some([
                Self::new(below(&self.polygons, axis, at, 1.0))?,
                Self::new(below(&self.polygons, axis, at, -1.0))?,
            ])
        });
        let volume = |[one, other]: &[Self; 2]| one.piece.volume + other.piece.volume;
        halves.reduce(|best, next| if volume(&next) < volume(&best) { next } else { best })
    }
}

/// Clips polygons to the half-space below a plane, or with the sign −1 above it (Sutherland and Hodgman
/// 1974).
fn below(polygons: &Polygons, axis: usize, at: f64, sign: f64) -> Polygons {
    let depth = |point: [f64; 3]| (at - part(point, axis)) * sign;
    let clip = |polygon: &Vec<[f64; 3]>| {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (one, next) in polygon.iter().zip(polygon.iter().cycle().skip(1)) {
            let (here, there) = (depth(*one), depth(*next));
            if here >= 0.0 {
                kept.push(*one);
            }
            if (here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0) {
                let share = here / (here - there);
                let between = |axis| part(*one, axis) + (part(*next, axis) - part(*one, axis)) * share;
                kept.push([between(0), between(1), between(2)]);
            }
        }
        kept
    };
    polygons.iter().map(clip).filter(|polygon| !polygon.is_empty()).collect()
}

impl Piece {
    /// Finds the smallest shape around polygons; `None` without points.
    fn around(polygons: &Polygons) -> Option<Self> {
        let points = || polygons.iter().flatten().copied();
        let (low, high) = bounds(points())?;
        let centre = [0, 1, 2].map(|at| (part(low, at) + part(high, at)) / 2.0);
        let size = [0, 1, 2].map(|at| part(high, at) - part(low, at) + 2.0 * SLACK);
        let whole = Self { centre, along: 2, shape: Form::Box(size), volume: size.iter().product() };
        let round = (0..3).flat_map(|along| {
            let (a, b) = ((along + 1) % 3, (along + 2) % 3);
            let out = |point| libm::hypot(part(point, a) - part(centre, a), part(point, b) - part(centre, b));
            let radius = points().map(out).fold(0.0, f64::max) + SLACK;
            let length = part(size, along);
            // Distance by which the round end of the tube misses the points beyond it.
            let beyond = |point| {
                let out = out(point);
                let rise = (radius * radius - out * out).max(0.0).sqrt();
                (part(point, along) - part(centre, along)).abs() - rise
            };
            let tube = 2.0 * (points().map(beyond).fold(0.0, f64::max) + SLACK);
            let disc = std::f64::consts::PI * radius * radius;
            [
                Self { along, shape: Form::Cylinder { radius, length }, volume: disc * length, ..whole },
                Self {
                    along,
                    shape: Form::Capsule { radius, length: tube },
                    volume: disc * (tube + radius * 4.0 / 3.0),
                    ..whole
                },
            ]
        });
        Some(round.fold(whole, |best, next| if next.volume < best.volume { next } else { best }))
    }

    fn placed(&self, mesh_from_frame: Quaternion) -> LinkShape {
        let right = std::f64::consts::FRAC_PI_2;
        // Rotates z to the shape's own z axis.
        let frame_from_shape = match self.along {
            0 => from_axis_angle(1, right),
            1 => from_axis_angle(0, -right),
            _ => from_axis_angle(2, 0.0),
        };
        let shape = match self.shape {
            Form::Box(size) => UrdfShape::Box(size),
            Form::Cylinder { radius, length } => UrdfShape::Cylinder { radius, length },
            Form::Capsule { radius, length } => UrdfShape::Capsule { radius, length },
        };
        let quaternion_xyzw = mul(mesh_from_frame, frame_from_shape);
        LinkShape {
            link_from_shape: Pose { xyz: rotate(mesh_from_frame, self.centre), quaternion_xyzw },
            shape,
        }
    }
}
