//! Tests of the C interface: its errors, its header, and the example in C.

#![allow(
    clippy::unwrap_used,
    clippy::undocumented_unsafe_blocks,
    clippy::indexing_slicing,
    clippy::disallowed_methods,
    clippy::print_stdout,
    reason = "a test fails by panicking; it keeps what the functions ask for"
)]

mod border;
mod example;
mod header;
