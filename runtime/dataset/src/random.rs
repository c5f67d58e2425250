//! Draws from a seeded generator, SplitMix64 (Steele, Lea and Flood 2014), which is the same everywhere.

use rand::{Rng, RngExt};
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::SeedableRng;

/// Draws of the values of which scenes and cases are made. Written out here, because a later version of
/// `rand` may draw ranges otherwise, and then a seed would give another dataset.
pub(crate) trait Draw: Rng {
    /// A number in `least ..= most`.
    fn within(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.random::<f64>()
    }

    /// A number below `count`; 0 where that is 0. The bias is below 2⁻⁴⁰ for the counts of a scene.
    fn below(&mut self, count: usize) -> usize {
        let count = u64::try_from(count).unwrap_or(u64::MAX).max(1);
        usize::try_from(self.next_u64() % count).unwrap_or_default()
    }

    /// Draws an event of this probability.
    fn chance(&mut self, probability: f64) -> bool {
        self.random::<f64>() < probability
    }

    /// One of several; none of nothing.
    fn pick<'t, T>(&mut self, from: &'t [T]) -> Option<&'t T> {
        let index = self.below(from.len());
        from.get(index)
    }

    /// Puts things into another order (Fisher and Yates).
    fn shuffle<T>(&mut self, things: &mut [T]) {
        for last in (1..things.len()).rev() {
            let other = self.below(last + 1);
            things.swap(last, other);
        }
    }
}

impl Draw for SplitMix64 {}

/// A generator of its own for a part of the work, so that parts do not disturb one another.
pub(crate) fn part(seed: u64, part: u64) -> SplitMix64 {
    let mut random = SplitMix64::seed_from_u64(seed ^ part.wrapping_mul(0xd6e8_feb8_6659_fd93));
    random.next_u64();
    random
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draw_repeats_for_a_seed_and_covers_its_range() {
        let (mut one, mut other) = (part(7, 3), part(7, 3));
        let drawn: Vec<usize> = (0..200).map(|_| one.below(5)).collect();
        assert_eq!(drawn, (0..200).map(|_| other.below(5)).collect::<Vec<_>>());
        assert!((0..5).all(|number| drawn.contains(&number)));
        let mut things: Vec<u32> = (0..20).collect();
        one.shuffle(&mut things);
        assert_ne!(things, (0..20).collect::<Vec<_>>());
        things.sort_unstable();
        assert_eq!(things, (0..20).collect::<Vec<_>>());
        assert_eq!((one.below(0), one.pick::<u8>(&[])), (0, None));
    }
}
