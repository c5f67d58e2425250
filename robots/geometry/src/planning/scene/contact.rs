//! What touches what: the robot itself, the things around, the floor. How that is found is in `around`.

use nalgebra::Vector3;
use smol_str::SmolStr;

use crate::collision::Solid;

/// Padding of every check: the least distance between any two bodies that may not touch, in m.
pub const MIN_CLEARANCE: f64 = 0.002;

/// What may touch what, beside what always may.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct AllowedCollisions {
    /// The hand may touch this entity: it is about to be grasped or has just been let go.
    pub hand: Option<usize>,
    /// What is in the hand may touch this entity: it stands on it.
    pub held: Option<usize>,
}

/// Two things that touch.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Contact {
    /// The robot's link; that of the hand for what is in it.
    pub link: SmolStr,
    /// What it touches: an entity, another link, or `floor`.
    pub other: SmolStr,
    /// Whether that is a part of the robot.
    pub is_own: bool,
}

/// What a pair of solids is looked at for.
#[derive(Clone, Copy)]
pub(crate) enum ContactTarget {
    Obstacle(usize),
    Part(usize),
    Floor,
}

/// Height of the lowest point of a solid above the floor, in m.
pub(crate) fn above_floor(solid: &Solid) -> f64 {
    solid.centre.z - solid.extent(&Vector3::z())
}
