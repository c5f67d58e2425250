//! The client against a scripted server, up to what the robot does with the replies.

#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::indexing_slicing,
    reason = "a test fails by panicking"
)]

mod cleanup;
mod dialects;
mod flood;
mod kitchen;
mod planner;
mod pointing;
mod replies;
mod server;
mod vision;
