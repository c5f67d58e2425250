//! The engine from outside: scripted runs with their effects as snapshots, random runs against the laws, wire
//! forms, journal and memory.

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
mod journal;
mod memory;
mod monitors;
mod naive;
mod python;
mod random;
mod ready;
mod rescan;
mod script;
mod snapshot;
mod swap;
mod threads;
mod verify;
mod wire;
