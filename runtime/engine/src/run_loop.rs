//! The loop around an engine: effects to a driver, its reports back. Time is the driver's.

use crate::driver::{Capabilities, Driver, DriverClock};
use crate::effect::{DeferredMotion, Effect, Fault, RunEnd};
use crate::engine::Engine;
use crate::event::{DriverEvent, Event, Verification};
use crate::ids::CheckId;
use crate::perception::{CameraImage, Detection};
use crate::query::{Answer, Query};
use crate::swap::{PreparedSwap, RetiredGraph, SwapRefusal};
use crate::telemetry::{Heard, Moved, ToldThing};
use crate::time::Time;
use crate::verifier::Verifier;
use motet_graph::Graph;
use motet_stdlib::lang;
use smol_str::SmolStr;
use std::collections::VecDeque;
use std::sync::Arc;

/// Number of times it is looked whether a verdict has come that is waited for.
const VERDICT_EVERY: Time = Time::from_nanos(20_000_000);
/// Longest span of a run without reading telemetry, where the driver sends it.
const TELEMETRY_EVERY: Time = Time::from_nanos(100_000_000);
/// Longest span of a run without a call of [`Observer::reached`], where time is the driver's and may pass at
/// any speed.
const REACHED_EVERY: Time = Time::from_nanos(500_000_000);

/// Span of a held run after which it is looked whether it may go on.
const HELD_EVERY: Time = Time::from_nanos(100_000_000);

/// Looks on while a graph runs, and may pace and stop it. Every method does nothing by default.
pub trait Observer {
    /// Observer behind this one, to which this one passes on what it does not treat itself: events, effects,
    /// telemetry, pictures, detections, words, swaps and the verifier. `None` for an observer that stands
    /// alone.
    fn inner(&mut self) -> Option<&mut dyn Observer> {
        None
    }

    /// An event is about to be handled.
    fn event(&mut self, now: Time, event: &Event) {
        if let Some(inner) = self.inner() {
            inner.event(now, event);
        }
    }

    /// An event was handled, or else the engine gave up, and these effects are about to be carried out, all
    /// together. Who keeps a journal writes here. Where this says [`RunControl::Stop`], nothing is started or
    /// changed any more: starts are taken back as refused, what runs is stopped.
    fn commit(&mut self, _now: Time, _effects: &[Effect]) -> RunControl {
        RunControl::Continue
    }

    /// An effect is about to be carried out.
    fn effect(&mut self, now: Time, effect: &Effect) {
        if let Some(inner) = self.inner() {
            inner.effect(now, effect);
        }
    }

    /// The run has reached a time; called before anything takes time, and after. To pace it against a clock,
    /// wait here until it is that late.
    fn reached(&mut self, _now: Time) -> RunControl {
        RunControl::Continue
    }

    /// True if it wants to hear of every motion. Then the run stops often enough to read telemetry.
    fn wants_telemetry(&self) -> bool {
        false
    }

    /// The driver sent telemetry. It may have a time before that of the last event.
    fn moved(&mut self, moved: &Moved) {
        if let Some(inner) = self.inner() {
            inner.moved(moved);
        }
    }

    /// True if it wants a picture of the robot's camera now. To take one may keep the driver busy for a
    /// moment.
    fn wants_picture(&self) -> bool {
        false
    }

    /// Takes in the picture that it wanted; `None` if the driver has none.
    fn pictured(&mut self, image: Option<CameraImage>) {
        if let Some(inner) = self.inner() {
            inner.pictured(image);
        }
    }

    /// The driver saw something new. Returns the facts that follow from it, which the engine then takes for
    /// observed ([`Event::Noticed`]).
    fn detected(&mut self, now: Time, seen: &[Detection], engine: &Engine) -> Vec<(Query, Answer)> {
        self.inner().map(|inner| inner.detected(now, seen, engine)).unwrap_or_default()
    }

    /// Next thing of which the driver is to be told. Asked before each event, until there is none.
    fn tell(&mut self) -> Option<ToldThing> {
        self.inner()?.tell()
    }

    /// A person said something that nobody had asked for.
    fn heard(&mut self, now: Time, heard: &Heard) {
        if let Some(inner) = self.inner() {
            inner.heard(now, heard);
        }
    }

    /// A policy to take over from the one that runs. Asked after each event, so at least as often as
    /// [`Observer::at_least_every`] says, and at each glance. Of
    /// several the newest should be given: one that was never given was never there.
    fn swap(&mut self, now: Time, engine: &Engine) -> Option<PreparedSwap> {
        self.inner()?.swap(now, engine)
    }

    /// Called with the result of a swap, before its effects are carried out.
    fn swapped(&mut self, now: Time, graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        if let Some(inner) = self.inner() {
            inner.swapped(now, graph, result);
        }
    }

    /// The verifier for motions that the compiler deferred, if there is one. The engine asks only if enabled
    /// by [`crate::EngineSettings::verify_within`].
    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        self.inner()?.verifier()
    }

    /// The longest span without a call of [`Observer::reached`], for a live display or to notice an
    /// interrupt.
    fn at_least_every(&self) -> Time {
        Time::NEVER
    }

    /// Longest span without a call of [`Observer::reached`] and [`Observer::swap`]. Unlike
    /// [`Observer::at_least_every`] it makes no event, so it leaves nothing in a journal.
    fn glance_every(&self) -> Time {
        Time::NEVER
    }
}

/// Looks on without a word.
impl Observer for () {}

/// Decision of an observer about the run.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RunControl {
    /// It goes on.
    Continue,
    /// A person wants everything to keep still.
    Hold,
    /// A person lets everything go on after [`RunControl::Hold`].
    Proceed,
    /// A person stops it.
    Stop,
}

/// Runs an engine to its end. Starts at `from`, the driver's present time.
pub fn run(engine: &mut Engine, driver: &mut dyn Driver, observer: &mut dyn Observer, from: Time) -> RunEnd {
    resume(engine, driver, observer, from, vec![Event::Begin])
}

/// Goes on with an engine that has begun, to its end: first with these events at `from`, then with what the
/// driver reports.
pub fn resume(
    engine: &mut Engine,
    driver: &mut dyn Driver,
    observer: &mut dyn Observer,
    from: Time,
    events: Vec<Event>,
) -> RunEnd {
    let asked = engine.unverified().map(|(check, motion)| (check, Arc::clone(motion))).collect();
    let (first, out) = (events.into(), Vec::new());
    let capabilities = driver.capabilities();
    let mut host = RunLoop { driver, observer, now: from, first, out, asked, capabilities, stopped: false };
    loop {
        host.verify();
        host.tell();
        if let Some(event) = host.first.pop_front() {
            host.observer.event(host.now, &event);
            if let Some(verifier) = host.observer.verifier() {
                verifier.event(host.now, &event);
            }
            engine.handle(host.now, event, &mut host.out);
            if let Some(end) = host.carry_out().or_else(|| host.swap(engine)) {
                return end;
            }
            continue;
        }
        // What a person said meanwhile goes before anything that takes time.
        if host.reached(engine) {
            continue;
        }
        match host.next(engine) {
            Next::Event(event) => host.first.push_back(event),
            Next::Glance => {
                if let Some(end) = host.swap(engine) {
                    return end;
                }
            }
            Next::Nothing => {
                engine.give_up(&mut host.out);
                return host.carry_out().unwrap_or(RunEnd::Fault(Fault::Stalled));
            }
        }
        host.read_telemetry(engine);
        host.reached(engine);
    }
}

/// Longest span without a look at what is no event; `tick` is the time of the next tick.
fn glance(capabilities: &Capabilities, wants_telemetry: bool, tick: Time) -> Time {
    match (capabilities.clock, capabilities.moved && wants_telemetry) {
        (DriverClock::Driver, false) => REACHED_EVERY,
        (DriverClock::Driver, true) => TELEMETRY_EVERY,
        // A simulator in this process can say that nothing will ever happen, if nothing limits its time.
        (DriverClock::Wall, true) if tick != Time::NEVER => TELEMETRY_EVERY,
        (DriverClock::Wall, _) => Time::NEVER,
    }
}

/// Outcome of letting time pass.
enum Next {
    Event(Event),
    /// Nothing for the engine: the observer looks on.
    Glance,
    /// Nothing will ever happen.
    Nothing,
}

struct RunLoop<'a> {
    driver: &'a mut dyn Driver,
    observer: &'a mut dyn Observer,
    now: Time,
    /// Events that come before anything that the driver reports.
    first: VecDeque<Event>,
    out: Vec<Effect>,
    /// Motions that wait for a verdict.
    asked: Vec<(CheckId, Arc<DeferredMotion>)>,
    /// Abilities of the driver.
    capabilities: Capabilities,
    stopped: bool,
}

impl RunLoop<'_> {
    /// Lets time pass until the next event or glance.
    fn next(&mut self, engine: &Engine) -> Next {
        let wake = engine.wake_at().unwrap_or(Time::NEVER);
        let is_awaited = self.observer.verifier().is_some_and(|verifier| verifier.is_busy());
        let every = if is_awaited { VERDICT_EVERY } else { Time::NEVER };
        let tick = wake.min(self.now.after(self.observer.at_least_every().min(every)));
        let wants = self.observer.wants_telemetry();
        let held = if engine.is_held() { HELD_EVERY } else { Time::NEVER };
        let glance = glance(&self.capabilities, wants, tick).min(self.observer.glance_every());
        let until = tick.min(self.now.after(held.min(glance)));
        match self.driver.advance(until) {
            Some((at, report)) => {
                self.now = at.max(self.now);
                Next::Event(Event::Driver(report))
            }
            None if until == Time::NEVER => Next::Nothing,
            None => {
                self.now = until.max(self.now);
                if until < tick { Next::Glance } else { Next::Event(Event::Tick) }
            }
        }
    }

    /// Hands to the observer what the driver reports beside the engine's events. What follows from detections
    /// goes to the engine.
    fn read_telemetry(&mut self, engine: &Engine) {
        let is_wanted = self.observer.wants_telemetry();
        if is_wanted || self.observer.verifier().is_some() {
            while let Some(moved) = self.driver.telemetry() {
                if let Some(verifier) = self.observer.verifier() {
                    verifier.moved(&moved);
                }
                if is_wanted {
                    self.observer.moved(&moved);
                }
            }
        }
        if self.observer.wants_picture() {
            let view = self.driver.look(self.now, None);
            self.observer.pictured(view.map(|view| view.image));
        }
        while let Some(seen) = self.driver.detected() {
            let noticed = self.observer.detected(self.now, &seen, engine).into_iter();
            self.first.extend(noticed.map(|(query, answer)| Event::Noticed { query, answer }));
        }
        while let Some(heard) = self.driver.heard() {
            self.observer.heard(self.now, &heard);
        }
    }

    /// Tells the driver what the observer wants it to know.
    fn tell(&mut self) {
        while let Some(thing) = self.observer.tell() {
            if self.capabilities.told {
                self.driver.told(self.now, &thing);
            }
        }
    }

    /// Has the motions verified that were asked for. Verdicts go before anything that the driver reports.
    fn verify(&mut self) {
        let asked = std::mem::take(&mut self.asked);
        let Some(verifier) = self.observer.verifier() else {
            for (check, _) in asked {
                let verdict = Verification::Unknown { why: SmolStr::new_static("nobody is there to ask") };
                self.first.push_back(Event::Verified { check, verdict });
            }
            return;
        };
        for (check, motion) in asked {
            verifier.ask(check, &motion);
        }
        while let Some((check, verdict)) = verifier.verdict() {
            self.first.push_back(Event::Verified { check, verdict });
        }
    }

    /// Lets another policy take over, if there is one. Gives the run's end where that follows at once.
    fn swap(&mut self, engine: &mut Engine) -> Option<RunEnd> {
        let prepared = self.observer.swap(self.now, engine)?;
        let graph = prepared.graph().clone();
        let result = engine.swap(self.now, prepared, &mut self.out);
        self.observer.swapped(self.now, &graph, result);
        self.carry_out()
    }

    /// Tells the observer the time, and does as it decides. True if an event follows from that.
    fn reached(&mut self, engine: &Engine) -> bool {
        if self.stopped {
            return false;
        }
        let event = match (self.observer.reached(self.now), engine.is_held()) {
            (RunControl::Stop, _) => {
                self.stop();
                return true;
            }
            (RunControl::Hold, false) => Event::Hold,
            (RunControl::Proceed, true) => Event::Proceed,
            (RunControl::Continue | RunControl::Hold | RunControl::Proceed, _) => return false,
        };
        self.first.push_back(event);
        true
    }

    fn stop(&mut self) {
        if !std::mem::replace(&mut self.stopped, true) {
            self.first.push_back(Event::Stop);
        }
    }

    /// Carries out the effects of one event. Gives the run's end, if it is among them.
    fn carry_out(&mut self) -> Option<RunEnd> {
        let now = self.now;
        let control = self.observer.commit(now, &self.out);
        if control == RunControl::Stop {
            self.stop();
        }
        let mut end = None;
        for effect in self.out.drain(..) {
            match (&effect, control) {
                (Effect::Start { goal, .. }, RunControl::Stop) => {
                    let failure = SmolStr::new_static(lang::failures::FAILED).into();
                    let refused = DriverEvent::Refused { goal: *goal, failure };
                    self.first.push_back(Event::Driver(refused));
                    continue;
                }
                (Effect::Update { .. }, RunControl::Stop) => continue,
                (_, RunControl::Stop | RunControl::Continue | RunControl::Hold | RunControl::Proceed) => {}
            }
            self.observer.effect(now, &effect);
            if let Some(verifier) = self.observer.verifier() {
                verifier.effect(&effect);
            }
            match effect {
                Effect::Report(_) => {}
                Effect::Finished(ending) => end = Some(*ending),
                Effect::Verify { check, motion, .. } => self.asked.push((check, motion)),
                command => self.driver.carry_out(now, &command),
            }
        }
        end
    }
}
