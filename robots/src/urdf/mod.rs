//! Robot descriptions in URDF: from the text to a tree of links and joints that is sound, or to what is wrong with it.
//!
//! The reader takes its numbers from the same parse that it checks, so what was checked is what is used. It reads what
//! kinematics and collision need: links with their shapes, joints with their origin, axis, limits and mimic rule.
//! Inertia, materials, transmissions and simulator extensions are passed over. No file is opened: a mesh is a name
//! until [`crate::mesh::attach`] reads it.

mod document;
mod errors;
mod joint;
pub mod model;
mod number;
mod read;
mod shape;
mod surplus;
mod tree;

pub use errors::CODES;
pub use model::*;
pub use read::read;

pub(crate) use document::{XmlDialect, XmlDocument, XmlSpans, children, is_own};
pub(crate) use surplus::unknown;
