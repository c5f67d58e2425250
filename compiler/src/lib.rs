//! The compiler of Motet: from a spanned AST to a checked execution graph.
//!
//! Stages, each a pure function of the one before: `resolve` (names and types), `check` (robot, resources,
//! bounds),
//! `prove` (state), `place` (geometry), `lower` (the graph). A stage returns what it could make and its
//! diagnostics; no
//! stage reads a file, a clock or the environment, and none panics on any input.

pub mod codes;
mod declare;
mod document;
mod environment;
mod explicit;
mod facts;
mod feasibility;
pub mod fix;
pub mod incremental;
mod ir;
mod limits;
mod lower;
pub mod plan;
mod prove;
mod repair;
mod resolve;
mod session;
pub mod signature;

pub use declare::{Library, LibraryBuilder, MAX_DECLARATIONS, MAX_FLUENT_PARAMS, MAX_RESOURCES};
pub use declare::{MAX_COUNT, MAX_SECONDS};
pub use document::{Compiled, DocumentCheck, PolicyOutcome};
pub use environment::{Environment, InitialState};
pub use explicit::make_explicit;
pub use feasibility::{Access, Forecast, Geometry, WorldTracker};
pub use ir::MAX_ENTITIES;
pub use prove::MAX_FIXPOINTS;
pub use resolve::MAX_NODES;
pub use session::{CheckOptions, InitialFact, Session, SessionBuilder};
pub use signature::Signatures;
