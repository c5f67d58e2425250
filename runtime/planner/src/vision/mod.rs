//! Perception for the planner: detections as things of the scene, and image points of a model lifted into it.

mod ground;
mod grounding_driver;
mod sightings;

pub use ground::{NoPoint, Pointer, Purpose, ground, lift, point};
pub use grounding_driver::{GroundedPoint, GroundingDriver, GroundingTask};
pub use sightings::{Sightings, lies_on_floor};
