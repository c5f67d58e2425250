//! Perception for the planner: detections in the scene, and image points of a model lifted into it.

mod ground;
mod pointing;
mod seen;

pub use ground::{NoPoint, Pointer, ground, lift, point};
pub use pointing::{Pointed, Pointing};
pub use seen::with_detections;
