//! Perception for the planner: detections in the scene, and image points of a model lifted into it.

mod detections;
mod ground;
mod grounding_driver;

pub use detections::with_detections;
pub use ground::{NoPoint, Pointer, ground, lift, point};
pub use grounding_driver::{GroundedPoint, GroundingDriver};
