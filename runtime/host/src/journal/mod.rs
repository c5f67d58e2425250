//! Journals on disk: a folder of segments, which are files of lines, named by the number of their first line.
//!
//! A line is written whole, by one call, as soon as the engine has handled its event and before any of its
//! effects goes out. It is synced to disk at once where an effect starts something
//! ([`motet_runtime::journal::must_be_durable`]), and with others otherwise, see [`SyncGrouping`]. A folder
//! is written by one process at a time; a lock that the system takes back when the process ends sees to it.

mod motion;
mod read;
mod record;
mod write;

pub use motion::MotionReader;
pub use read::{JournalError, JournalTail, lines, read, size};
pub use record::RunRecorder;
pub use write::{JournalWriter, SyncGrouping};

/// The name of a segment's file, by the number of its first line.
fn segment_name(seq: u64) -> String {
    format!("{seq:012}.{EXTENSION}")
}

/// The extension of a segment's file.
const EXTENSION: &str = "journal";
/// The file that is locked while a folder is written.
const LOCK: &str = "lock";
