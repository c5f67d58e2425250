//! The loop around an engine: effects to a driver, its reports back. Time is the driver's.

use crate::driver::Driver;
use crate::effect::{Effect, Fault, RunEnd};
use crate::engine::Engine;
use crate::event::Event;
use crate::time::Time;

/// Looks on while a graph runs, and may pace and stop it. Every method does nothing by default.
pub trait Onlooker {
    /// An event is about to be handled.
    fn event(&mut self, _now: Time, _event: &Event) {}

    /// An effect is about to be carried out.
    fn effect(&mut self, _now: Time, _effect: &Effect) {}

    /// The run has reached a time. To pace it against a clock, wait here until it is that late.
    fn reached(&mut self, _now: Time) -> Control {
        Control::GoOn
    }

    /// The longest span without a call of [`Onlooker::reached`], for a live display or to notice an interrupt.
    fn at_least_every(&self) -> Time {
        Time::NEVER
    }
}

/// Looks on without a word.
impl Onlooker for () {}

/// Whether a run shall go on.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Control {
    /// It goes on.
    GoOn,
    /// A person stops it.
    Stop,
}

/// Runs an engine to its end. Starts at `from`, the driver's present time.
pub fn run(engine: &mut Engine, driver: &mut dyn Driver, onlooker: &mut dyn Onlooker, from: Time) -> RunEnd {
    let mut out = Vec::new();
    let (mut now, mut stopped) = (from, false);
    let mut event = Event::Begin;
    loop {
        onlooker.event(now, &event);
        engine.handle(now, event, &mut out);
        if let Some(end) = carry_out(driver, onlooker, now, &mut out) {
            return end;
        }
        let wake = engine.wake_at();
        let until = wake.unwrap_or(Time::NEVER).min(now.after(onlooker.at_least_every()));
        event = match driver.advance(until) {
            Some((at, report)) => {
                now = at.max(now);
                Event::Driver(report)
            }
            None if until == Time::NEVER => {
                engine.give_up(&mut out);
                return carry_out(driver, onlooker, now, &mut out).unwrap_or(RunEnd::Fault(Fault::Stalled));
            }
            None => {
                now = until.max(now);
                Event::Tick
            }
        };
        if !stopped && onlooker.reached(now) == Control::Stop {
            stopped = true;
            onlooker.event(now, &event);
            engine.handle(now, event, &mut out);
            if let Some(end) = carry_out(driver, onlooker, now, &mut out) {
                return end;
            }
            event = Event::Stop;
        }
    }
}

fn carry_out(
    driver: &mut dyn Driver,
    onlooker: &mut dyn Onlooker,
    now: Time,
    out: &mut Vec<Effect>,
) -> Option<RunEnd> {
    let mut end = None;
    for effect in out.drain(..) {
        onlooker.effect(now, &effect);
        match effect {
            Effect::Start { goal, command, .. } => driver.start(now, goal, &command),
            Effect::Cancel { goal } => driver.cancel(now, goal),
            Effect::Update { goal, command, .. } => driver.update(now, goal, &command),
            Effect::Hold { goal } => driver.hold(now, goal),
            Effect::Proceed { goal } => driver.proceed(now, goal),
            Effect::SafeStop { goal } => driver.safe_stop(now, goal),
            Effect::Observe { query } => driver.observe(now, &query),
            Effect::Watch { query } => driver.watch(now, &query),
            Effect::Unwatch { query } => driver.unwatch(now, &query),
            Effect::Report(_) => {}
            Effect::Finished(ending) => end = Some(*ending),
        }
    }
    end
}
