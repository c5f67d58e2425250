//! Configurations spread evenly over the limits, without chance.

use super::tree::Variable;

/// Configuration `index` of a low-discrepancy sequence over the limits (Roberts 2018: multiples of powers of a
/// generalised golden ratio); the middle for index 0, and a turn or a metre either way where there are no limits.
#[must_use]
pub fn spread(variables: &[Variable], index: usize) -> Vec<f64> {
    // The root of x^(n+1) = x + 1, to which this iteration closes in from any start.
    let mut ratio = 1.5_f64;
    for _ in 0..40 {
        ratio = libm::pow(1.0 + ratio, 1.0 / (variables.len() as f64 + 1.0));
    }
    let mut power = 1.0;
    let values = variables.iter().map(|variable| {
        power /= ratio;
        let part = 0.5 + power * index as f64;
        let part = part - libm::floor(part);
        let free = if variable.is_turn { std::f64::consts::PI } else { 1.0 };
        let (lower, upper) = variable.limits.unwrap_or((-free, free));
        lower + part * (upper - lower)
    });
    values.collect()
}
