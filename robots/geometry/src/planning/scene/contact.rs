//! Contacts and the pairs of bodies that may be in contact. The collision checker finds them.

use nalgebra::Vector3;
use smol_str::SmolStr;

use crate::collision::Solid;

/// Padding of every check: the least distance between any two bodies that may not touch, in m.
pub const MIN_CLEARANCE: f64 = 0.002;

/// Pairs that may be in contact, besides those that always may.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct AllowedCollisions {
    /// Index of the entity that the hand may touch: the one about to be grasped or just released.
    pub hand: Option<usize>,
    /// Index of the entity that the held object may touch: the one on which it stands.
    pub held: Option<usize>,
}

/// Contact between two bodies: they are closer than [`MIN_CLEARANCE`].
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Contact {
    /// Link of the robot; the link of the hand for the held object.
    pub link: SmolStr,
    /// Name of the other body: an entity, another link, or `floor`.
    pub other: SmolStr,
    /// Set where the other body is a part of the robot.
    pub is_own: bool,
}

/// Other body of a checked pair.
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
