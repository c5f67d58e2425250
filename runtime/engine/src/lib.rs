//! The engine that runs execution graphs: `(graph, state, event) -> effects`, without a clock, without input or output.
//!
//! An event goes in, effects come out. A host passes the effects to a [`Driver`] and feeds back what it reports.

mod driver;
mod effect;
mod event;
mod goals;
mod query;
mod record;
mod time;
mod truth;

pub use driver::Driver;
pub use effect::{Command, Effect, Fault, RunEnd};
pub use event::{DriverEvent, Event, GoalId, Outcome};
pub use query::{Answer, Pattern, Query};
pub use record::{Cause, Happening, NodeEnding, Record};
pub use time::Time;
pub use truth::Truth;
