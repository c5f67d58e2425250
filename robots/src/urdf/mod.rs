//! URDF: from text to a sound tree of links and joints, with diagnostics.
//!
//! The reader takes its numbers from the parse that it checks, so the checked values are the used ones. It
//! reads what kinematics and collision checking need: links with their shapes, joints with origin, axis,
//! limits and mimic rule. It skips inertia, materials, transmissions and simulator extensions. It opens no
//! file: a mesh is a name until [`crate::mesh::attach`] reads it.
//!
//! ```
//! use motet_robots::{builtin, urdf};
//! use motet_syntax::{FileId, Source};
//!
//! let text = builtin::robot_texts("panda").unwrap().urdf;
//! let (robot, diagnostics) = urdf::read(&Source::new("robot.urdf", text), FileId(0));
//! assert!(diagnostics.is_empty());
//! assert!(robot.unwrap().joint("panda_joint1").is_some());
//! ```

mod diagnostics;
mod document;
mod element;
pub mod model;
mod read;
mod surplus;
mod tree;

pub use diagnostics::CODES;
pub(crate) use diagnostics::{BadNumber, ImpossibleNumber, XmlDialect, XmlPart};
pub(crate) use document::{XmlDocument, XmlSpans, child, children, from_rpy, is_own, numbers};
pub use model::*;
pub use read::read;
pub(crate) use surplus::unknown;
