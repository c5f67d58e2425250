//! Bounds from below of the distance between two solids, in lanes: how much more than wanted the square of one is.

use pulp::Simd;

use super::lanes::{Lanes, Lanes3};

/// The axis of a capsule: its centre, and from there to an end.
#[derive(Clone, Copy)]
pub(super) struct CapsuleAxis<S: Simd> {
    pub(super) centre: Lanes3<S>,
    pub(super) half: Lanes3<S>,
}

/// A box: its centre, directions, and half of its sides.
#[derive(Clone, Copy)]
pub(super) struct Cuboid<S: Simd> {
    pub(super) centre: Lanes3<S>,
    pub(super) axes: [Lanes3<S>; 3],
    pub(super) half: Lanes3<S>,
    /// Whether it is a cylinder along the last direction.
    pub(super) is_round: bool,
}

impl<S: Simd> Cuboid<S> {
    /// Positive where another box is farther than `wanted` for certain: by the box around it along the directions of this one.
    #[inline(always)]
    pub(super) fn aside(self, simd: S, other: Self, wanted: Lanes<S>) -> Lanes<S> {
        let between = other.centre - self.centre;
        let [x, y, z] = self.axes;
        let Lanes3([a, b, c]) = self.half;
        let x = (between.dot(x).abs() - a - other.extent(simd, x)).max_zero();
        let y = (between.dot(y).abs() - b - other.extent(simd, y)).max_zero();
        let z = (between.dot(z).abs() - c - other.extent(simd, z)).max_zero();
        x * x + y * y + z * z - wanted * wanted
    }

    /// How far it goes from its centre in a direction of length 1.
    #[inline(always)]
    fn extent(self, simd: S, direction: Lanes3<S>) -> Lanes<S> {
        let [x, y, z] = self.axes;
        let Lanes3([a, b, c]) = self.half;
        let up = direction.dot(z).abs();
        if self.is_round {
            // A little more, for directions that are not quite of length 1.
            let aside = (Lanes::splat(simd, 1.00001) - up * up).max_zero().sqrt();
            return a * aside + c * up;
        }
        a * direction.dot(x).abs() + b * direction.dot(y).abs() + c * up
    }
}

impl<S: Simd> CapsuleAxis<S> {
    /// Positive where the axis is farther than `wanted` from a box for certain: by the boxes along the directions of that one around
    /// `pieces` pieces of the axis.
    #[inline(always)]
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

    /// Negative where the middle or an end of the axis is nearer to a box than `wanted` for certain.
    #[inline(always)]
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

    /// The way from a place on another axis to one on this, of which both are nearly the nearest (Ericson 2005, 5.1.9).
    #[inline(always)]
    pub(super) fn way(self, simd: S, other: Self) -> Lanes3<S> {
        let tiny = Lanes::splat(simd, 1e-9);
        let between = self.centre - other.centre;
        let (d1, d2) = (self.half, other.half);
        let (a, b, e) = (d1.dot(d1) + tiny, d1.dot(d2), d2.dot(d2) + tiny);
        let (c, f) = (d1.dot(between), d2.dot(between));
        // From −1 to 1 along each, the first free of the other's ends.
        let s = (b * f - c * e).div((a * e - b * b).max(Lanes::splat(simd, 1e-12))).within();
        let t = (b * s + f).div(e).within();
        let s = (b * t - c).div(a).within();
        between + d1.times(s) - d2.times(t)
    }
}

/// A bit for each state in which an axis may be no farther from a box than wanted; in pieces where it matters.
#[inline(always)]
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

/// The square of the distance of a box from the box around a piece of an axis, along the directions of the first, of which the
/// middle of the axis is so far off. The piece is at a place from −1 to 1, and is a share of the axis.
#[inline(always)]
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
