//! The distance between two solids: in closed form where both are capsules, else by Gilbert, Johnson and Keerthi (1988).

use nalgebra::Vector3;

use super::simplex::Simplex;
use super::solid::{Shape, Solid};

/// How near the bounds from below and above have to come, in m.
const CLOSE: f64 = 1e-9;

/// Steps after which the bound from below is taken as it is.
const STEPS: usize = 96;

impl Solid {
    /// The distance in m to another solid: never above the true one, and below it by no more than 1e-9 m but where both are
    /// nearly flat. Where they overlap it is 0 or negative, and says nothing about how deep.
    #[must_use]
    pub fn distance(&self, other: &Self) -> f64 {
        self.bounded(other, f64::INFINITY)
    }

    /// Whether the distance is more than `metres`. Cheaper than the distance.
    #[must_use]
    pub fn is_farther(&self, other: &Self, metres: f64) -> bool {
        let between = (self.centre - other.centre).norm() - self.reach() - other.reach();
        between > metres || self.bounded(other, metres) > metres
    }

    /// The distance, or a bound from below as soon as one is above `enough`.
    fn bounded(&self, other: &Self, enough: f64) -> f64 {
        match (&self.shape, &other.shape) {
            (Shape::HalfSpace, Shape::HalfSpace) => f64::NEG_INFINITY,
            (_, Shape::HalfSpace) => above(other, self),
            (Shape::HalfSpace, _) => above(self, other),
            (Shape::Capsule { radius, half }, Shape::Capsule { radius: far_radius, half: far_half }) => {
                segments(&ends(self, *half), &ends(other, *far_half)) - radius - far_radius
            }
            _ => {
                let rims = self.rim() + other.rim();
                cores(self, other, enough + rims) - rims
            }
        }
    }
}

fn above(half_space: &Solid, solid: &Solid) -> f64 {
    let [_, _, up] = &half_space.axes;
    (solid.centre - half_space.centre).dot(up) - solid.extent(up)
}

fn ends(solid: &Solid, half: f64) -> [Vector3<f64>; 2] {
    let [_, _, z] = &solid.axes;
    [solid.centre - z * half, solid.centre + z * half]
}

/// The distance between the cores of two solids, from below. With the nearest point `v` of a simplex within the difference of
/// both, no point of the difference is nearer to the origin than the plane square to `v` through the support `w`.
fn cores(one: &Solid, other: &Solid, enough: f64) -> f64 {
    let mut nearest = one.centre - other.centre;
    let mut simplex = Simplex::empty();
    let mut below = 0.0_f64;
    for _ in 0..STEPS {
        let length = nearest.norm();
        if length < 1e-12 {
            return 0.0;
        }
        let support = one.support(&-nearest) - other.support(&nearest);
        below = below.max(nearest.dot(&support) / length);
        if below > enough || length - below <= CLOSE || simplex.contains(&support) {
            return below;
        }
        simplex.push(support);
        let Some((next, rest)) = simplex.nearest() else { return 0.0 };
        simplex = rest;
        nearest = next;
    }
    below
}

/// The distance between two segments (Ericson 2005, 5.1.9).
fn segments([p1, q1]: &[Vector3<f64>; 2], [p2, q2]: &[Vector3<f64>; 2]) -> f64 {
    let (d1, d2, r) = (q1 - p1, q2 - p2, p1 - p2);
    let (a, e, f) = (d1.norm_squared(), d2.norm_squared(), d2.dot(&r));
    let tiny = 1e-18;
    let (s, t) = if a <= tiny && e <= tiny {
        (0.0, 0.0)
    } else if a <= tiny {
        (0.0, (f / e).clamp(0.0, 1.0))
    } else {
        let c = d1.dot(&r);
        if e <= tiny {
            ((-c / a).clamp(0.0, 1.0), 0.0)
        } else {
            let b = d1.dot(&d2);
            let determinant = a * e - b * b;
            let s = if determinant > 1e-12 * a * e {
                ((b * f - c * e) / determinant).clamp(0.0, 1.0)
            } else {
                0.0
            };
            let t = (b * s + f) / e;
            if t < 0.0 {
                ((-c / a).clamp(0.0, 1.0), 0.0)
            } else if t > 1.0 {
                (((b - c) / a).clamp(0.0, 1.0), 1.0)
            } else {
                (s, t)
            }
        }
    };
    (r + d1 * s - d2 * t).norm()
}
