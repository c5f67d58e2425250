//! Tests of the execution graph at its public boundary.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod decode;
mod draw;
mod properties;
mod validate;
