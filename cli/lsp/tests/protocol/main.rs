//! The server over its protocol, with a client of its own.

mod client;
mod diagnostics;
mod features;
mod session;
