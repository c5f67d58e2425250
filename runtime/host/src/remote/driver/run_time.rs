//! Time of a run with a driver in another process: the wall clock's, or the driver's own.

use super::super::link::Clock;
use motet_runtime::Time;
use std::time::Instant;

/// Time of a run with a driver in another process.
#[derive(Clone, Copy, Debug)]
pub(super) enum RunTime {
    /// The wall clock's.
    Wall(Clock),
    /// The driver's, which stands still between calls.
    Own { now: Time, stall: Option<Stall> },
}

/// Answers to `advance` in a row after which the clock has hardly got on, without a report.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stall {
    pub(super) answers: u32,
    pub(super) since: Instant,
}

impl RunTime {
    pub(super) fn now(&self) -> Time {
        match self {
            Self::Wall(clock) => clock.now(),
            Self::Own { now, .. } => *now,
        }
    }

    pub(super) const fn is_own(&self) -> bool {
        matches!(self, Self::Own { .. })
    }

    /// Time that the driver is told with each call, if it owns the clock.
    pub(super) fn told(&self) -> Option<Time> {
        self.is_own().then(|| self.now())
    }
}
