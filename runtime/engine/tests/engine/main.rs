//! The engine from outside: scripted runs with their effects as snapshots, and random runs against the laws.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod calls;
mod control;
mod host;
mod monitors;
mod naive;
mod random;
mod rescan;
mod script;
mod snapshot;
mod swap;
mod threads;
mod verify;
