//! How far what a frame carries can be from where it is in the middle of a cell.

use nalgebra::Vector3;

use crate::collision::{Shape, Solid};

/// A frame goes by no more than this: it turns about a point and is shifted, and turns about an axis; in any order where the point
/// is on the axis, else the axis last.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Drift {
    /// In m.
    pub(crate) shift: f64,
    /// In rad about any axis through a point, in the map.
    pub(crate) turn: f64,
    pub(crate) about: Vector3<f64>,
    /// In rad about one direction through another point.
    pub(crate) spin: f64,
    pub(crate) axis: Vector3<f64>,
    pub(crate) at: Vector3<f64>,
}

impl Drift {
    /// What does not move.
    pub(crate) fn none() -> Self {
        let (zero, axis) = (Vector3::zeros(), Vector3::z());
        Self { shift: 0.0, turn: 0.0, about: zero, spin: 0.0, axis, at: zero }
    }

    /// What turns about the vertical through a point.
    pub(crate) fn upright(at: Vector3<f64>, spin: f64) -> Self {
        Self { spin, at, ..Self::none() }
    }

    /// The same, and shifted by so much more before.
    pub(crate) fn shifted(self, more: f64) -> Self {
        Self { shift: self.shift + more, ..self }
    }

    /// The same, with a turn about a point before.
    pub(crate) fn turned(self, about: Vector3<f64>, turn: f64) -> Self {
        Self { turn, about, ..self }
    }

    /// How far a solid goes at most, in m: the axis of a capsule, whose rim goes along however it turns, and every point of
    /// anything else.
    pub(crate) fn of(&self, solid: &Solid) -> f64 {
        let [x, y, z] = &solid.axes;
        match solid.shape {
            Shape::Capsule { half, .. } => self.ends(solid, z * half, 0.0),
            Shape::Cylinder { radius, half } => {
                // About its own direction it turns into itself.
                let is_along = self.turn == 0.0 && z.cross(&self.axis).norm_squared() < 1e-18;
                self.ends(solid, z * half, if is_along { 0.0 } else { radius })
            }
            Shape::Box(half) => {
                let (x, y, z) = (x * half.x, y * half.y, z * half.z);
                [x + y, x - y].into_iter().fold(0.0_f64, |most, side| {
                    most.max(self.ends(solid, side + z, 0.0)).max(self.ends(solid, side - z, 0.0))
                })
            }
            Shape::HalfSpace => f64::INFINITY,
        }
    }

    /// The same for what is within `rim` of a line from `half` before the centre of a solid to `half` after it.
    fn ends(&self, solid: &Solid, half: Vector3<f64>, rim: f64) -> f64 {
        self.point(&(solid.centre + half), rim).max(self.point(&(solid.centre - half), rim))
    }

    /// The same for what is within `rim` of a point.
    pub(crate) fn point(&self, point: &Vector3<f64>, rim: f64) -> f64 {
        // A chord is no longer than its arc, nor than twice the radius.
        let turned = self.turn.min(2.0) * ((point - self.about).norm() + rim) + self.shift;
        let off = point - self.at;
        let aside = (off - self.axis * off.dot(&self.axis)).norm();
        turned + self.spin.min(2.0) * (aside + rim + turned)
    }
}
