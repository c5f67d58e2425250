//! Clearance: the distance that a robot keeps from obstacles besides not touching them. A card gives it or
//! the errors that it follows from; a scene and a command may override it.

use serde::{Deserialize, Serialize};

/// Greatest clearance that may be asked for, in m: more would keep most robots out of most rooms.
pub const GREATEST_CLEARANCE: f64 = 0.5;

/// Distances in m, from 0 to [`GREATEST_CLEARANCE`], that two groups of a robot's parts keep from obstacles.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Clearance {
    /// Distance of every part that the arm does not move.
    pub base_m: f64,
    /// Distance of the arm, the hand and the held object.
    pub arm_m: f64,
}

/// Clearance of which a part may be left open.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClearanceOverride {
    /// Distance of the base, if it is given.
    #[serde(default, rename = "base")]
    pub base_m: Option<f64>,
    /// Distance of the arm, if it is given.
    #[serde(default, rename = "arm")]
    pub arm_m: Option<f64>,
}

impl ClearanceOverride {
    /// Clearance with the open parts from another one.
    ///
    /// ```
    /// use motet_robots::clearance::{Clearance, ClearanceOverride};
    ///
    /// let of_card = Clearance { base_m: 0.05, arm_m: 0.01 };
    /// let of_scene = ClearanceOverride { base_m: Some(0.02), arm_m: None };
    /// assert_eq!(of_scene.over(of_card), Clearance { base_m: 0.02, arm_m: 0.01 });
    /// ```
    #[must_use]
    pub fn over(self, other: Clearance) -> Clearance {
        Clearance { base_m: self.base_m.unwrap_or(other.base_m), arm_m: self.arm_m.unwrap_or(other.arm_m) }
    }

    /// Override with the open parts from another one.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self { base_m: self.base_m.or(other.base_m), arm_m: self.arm_m.or(other.arm_m) }
    }

    /// Checks whether both parts are open.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}
