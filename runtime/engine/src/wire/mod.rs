//! What is written of a run, in a journal or to a driver: JSON forms of events, effects, records and all that they hold.
//!
//! These are types of their own, apart from the engine's, so that the engine may change without what is written. They are
//! lossless both ways, numbers that are not finite and ids included, and the same value gives the same bytes. Values are
//! those of the graph's own encoding. Times are whole nanoseconds since the run's origin, goals are their numbers, steps and
//! bindings are indices into the graph of the record's revision.

mod effect;
mod event;
mod query;
mod record;
mod snapshot;
mod start;

pub use effect::{Arg, Command, Effect, Fault, RunEnd, Start, Verify};
pub use event::{DriverEvent, Event, Outcome, Verification};
pub use motet_graph::encode::wire::{Document, Float, Value};
pub use query::{Answer, Pattern, Query};
pub use record::{Cause, Happening, NodeEnding, Record, Truth};
pub use snapshot::{LiveGoal, Named, Reading, Snapshot};
pub use start::{Capabilities, Entity, Fact, Primitives, Settings, StartState};

/// The version of these forms.
pub const VERSION: u32 = 1;

/// A value as compact JSON. Writing to memory fails for no value of these types.
pub(crate) fn json<T: serde::Serialize>(value: &T) -> String {
    serde_json::to_string(value).unwrap_or_default()
}
