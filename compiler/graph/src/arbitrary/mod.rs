//! Random valid graphs over a small vocabulary, for property tests here and in the crates that run or write
//! graphs.
//!
//! [`vocabulary`] declares kinds, fluents, measures and primitives; a [`StepSketch`] is a step as a tree;
//! [`graph`] lays such trees out as a graph that always validates; [`graphs`] draws them at random. Tests
//! that need a certain graph write the tree down themselves.

mod layout;
mod sketch;
mod strategy;
pub mod vocabulary;

pub use layout::graph;
pub use sketch::{CallSketch, ReactionSketch, StepSketch, WatchSketch};
pub use strategy::{conditions, graphs, steps};
