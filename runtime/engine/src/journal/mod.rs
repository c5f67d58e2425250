//! The journal: everything that an engine took in and gave out, a line each, from which a run can be
//! replayed.
//!
//! A line is the CRC-32 (IEEE 802.3) of its JSON as eight hexadecimal digits, a blank, the JSON, and a line
//! feed. The JSON holds the line's sequence number, the hash of the line before, and an [`JournalEntry`]:
//! first the [`JournalHead`] with all that the engine was made from, then one entry for each thing that
//! happened together with the effects that followed from it. The CRC tells a line that was not written to its
//! end, the chain of hashes a line that is missing or was changed.
//!
//! Here are the lines, their chain, their reading and the replay; all of it is pure. Files, segments and when
//! they are synced are the host's affair. An entry has to be on disk before its effects are carried out where
//! [`must_be_durable`] says so; then a crash loses nothing that anybody acted on.

mod entry;
mod line;
mod read;
mod replay;

pub use entry::{JournalEntry, JournalHead, ResumeEntry, StepEntry, SwapEntry};
pub use line::{LineChain, LineError, decode};
pub use read::{DamageKind, JournalDamage, JournalReader, OpenGoal, OpenGoals, SegmentEnd, SegmentPosition};
pub use replay::{DriverReplay, EffectMismatch, EngineReplay, ReplayError, ReplayMismatch};

use crate::effect::Effect;

/// Version of the lines and entries.
pub const VERSION: u32 = 1;
/// Version of the JSON of events, effects, start states and settings.
pub const WIRE_VERSION: u32 = 1;
/// The longest line in bytes: a graph of the largest size, and room for what stands around it.
pub const MAX_LINE_BYTES: usize = 72 * 1024 * 1024;
/// Size in bytes at which the next segment begins. A line is never divided.
pub const SEGMENT_BYTES: u64 = 8 * 1024 * 1024;
/// The most segments of a journal.
pub const MAX_SEGMENTS: usize = 10_000;

/// True if an entry with these effects has to be on disk before they go out: a primitive starts or changes
/// what it does (a question to a person is a primitive too), or the run is over. Other entries may be synced
/// in groups.
#[must_use]
pub fn must_be_durable(effects: &[Effect]) -> bool {
    effects.iter().any(|effect| match effect {
        Effect::Start { .. } | Effect::Update { .. } | Effect::Finished(_) => true,
        Effect::Cancel { .. } | Effect::Hold { .. } | Effect::Proceed { .. } | Effect::SafeStop { .. } => {
            false
        }
        Effect::Observe { .. } | Effect::Watch { .. } | Effect::Unwatch { .. } => false,
        Effect::Verify { .. } | Effect::Report(_) => false,
    })
}
