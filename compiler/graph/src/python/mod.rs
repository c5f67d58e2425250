//! Graphs as Python scripts, for people who read and change them: the steps as Python statements, against the
//! class `Driver` of the Python package `motet`.
//!
//! A script makes the same calls as the engine. It does one thing at a time: what runs beside something else
//! has no place in it ([`Unsayable`]). The same graph gives the same text.

mod contract;
mod step;
mod term;
mod writer;

pub use step::{Unsayable, script};
pub use writer::identifier;
