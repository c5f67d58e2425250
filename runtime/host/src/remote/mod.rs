//! Drivers in another process, over the driver protocol: JSON-RPC 2.0, a message a line, over standard input
//! and output or a TCP connection of this machine. `docs/drivers.md` tells it with an example session.
//!
//! [`protocol`] is what is said, `link` how lines come and go, [`RemoteDriver`] the driver that the engine's
//! host sees. A goal's number makes every command idempotent: to say it again does nothing new. So an answer
//! that never comes means unknown, never refused: a start is said again once, and then its goal is lost.

mod connect;
mod driver;
mod link;
pub mod protocol;
mod rate;

pub use connect::{DriverAddress, DriverAddressError};
pub use driver::{DriverLog, LineFrom, RemoteDriver};
pub use link::{ErrorOutput, LinkError};
pub use protocol::DriverTimeouts;
