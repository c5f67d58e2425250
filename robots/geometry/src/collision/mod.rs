//! What touches what, in `f64`: solids and the distance between two, and the solids of a robot.

mod collision_model;
mod distance;
mod link_solid;
mod outline;
mod simplex;
mod solid;

pub use collision_model::{CollisionModel, NearestPair};
pub use link_solid::LinkSolid;
pub use solid::{Shape, Solid};
