//! Tests across crates, in one binary.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::string_slice,
    clippy::print_stdout,
    reason = "a test fails by panicking"
)]

mod advice;
mod canonical;
mod conversation;
mod corpus;
mod dialect;
mod during_motion;
mod dynamic;
mod engines;
mod explanation;
mod fault_classes;
mod fix;
mod formats;
mod forms;
mod grammars;
mod hostile;
mod library;
mod manners;
mod names;
mod notations;
mod oracle;
mod outcomes;
mod pddl;
mod perceived;
mod physics;
mod places;
mod planning;
mod promises;
mod prompt;
mod proofs;
mod quantified;
mod recovery;
mod replies;
mod request;
mod scopes;
mod soundness;
mod spec;
mod speech;
mod values;
mod vision;
