//! Keeps a run in step with the wall clock, shows it, and stops it on Ctrl-C.

use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use motet_planner::runtime_check::Guard;
use motet_runtime::{Effect, Event, Observer, RunControl, RunEnd, Time, Verifier};

use super::view::View;
use crate::args::Speed;
use crate::exit::Trouble;

/// How often a waiting run looks whether it shall stop.
const SLICE: Duration = Duration::from_millis(50);

/// How often Ctrl-C was pressed.
static PRESSED: AtomicU32 = AtomicU32::new(0);

/// Makes Ctrl-C a request to stop; the second one ends the process.
///
/// # Errors
///
/// The system does not allow it.
pub(crate) fn catch_interrupts() -> Result<(), Trouble> {
    ctrlc::set_handler(|| {
        if PRESSED.fetch_add(1, Ordering::SeqCst) > 0 {
            std::process::exit(130);
        }
    })
    .map_err(|error| Trouble::Other(format!("Ctrl-C cannot be caught: {error}")))
}

/// Whether Ctrl-C was pressed.
pub(crate) fn is_interrupted() -> bool {
    PRESSED.load(Ordering::SeqCst) > 0
}

/// The host's eyes and clock.
pub(crate) struct Pace {
    view: Box<dyn View>,
    speed: Speed,
    begun: Option<(Instant, Time)>,
    now: Time,
    guard: Option<Guard>,
}

impl Pace {
    pub(super) fn new(view: Box<dyn View>, speed: Speed) -> Self {
        Self { view, speed, begun: None, now: Time::ZERO, guard: None }
    }

    /// With somebody who checks motions that were left to the run.
    pub(super) fn with_guard(self, guard: Option<Guard>) -> Self {
        Self { guard, ..self }
    }

    /// Takes in what was carried out before the process began.
    pub(super) fn past(&mut self, now: Time, effects: &[Effect]) {
        self.now = now;
        effects.iter().for_each(|effect| self.view.past(now, effect));
    }

    /// Another policy takes over, which is shown elsewhere.
    pub(crate) fn leave(&mut self, now: Time) {
        self.view.leave(now);
    }

    /// Takes in what came of its policy after it was replaced.
    pub(crate) fn late(&mut self, now: Time, effect: &Effect) {
        self.view.late(now, effect);
    }

    /// Says how it ended.
    pub(crate) fn finish(&mut self, end: &RunEnd) {
        self.view.finish(self.now, end);
    }

    /// Waits until the wall clock has come as far.
    fn wait(&mut self, now: Time) {
        let Speed::Times(factor) = self.speed else { return };
        let (begun, origin) = *self.begun.get_or_insert_with(|| (Instant::now(), now));
        let due = Duration::try_from_secs_f64(now.since(origin).secs() / factor).unwrap_or(Duration::MAX);
        while let Some(left) = due.checked_sub(begun.elapsed()).filter(|left| !left.is_zero()) {
            if is_interrupted() {
                return;
            }
            thread::sleep(left.min(SLICE));
        }
    }
}

impl Observer for Pace {
    fn event(&mut self, _now: Time, event: &Event) {
        self.view.event(event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.now = now;
        if self.begun.is_none() {
            self.begun = Some((Instant::now(), now));
        }
        self.view.effect(now, effect);
    }

    fn reached(&mut self, now: Time) -> RunControl {
        self.now = now;
        self.wait(now);
        self.view.reached(now);
        // A run that nobody watches is not left to itself.
        if is_interrupted() || self.view.is_closed() { RunControl::Stop } else { RunControl::Continue }
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        let guard: &mut dyn Verifier = self.guard.as_mut()?;
        Some(guard)
    }

    fn at_least_every(&self) -> Time {
        match self.speed {
            Speed::Max => Time::NEVER,
            Speed::Times(factor) => Time::from_secs(0.1 * factor),
        }
    }
}
