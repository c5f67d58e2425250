//! The execution graph: what the compiler makes of a policy, and all that a robot needs to run it.
//!
//! [`model`] is the graph in memory. It knows neither text nor compiler, and it trusts nothing: a graph that comes from
//! elsewhere is decoded ([`decode`]) and validated ([`validate()`]) before an engine takes it. [`draw`] shows it to people.

#[cfg(feature = "arbitrary")]
pub mod arbitrary;
pub mod draw;
pub mod encode;
pub mod model;
pub mod validate;

pub use encode::{DecodeError, GraphDocument, decode, encode, hash};
pub use model::*;
pub use validate::{InvalidGraph, InvalidReason, validate};
