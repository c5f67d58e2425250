//! The evaluations themselves, and a few trials of each.

#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::print_stdout,
    reason = "a test fails by panicking"
)]

mod actions;
mod dialogue;
mod dynamic;
mod mended;
mod mutations;
mod planbench;
mod saycan;
mod scenarios;
mod soundness;
mod tasks;
mod world;
