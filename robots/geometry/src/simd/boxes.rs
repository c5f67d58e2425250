//! Bounding boxes in `f32`: axis-aligned ones in the map frame, eight side by side, and the oriented ones of
//! obstacles, relative to the origin of a neighbourhood.

use nalgebra::Vector3;
use pulp::Simd;

use super::FAR;
use super::lanes::{Lanes, Lanes3};
use crate::collision::{Shape, Solid};

/// Axis-aligned box by its least and greatest corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aabb {
    pub(super) low: [f32; 3],
    pub(super) high: [f32; 3],
}

/// Boxes in rows of eight; unused lanes of the last row are empty boxes.
#[derive(Clone, Debug, Default)]
pub(super) struct AabbRows {
    rows: Vec<[[f32; 8]; 6]>,
}

impl Aabb {
    pub(super) const NOWHERE: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    /// Grows to contain another box.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn add(&mut self, other: &Self) {
        for (slot, value) in self.low.iter_mut().zip(&other.low) {
            *slot = if *value < *slot { *value } else { *slot };
        }
        for (slot, value) in self.high.iter_mut().zip(&other.high) {
            *slot = if *value > *slot { *value } else { *slot };
        }
    }
}

impl Default for Aabb {
    fn default() -> Self {
        Self::NOWHERE
    }
}

impl FromIterator<Aabb> for AabbRows {
    fn from_iter<I: IntoIterator<Item = Aabb>>(bounds: I) -> Self {
        let mut all = Self::default();
        for (bound, at) in bounds.into_iter().zip(0..) {
            all.set(at, &bound);
        }
        all
    }
}

impl AabbRows {
    /// Sets a box; the row before it must exist.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn set(&mut self, at: usize, bound: &Aabb) {
        let (row, lane) = (at / 8, at % 8);
        if row == self.rows.len() {
            let (low, high) = ([f32::INFINITY; 8], [f32::NEG_INFINITY; 8]);
            self.rows.push([low, low, low, high, high, high]);
        }
        let Some(slots) = self.rows.get_mut(row) else { return };
        for (slots, value) in slots.iter_mut().zip(bound.low.iter().chain(&bound.high)) {
            slots.get_mut(lane).into_iter().for_each(|slot| *slot = *value);
        }
    }

    /// Number of rows.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Bit mask of the boxes of a row that are at most `wide` from another box along each axis.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn near<S: Simd>(&self, simd: S, row: usize, other: &Aabb, wide: f32) -> u8 {
        let Some([low_x, low_y, low_z, high_x, high_y, high_z]) = self.rows.get(row) else { return 0 };
        let mut bits = 0;
        for chunk in 0..8 / S::F32_LANES {
            let (Lanes3([x, y, z]), Lanes3([a, b, c])) =
                (Lanes3::splat(simd, other.low), Lanes3::splat(simd, other.high));
            let of = |row: &[f32; 8]| Lanes::of(simd, row, chunk);
            let along_x = (of(low_x) - a).max(x - of(high_x));
            let along_y = (of(low_y) - b).max(y - of(high_y));
            let along_z = (of(low_z) - c).max(z - of(high_z));
            let apart = along_x.max(along_y).max(along_z) - Lanes::splat(simd, wide);
            bits |= apart.not_positive() << (chunk * S::F32_LANES);
        }
        bits
    }
}

/// Oriented bounding box of an obstacle, in m from the origin of a neighbourhood.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Obb {
    pub(super) centre: [f32; 3],
    pub(super) axes: [[f32; 3]; 3],
    pub(super) half: [f32; 3],
    /// Axis-aligned box around it in the map frame.
    pub(super) bound: Aabb,
    /// True if the obstacle is that box, and so small and near that its rounding is below a tenth of a
    /// millimetre.
    pub(super) is_exact: bool,
}

/// Obstacles of a neighbourhood.
#[derive(Clone, Debug, Default)]
pub(crate) struct ObbSet {
    pub(super) all: Vec<Obb>,
    pub(super) bounds: AabbRows,
}

impl FromIterator<Obb> for ObbSet {
    fn from_iter<I: IntoIterator<Item = Obb>>(obbs: I) -> Self {
        let all: Vec<Obb> = obbs.into_iter().collect();
        Self { bounds: all.iter().map(|obb| obb.bound).collect(), all }
    }
}

impl Obb {
    /// Positive if a point is certainly farther than `wanted`, by the axis-aligned box.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn aside<S: Simd>(&self, simd: S, point: Lanes3<S>, wanted: Lanes<S>) -> Lanes<S> {
        let (Lanes3([x, y, z]), Lanes3([a, b, c]), Lanes3([d, e, f])) =
            (point, Lanes3::splat(simd, self.bound.low), Lanes3::splat(simd, self.bound.high));
        let x = (a - x).max(x - d).max_zero();
        let y = (b - y).max(y - e).max_zero();
        let z = (c - z).max(z - f).max_zero();
        x * x + y * y + z * z - wanted * wanted
    }

    /// Oriented box of a solid; `None` for an unbounded one.
    pub(crate) fn new(solid: &Solid, [x, y]: [f64; 2]) -> Option<Self> {
        let half = sides(&solid.shape)?;
        let centre = solid.centre - Vector3::new(x, y, 0.0);
        // A large or distant box is rounded more, in proportion to 3 m.
        let size = centre.norm() + half.norm();
        let half = half.add_scalar(size / FAR * 1e-6);
        let extent = solid
            .axes
            .iter()
            .zip(half.iter())
            .fold(Vector3::zeros(), |sum: Vector3<f64>, (axis, half)| sum + axis.abs() * *half);
        let (low, high) = (centre - extent, centre + extent);
        Some(Self {
            centre: single(&centre),
            axes: [0, 1, 2].map(|at: usize| solid.axes.get(at).map_or([0.0; 3], single)),
            half: single(&half),
            bound: Aabb { low: single(&low.add_scalar(-1e-5)), high: single(&high.add_scalar(1e-5)) },
            is_exact: matches!(solid.shape, Shape::Box(_)) && size < 50.0,
        })
    }
}

/// Half extents of the bounding box of a shape.
pub(super) fn sides(shape: &Shape) -> Option<Vector3<f64>> {
    Some(match *shape {
        Shape::Box(half) => half,
        Shape::Cylinder { radius, half } => Vector3::new(radius, radius, half),
        Shape::Capsule { radius, half } => Vector3::new(radius, radius, half + radius),
        Shape::HalfSpace => return None,
    })
}

pub(super) fn single(vector: &Vector3<f64>) -> [f32; 3] {
    [vector.x as f32, vector.y as f32, vector.z as f32]
}
