//! The engine that runs execution graphs: `(graph, state, event) -> effects`, without a clock, without input or output.
//!
//! An [`Event`] goes into the [`Engine`], [`Effect`]s come out. A host passes them to a [`Driver`] and feeds back what it
//! reports; [`run`] is such a host, for any driver whose time is not the wall clock's as well as for those whose is.
//!
//! Inside: `plan` is the graph made ready once; `state` is all that changes, in flat tables; `turn` makes the transitions
//! that one event enables; `belief` is what the engine believes of the world. Only `turn` changes the state.

mod belief;
mod describe;
mod driver;
mod effect;
mod engine;
mod event;
mod goals;
mod host;
mod plan;
mod query;
mod record;
mod settings;
mod start;
mod state;
mod table;
mod time;
mod timers;
mod truth;
mod turn;
mod verifier;
mod work;

pub use driver::Driver;
pub use effect::{Command, Effect, Fault, RunEnd};
pub use engine::Engine;
pub use event::{DriverEvent, Event, GoalId, Outcome};
pub use host::{Control, Onlooker, run};
pub use query::{Answer, Pattern, Query};
pub use record::{Cause, Happening, NodeEnding, Record};
pub use settings::Settings;
pub use start::StartState;
pub use time::Time;
pub use truth::Truth;
pub use verifier::{LeaveToDriver, Verification, Verifier};
