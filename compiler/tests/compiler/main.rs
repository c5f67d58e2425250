//! Tests of the compiler at its public boundary.
//!
//! The prover is guarded by `tests/spec/prover.md`, lints by `tests/spec/intent.md`, fixes by
//! `tests/tests/fix.rs`, plans by
//! `tests/tests/planning.rs`, and incremental checks by the properties of `runtime/decode`.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    clippy::print_stderr,
    missing_docs,
    reason = "a test fails by panicking"
)]

mod explain;
mod feasibility;
mod session;
