//! Obstacles seen from above, each wider by as much of the robot as is between its heights, and which of them are near a
//! place.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::planning::scene::contact::MIN_CLEARANCE;

/// Clearances above this are not told apart, in m.
const WIDE: f64 = 0.4;
/// A side of the squares for each of which the outlines near it are listed, in m.
const SQUARE: f64 = 0.5;

/// The outlines of a room.
#[derive(Clone, Debug)]
pub(crate) struct FootprintIndex {
    all: Vec<Footprint>,
    /// Which are near each square of a grid.
    squares: Vec<Vec<Footprint>>,
    /// How many squares there are in a row and in a column.
    size: [usize; 2],
    origin: [f64; 2],
}

/// An obstacle seen from above, and the radius of the robot between its heights.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Footprint {
    centre: [f64; 2],
    /// Direction of its first side.
    side: [f64; 2],
    half: [f64; 2],
    /// How much is added around.
    round: f64,
    keep_off: f64,
}

impl FootprintIndex {
    /// Outlines with a grid over them, from a corner and so wide and so deep in m. O(outlines × squares near each).
    pub(crate) fn new(all: Vec<Footprint>, origin: [f64; 2], span: [f64; 2]) -> Self {
        let size = span.map(|span| libm::ceil(span / SQUARE) as usize + 1);
        let mut new = Self { all: vec![], squares: vec![vec![]; size[0] * size[1]], size, origin };
        all.iter().for_each(|outline| new.list(outline));
        Self { all, ..new }
    }

    /// All, in the order of the room.
    pub(crate) fn all(&self) -> &[Footprint] {
        &self.all
    }

    /// The clearance of a place in m, or what is much where it is more; negative where the robot would touch something.
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

    /// Lists an outline in the squares that it is near to.
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
                // The corners of a square are 0.71 of its side from its middle.
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
    /// `None` where no part of the robot is between the solid's heights.
    pub(crate) fn new(solid: &Solid, discs: &[(f64, [f64; 2])]) -> Option<Self> {
        let up = solid.extent(&Vector3::z());
        let (low, high) = (solid.centre.z - up - MIN_CLEARANCE, solid.centre.z + up + MIN_CLEARANCE);
        let meets = discs.iter().filter(|(_, [least, greatest])| *greatest >= low && *least <= high);
        let widest = meets.map(|(radius, _)| *radius).fold(f64::NEG_INFINITY, f64::max);
        if widest < 0.0 {
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
        Some(Self {
            centre: [solid.centre.x, solid.centre.y],
            side,
            half,
            round,
            keep_off: widest + MIN_CLEARANCE,
        })
    }

    /// The middle of what is covered.
    pub(crate) fn centre(&self) -> [f64; 2] {
        self.centre
    }

    /// How far the obstacle goes from its middle, in m.
    pub(crate) fn reach(&self) -> f64 {
        libm::hypot(self.half[0], self.half[1]) + self.round
    }

    /// How far the base's axis stays from the obstacle, in m.
    pub(crate) fn keep_off(&self) -> f64 {
        self.keep_off
    }

    /// How far the base's axis at a place is from where the robot may touch the obstacle, in m.
    pub(crate) fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let (x, y) = (x - self.centre[0], y - self.centre[1]);
        let [c, s] = self.side;
        let a = ((x * c + y * s).abs() - self.half[0]).max(0.0);
        let b = ((y * c - x * s).abs() - self.half[1]).max(0.0);
        (a * a + b * b).sqrt() - self.round - self.keep_off
    }
}
