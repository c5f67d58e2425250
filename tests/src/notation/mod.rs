//! Readers of the grammars that are exported, and random derivations of what they say: written apart from
//! what prints them, so that the one is held against the other.

mod derive;
mod reader;
mod schema;

pub use derive::Deriver;
pub use reader::{Notation, read};
pub use schema::derive as derive_schema;
