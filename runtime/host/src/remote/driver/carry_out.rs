//! Commands of the engine as calls of the protocol.

use super::super::link::SLICE;
use super::super::protocol::{DriverCall, GoalParams, QueryParams, StartParams, ToldParams};
use super::run_time::RunTime;
use super::{RemoteDriver, failed};
use motet_graph::Graph;
use motet_runtime::{
    Answer, CameraImage, Capabilities, Command, Detection, Driver, DriverEvent, GoalId, Heard, Moved,
    Perception, Query, RgbdView, Time, ToldThing,
};
use std::thread;
use std::time::Duration;

impl Driver for RemoteDriver {
    fn start(&mut self, _now: Time, goal: GoalId, command: &Command) {
        if self.reach() {
            self.goals.started(goal, &command.primitive);
            self.call(DriverCall::Start(StartParams { goal, command: command.clone().into() }));
        } else {
            // It was never said, so it was never done.
            self.report(DriverEvent::Refused { goal, failure: failed().into() });
        }
    }

    fn cancel(&mut self, _now: Time, goal: GoalId) {
        self.call(DriverCall::Cancel(GoalParams { goal }));
    }

    fn capabilities(&self) -> Capabilities {
        self.welcome.capabilities.clone()
    }

    fn base(&self) -> Option<[f64; 3]> {
        self.telemetry.base
    }

    fn instance(&mut self) -> Option<String> {
        Some(self.welcome.instance.clone())
    }

    fn begin_run(&mut self, now: Time, run: &str, graph: Option<&Graph>) -> Time {
        let now = now.max(self.time.now());
        self.set_time(now);
        self.last = now;
        if let Err(breakage) = self.begin(run, graph) {
            // The next start calls it again.
            self.link = None;
            self.log.note(&breakage.to_string());
        }
        now
    }

    fn rest(&mut self, now: Time) -> Time {
        if !self.time.is_own() {
            self.listen(Duration::ZERO);
            self.tend();
            self.outbox.clear();
        }
        now.max(self.time.now())
    }

    fn update(&mut self, _now: Time, goal: GoalId, command: &Command) {
        self.call(DriverCall::Update(StartParams { goal, command: command.clone().into() }));
    }

    fn hold(&mut self, _now: Time, goal: GoalId) {
        self.call(DriverCall::Hold(GoalParams { goal }));
    }

    fn proceed(&mut self, _now: Time, goal: GoalId) {
        self.call(DriverCall::Proceed(GoalParams { goal }));
    }

    fn safe_stop(&mut self, _now: Time, goal: GoalId) {
        let was_reached = self.link.is_some();
        self.goals.stopping.insert(goal);
        // Who is called again is told all that is to stop.
        if self.reach_to_stop() && was_reached {
            self.call(DriverCall::SafeStop(GoalParams { goal }));
        }
    }

    fn observe(&mut self, _now: Time, query: &Query) {
        if self.link.is_some() {
            self.call(DriverCall::Observe(QueryParams::from(query)));
        } else {
            self.observed(QueryParams::from(query), Answer::Unknown);
        }
    }

    fn watch(&mut self, _now: Time, query: &Query) {
        if self.watches.contains(query) {
            return;
        }
        self.watches.push(query.clone());
        if self.link.is_some() {
            self.call(DriverCall::Watch(QueryParams::from(query)));
        } else {
            self.observed(QueryParams::from(query), Answer::Unknown);
        }
    }

    fn unwatch(&mut self, _now: Time, query: &Query) {
        self.watches.retain(|watched| watched != query);
        self.call(DriverCall::Unwatch(QueryParams::from(query)));
    }

    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let RunTime::Wall(clock) = self.time else { return self.advance_own(until) };
        let mut wait = Duration::ZERO;
        loop {
            self.listen(wait);
            self.tend();
            if let Some((at, event)) = self.outbox.pop_front() {
                self.last = at.min(until).max(self.last);
                return Some((self.last, event));
            }
            if (self.patience.is_over)() {
                return None;
            }
            let left = clock.left(until);
            match (left, &self.link) {
                (Some(Duration::ZERO), _) | (None, None) => return None,
                (Some(left), None) => {
                    thread::sleep(left.min(SLICE));
                    wait = Duration::ZERO;
                }
                (left, Some(_)) => wait = left.map_or(SLICE, |left| left.min(SLICE)),
            }
        }
    }

    fn telemetry(&mut self) -> Option<Moved> {
        self.telemetry.moved()
    }

    fn detected(&mut self) -> Option<Vec<Detection>> {
        self.telemetry.detected()
    }

    fn heard(&mut self) -> Option<Heard> {
        self.telemetry.heard()
    }

    fn look(&mut self, _now: Time, camera: Option<&str>) -> Option<RgbdView> {
        if self.welcome.capabilities.look { self.ask_for_picture(camera) } else { None }
    }

    fn detections(&mut self, _now: Time) -> Vec<Detection> {
        if self.welcome.capabilities.detections { self.ask_for_detections() } else { Vec::new() }
    }

    fn told(&mut self, _now: Time, thing: &ToldThing) {
        if self.welcome.capabilities.told {
            self.call(DriverCall::Told(ToldParams { thing: thing.clone() }));
        }
    }
}

/// Pictures of the camera as it is turned.
impl Perception for RemoteDriver {
    fn image(&mut self, now: Time) -> Option<CameraImage> {
        Some(self.look(now, None)?.image)
    }

    fn view(&mut self, now: Time, _of: &str) -> Option<RgbdView> {
        self.look(now, None)
    }
}
