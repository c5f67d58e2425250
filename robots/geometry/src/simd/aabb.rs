//! Axis-aligned boxes in the map frame, eight side by side: overlap tests against another box.

use pulp::Simd;

use super::lanes::{Lanes, Lanes3};

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
