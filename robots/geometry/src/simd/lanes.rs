//! Several numbers of one kind at once, as many as the processor takes; the same bits on every one.
//!
//! Everything here, and what uses it, is inlined into one function that is compiled for a kind of processor. A closure that an
//! adaptor calls is not, most often, and then costs a call an operation: hence destructured arrays and plain loops.
//!
//! Only sums, products, quotients, square roots and comparisons are used, one after the other and never fused, which IEEE 754
//! defines to the last bit.

use std::ops::{Add, Mul, Neg, Sub};

use pulp::Simd;

/// Numbers in as many lanes as `S` has.
#[derive(Clone, Copy)]
pub(super) struct Lanes<S: Simd>(S, S::f32s);

/// A quarter of a turn in three parts, each of which has so few digits that small multiples of it are exact.
const QUARTER: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];
/// Added and taken away again, it rounds to a whole number.
const ROUNDER: f32 = 12_582_912.0;

impl<S: Simd> Lanes<S> {
    #[inline(always)]
    pub(super) fn splat(simd: S, value: f32) -> Self {
        Self(simd, simd.splat_f32s(value))
    }

    /// The chunk `at` of eight numbers.
    #[inline(always)]
    pub(super) fn of(simd: S, values: &[f32; 8], at: usize) -> Self {
        let (chunks, _) = S::as_simd_f32s(values);
        match chunks.get(at) {
            Some(chunk) => Self(simd, *chunk),
            None => Self::splat(simd, 0.0),
        }
    }

    /// Writes them to the chunk `at` of eight numbers.
    #[inline(always)]
    pub(super) fn store(self, values: &mut [f32; 8], at: usize) {
        let (chunks, _) = S::as_mut_simd_f32s(values);
        if let Some(slot) = chunks.get_mut(at) {
            *slot = self.1;
        }
    }

    #[inline(always)]
    pub(super) fn abs(self) -> Self {
        // The library's own is a call.
        self.max(-self)
    }

    #[inline(always)]
    pub(super) fn sqrt(self) -> Self {
        Self(self.0, self.0.sqrt_f32s(self.1))
    }

    #[inline(always)]
    pub(super) fn div(self, other: Self) -> Self {
        Self(self.0, self.0.div_f32s(self.1, other.1))
    }

    /// Of each lane the smaller one.
    #[inline(always)]
    pub(super) fn min(self, other: Self) -> Self {
        // By the greater one, which is the same on every processor.
        -(-self).max(-other)
    }

    /// Of each lane the greater one.
    #[inline(always)]
    pub(super) fn max(self, other: Self) -> Self {
        Self(self.0, self.0.max_f32s(self.1, other.1))
    }

    /// Zero where negative.
    #[inline(always)]
    pub(super) fn max_zero(self) -> Self {
        self.max(Self::splat(self.0, 0.0))
    }

    /// No less than −1 and no more than 1.
    #[inline(always)]
    pub(super) fn within(self) -> Self {
        self.max(self.like(-1.0)).min(self.like(1.0))
    }

    /// One of two, by whether this is less than a number.
    #[inline(always)]
    fn pick(self, less_than: f32, yes: Self, no: Self) -> Self {
        let is_less = self.0.less_than_f32s(self.1, self.0.splat_f32s(less_than));
        Self(self.0, self.0.select_f32s(is_less, yes.1, no.1))
    }

    /// The least of all lanes.
    #[inline(always)]
    pub(super) fn min_lane(self) -> f32 {
        self.0.reduce_min_f32s(self.1)
    }

    /// The greatest of all lanes.
    #[inline(always)]
    pub(super) fn max_lane(self) -> f32 {
        self.0.reduce_max_f32s(self.1)
    }

    /// A bit for each lane, the first lowest: whether it is not above 0. What is no number at all is not.
    #[inline(always)]
    pub(super) fn not_positive(self) -> u8 {
        let zero = self.like(0.0);
        let is_above = self.0.less_than_f32s(zero.1, self.1);
        Self(self.0, self.0.select_f32s(is_above, zero.1, self.bits().1)).summed()
    }

    /// A bit for each lane, the first lowest: whether it is below 0.
    #[inline(always)]
    pub(super) fn negative(self) -> u8 {
        let zero = self.like(0.0);
        let is_below = self.0.less_than_f32s(self.1, zero.1);
        Self(self.0, self.0.select_f32s(is_below, self.bits().1, zero.1)).summed()
    }

    /// In each lane the number that its bit alone is.
    #[inline(always)]
    fn bits(self) -> Self {
        Self::of(self.0, &[1.0, 2.0, 4.0, 8.0, 16.0, 32.0, 64.0, 128.0], 0)
    }

    /// The sum of lanes that are zero or their bit: exact, and the same in every order.
    #[inline(always)]
    fn summed(self) -> u8 {
        self.0.reduce_sum_f32s(self.1) as u8
    }

    /// The sum of the powers of this from the zeroth on, times the terms.
    #[inline(always)]
    fn series(self, [a, b, c, d]: [f32; 4]) -> Self {
        ((self.like(d) * self + self.like(c)) * self + self.like(b)) * self + self.like(a)
    }

    /// A number in all lanes.
    #[inline(always)]
    fn like(self, value: f32) -> Self {
        Self::splat(self.0, value)
    }

    /// The nearest whole number.
    #[inline(always)]
    fn round(self) -> Self {
        (self + self.like(ROUNDER)) - self.like(ROUNDER)
    }

    /// Sine and cosine, off by 4e-7 at most for angles up to 100 rad: taken back to an eighth of a turn on either side of 0
    /// (Cody and Waite 1980), where the first terms of the series are enough.
    #[inline(always)]
    pub(super) fn sin_cos(self) -> [Self; 2] {
        let quarters = (self * self.like(std::f32::consts::FRAC_2_PI)).round();
        let [high, middle, low] = QUARTER;
        let rest = self - quarters * self.like(high);
        let rest = (rest - quarters * self.like(middle)) - quarters * self.like(low);
        let square = rest * rest;
        let sin =
            rest + rest * square * square.series([-1.0 / 6.0, 1.0 / 120.0, -1.0 / 5040.0, 1.0 / 362_880.0]);
        let cos = self.like(1.0) + square * square.series([-0.5, 1.0 / 24.0, -1.0 / 720.0, 1.0 / 40_320.0]);
        // Which quarter it is: −2 to 2.
        let quarter = quarters - self.like(4.0) * (quarters * self.like(0.25)).round();
        let is_swapped = (quarter.abs() - self.like(1.0)).abs();
        let (first, second) = (is_swapped.pick(0.5, cos, sin), is_swapped.pick(0.5, sin, cos));
        let signed_sin = quarter.pick(-0.5, -first, quarter.pick(1.5, first, -first));
        let signed_cos = quarter.pick(-1.5, -second, quarter.pick(0.5, second, -second));
        [signed_sin, signed_cos]
    }
}

impl<S: Simd> Add for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0, self.0.add_f32s(self.1, other.1))
    }
}

impl<S: Simd> Sub for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0, self.0.sub_f32s(self.1, other.1))
    }
}

impl<S: Simd> Mul for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0, self.0.mul_f32s(self.1, other.1))
    }
}

impl<S: Simd> Neg for Lanes<S> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::splat(self.0, 0.0) - self
    }
}

/// Vectors in lanes.
#[derive(Clone, Copy)]
pub(super) struct Lanes3<S: Simd>(pub(super) [Lanes<S>; 3]);

impl<S: Simd> Lanes3<S> {
    #[inline(always)]
    pub(super) fn splat(simd: S, [x, y, z]: [f32; 3]) -> Self {
        Self([Lanes::splat(simd, x), Lanes::splat(simd, y), Lanes::splat(simd, z)])
    }

    #[inline(always)]
    pub(super) fn dot(self, other: Self) -> Lanes<S> {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        a * x + b * y + c * z
    }

    /// The chunk `at` of eight vectors.
    #[inline(always)]
    pub(super) fn of(simd: S, [x, y, z]: &[[f32; 8]; 3], at: usize) -> Self {
        Self([Lanes::of(simd, x, at), Lanes::of(simd, y, at), Lanes::of(simd, z, at)])
    }

    /// Writes them to the chunk `at` of eight vectors.
    #[inline(always)]
    pub(super) fn store(self, [x, y, z]: &mut [[f32; 8]; 3], at: usize) {
        let [a, b, c] = self.0;
        a.store(x, at);
        b.store(y, at);
        c.store(z, at);
    }

    #[inline(always)]
    pub(super) fn cross(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([b * z - c * y, c * x - a * z, a * y - b * x])
    }

    #[inline(always)]
    pub(super) fn times(self, factor: Lanes<S>) -> Self {
        let [x, y, z] = self.0;
        Self([x * factor, y * factor, z * factor])
    }
}

impl<S: Simd> Add for Lanes3<S> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a + x, b + y, c + z])
    }
}

impl<S: Simd> Sub for Lanes3<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        let ([a, b, c], [x, y, z]) = (self.0, other.0);
        Self([a - x, b - y, c - z])
    }
}
