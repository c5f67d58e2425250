//! Journals as MCAP files, which the tools of roboticists open: events, effects, graphs and states as JSON
//! messages with their schemas, and where a simulated world is known, its transforms and its scene as
//! Foxglove's messages.

mod export;
mod foxglove;

pub use export::{ExportError, McapExporter, McapLimits};
pub use foxglove::{McapBody, McapScene, McapSolid};
