//! A scripted server, and the room in which its replies are carried out.
#![allow(
    dead_code,
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::indexing_slicing,
    reason = "a test fails by panicking, and not every test uses all of this"
)]

pub(crate) mod server;
pub(crate) mod world;
