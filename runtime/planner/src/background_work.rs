//! Work beside a run, on a thread of its own: the loop of a run looks if it is done, and never waits for it.
//! In virtual time it is done at once, so that every run is the same.

use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::time::{Duration, Instant};

use crate::runtime_check::CheckMode;

/// Longest time for the reading of a line.
pub const READ_WITHIN: Duration = Duration::from_secs(2);
/// Longest time for the check of a reply.
pub const CHECK_WITHIN: Duration = Duration::from_secs(20);
/// Time between two looks at a person's wish to stop.
const SLICE: Duration = Duration::from_millis(20);

/// Work that is being done.
pub(crate) struct BackgroundWork<T> {
    coming: Receiver<T>,
    /// End of the time that it has; none where it was done at once.
    until: Option<Instant>,
}

/// Progress of some work.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum WorkProgress<T> {
    Coming,
    Done(T),
    /// It took too long, and nobody waits for it any more.
    Late,
}

impl<T: Send + 'static> BackgroundWork<T> {
    /// Starts some work.
    pub(crate) fn start(
        mode: CheckMode,
        within: Duration,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Self {
        let (told, coming) = mpsc::channel();
        let until = match mode {
            CheckMode::AtOnce => {
                // The receiver is here.
                let _ = told.send(work());
                None
            }
            CheckMode::Background => {
                std::thread::spawn(move || {
                    // Nobody may wait for it any more.
                    let _ = told.send(work());
                });
                Some(Instant::now() + within)
            }
        };
        Self { coming, until }
    }

    /// Looks if the work is done.
    pub(crate) fn progress(&self) -> WorkProgress<T> {
        self.after(Duration::ZERO)
    }

    /// Waits at most so long for the work. Where it was done at once, no clock is read.
    fn after(&self, wait: Duration) -> WorkProgress<T> {
        match self.coming.try_recv() {
            Ok(done) => return WorkProgress::Done(done),
            // A thread that broke down gives nothing.
            Err(TryRecvError::Disconnected) => return WorkProgress::Late,
            Err(TryRecvError::Empty) => {}
        }
        match self.coming.recv_timeout(wait) {
            Ok(done) => WorkProgress::Done(done),
            Err(RecvTimeoutError::Disconnected) => WorkProgress::Late,
            Err(RecvTimeoutError::Timeout) if self.until.is_some_and(|until| Instant::now() >= until) => {
                WorkProgress::Late
            }
            Err(RecvTimeoutError::Timeout) => WorkProgress::Coming,
        }
    }

    /// Waits for the work while nothing moves. `Coming` if a person wants to stop.
    pub(crate) fn wait(&self, is_stopped: impl Fn() -> bool) -> WorkProgress<T> {
        loop {
            match self.after(SLICE) {
                WorkProgress::Coming if is_stopped() => return WorkProgress::Coming,
                WorkProgress::Coming => {}
                over => return over,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::time::Duration;

    use super::{BackgroundWork, WorkProgress};
    use crate::runtime_check::CheckMode;

    #[test]
    fn beside_work_is_coming_until_it_is_done() {
        let (go_on, gate) = mpsc::channel::<()>();
        let work = move || gate.recv().is_ok();
        let background = BackgroundWork::start(CheckMode::Background, Duration::from_secs(60), work);
        assert_eq!(background.progress(), WorkProgress::Coming);
        assert_eq!(background.wait(|| true), WorkProgress::Coming, "a person stopped it");
        go_on.send(()).unwrap();
        assert_eq!(background.wait(|| false), WorkProgress::Done(true));
    }

    #[test]
    fn beside_work_that_takes_too_long_is_late() {
        let (_held, gate) = mpsc::channel::<()>();
        let background =
            BackgroundWork::start(CheckMode::Background, Duration::ZERO, move || gate.recv().is_ok());
        assert_eq!(background.progress(), WorkProgress::Late);
    }

    #[test]
    fn beside_work_in_virtual_time_is_done_at_once() {
        let background = BackgroundWork::start(CheckMode::AtOnce, Duration::ZERO, || 7);
        assert_eq!(background.progress(), WorkProgress::Done(7));
    }
}
