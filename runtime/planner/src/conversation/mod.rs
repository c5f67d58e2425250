//! The loop: a request becomes a policy, the policy runs, and what goes wrong becomes a question whose answer goes into the
//! next policy, until it is done, given up or stopped. A new request may come at any time and takes over.
//!
//! Who plans is a [`Planner`], who answers a [`Person`], who looks on a [`Watcher`]; the robot is any
//! [`Driver`](motet_runtime::Driver). [`Conversation`] brings them together, and [`Known`] is what lasts from one policy to
//! the next.

mod answer;
mod first;
mod known;
mod live;
mod planner;
mod polarity;
mod problem;
mod pursuit;
mod sense;
mod talk;
mod watcher;

pub use answer::Answer;
pub use known::Known;
pub use planner::{Ask, Builtin, Planner, Rest, Wait};
pub(crate) use problem::called;
pub use problem::{Kind, Problem};
pub use talk::{Conversation, Outcome, Setting};
pub use watcher::{Nobody, Person, Scribe, Watcher};
