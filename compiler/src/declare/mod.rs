//! The declarations in force: kinds, fluents, measures, primitives with their contracts, and policies.
//!
//! A [`Library`] is built once from layers (standard library, robot, domains, document) and then only read.
//! The [`elaborator`](self::elaborator) gives terms and conditions their meaning and type; contracts need it
//! here, and the resolver of steps needs it again for the arguments of calls. Fed by the syntax front ends,
//! read by every stage.

pub(crate) mod arithmetic;
mod builder;
mod card;
pub(crate) mod condition;
mod contract;
pub(crate) mod diagnostics;
pub(crate) mod elaborator;
pub(crate) mod library;
pub(crate) mod list_term;
pub(crate) mod name;
pub(crate) mod notation;
mod pose;
pub(crate) mod unbound;
pub(crate) mod words;

pub use self::arithmetic::{MAX_COUNT, MAX_SECONDS};
pub use self::builder::{LibraryBuilder, MAX_DECLARATIONS, MAX_FLUENT_PARAMS};
pub(crate) use self::builder::{MAX_INITIALLY, MAX_PATTERNS};
pub use self::card::MAX_RESOURCES;
pub use self::library::Library;

pub(crate) use self::contract::resolve_type;
pub(crate) use self::library::{EffectDef, LastsDef, NeedDef, PerceptionLifetime, PrimitiveDef, ResourceSet};
