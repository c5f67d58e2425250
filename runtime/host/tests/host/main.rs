//! What surrounds the engine, from outside.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod conformance;
mod journal;
mod protocol;
mod remote;
mod robot_thread;
