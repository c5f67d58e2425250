//! The declarations in force, resolved once: kinds, fluents, primitives with their contracts. Fed by the text front end,
//! read by every stage.

mod build;
mod card;
mod contract;
pub(crate) mod errors;
mod layer;
pub(crate) mod model;
mod robot;

pub use build::{LibraryBuilder, MAX_DECLARATIONS, MAX_FLUENT_PARAMS};
pub use model::Library;
pub(crate) use model::ResourceSet;
pub use robot::MAX_RESOURCES;

pub(crate) use contract::resolve_type;
pub(crate) use model::{EffectDef, NeedDef, PrimitiveDef};
