//! The execution graph: what the compiler makes of a policy, and all that a robot needs to run it.
//!
//! [`model`] is the graph in memory. It knows neither text nor compiler, and it trusts nothing: a graph that comes from
//! elsewhere is decoded and validated before an engine takes it.

mod display;
pub mod model;

pub use model::*;

mod fit;
pub mod validate;

pub use validate::{Invalid, validate};
