//! Lower bounds of the distance between two solids in lanes: the excess of the squared distance over the
//! required one.

use pulp::Simd;

use super::lanes::{Lanes, Lanes3};

/// Axis of a capsule: its centre, and the vector to an end.
#[derive(Clone, Copy)]
pub(super) struct CapsuleAxis<S: Simd> {
    pub(super) centre: Lanes3<S>,
    pub(super) half: Lanes3<S>,
}

/// Box: its centre, axes and half extents.
#[derive(Clone, Copy)]
pub(super) struct Cuboid<S: Simd> {
    pub(super) centre: Lanes3<S>,
    pub(super) axes: [Lanes3<S>; 3],
    pub(super) half: Lanes3<S>,
    /// True for a cylinder along the last axis.
    pub(super) is_round: bool,
}

impl<S: Simd> Cuboid<S> {
    /// Positive if another box is certainly farther than `wanted`, by its bounding box along the axes of this
    /// one.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn aside(self, simd: S, other: Self, wanted: Lanes<S>) -> Lanes<S> {
        let between = other.centre - self.centre;
        let [x, y, z] = self.axes;
        let Lanes3([a, b, c]) = self.half;
        let x = (between.dot(x).abs() - a - other.extent(simd, x)).max_zero();
        let y = (between.dot(y).abs() - b - other.extent(simd, y)).max_zero();
        let z = (between.dot(z).abs() - c - other.extent(simd, z)).max_zero();
        x * x + y * y + z * z - wanted * wanted
    }

    /// Extent from its centre along a unit vector.
    #[cfg_attr(optimised, inline(always))]
    fn extent(self, simd: S, direction: Lanes3<S>) -> Lanes<S> {
        let [x, y, z] = self.axes;
        let Lanes3([a, b, c]) = self.half;
        let up = direction.dot(z).abs();
        if self.is_round {
            // Slightly more, for vectors that are not exactly of length 1.
            let aside = (Lanes::splat(simd, 1.00001) - up * up).max_zero().sqrt();
            return a * aside + c * up;
        }
        a * direction.dot(x).abs() + b * direction.dot(y).abs() + c * up
    }
}

impl<S: Simd> CapsuleAxis<S> {
    /// Positive if the axis is certainly farther than `wanted` from a box, by the bounding boxes of `pieces`
    /// pieces of the axis along the axes of the box.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn beside(self, simd: S, other: Cuboid<S>, wanted: Lanes<S>, pieces: u8) -> Lanes<S> {
        let between = self.centre - other.centre;
        let [x, y, z] = other.axes;
        let off = [between.dot(x), between.dot(y), between.dot(z)];
        let along = [self.half.dot(x), self.half.dot(y), self.half.dot(z)];
        let share = 1.0 / f32::from(pieces);
        let mut least = squared(simd, off, along, other.half, [share - 1.0, share]);
        for piece in 1..pieces {
            let place = (2.0 * f32::from(piece) + 1.0) * share - 1.0;
            least = least.min(squared(simd, off, along, other.half, [place, share]));
        }
        least - wanted * wanted
    }

    /// Negative if the middle or an end of the axis is certainly nearer to a box than `wanted`.
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn within(self, simd: S, other: Cuboid<S>, wanted: Lanes<S>) -> Lanes<S> {
        let between = self.centre - other.centre;
        let [x, y, z] = other.axes;
        let off = [between.dot(x), between.dot(y), between.dot(z)];
        let along = [self.half.dot(x), self.half.dot(y), self.half.dot(z)];
        let middle = squared(simd, off, along, other.half, [0.0, 0.0]);
        let first = squared(simd, off, along, other.half, [-1.0, 0.0]);
        let last = squared(simd, off, along, other.half, [1.0, 0.0]);
        middle.min(first).min(last) - wanted * wanted
    }

    /// Vector from a point on another axis to one on this; both are nearly the nearest points (Ericson 2005,
    /// 5.1.9).
    #[cfg_attr(optimised, inline(always))]
    pub(super) fn way(self, simd: S, other: Self) -> Lanes3<S> {
        let tiny = Lanes::splat(simd, 1e-9);
        let between = self.centre - other.centre;
        let (d1, d2) = (self.half, other.half);
        let (a, b, e) = (d1.dot(d1) + tiny, d1.dot(d2), d2.dot(d2) + tiny);
        let (c, f) = (d1.dot(between), d2.dot(between));
        // From −1 to 1 along each, the first regardless of the ends of the other.
        let s = (b * f - c * e).div((a * e - b * b).max(Lanes::splat(simd, 1e-12))).within();
        let t = (b * s + f).div(e).within();
        let s = (b * t - c).div(a).within();
        between + d1.times(s) - d2.times(t)
    }
}

/// Bit mask of the configurations in which an axis may be nearer to a box than `wanted`; in pieces only where
/// needed.
#[cfg_attr(optimised, inline(always))]
pub(super) fn beside<S: Simd>(
    simd: S,
    axis: CapsuleAxis<S>,
    other: Cuboid<S>,
    wanted: Lanes<S>,
    pieces: u8,
) -> u8 {
    match axis.beside(simd, other, wanted, 1).not_positive() {
        0 => 0,
        bits => bits & axis.beside(simd, other, wanted, pieces).not_positive(),
    }
}

/// Squared distance of a box from the bounding box of a piece of an axis, along the axes of the box; `off` is
/// the offset of the middle of the axis, `place` is from −1 to 1, and `share` is the fraction of the axis.
#[cfg_attr(optimised, inline(always))]
fn squared<S: Simd>(
    simd: S,
    [off_x, off_y, off_z]: [Lanes<S>; 3],
    [x, y, z]: [Lanes<S>; 3],
    half: Lanes3<S>,
    [place, share]: [f32; 2],
) -> Lanes<S> {
    let (place, share) = (Lanes::splat(simd, place), Lanes::splat(simd, share));
    let Lanes3([a, b, c]) = half;
    let x = ((off_x + x * place).abs() - a - x.abs() * share).max_zero();
    let y = ((off_y + y * place).abs() - b - y.abs() * share).max_zero();
    let z = ((off_z + z * place).abs() - c - z.abs() * share).max_zero();
    x * x + y * y + z * z
}
