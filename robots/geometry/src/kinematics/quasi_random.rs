//! Quasi-random configurations: a low-discrepancy sequence over the ranges of the degrees of freedom, without
//! chance.

use super::tree::Dof;

/// Configuration `index` of the R sequence over the sampling ranges (Roberts 2018: multiples of powers of a
/// generalised golden ratio); the middle for index 0. O(degrees of freedom).
///
/// ```
/// use motet_geometry::KinematicTree;
/// use motet_geometry::kinematics::quasi_random;
/// use motet_robots::builtin;
///
/// let tree = KinematicTree::new(&builtin::robot("panda").unwrap().urdf);
/// assert!((0..100).all(|index| tree.allows(&quasi_random(tree.dofs(), index))));
/// ```
#[must_use]
pub fn quasi_random(dofs: &[Dof], index: usize) -> Vec<f64> {
    quasi_random_in(dofs.iter().map(Dof::sampling_range), index)
}

/// Point `index` of the R sequence over some ranges.
pub(crate) fn quasi_random_in(ranges: impl ExactSizeIterator<Item = (f64, f64)>, index: usize) -> Vec<f64> {
    // The root of x^(n+1) = x + 1: this iteration converges from any start.
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
