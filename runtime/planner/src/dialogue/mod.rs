//! The dialogue: a request becomes a policy, the policy runs, and a problem becomes a question whose answer
//! goes into the next policy, until the request is done, given up or stopped. A new request may come at any
//! time and takes over.
//!
//! [`Conversation`] connects a [`Planner`](crate::Planner), a [`Person`] who answers, a [`DialogueObserver`]
//! and a [`Driver`](motet_runtime::Driver). [`Knowledge`] lasts from one policy to the next.

mod answer;
mod conversation;
mod early_start;
mod interjection;
mod knowledge;
mod live_run;
mod manager;
mod problem;
mod reason;
mod reply;
mod senses;
mod sight;
mod world;

pub use answer::Answer;
pub use conversation::{Conversation, DialogueSetup, OnInstruction, Outcome};
pub use conversation::{DialogueObserver, NoOperator, Person, RunRecorder};
pub use knowledge::Knowledge;
pub use problem::{Kind, Problem};
