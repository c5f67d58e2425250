//! Footprints: obstacles seen from above, grown by the radius of the robot at their heights, in a grid.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::planning::scene::Obstacle;

/// Cap of the clearance, in m.
const WIDE: f64 = 0.4;
/// Side of a square of the grid, in m.
const SQUARE: f64 = 0.5;

/// Disc about the base's axis that a part of the robot fills at most.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PartDisc {
    pub(crate) radius: f64,
    pub(crate) heights: [f64; 2],
    /// Set for a part of the arm.
    pub(crate) is_carried: bool,
}

/// Footprints of a scene with a grid over them.
#[derive(Clone, Debug)]
pub(crate) struct FootprintIndex {
    all: Vec<Footprint>,
    /// Footprints near each square.
    squares: Vec<Vec<Footprint>>,
    /// Numbers of squares in a row and in a column.
    size: [usize; 2],
    origin: [f64; 2],
}

/// Footprint of an obstacle, and the radius of the robot between its heights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint {
    centre: [f64; 2],
    /// Unit direction of its first side.
    side: [f64; 2],
    half: [f64; 2],
    /// Radius around the rectangle.
    round: f64,
    keep_off: f64,
}

impl FootprintIndex {
    /// Builds the grid from a corner and a size in m. O(footprints × squares near each).
    pub(crate) fn new(all: Vec<Footprint>, origin: [f64; 2], span: [f64; 2]) -> Self {
        let size = span.map(|span| libm::ceil(span / SQUARE) as usize + 1);
        let mut new = Self { all: vec![], squares: vec![vec![]; size[0] * size[1]], size, origin };
        all.iter().for_each(|outline| new.list(outline));
        Self { all, ..new }
    }

    /// All footprints in the scene's order.
    pub(crate) fn all(&self) -> &[Footprint] {
        &self.all
    }

    /// Clearance of a place in m, capped; negative where the robot would be in contact.
    pub(crate) fn at(&self, place: [f64; 2]) -> f64 {
        let [column, row] = [0, 1].map(|axis: usize| {
            let off = place.get(axis).zip(self.origin.get(axis)).map_or(0.0, |(at, origin)| at - origin);
            libm::floor(off / SQUARE)
        });
        let [columns, rows] = self.size.map(|count| count as f64);
        let is_within = column >= 0.0 && row >= 0.0 && column < columns && row < rows;
        let near = if is_within {
            self.squares.get(row as usize * self.size[0] + column as usize).unwrap_or(&self.all)
        } else {
            &self.all
        };
        near.iter().map(|outline| outline.distance(place)).fold(WIDE, f64::min)
    }

    /// Lists a footprint in the squares near it.
    fn list(&mut self, outline: &Footprint) {
        let far = outline.reach() + outline.keep_off + WIDE;
        let range = |axis: usize| {
            let middle = outline.centre.get(axis).zip(self.origin.get(axis));
            let at = middle.map_or(0.0, |(centre, origin)| centre - origin);
            let count = self.size.get(axis).copied().unwrap_or(0);
            let first = libm::floor((at - far) / SQUARE).max(0.0) as usize;
            first..(libm::ceil((at + far) / SQUARE).max(0.0) as usize + 1).min(count)
        };
        let (columns, rows) = (range(0), range(1));
        for row in rows {
            for column in columns.clone() {
                let middle = [column, row].map(|at| (at as f64 + 0.5) * SQUARE);
                let middle = [self.origin[0] + middle[0], self.origin[1] + middle[1]];
                // A square's corner is 0.71 of its side from its middle.
                if outline.distance(middle) <= WIDE + 0.72 * SQUARE
                    && let Some(square) = self.squares.get_mut(row * self.size[0] + column)
                {
                    square.push(*outline);
                }
            }
        }
    }
}

impl Footprint {
    /// Footprint of an obstacle; `None` where no part of the robot is at its heights.
    pub(crate) fn new(Obstacle { solid, padding, .. }: &Obstacle, discs: &[PartDisc]) -> Option<Self> {
        let up = solid.extent(&Vector3::z());
        let [low, high] = [solid.centre.z - up, solid.centre.z + up];
        let meets = discs.iter().filter_map(|disc| {
            let (pad, [least, greatest]) = (padding.of(disc.is_carried), disc.heights);
            (greatest >= low - pad && least <= high + pad).then_some(disc.radius + pad)
        });
        let keep_off = meets.fold(f64::NEG_INFINITY, f64::max);
        if keep_off < 0.0 {
            return None;
        }
        let [x, _, z] = &solid.axes;
        let is_upright = z.x.abs() < 1e-9 && z.y.abs() < 1e-9;
        let (side, half, round) = match solid.shape {
            Shape::Box(half) if is_upright => ([x.x, x.y], [half.x, half.y], 0.0),
            Shape::Cylinder { radius, .. } | Shape::Capsule { radius, .. } if is_upright => {
                ([1.0, 0.0], [0.0, 0.0], radius)
            }
            Shape::Capsule { .. } | Shape::Cylinder { .. } | Shape::Box(_) | Shape::HalfSpace => {
                ([1.0, 0.0], [solid.extent(&Vector3::x()), solid.extent(&Vector3::y())], 0.0)
            }
        };
        Some(Self { centre: [solid.centre.x, solid.centre.y], side, half, round, keep_off })
    }

    /// Centre in the map, in m.
    pub(crate) fn centre(&self) -> [f64; 2] {
        self.centre
    }

    /// Greatest distance of its points from its centre, in m.
    pub(crate) fn reach(&self) -> f64 {
        libm::hypot(self.half[0], self.half[1]) + self.round
    }

    /// Required distance of the base's axis, in m.
    pub(crate) fn keep_off(&self) -> f64 {
        self.keep_off
    }

    /// Clearance of the base's axis at a place, in m.
    pub(crate) fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let (x, y) = (x - self.centre[0], y - self.centre[1]);
        let [c, s] = self.side;
        let a = ((x * c + y * s).abs() - self.half[0]).max(0.0);
        let b = ((y * c - x * s).abs() - self.half[1]).max(0.0);
        (a * a + b * b).sqrt() - self.round - self.keep_off
    }
}

/// Cylinder about a vertical axis that holds a solid: its radius and its heights, in m.
pub(crate) fn about_vertical(solid: &Solid, x: f64, y: f64) -> (f64, [f64; 2]) {
    let up = solid.extent(&Vector3::z());
    let aside = libm::hypot(solid.centre.x - x, solid.centre.y - y);
    // Extent along the direction from the axis to the centre; a box's corners may be farther.
    let wide = match solid.shape {
        crate::collision::Shape::Capsule { radius, half }
        | crate::collision::Shape::Cylinder { radius, half } => {
            let [_, _, z] = &solid.axes;
            let end = |sign: f64| {
                let end = solid.centre + z * (half * sign);
                libm::hypot(end.x - x, end.y - y)
            };
            end(1.0).max(end(-1.0)) + radius
        }
        crate::collision::Shape::Box(_) | crate::collision::Shape::HalfSpace => aside + solid.reach(),
    };
    (wide, [solid.centre.z - up, solid.centre.z + up])
}
