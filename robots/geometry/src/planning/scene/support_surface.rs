//! Support surface: the flat face on which an object can be put.

use nalgebra::Isometry3;

/// How far above its support a thing is let go, in m.
pub(crate) const ABOVE: f64 = 0.004;

/// A flat rectangle or disc on which things can stand.
pub(crate) struct SupportSurface {
    /// The middle of its upper face, with its directions.
    pub(crate) map_from_face: Isometry3<f64>,
    pub(crate) half: [f64; 2],
    /// How high the walls around it are, in m: what is put there comes from above them.
    pub(crate) walls: f64,
    pub(crate) is_disc: bool,
}

impl SupportSurface {
    /// A place on the rim, so far around it of 1, in parts of half its sides.
    pub(crate) fn rim(&self, around: f64) -> [f64; 2] {
        if self.is_disc {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * around);
            return [cos, sin];
        }
        // As far from one place to the next on a long side as on a short one.
        let [wide, deep] = self.half;
        // No rim but one place.
        if wide + deep <= 0.0 {
            return [0.0; 2];
        }
        let gone = around * 2.0 * (wide + deep);
        if gone < wide {
            [2.0 * gone / wide - 1.0, -1.0]
        } else if gone < wide + deep {
            [1.0, 2.0 * (gone - wide) / deep - 1.0]
        } else if gone < 2.0 * wide + deep {
            [1.0 - 2.0 * (gone - wide - deep) / wide, 1.0]
        } else {
            [-1.0, 1.0 - 2.0 * (gone - 2.0 * wide - deep) / deep]
        }
    }
}
