//! Configurations spread evenly over the limits, without chance.

use super::tree::Dof;

/// Configuration `index` of a low-discrepancy sequence over the variables' spans (Roberts 2018: multiples of powers of a
/// generalised golden ratio); the middle for index 0.
#[must_use]
pub fn quasi_random(dofs: &[Dof], index: usize) -> Vec<f64> {
    quasi_random_in(dofs.iter().map(Dof::sampling_range), index)
}

/// The same over some ranges.
pub(crate) fn quasi_random_in(ranges: impl ExactSizeIterator<Item = (f64, f64)>, index: usize) -> Vec<f64> {
    // The root of x^(n+1) = x + 1, to which this iteration closes in from any start.
    let mut ratio = 1.5_f64;
    for _ in 0..40 {
        ratio = libm::pow(1.0 + ratio, 1.0 / (ranges.len() as f64 + 1.0));
    }
    let mut power = 1.0;
    let values = ranges.map(|(lower, upper)| {
        power /= ratio;
        let part = 0.5 + power * index as f64;
        lower + (part - libm::floor(part)) * (upper - lower)
    });
    values.collect()
}
