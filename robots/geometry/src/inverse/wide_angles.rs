//! Eight numbers at a time, and the angle of a vector among them.
//!
//! Only sums, products, quotients, square roots and comparisons are used, one after the other: these are the same to
//! the last bit on every processor, where a library's own arc tangent may fuse products with sums.

use wide::f32x8;

/// Coefficients of arctan(t) = t + t³ (c0 + c1 t² + …) for |t| ≤ 1, fitted at Chebyshev points; off by 1.2e-7 at most.
const ARC: [f32; 8] = [
    -0.333_333_25,
    0.199_988_1,
    -0.142_590_37,
    0.108_774_08,
    -0.080_422_95,
    0.049_384_937,
    -0.020_364_47,
    0.003_962_159,
];

pub(super) const TURN: f32 = std::f32::consts::TAU;

/// The angles of the vectors (x, y), in [−π, π]; 0 for the zero vector.
pub(super) fn atan2(y: f32x8, x: f32x8) -> f32x8 {
    let (zero, one) = (f32x8::splat(0.0), f32x8::splat(1.0));
    let (ax, ay) = (x.abs(), y.abs());
    let steep = ax.simd_lt(ay);
    let (small, large) = (steep.select(ax, ay), steep.select(ay, ax));
    let ratio = small / large.simd_le(zero).select(one, large);
    let square = ratio * ratio;
    let mut sum = f32x8::splat(0.0);
    for coefficient in ARC.iter().rev() {
        sum = sum * square + f32x8::splat(*coefficient);
    }
    let angle = ratio + ratio * square * sum;
    let angle = steep.select(f32x8::splat(std::f32::consts::FRAC_PI_2) - angle, angle);
    let angle = x.simd_lt(zero).select(f32x8::splat(std::f32::consts::PI) - angle, angle);
    y.simd_lt(zero).select(zero - angle, angle)
}

/// The angles, brought by full turns to `least` or up to a turn above it.
pub(super) fn above(angle: f32x8, least: f32) -> f32x8 {
    let least = f32x8::splat(least);
    angle - ((angle - least) * f32x8::splat(1.0 / TURN)).floor() * f32x8::splat(TURN)
}

#[cfg(test)]
mod tests {
    use super::{above, atan2};
    use wide::f32x8;

    #[test]
    fn angles_are_right_all_around() {
        for step in 0..10_000_u16 {
            let angle = (f64::from(step) / 5000.0 - 1.0) * std::f64::consts::PI * 0.999_999;
            let (x, y) = ((angle.cos() * 0.3) as f32, (angle.sin() * 0.3) as f32);
            let found = f64::from(atan2(f32x8::splat(y), f32x8::splat(x)).to_array()[0]);
            assert!((found - f64::from(y).atan2(f64::from(x))).abs() < 5e-7, "{angle}: {found}");
        }
        assert_eq!(atan2(f32x8::splat(0.0), f32x8::splat(0.0)).to_array()[0], 0.0);
        let wrapped = above(f32x8::splat(-3.0), -2.0).to_array()[0];
        assert!((f64::from(wrapped) - (std::f64::consts::TAU - 3.0)).abs() < 1e-6);
    }
}
