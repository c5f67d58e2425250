//! The engine that runs execution graphs: `(graph, state, event) -> effects`, without a clock, without input or output.
//!
//! An [`Event`] goes into the [`Engine`], [`Effect`]s come out. A host passes them to a [`Driver`] and feeds back what it
//! reports; [`run`] is such a host, for any driver whose time is not the wall clock's as well as for those whose is.
//!
//! ```
//! use motet_graph::{Bounds, Ending, Graph, Node, NodeKind, Region, ROOT};
//! use motet_runtime::{Effect, Engine, Event, StartState, Time};
//!
//! // A policy of one step, `done`.
//! let graph = Graph {
//!     policy: "nothing".into(),
//!     robot: "".into(),
//!     kinds: vec![], fluents: vec![], measures: vec![], primitives: vec![], resources: vec![], bindings: vec![],
//!     failures: vec!["timeout".into()],
//!     nodes: vec![Node {
//!         path: "/steps/0".into(),
//!         region: ROOT,
//!         next: None,
//!         duration: Bounds::default(),
//!         kind: NodeKind::End { how: Ending::Done, of: None, why: None },
//!     }],
//!     regions: vec![Region { owner: None, entry: Some(motet_graph::NodeId(0)) }],
//!     initial: vec![],
//!     observe_within_secs: 0.5,
//!     duration: Bounds::default(),
//! };
//! let mut engine = Engine::new(graph, &StartState::default())?;
//! let mut effects = Vec::new();
//! engine.handle(Time::ZERO, Event::Begin, &mut effects);
//! assert!(matches!(effects.last(), Some(Effect::Finished(_))));
//! # Ok::<(), Vec<motet_graph::InvalidGraph>>(())
//! ```
//!
//! Inside: `plan` is the graph made ready once; `state` is all that changes, in flat tables; `turn` makes the transitions
//! that one event enables; `belief` is what the engine believes of the world. Only `turn` changes the state.

mod belief;
pub mod conformance;
mod describe;
mod driver;
mod effect;
mod engine;
mod event;
mod flat_table;
mod goal_table;
mod ids;
pub mod journal;
mod json;
pub mod memory;
mod orphan;
mod perception;
mod prepared_graph;
mod query;
mod rows;
mod run_loop;
mod settings;
mod snapshot;
mod start;
mod state;
mod swap;
mod time;
mod timers;
mod trace;
mod truth;
mod turn;
mod verifier;
mod work_list;

pub use driver::{Capabilities, Driver, PrimitiveSet};
pub use effect::{Command, Effect, Fault, RunEnd};
pub use engine::Engine;
pub use event::{DriverEvent, Event, Outcome};
pub use ids::{CheckId, GoalId};
pub use perception::{CameraImage, CameraModel, DepthImage, Detection, Perception, RgbdView};
pub use query::{Answer, Pattern, Query};
pub use run_loop::{Observer, RunControl, resume, run};
pub use settings::EngineSettings;
pub use snapshot::{LiveGoal, Reading, Snapshot};
pub use start::StartState;
pub use swap::{PreparedSwap, RetiredGraph, RunningGraph, SwapRefusal};
pub use time::Time;
pub use trace::{EndCause, NodeEnding, TraceEvent, TraceEventKind};
pub use truth::Truth;
pub use verifier::{DeferredMotion, Verification, Verifier};
