#![doc = include_str!("../README.md")]

mod background_work;
pub mod builtin;
pub mod dialogue;
pub mod inteliplan;
pub mod model;
mod named_step;
mod planned;
mod planner;
pub mod prompt;
mod reply_verdict;
pub mod runtime_check;
pub mod vision;

pub use background_work::{CHECK_WITHIN, READ_WITHIN};
pub use planner::{BackgroundBuiltin, Builtin, PlanRequest, Planner, RemainingSteps, Wait};
