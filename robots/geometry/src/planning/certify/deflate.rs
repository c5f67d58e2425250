//! Whether two solids touch wherever they are within some distance of where they are known to be: each is made smaller by as much as it
//! can be off.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};
use crate::planning::scene::contact::MIN_CLEARANCE;

/// What may be off of places and lengths, in m: far more than rounding, and than what the axes of a URDF are off.
pub(crate) const SLACK: f64 = 1e-5;

/// A part where it is in the middle of a cell, and how far it can be from there.
#[derive(Clone, Copy)]
pub(crate) struct DeflatedPart {
    pub(crate) solid: Solid,
    pub(crate) inner: f64,
    pub(crate) reach: f64,
    pub(crate) drift: f64,
}

impl DeflatedPart {
    /// Whether it touches another solid, in which so large a ball is and which is in so large a one, wherever both are within their drifts.
    #[inline]
    pub(crate) fn touches(&self, other: &Solid, inner: f64, reach: f64, drift: f64) -> bool {
        let off = drift + SLACK;
        let from_other = (off - self.inner).max(0.0);
        // What is not known at all is off by more than any number.
        if off.is_nan() || from_other >= inner {
            return false;
        }
        let (wide, between) =
            (self.reach + MIN_CLEARANCE - off.min(self.inner), self.solid.centre - other.centre);
        let most = wide + reach - from_other;
        if wide < 0.0 || between.norm_squared() > most * most || beyond(other, &between, wide - from_other) {
            return false;
        }
        let (one, far) = (within(&self.solid, off.min(self.inner)), within(other, from_other));
        one.is_nearer(&far, MIN_CLEARANCE)
    }

    /// Whether it stays apart from another solid, around which so large a ball is, wherever both are within their drifts.
    #[inline]
    pub(crate) fn is_apart(&self, other: &Solid, reach: f64, drift: f64) -> bool {
        let wide = self.reach + MIN_CLEARANCE + drift + SLACK;
        let between = self.solid.centre - other.centre;
        let most = wide + reach;
        between.norm_squared() > most * most || beyond(other, &between, wide)
    }
}

/// Whether a place, seen from the centre of a solid, is farther from it than `far`, by the directions of a box: a ball there is
/// not near it.
#[inline]
fn beyond(solid: &Solid, between: &Vector3<f64>, far: f64) -> bool {
    let Shape::Box(half) = solid.shape else { return false };
    let [x, y, z] = &solid.axes;
    let out = |axis: &Vector3<f64>, half: f64| between.dot(axis).abs() - half;
    let (x, y, z) = (out(x, half.x), out(y, half.y), out(z, half.z));
    if far < 0.0 {
        return x > far || y > far || z > far;
    }
    let (x, y, z) = (x.max(0.0), y.max(0.0), z.max(0.0));
    x * x + y * y + z * z > far * far
}

/// The radius of the greatest ball within a solid.
pub(crate) fn inner(solid: &Solid) -> f64 {
    match solid.shape {
        Shape::Box(half) => half.min(),
        Shape::Cylinder { radius, half } => radius.min(half),
        Shape::Capsule { radius, .. } => radius,
        Shape::HalfSpace => 0.0,
    }
}

/// The points of a solid that are so deep within it, at most as deep as the greatest ball.
fn within(solid: &Solid, depth: f64) -> Solid {
    resized(solid, |length| (length - depth).max(0.0))
}

/// A solid with its surface elsewhere: every length from the core of its shape to it is another one.
pub(crate) fn resized(solid: &Solid, length: impl Fn(f64) -> f64) -> Solid {
    let shape = match solid.shape {
        Shape::Box(half) => Shape::Box(half.map(length)),
        Shape::Cylinder { radius, half } => Shape::Cylinder { radius: length(radius), half: length(half) },
        Shape::Capsule { radius, half } => Shape::Capsule { radius: length(radius), half },
        Shape::HalfSpace => Shape::HalfSpace,
    };
    Solid { shape, ..*solid }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
    use proptest::prelude::*;

    use super::{DeflatedPart, inner};
    use crate::collision::{Shape, Solid};

    fn solid(at: [f64; 3], turn: [f64; 3], shape: Shape) -> Solid {
        let turned = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        Solid::new(&Isometry3::from_parts(Translation3::from(Vector3::from(at)), turned), shape)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        /// What touches a board throughout does so wherever it is moved within its drift, and what is apart is so.
        #[test]
        fn what_is_said_of_a_board_holds_for_all_that_is_near(
            at in [-0.3..0.3_f64, -0.3..0.3_f64, -0.2..0.2_f64], turn in [-1.5..1.5_f64, -1.5..1.5_f64, -1.5..1.5_f64],
            half in 0.05..0.4_f64, radius in 0.01..0.06_f64, drift in 0.0..0.25_f64, kind in 0..3_u8,
            shift in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64], share in 0.0..1.0_f64,
            board in [0.05..0.5_f64, 0.05..0.5_f64, 0.002..0.03_f64], lean in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
        ) {
            let shape = match kind {
                0 => Shape::Capsule { radius, half },
                1 => Shape::Cylinder { radius, half },
                _ => Shape::Box(Vector3::new(radius, half, radius)),
            };
            let own = solid(at, turn, shape);
            let board = solid([0.0; 3], lean, Shape::Box(Vector3::from(board)));
            let placed = DeflatedPart { solid: own, inner: inner(&own), reach: own.reach(), drift };
            let is_stuck = placed.touches(&board, inner(&board), board.reach(), drift);
            let is_apart = placed.is_apart(&board, board.reach(), drift);
            // A turn about its centre and a shift that together are no more than the drift.
            let [x, y, z] = shift;
            let along = Vector3::new(x, y, z + 1e-3).normalize();
            let axis = Vector3::new(y, z, x + 1e-3).normalize();
            let turned = UnitQuaternion::from_scaled_axis(axis * (share * drift / own.reach()).min(1.0));
            let about = Translation3::from(own.centre);
            let moved = Translation3::from(along * ((1.0 - share) * drift)) * about * turned * about.inverse();
            let moved = own.moved(&moved);
            prop_assert!(!is_stuck || moved.is_nearer(&board, super::MIN_CLEARANCE));
            prop_assert!(!is_apart || moved.is_farther(&board, super::MIN_CLEARANCE));
        }
    }
}
