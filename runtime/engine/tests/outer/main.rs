//! What lies around the engine and does no input or output: wire forms, journal and memory.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod journal;
mod memory;
mod ready;
mod wire;
