//! Collision checking in `f64`: solids, the distance between two, and the collision model of a robot.

mod collision_model;
mod distance;
mod solid;

pub use collision_model::{CollisionModel, LinkSolid, NearestPair};
pub use solid::{Shape, Solid};
