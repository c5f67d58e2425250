//! The compiler of Motet: from a spanned AST to a checked execution graph.
//!
//! Stages, each a pure function of the one before: `resolve` (names and types), `check` (robot, resources, bounds),
//! `prove` (state), `place` (geometry), `lower` (the graph). A stage returns what it could make and its diagnostics; no
//! stage reads a file, a clock or the environment, and none panics on any input.

mod check;
pub mod codes;
pub mod draft;
pub mod fix;
mod ir;
mod library;
mod lower;
mod place;
pub mod plan;
mod prove;
mod resolve;
mod session;
mod settle;
pub mod signature;
mod world;

pub use library::{Library, LibraryBuilder, MAX_DECLARATIONS, MAX_FLUENT_PARAMS, MAX_RESOURCES};
pub use place::{Access, Course, Geometry, Prospect};
pub use prove::MAX_FIXPOINTS;
pub use resolve::{MAX_COUNT, MAX_NODES, MAX_SECONDS};
pub use session::{Compiled, Given, Options, Session};
pub use settle::settle;
pub use signature::Signatures;
pub use world::{MAX_ENTITIES, State, World};
