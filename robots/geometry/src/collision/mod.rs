//! How far a capsule is from another shape: exact, in `f64`. A robot's parts are capsules here, obstacles keep their shapes.

mod distance;

pub use distance::{Capsule, Obstacle, ObstacleShape};
