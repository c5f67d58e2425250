//! Lines of a journal: an entry as JSON behind a checksum, with its number and the hash of the line before.

use super::entry::{JournalEntry, JournalHead, StepEntry, SwapEntry};
use crate::effect::Effect;
use crate::event::Event;
use crate::time::Time;
use motet_graph::Graph;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use thiserror::Error;

/// Hexadecimal digits of a checksum.
pub(super) const CRC_DIGITS: usize = 8;
/// Bytes of a hash that are kept. 128 bits: against accidents far more than enough, and nobody finds a second
/// line with them.
const HASH_BYTES: usize = 16;

/// JSON content of a line.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Body {
    /// The number of the line in the journal, from 0.
    pub(super) seq: u64,
    /// The hash of the line before; that of no bytes before the first.
    pub(super) prev: String,
    pub(super) entry: JournalEntry,
}

/// Error of a line in itself.
#[derive(Clone, PartialEq, Eq, Debug, Error)]
pub enum LineError {
    /// It is shorter than a checksum, or does not begin with one.
    #[error("it does not begin with a checksum")]
    NoChecksum,
    /// Its checksum is not that of its content.
    #[error("its checksum is {stated:08x}, its content has {actual:08x}")]
    Checksum { stated: u32, actual: u32 },
    /// Its JSON is not of the form of an entry.
    #[error("it is no entry: {0}")]
    Form(String),
}

/// A line with its checksum, without the line feed.
pub(super) fn encode(body: &Body) -> String {
    let json = crate::json::to_json(body);
    let mut line = String::with_capacity(json.len() + CRC_DIGITS + 2);
    // Writing to a string does not fail.
    let _ = write!(line, "{:08x} ", crc32fast::hash(json.as_bytes()));
    line.push_str(&json);
    line
}

/// The sequence number, the hash of the line before, and the entry of a line without its line feed.
///
/// # Errors
///
/// Where the checksum does not hold, or the JSON is not that of an entry.
pub fn decode(line: &[u8]) -> Result<(u64, String, JournalEntry), LineError> {
    let json = checked(line)?;
    let body: Body = serde_json::from_slice(json).map_err(|error| LineError::Form(error.to_string()))?;
    Ok((body.seq, body.prev, body.entry))
}

/// The JSON of a line whose checksum holds.
fn checked(line: &[u8]) -> Result<&[u8], LineError> {
    let (digits, rest) = line.split_at_checked(CRC_DIGITS).ok_or(LineError::NoChecksum)?;
    let digits = std::str::from_utf8(digits).map_err(|_| LineError::NoChecksum)?;
    // `from_str_radix` would take a sign too.
    let is_hex = digits.bytes().all(|byte| byte.is_ascii_digit() || (b'a'..=b'f').contains(&byte));
    let stated = u32::from_str_radix(digits, 16).ok().filter(|_| is_hex).ok_or(LineError::NoChecksum)?;
    let json = rest.strip_prefix(b" ").ok_or(LineError::NoChecksum)?;
    let actual = crc32fast::hash(json);
    if stated == actual { Ok(json) } else { Err(LineError::Checksum { stated, actual }) }
}

/// The hash of a line without its line feed: the first 128 bits of its SHA-256, in hexadecimal digits.
pub(super) fn hash(line: &[u8]) -> String {
    let digest = Sha256::digest(line);
    let mut text = String::with_capacity(2 * HASH_BYTES);
    for byte in digest.iter().take(HASH_BYTES) {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// Numbers lines and links each to the one before.
///
/// ```
/// use motet_runtime::journal::{LineChain, decode};
/// use motet_runtime::{Event, Time};
///
/// let mut chain = LineChain::default();
/// let first = chain.step(Time::ZERO, &Event::Begin, &[]);
/// let second = chain.step(Time::from_secs(1.0), &Event::Tick, &[]);
/// assert_eq!(decode(first.trim_end().as_bytes())?.0, 0);
/// assert_eq!(decode(second.trim_end().as_bytes())?.0, 1);
/// // A line whose bytes were changed is refused.
/// assert!(decode(second.trim_end().replace("tick", "stop").as_bytes()).is_err());
/// # Ok::<(), motet_runtime::journal::LineError>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct LineChain {
    seq: u64,
    prev: String,
}

impl Default for LineChain {
    /// Before the first line.
    fn default() -> Self {
        Self { seq: 0, prev: hash(b"") }
    }
}

impl LineChain {
    /// The number that the next line gets.
    #[must_use]
    pub const fn next_seq(&self) -> u64 {
        self.seq
    }

    /// The hash of the last line.
    pub(super) fn prev(&self) -> &str {
        &self.prev
    }

    /// A line was added.
    pub(super) fn advance(&mut self, line: &[u8]) {
        self.seq += 1;
        self.prev = hash(line);
    }

    /// The line of an entry, with its line feed.
    pub fn line(&mut self, entry: JournalEntry) -> String {
        let body = Body { seq: self.seq, prev: std::mem::take(&mut self.prev), entry };
        let mut line = encode(&body);
        self.advance(line.as_bytes());
        line.push('\n');
        line
    }

    /// The first line.
    pub fn head(&mut self, head: JournalHead) -> String {
        self.line(JournalEntry::Head(Box::new(head)))
    }

    /// The line of an event with its effects.
    pub fn step(&mut self, at: Time, event: &Event, effects: &[Effect]) -> String {
        self.line(JournalEntry::Step(StepEntry { at, event: Some(event.clone()), effects: effects.to_vec() }))
    }

    /// The line of giving up.
    pub fn gave_up(&mut self, at: Time, effects: &[Effect]) -> String {
        self.line(JournalEntry::GaveUp(StepEntry { at, event: None, effects: effects.to_vec() }))
    }

    /// The line of a new policy.
    pub fn swap(&mut self, at: Time, graph: &Graph, effects: &[Effect]) -> String {
        let graph = motet_graph::encode::document(graph);
        self.line(JournalEntry::Swap(Box::new(SwapEntry { at, graph, effects: effects.to_vec() })))
    }
}
