//! The laws, and what it is to break one.

use std::fmt;

/// A law of [`crate::Driver`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum Law {
    /// Every start is acknowledged or refused, once.
    Answered,
    /// An acknowledged goal ends, and once only.
    EndsOnce,
    /// After its end nothing is said of a goal.
    SilentAfterEnd,
    /// A cancelled goal ends soon.
    Cancelled,
    /// A safe stop is answered, also of a goal that has ended, is held, or was never heard of.
    SafeStop,
    /// A held goal does not end, and goes on when it is told to; or it is said that it cannot be held.
    Held,
    /// An updated goal goes on under its number, and ends by itself.
    Updated,
    /// An observation is answered once.
    Observed,
    /// A watch is answered at once, and watching twice is watching once.
    Watched,
    /// Time never runs backwards, nor past what was asked for.
    Time,
    /// The same calls at the same times give the same reports.
    Repeatable,
}

/// A law that was broken.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub struct LawViolation {
    pub law: Law,
    /// Description of the violation.
    pub told: String,
}

impl Law {
    /// The law in words.
    #[must_use]
    pub const fn text(self) -> &'static str {
        match self {
            Self::Answered => "every start is acknowledged or refused, once",
            Self::EndsOnce => "an acknowledged goal ends exactly once",
            Self::SilentAfterEnd => "after its end nothing is said of a goal",
            Self::Cancelled => "a cancelled goal ends soon",
            Self::SafeStop => "a safe stop is always answered",
            Self::Held => "a held goal keeps still until it is told to go on",
            Self::Updated => "an updated goal goes on under its number, and ends by itself",
            Self::Observed => "an observation is answered once",
            Self::Watched => "a watch is answered at once, and watching twice is watching once",
            Self::Time => "time never runs backwards, nor past what was asked for",
            Self::Repeatable => "the same calls at the same times give the same reports",
        }
    }
}

impl fmt::Display for LawViolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.law.text(), self.told)
    }
}
