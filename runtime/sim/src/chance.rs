//! Chance: seeded draws that depend on what they are drawn for and on nothing else.
//!
//! A stream shared by all would shift every later draw when one more is made. So each draw has its own
//! generator, from the seed, the occasion and what it is about: the same run gives the same draws, and a
//! profile that adds one kind of failure leaves the others where they are.

use fnv::FnvHasher;
use rand::RngExt;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng;
use std::hash::Hasher as _;

/// Occasion of draws: one look, one grasp, one drive.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Chance {
    seed: u64,
    occasion: u64,
}

impl Chance {
    /// Draws of an occasion, by its number.
    pub(crate) const fn new(seed: u64, occasion: u64) -> Self {
        Self { seed, occasion }
    }

    /// A number in `0 .. 1` for a purpose, such as `slip mug_1`.
    pub(crate) fn share(self, purpose: &str, of: &str) -> f64 {
        self.random(purpose, of).random()
    }

    /// True with a probability.
    pub(crate) fn comes(self, rate: f64, purpose: &str, of: &str) -> bool {
        rate > 0.0 && self.share(purpose, of) < rate
    }

    /// Error in the plane with a standard deviation along each axis: normal, cut off at twice the deviation.
    pub(crate) fn error(self, deviation: f64, purpose: &str, of: &str) -> [f64; 2] {
        if deviation <= 0.0 {
            return [0.0; 2];
        }
        let mut random = self.random(purpose, of);
        // Box and Muller 1958: two normal numbers from two uniform ones.
        let (one, other): (f64, f64) = (random.random(), random.random());
        let length = deviation * (-2.0 * (1.0 - one).ln()).sqrt().min(2.0);
        let (sin, cos) = (other * std::f64::consts::TAU).sin_cos();
        [length * cos, length * sin]
    }

    fn random(self, purpose: &str, of: &str) -> SplitMix64 {
        // FNV-1a is the same everywhere.
        let mut hasher = FnvHasher::default();
        for part in [&self.occasion.to_le_bytes(), purpose.as_bytes(), &[0][..], of.as_bytes()] {
            hasher.write(part);
        }
        let mut random = SplitMix64::seed_from_u64(self.seed ^ hasher.finish());
        // The first number of near seeds is not far enough apart.
        let seed: u64 = random.random();
        SplitMix64::seed_from_u64(seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn chance_comes_as_often_as_its_rate() {
        let count = (0..10_000).filter(|at| Chance::new(7, *at).comes(0.03, "slip", "mug_1")).count();
        assert!((250..350).contains(&count), "{count} of 10000");
        let count = (0..10_000).filter(|seed| Chance::new(*seed, 3).comes(0.03, "slip", "mug_1")).count();
        assert!((250..350).contains(&count), "{count} of 10000 seeds");
        assert!(!(0..100).any(|at| Chance::new(7, at).comes(0.0, "slip", "mug_1")));
        assert!((0..100).all(|at| Chance::new(7, at).comes(1.0, "slip", "mug_1")));
    }

    #[test]
    fn chance_errors_have_their_deviation_and_their_bound() {
        let errors: Vec<[f64; 2]> = (0..5_000).map(|at| Chance::new(1, at).error(0.01, "base", "")).collect();
        assert!(errors.iter().all(|[x, y]| x.hypot(*y) <= 0.02 + 1e-12));
        let square = errors.iter().map(|[x, _]| x * x).sum::<f64>() / 5_000.0;
        assert!((0.008..0.0102).contains(&square.sqrt()), "{}", square.sqrt());
        assert_eq!(Chance::new(1, 1).error(0.0, "base", ""), [0.0; 2]);
    }

    #[test]
    fn chance_draws_are_apart_for_each_purpose() {
        let chance = Chance::new(3, 4);
        assert_eq!(chance.share("slip", "mug_1").to_bits(), chance.share("slip", "mug_1").to_bits());
        assert_ne!(chance.share("slip", "mug_1").to_bits(), chance.share("slip", "mug_2").to_bits());
        assert_ne!(chance.share("slip", "mug_1").to_bits(), chance.share("stick", "mug_1").to_bits());
    }
}
