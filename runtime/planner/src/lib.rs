//! From an instruction to a policy that is checked, run, and replaced when the world or the person wants
//! otherwise.
//!
//! [`builtin`] is the planner that needs no model: a small grammar of household requests gives goals, and a
//! search over the
//! contracts of the robot's primitives gives the calls that reach them. What it does not understand it says.
//!
//! [`conversation`] is the loop around a planner: it runs what is planned, asks where something goes wrong,
//! and plans anew.
//! [`model`] is the planner that asks a model, [`prompt`] what a model sees. [`dialect`] is another way to
//! write both down, as
//! one model was trained on it; [`vision`] is what is seen. [`guard`] checks in a run what the compiler
//! left to it.

pub mod builtin;

pub mod dialect;
pub mod dialogue;
pub mod model;
mod planner;
pub mod prompt;
pub mod runtime_check;
pub mod vision;

pub use planner::{Builtin, PlanRequest, Planner, RemainingSteps, Wait};
