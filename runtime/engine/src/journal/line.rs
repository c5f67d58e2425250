//! One line: checksum, sequence number, hash of the line before, entry.

use super::crc;
use super::entry::JournalEntry;
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
    let _ = write!(line, "{:08x} ", crc::of(json.as_bytes()));
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
    let actual = crc::of(json);
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
