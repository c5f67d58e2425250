//! The engine's time from the wall clock.

use motet_runtime::Time;
use std::time::{Duration, Instant};

/// Time that began at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Clock {
    origin: Instant,
    from: Time,
}

impl Clock {
    /// It is `from` now.
    pub(super) fn new(from: Time) -> Self {
        Self { origin: Instant::now(), from }
    }

    pub(super) fn now(&self) -> Time {
        let passed = u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.from.after(Time::from_nanos(passed))
    }

    /// Duration until a time; `None` for [`Time::NEVER`].
    pub(super) fn left(&self, until: Time) -> Option<Duration> {
        (until != Time::NEVER).then(|| Duration::from_nanos(until.since(self.now()).nanos()))
    }
}
