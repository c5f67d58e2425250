//! Robot cards: what a robot is, what it can do, what it can observe.
//!
//! A card is a folder with a `robot.toml` ([`wire`]) and, where the robot's primitives differ from the standard ones, a
//! `primitives.motet`. [`read`] makes a [`Robot`] of it.

mod body;
mod draft;
mod embedded;
mod errors;
pub mod model;
mod quantity;
mod read;
mod resources;
mod shape;
mod spans;
pub mod wire;

pub(crate) use body::JointPosition;
pub use body::{ModelFile, fit, missing};
pub use draft::{DraftInputs, DraftStance, draft};
pub use embedded::{embedded, embedded_urdf};
pub use errors::CODES;
pub use model::*;
pub use read::read;
pub use spans::{BoundSpan, CardSpans};
pub use wire::schema;
