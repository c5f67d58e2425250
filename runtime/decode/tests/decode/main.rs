//! Tests of the acceptor against the checker, against an engine that knows the exported grammar only, and
//! of the readers of vocabularies.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::print_stdout,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::disallowed_methods,
    reason = "a test fails by panicking, and prints what it counted"
)]

mod acceptor;
mod common;
mod constructs;
mod engine;
mod scopes;
mod vocabulary;
