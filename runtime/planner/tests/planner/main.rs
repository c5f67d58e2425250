//! The planner from outside: feasibility in prompts, and motions that are verified during a run.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic, reason = "a test fails by panicking")]

mod common;
mod feasible;
mod runtime_check;
