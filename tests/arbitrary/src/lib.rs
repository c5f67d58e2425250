//! Random graphs and syntax trees, for the property tests of the crates that read, run or write them.

pub mod graph;
pub mod syntax;
