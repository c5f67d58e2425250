#![doc = include_str!("../README.md")]

mod analysis;
mod declare;
mod document;
mod environment;
pub mod explain_pages;
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
mod signature_leaves;
mod syntax_conversion;

pub use declare::{
    Library, LibraryBuilder, MAX_COUNT, MAX_DECLARATIONS, MAX_FLUENT_PARAMS, MAX_RESOURCES, MAX_SECONDS,
};
pub use document::{Compiled, DocumentCheck, PolicyOutcome};
pub use environment::{Environment, FactLifetime, InitialState};
pub use feasibility::{Access, Forecast, Geometry, WorldTracker};
pub use ir::MAX_ENTITIES;
pub use lower::{CallInspection, MotionInspection, StepInspection};
pub use prove::MAX_FIXPOINTS;
pub use resolve::MAX_NODES;
pub use session::{CheckOptions, InitialFact, Session, SessionBuilder};
pub use signature::Signatures;
pub use syntax_conversion::make_explicit;
