//! Robot cards: what a robot is, what it can do, what it can observe.

pub mod model;

pub use model::*;
