//! The host loop with a small driver in virtual time.

use motet_arbitrary::graph::{StepSketch, graph};
use motet_runtime::{
    Command, Driver, DriverEvent, Effect, Engine, Fault, GoalId, Observer, Outcome, Query, RunControl,
    RunEnd, StartState, Time, run,
};

/// Every goal takes two seconds; a cancel a tenth of one.
#[derive(Default)]
struct TwoSeconds {
    due: Vec<(Time, GoalId, Outcome)>,
    /// It says nothing at all.
    mute: bool,
}

impl Driver for TwoSeconds {
    fn start(&mut self, now: Time, goal: GoalId, _command: &Command) {
        self.due.push((now.after(Time::from_secs(2.0)), goal, Outcome::Success(None)));
    }
    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.due.retain(|(_, other, _)| *other != goal);
        self.due.push((now.after(Time::from_secs(0.1)), goal, Outcome::Interrupted));
    }
    fn update(&mut self, _now: Time, _goal: GoalId, _command: &Command) {}
    fn hold(&mut self, _now: Time, _goal: GoalId) {}
    fn proceed(&mut self, _now: Time, _goal: GoalId) {}
    fn safe_stop(&mut self, _now: Time, _goal: GoalId) {}
    fn observe(&mut self, _now: Time, _query: &Query) {}
    fn watch(&mut self, _now: Time, _query: &Query) {}
    fn unwatch(&mut self, _now: Time, _query: &Query) {}
    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        self.due.sort_by_key(|(at, ..)| *at);
        let (at, ..) = self.due.first().filter(|(at, ..)| *at <= until && !self.mute)?;
        let at = *at;
        let (_, goal, outcome) = self.due.remove(0);
        Some((at, DriverEvent::Ended { goal, outcome }))
    }
}

/// Stops once a time is reached, and notes when the run ended.
struct Stopwatch {
    stop_at: Time,
    ended_at: Option<Time>,
    reached: u32,
    every: Time,
}

impl Observer for Stopwatch {
    fn effect(&mut self, now: Time, effect: &Effect) {
        if matches!(effect, Effect::Finished(_)) {
            self.ended_at = Some(now);
        }
    }
    fn reached(&mut self, now: Time) -> RunControl {
        self.reached += 1;
        if now >= self.stop_at { RunControl::Stop } else { RunControl::Continue }
    }
    fn at_least_every(&self) -> Time {
        self.every
    }
}

fn check(stop_at: f64, every: f64, expected: RunEnd, ended_at: f64, reached: u32) {
    let mut engine =
        Engine::new(graph(&[StepSketch::go("table"), StepSketch::say("there")]), &StartState::default())
            .unwrap();
    let mut watch = Stopwatch {
        stop_at: Time::from_secs(stop_at),
        ended_at: None,
        reached: 0,
        every: Time::from_secs(every),
    };
    // A goal must be acknowledged before it can be cancelled: this driver never does, so only its end counts.
    let end = run(&mut engine, &mut TwoSeconds::default(), &mut watch, Time::ZERO);
    assert_eq!((end, watch.ended_at, watch.reached), (expected, Some(Time::from_secs(ended_at)), reached));
}

#[test]
fn run_ends_by_itself() {
    check(100.0, f64::INFINITY, RunEnd::Done { why: None, result: None }, 4.0, 4);
}

#[test]
fn run_onlooker_is_called_in_between() {
    check(100.0, 0.5, RunEnd::Done { why: None, result: None }, 4.0, 16);
}

#[test]
fn run_onlooker_stops_the_run() {
    // The first goal was not acknowledged, so it runs to its end, and then nothing else starts.
    check(1.0, 0.5, RunEnd::Interrupted, 2.0, 4);
}

#[test]
fn run_driver_that_says_nothing_ends_in_a_fault() {
    let mut engine = Engine::new(graph(&[StepSketch::go("table")]), &StartState::default()).unwrap();
    let end = run(&mut engine, &mut TwoSeconds { mute: true, ..TwoSeconds::default() }, &mut (), Time::ZERO);
    assert!(matches!(end, RunEnd::Fault(Fault::NotStopped { .. })), "{end:?}");
}
