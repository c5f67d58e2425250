//! The command from outside: the built binary is run as a user runs it. One program, so that it is linked
//! once.

#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::print_stdout,
    clippy::string_slice,
    clippy::unwrap_used,
    reason = "a test fails by panicking, and prints why it is skipped"
)]

mod check;
mod commands;
mod crash;
mod dataset;
mod decode;
mod dialog;
mod driver;
mod fmt;
mod grammar;
mod hostile;
mod import;
mod journal;
mod many;
mod mcp;
mod model;
mod robots;
mod run;
mod serve;
mod support;
mod talk;
mod trees;
