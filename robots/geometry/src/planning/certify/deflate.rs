//! Deflated solids: contact for all poses within a drift, since two solids are in contact wherever they
//! move if the deflated ones are.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};

/// Numerical slack of positions and lengths, in m: far more than rounding and than the error of a URDF's
/// axes.
pub(crate) const SLACK: f64 = 1e-5;

/// Part at the middle of a cell, with the bound of its drift.
#[derive(Clone, Copy)]
pub(crate) struct DeflatedPart {
    pub(crate) solid: Solid,
    pub(crate) inner: f64,
    pub(crate) reach: f64,
    pub(crate) drift: f64,
}

impl DeflatedPart {
    /// Checks whether the part is in contact with a solid for all poses within both drifts. `inner` is the
    /// radius of a ball within that solid, `reach` of one around it, `pad` the distance of a contact.
    #[inline]
    pub(crate) fn touches(&self, other: &Solid, [inner, reach]: [f64; 2], pad: f64, drift: f64) -> bool {
        let off = drift + SLACK;
        let from_other = (off - self.inner).max(0.0);
        // An unknown drift is NaN or infinite.
        if off.is_nan() || from_other >= inner {
            return false;
        }
        let (wide, between) = (self.reach + pad - off.min(self.inner), self.solid.centre - other.centre);
        let most = wide + reach - from_other;
        if wide < 0.0 || between.norm_squared() > most * most || beyond(other, &between, wide - from_other) {
            return false;
        }
        let (one, far) = (within(&self.solid, off.min(self.inner)), within(other, from_other));
        one.is_nearer(&far, pad)
    }

    /// Checks whether the part is apart from a solid for all poses within both drifts.
    #[inline]
    pub(crate) fn is_apart(&self, other: &Solid, reach: f64, pad: f64, drift: f64) -> bool {
        let wide = self.reach + pad + drift + SLACK;
        let between = self.solid.centre - other.centre;
        let most = wide + reach;
        between.norm_squared() > most * most || beyond(other, &between, wide)
    }
}

/// Checks whether a ball is apart from a box, by the box's axes.
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

/// Radius of the largest ball within a solid, in m.
pub(crate) fn inner(solid: &Solid) -> f64 {
    match solid.shape {
        Shape::Box(half) => half.min(),
        Shape::Cylinder { radius, half } => radius.min(half),
        Shape::Capsule { radius, .. } => radius,
        Shape::HalfSpace => 0.0,
    }
}

/// Points of a solid deeper than `depth`, at most the radius of its largest ball.
fn within(solid: &Solid, depth: f64) -> Solid {
    resized(solid, |length| (length - depth).max(0.0))
}

/// Solid with its surface offset: `length` maps each distance from the core to the surface.
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
    use crate::planning::scene::MIN_CLEARANCE;

    fn solid(at: [f64; 3], turn: [f64; 3], shape: Shape) -> Solid {
        let turned = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        Solid::new(&Isometry3::from_parts(Translation3::from(Vector3::from(at)), turned), shape)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4096))]

        /// Deflation is sound: contact and separation hold for every pose within the drift.
        #[test]
        fn deflated_contact_holds_for_all_near_poses(
            at in [-0.3..0.3_f64, -0.3..0.3_f64, -0.2..0.2_f64],
            turn in [-1.5..1.5_f64, -1.5..1.5_f64, -1.5..1.5_f64], half in 0.05..0.4_f64,
            radius in 0.01..0.06_f64, drift in 0.0..0.25_f64, kind in 0..3_u8,
            shift in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64], share in 0.0..1.0_f64,
            board in [0.05..0.5_f64, 0.05..0.5_f64, 0.002..0.03_f64], clearance in 0.0..0.08_f64,
            lean in [-1.0..1.0_f64, -1.0..1.0_f64, -1.0..1.0_f64],
        ) {
            let shape = match kind {
                0 => Shape::Capsule { radius, half },
                1 => Shape::Cylinder { radius, half },
                _ => Shape::Box(Vector3::new(radius, half, radius)),
            };
            let own = solid(at, turn, shape);
            let board = solid([0.0; 3], lean, Shape::Box(Vector3::from(board)));
            let placed = DeflatedPart { solid: own, inner: inner(&own), reach: own.reach(), drift };
            let pad = clearance.max(MIN_CLEARANCE);
            let is_stuck = placed.touches(&board, [inner(&board), board.reach()], pad, drift);
            let is_apart = placed.is_apart(&board, board.reach(), pad, drift);
            // A turn about its centre and a shift that together stay within the drift.
            let [x, y, z] = shift;
            let along = Vector3::new(x, y, z + 1e-3).normalize();
            let axis = Vector3::new(y, z, x + 1e-3).normalize();
            let turned = UnitQuaternion::from_scaled_axis(axis * (share * drift / own.reach()).min(1.0));
            let about = Translation3::from(own.centre);
            let moved = Translation3::from(along * ((1.0 - share) * drift)) * about * turned
                * about.inverse();
            let moved = own.moved(&moved);
            prop_assert!(!is_stuck || moved.is_nearer(&board, pad));
            prop_assert!(!is_apart || moved.is_farther(&board, pad));
        }
    }
}
