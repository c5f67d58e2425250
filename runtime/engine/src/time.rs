//! Points in time. The engine reads no clock: every event carries its time, and a simulator's time is as good
//! as any.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// A point in time in whole nanoseconds since the run's origin, or a span of it. Integers, so that sums are
/// exact and a replay meets the same instants.
///
/// ```
/// use motet_runtime::Time;
///
/// let start = Time::from_secs(1.5);
/// let later = start.after(Time::from_nanos(500_000_000));
/// assert_eq!(later.secs(), 2.0);
/// assert_eq!(start.since(later), Time::ZERO);
/// assert_eq!(later.after(Time::NEVER), Time::NEVER);
/// ```
#[derive(
    Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug, Default, Serialize, Deserialize, JsonSchema,
)]
#[serde(transparent)]
pub struct Time(u64);

/// Nanoseconds in a second.
const NANOS: f64 = 1e9;

impl Time {
    /// The origin of the run's time.
    pub const ZERO: Self = Self(0);
    /// Later than everything that happens.
    pub const NEVER: Self = Self(u64::MAX);

    /// So many seconds after the origin, rounded to the nanosecond; negative and NaN give [`Time::ZERO`],
    /// what is too large gives [`Time::NEVER`].
    #[must_use]
    pub fn from_secs(secs: f64) -> Self {
        // A cast from a float saturates, and NaN gives zero.
        Self((secs * NANOS).round() as u64)
    }

    /// So many nanoseconds after the origin.
    #[must_use]
    pub const fn from_nanos(nanos: u64) -> Self {
        Self(nanos)
    }

    /// Seconds since the origin.
    #[must_use]
    pub fn secs(self) -> f64 {
        self.0 as f64 / NANOS
    }

    /// Nanoseconds since the origin.
    #[must_use]
    pub const fn nanos(self) -> u64 {
        self.0
    }

    /// Later by `span`; at most [`Time::NEVER`].
    #[must_use]
    pub const fn after(self, span: Self) -> Self {
        Self(self.0.saturating_add(span.0))
    }

    /// The span from `earlier` to this; zero where `earlier` is not earlier.
    #[must_use]
    pub const fn since(self, earlier: Self) -> Self {
        Self(self.0.saturating_sub(earlier.0))
    }
}

impl fmt::Display for Time {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if *self == Self::NEVER {
            return f.write_str("never");
        }
        write!(f, "{} s", self.secs())
    }
}
