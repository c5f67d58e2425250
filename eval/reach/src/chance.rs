//! Draws from a seeded generator, SplitMix64 (Steele, Lea and Flood 2014), which is the same everywhere.

use rand::{Rng, RngExt};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng;

/// Draws of the values of which rooms and grasps are made.
pub(crate) trait Chance: Rng {
    /// A number in [0, 1).
    fn unit(&mut self) -> f64 {
        self.random()
    }

    /// A number between two.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of `count`, which is not 0.
    fn below(&mut self, count: usize) -> usize {
        ((self.unit() * count as f64) as usize).min(count - 1)
    }

    /// True so often.
    fn is(&mut self, share: f64) -> bool {
        self.unit() < share
    }
}

impl Chance for SplitMix64 {}

/// The generator of a seed.
pub(crate) fn seeded(seed: u64) -> SplitMix64 {
    SplitMix64::seed_from_u64(seed ^ 0x5851_f42d_4c95_7f2d)
}
