//! Tests of kinematics, collision checking, laws of `reach`, and motion queries.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::unreachable,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    clippy::print_stdout,
    clippy::print_stderr,
    missing_docs,
    reason = "a test fails by panicking"
)]

mod collision;
mod forward;
mod inverse;
mod planning;
mod properties;
