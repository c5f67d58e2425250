//! Scenes: the room, what stands in it, where the robot is at the start.

pub mod model;

pub use model::*;
