//! Ids that the engine hands out in a run: goals and checks of motions.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Bits of a [`GoalId`] that hold its slot in the table of goals; the running number of the start stands
/// above them.
pub(crate) const SLOT_BITS: u32 = 24;

/// Id of one start of a primitive. The engine chooses it and never uses it twice in a run, not even for a
/// retry.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct GoalId(pub(crate) u64);

impl GoalId {
    /// The id as a number, for a protocol or a log.
    #[must_use]
    pub const fn number(self) -> u64 {
        self.0
    }

    /// The id with a number. An id of no live goal is harmless: events about it are ignored.
    #[must_use]
    pub const fn from_number(number: u64) -> Self {
        Self(number)
    }
}

impl fmt::Display for GoalId {
    /// Writes the running number of the start, from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0 >> SLOT_BITS)
    }
}

/// Id of one question to a verifier. The engine chooses it and never uses it twice in a run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct CheckId(pub(crate) u64);

impl CheckId {
    /// The id as a number, for a protocol or a log.
    #[must_use]
    pub const fn number(self) -> u64 {
        self.0
    }

    /// The id with a number. A verdict on a check that no step waits for is ignored.
    #[must_use]
    pub const fn from_number(number: u64) -> Self {
        Self(number)
    }
}

impl fmt::Display for CheckId {
    /// Writes the running number of the question, from 1.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "?{}", self.0)
    }
}
