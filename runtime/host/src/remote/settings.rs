//! Named limits of what is said to drivers and of how long they may take.

use std::time::Duration;

/// The longest line in bytes that a driver may say.
pub(crate) const MAX_LINE_BYTES: usize = 1024 * 1024;
/// The longest failure kind in bytes that a driver may name. Another one, or one that is no name, counts as
/// `failed`.
pub(crate) const MAX_KIND_BYTES: usize = 64;
/// The most lines that wait to be heard, and the most that wait to be said.
pub(crate) const MAX_WAITING: usize = 1_024;
/// Greatest nesting depth of a driver's message, so that a journal with it can be read again.
pub(crate) const MAX_DEPTH: usize = 32;
/// The most characters of a feedback that are kept.
pub(crate) const MAX_FEEDBACK: usize = 1_000;
/// Number of times a start is said before its goal counts as lost.
pub(crate) const SAYINGS: u32 = 2;

/// Time limits for a driver in another process.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct DriverTimeouts {
    /// To answer the greeting after it was started or called.
    pub greeting: Duration,
    /// To answer a command. It is an answer to have heard it; what it does may take as long as it takes.
    pub answer: Duration,
    /// Silence of either side after which the host asks for a sign of life.
    pub heartbeat: Duration,
    /// Silence of the driver after which it counts as lost.
    pub silence: Duration,
    /// Number of times it is started or called again after it was gone.
    pub restarts: u32,
    /// Time limit for a process to stop all motion and to end after `bye`. Then it is killed.
    pub farewell: Duration,
}

impl Default for DriverTimeouts {
    /// 10 s for the greeting, 2 s for an answer, a sign of life every second and at least every 5 s, 3
    /// restarts, 5 s to end.
    fn default() -> Self {
        Self {
            greeting: Duration::from_secs(10),
            answer: Duration::from_secs(2),
            heartbeat: Duration::from_secs(1),
            silence: Duration::from_secs(5),
            restarts: 3,
            farewell: Duration::from_secs(5),
        }
    }
}

impl DriverTimeouts {
    /// The longest that it takes until a driver that went silent is noticed, called again, greeted and told:
    /// how long a safe stop has to be waited for at least.
    #[must_use]
    pub const fn recovery(&self) -> Duration {
        self.silence.saturating_add(self.greeting).saturating_add(self.answer)
    }
}
