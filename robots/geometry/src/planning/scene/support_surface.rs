//! Support surface: the flat face on which an object is put.

use nalgebra::Isometry3;

/// Height above the surface at which an object is released, in m.
pub(crate) const ABOVE: f64 = 0.004;

/// Flat rectangle or disc that supports objects.
pub(crate) struct SupportSurface {
    /// Pose of the middle of its upper face.
    pub(crate) map_from_face: Isometry3<f64>,
    pub(crate) half: [f64; 2],
    /// Height of the walls around it, in m: objects come in from above them.
    pub(crate) walls: f64,
    pub(crate) is_disc: bool,
}

impl SupportSurface {
    /// Point of the rim at a share of its length, in units of half the sides.
    pub(crate) fn rim(&self, around: f64) -> [f64; 2] {
        if self.is_disc {
            let (sin, cos) = libm::sincos(std::f64::consts::TAU * around);
            return [cos, sin];
        }
        // Equal spacing on long and short sides.
        let [wide, deep] = self.half;
        // The rim is a single point.
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
