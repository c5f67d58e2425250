//! Helpers of the tests: adapters that turn other people's data into ordinary policies and scenes, helpers
//! that run them through every stage, and an interpreter that the prover is held against. No verdict of the
//! compiler is made here.

pub mod examples;
pub mod generate;
pub mod notation;
pub mod oracle;

pub use motet_eval::setup;
