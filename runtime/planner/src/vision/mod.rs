//! What is seen, for who plans: detections taken into the scene, and points of an image that a model gives lifted into it.

mod ground;
mod pointing;
mod seen;

pub use ground::{NoPoint, Pointer, ground, lift, point};
pub use pointing::{Pointed, Pointing};
pub use seen::with_detections;
