//! The loop: a request becomes a policy, the policy runs, and what goes wrong becomes a question whose
//! answer goes into the
//! next policy, until it is done, given up or stopped. A new request may come at any time and takes over.
//!
//! Who plans is a [`Planner`], who answers a [`Person`], who looks on a [`Watcher`]; the robot is any
//! [`Driver`](motet_runtime::Driver). [`Conversation`] brings them together, and [`Known`] is what lasts
//! from one policy to
//! the next.

mod answer;
mod conversation;
mod early_start;
mod knowledge;
mod live_run;
mod manager;
mod observer;
mod polarity;
mod problem;
mod proprioception;

pub use answer::Answer;
pub use conversation::{Conversation, DialogueSetup, Outcome};
pub use knowledge::Knowledge;
pub use observer::{DialogueObserver, NoOperator, Person, RunRecorder};
pub(crate) use problem::called;
pub use problem::{Kind, Problem};
