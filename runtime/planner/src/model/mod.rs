//! The planner that asks a model.
//!
//! A reply is read as it arrives: while it is written like the model surface, byte by byte, and else step
//! by step; what
//! is wrong stops it there and goes back to the model with its own text. What a reply comes to is checked
//! like any policy,
//! whatever the server was told to hold the model to. Nothing here opens a connection: a [`Model`] does.

mod background;
mod chat;
mod goal_check;
mod observer;
mod planner;
mod reply_verdict;
mod scanner;
mod stream_reader;

pub use background::without_first_step;
pub use chat::{Finish, Message, Model, ModelError, News, Reply, Role};
pub use observer::{ModelEvent, ModelObserver};
pub use planner::{ModelPlanner, Settings, Start, chat};
pub use reply_verdict::{ReplyVerdict, judge};
pub use stream_reader::{StreamReader, StreamVerdict, Wrong};
