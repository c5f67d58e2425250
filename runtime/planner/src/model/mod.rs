//! The planner that asks a language model.
//!
//! It reads a reply as it arrives: byte by byte while the reply stays in the canonical subset, and otherwise
//! step by step. The first error stops the reply, which goes back to the model with its diagnostics. The
//! final policy is checked like any other, whatever constraint the server enforces. A [`Model`] opens the
//! connections; this module opens none.

mod background;
mod chat;
mod planner;
mod reply_verdict;
mod stream_reader;

pub use background::without_first_step;
pub use chat::{Finish, Message, Model, ModelError, News, Reply, Role};
pub use chat::{ModelEvent, ModelObserver};
pub use planner::{ModelPlanner, Settings, Start, chat};
pub use reply_verdict::{ReplyVerdict, judge};
pub use stream_reader::{StreamReader, StreamVerdict, Wrong};
