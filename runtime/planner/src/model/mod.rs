//! The planner that asks a model.
//!
//! A reply is read as it arrives: while it is written like the model surface, byte by byte, and else step by step; what
//! is wrong stops it there and goes back to the model with its own text. What a reply comes to is checked like any policy,
//! whatever the server was told to hold the model to. Nothing here opens a connection: a [`Model`] does.

mod chat;
mod judge;
mod later;
mod listen;
mod planner;
mod purpose;
mod reading;
mod scan;

pub use chat::{Finish, Message, Model, ModelError, News, Reply, Role};
pub use judge::{Judged, judge};
pub use later::without_first_step;
pub use listen::{Happening, Listener};
pub use planner::{ModelPlanner, Settings, Start, chat};
pub use reading::{Reading, Verdict, Wrong};
