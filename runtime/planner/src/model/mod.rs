//! The planner that asks a language model.
//!
//! It reads a reply to the end of its policy and checks it like any other, whatever constraint the server
//! enforces. A wrong reply goes back to the model whole, with all its errors. A reply without a policy that
//! asks or refuses is for the person. If the first step may start early, the reply is followed as it arrives:
//! byte by byte while it stays in the canonical subset, and otherwise step by step. A [`Model`] opens the
//! connections; this module opens none.

mod background;
mod chat;
mod planner;
mod prose;
mod stream_reader;

pub use crate::reply_verdict::{ReplyVerdict, judge};
pub use background::without_first_step;
pub use chat::{Finish, Message, Model, ModelError, Reply, ReplyEvent, Role};
pub use chat::{ModelEvent, ModelObserver, TokenUsage};
pub use planner::{ChatContext, ModelPlanner, ReadTo, Settings, Start, chat, chat_with};
pub use stream_reader::{ReplyMistake, StreamReader, StreamVerdict};
