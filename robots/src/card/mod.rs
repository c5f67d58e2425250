//! Robot cards: the base, hands, cameras, resources and primitives of a robot.
//!
//! A card is a folder with a `robot.toml` and, if the primitives of the robot differ from the standard ones,
//! a `primitives.motet`. [`read`] makes a [`Robot`] of it; [`fit`] checks it against a URDF; [`draft`] writes
//! a first card for a URDF.

mod body;
mod diagnostics;
mod draft;
mod draft_parts;
pub mod model;
mod other_arms;
mod quantity;
mod read;
mod shape;
pub mod wire;

pub(crate) use body::JointPosition;
pub use body::{ModelFile, fit, missing};
pub use diagnostics::CODES;
pub use draft::{DraftInputs, DraftStance, draft};
pub use model::{BoundSpan, CardSpans, *};
pub use other_arms::other_arms;
pub use read::read;
pub use wire::schema;
