//! Pairs of links of a robot that touch each other, for the person who writes its SRDF. Motions do not use
//! them: for a motion, one contact is enough.

use motet_geometry::planning::{Configuration, RobotModel};
use smol_str::SmolStr;

/// Greatest number of pairs that are listed.
const PAIRS: usize = 200;

/// Pairs of links that touch each other in a posture and may not.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Touching {
    pub pairs: Vec<[SmolStr; 2]>,
    /// Number of pairs beyond these.
    pub more: usize,
}

/// Finds all pairs of links that touch with the joints at some positions, and lists 200 at most. Not among
/// them are pairs that may touch: those that an SRDF allows, and those that touch in every posture.
/// O(parts²).
#[must_use]
pub fn touching(machine: &RobotModel, joints: &[f64]) -> Touching {
    let found = machine.own_contacts(&Configuration { base: [0.0; 3], joints: joints.to_vec() });
    let name = |link: usize| machine.tree().links().get(link).cloned().unwrap_or_default();
    let more = found.len().saturating_sub(PAIRS);
    Touching { pairs: found.into_iter().take(PAIRS).map(|pair| pair.map(name)).collect(), more }
}
