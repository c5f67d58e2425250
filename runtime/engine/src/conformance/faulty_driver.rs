//! A driver that breaks laws on purpose.

use crate::driver::{Capabilities, Driver};
use crate::effect::Command;
use crate::event::DriverEvent;
use crate::ids::GoalId;
use crate::query::Query;
use crate::time::Time;
use motet_graph::Graph;
use motet_stdlib::lang;
use rand_xoshiro::SplitMix64;
use rand_xoshiro::rand_core::{Rng, SeedableRng};
use smol_str::SmolStr;

/// Rates of injected faults, each in cases per 1,000.
///
/// ```
/// use motet_runtime::conformance::FaultRates;
///
/// // One report in ten is lost; everything else goes well.
/// let rates = FaultRates { loses: 100, ..FaultRates::default() };
/// assert_eq!(rates.doubles, 0);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct FaultRates {
    /// A report is lost.
    pub loses: u32,
    /// A report comes twice.
    pub doubles: u32,
    /// A report comes late, by up to `late`.
    pub delays: u32,
    /// The longest delay.
    pub late: Time,
    /// A report comes before those that were to come earlier.
    pub reorders: u32,
    /// A start is refused, without a word to the driver within.
    pub refuses: u32,
    /// A command never reaches the driver within.
    pub deaf: u32,
    /// A hold never reaches the driver within.
    pub moves_on: u32,
    /// Of a goal that is cancelled nothing is reported any more.
    pub forgets: u32,
    /// A goal that is updated is interrupted.
    pub gives_up: u32,
    /// A new run does not reach the driver within, which goes on with the run before.
    pub remembers: u32,
    /// From a command on, nothing is reported any more.
    pub silence: u32,
    /// A report is of a time before the last.
    pub backwards: u32,
}

/// A driver around another one. The seed decides what goes wrong when; the same calls go wrong in the same
/// way.
#[derive(Clone, Debug)]
pub struct FaultyDriver<D> {
    inner: D,
    mischief: FaultRates,
    dice: SplitMix64,
    is_silent: bool,
    queue: Vec<(Time, DriverEvent)>,
    forgotten: Vec<GoalId>,
}

impl<D: Driver> FaultyDriver<D> {
    /// Around a driver.
    pub fn new(inner: D, mischief: FaultRates, seed: u64) -> Self {
        let dice = SplitMix64::seed_from_u64(seed);
        Self { inner, mischief, dice, is_silent: false, queue: Vec::new(), forgotten: Vec::new() }
    }

    /// True if something happens that does in so many of 1,000 cases.
    fn happens(&mut self, permille: u32) -> bool {
        permille > 0 && self.dice.next_u64() % 1_000 < u64::from(permille)
    }

    /// True if a command reaches the driver within.
    fn reaches(&mut self) -> bool {
        self.is_silent |= self.happens(self.mischief.silence);
        !self.happens(self.mischief.deaf)
    }

    /// A report from within.
    fn take(&mut self, at: Time, event: DriverEvent) {
        let is_forgotten = event.goal().is_some_and(|goal| self.forgotten.contains(&goal));
        if self.is_silent || is_forgotten || self.happens(self.mischief.loses) {
            return;
        }
        let mut at = at;
        if self.happens(self.mischief.delays) {
            at = at.after(Time::from_nanos(self.dice.next_u64() % self.mischief.late.nanos().max(1)));
        }
        if self.happens(self.mischief.backwards) {
            at = Time::from_nanos(at.nanos() / 2);
        }
        if self.happens(self.mischief.doubles) {
            self.queue.push((at, event.clone()));
        }
        if self.happens(self.mischief.reorders) {
            self.queue.insert(0, (at, event));
        } else {
            self.queue.push((at, event));
        }
    }
}

impl<D: Driver> Driver for FaultyDriver<D> {
    fn start(&mut self, now: Time, goal: GoalId, command: &Command) {
        if self.happens(self.mischief.refuses) {
            let failure = SmolStr::new_static(lang::failures::UNREACHABLE).into();
            self.queue.push((now, DriverEvent::Refused { goal, failure }));
        } else if self.reaches() {
            self.inner.start(now, goal, command);
        }
    }

    fn cancel(&mut self, now: Time, goal: GoalId) {
        if self.happens(self.mischief.forgets) {
            self.forgotten.push(goal);
        }
        if self.reaches() {
            self.inner.cancel(now, goal);
        }
    }

    fn capabilities(&self) -> Capabilities {
        self.inner.capabilities()
    }

    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        if self.happens(self.mischief.remembers) {
            return now;
        }
        self.queue.clear();
        self.forgotten.clear();
        self.inner.begin_run(now, run, graph)
    }

    fn update(&mut self, now: Time, goal: GoalId, command: &Command) {
        if self.happens(self.mischief.gives_up) {
            self.inner.cancel(now, goal);
        } else if self.reaches() {
            self.inner.update(now, goal, command);
        }
    }

    fn hold(&mut self, now: Time, goal: GoalId) {
        if !self.happens(self.mischief.moves_on) && self.reaches() {
            self.inner.hold(now, goal);
        }
    }

    fn proceed(&mut self, now: Time, goal: GoalId) {
        if self.reaches() {
            self.inner.proceed(now, goal);
        }
    }

    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        if self.reaches() {
            self.inner.safe_stop(now, goal);
        }
    }

    fn observe(&mut self, now: Time, query: &Query) {
        if self.reaches() {
            self.inner.observe(now, query);
        }
    }

    fn watch(&mut self, now: Time, query: &Query) {
        if self.reaches() {
            self.inner.watch(now, query);
        }
    }

    fn unwatch(&mut self, now: Time, query: &Query) {
        if self.reaches() {
            self.inner.unwatch(now, query);
        }
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        loop {
            let due = self.queue.iter().map(|(at, _)| *at).min().unwrap_or(until).min(until);
            if let Some((at, event)) = self.inner.advance(due) {
                self.take(at, event);
                continue;
            }
            let place = self.queue.iter().position(|(at, _)| *at <= due)?;
            return Some(self.queue.remove(place));
        }
    }

    fn inner(&mut self) -> Option<&mut dyn Driver> {
        Some(&mut self.inner)
    }
}
