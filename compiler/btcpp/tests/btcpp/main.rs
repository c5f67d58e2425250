//! Tests of behaviour trees at the public boundary.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod export;
mod import;
mod peer;
mod round_trip;
mod sketch;
