//! Tests of the syntax stage at its public boundary, one module a subject.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::panic,
    reason = "a test fails by panicking"
)]

mod hostile;
mod json_form;
mod json_read;
mod messages;
mod read;
mod reply;
mod round_trip;
mod shapes;
