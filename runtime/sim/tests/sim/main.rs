//! The simulator from outside: primitives one by one in the built-in rooms, faults, watches, and graphs
//! through the engine.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    clippy::indexing_slicing,
    clippy::type_complexity,
    reason = "a test fails by panicking, and its data is nested"
)]

mod camera;
mod conformance;
mod driver;
mod engine;
mod faults;
mod laws;
mod limits;
mod primitives;
mod rates;
mod world;

use motet_graph::Value;
use motet_robots::{builtin, card, scene};
use motet_runtime::{Command, Driver, DriverEvent, GoalId, Outcome, Time};
use motet_sim::{Sim, SimOptions};
use motet_syntax::{FileId, Source};

/// A simulator with the host's part of the driver protocol.
struct Bench {
    sim: Sim,
    now: Time,
    goals: u64,
    /// Everything that was reported, as text.
    log: Vec<String>,
}

fn robot(name: &str) -> card::Robot {
    builtin::robot(name).unwrap().robot
}

fn scene(text: &str) -> scene::Scene {
    let (scene, said) = scene::read(&Source::new("scene.json", text), FileId(0));
    scene.unwrap_or_else(|| panic!("{said:?}"))
}

fn sim(robot: &str, room: &str, options: SimOptions) -> Sim {
    Sim::new(&self::robot(robot), &builtin::scene(room).unwrap(), options)
}

impl Bench {
    fn kitchen() -> Self {
        Self::with(SimOptions::default())
    }

    fn with(options: SimOptions) -> Self {
        Self::of(sim("hsr", "kitchen", options))
    }

    fn of(sim: Sim) -> Self {
        Self { sim, now: Time::ZERO, goals: 0, log: Vec::new() }
    }

    /// Faults from their JSON text.
    fn faulty(text: &str) -> Self {
        Self::with(SimOptions {
            faults: motet_sim::Faults::from_json(text).unwrap(),
            ..SimOptions::default()
        })
    }

    /// Starts a primitive with a deadline of 20 s for what is not driven.
    fn start(&mut self, primitive: &str, args: &[(&str, Value)]) -> GoalId {
        self.goals += 1;
        let goal = GoalId::from_number(self.goals);
        let command = Command {
            primitive: primitive.into(),
            args: args.iter().map(|(name, value)| ((*name).into(), value.clone())).collect(),
            uses: ["hand".into()].into(),
            manner: None,
            deadline_secs: 20.0,
            motions: Vec::new(),
            leaves: None,
        };
        self.sim.start(self.now, goal, &command);
        goal
    }

    /// The next report, at most so many seconds from now.
    fn next(&mut self, secs: f64) -> Option<DriverEvent> {
        let until = self.now.after(Time::from_secs(secs));
        let report = self.sim.advance(until);
        self.now = report.as_ref().map_or(until, |(at, _)| *at);
        let event = report.map(|(_, event)| event)?;
        self.log.push(format!("{} {event}", self.now.nanos()));
        Some(event)
    }

    /// Runs a primitive to its end.
    fn call(&mut self, primitive: &str, args: &[(&str, Value)]) -> Outcome {
        let started = self.start(primitive, args);
        while let Some(event) = self.next(600.0) {
            if let DriverEvent::Ended { goal, outcome } = event
                && goal == started
            {
                return outcome;
            }
        }
        panic!("{primitive} does not end");
    }

    #[track_caller]
    fn does(&mut self, primitive: &str, args: &[(&str, Value)]) {
        let outcome = self.call(primitive, args);
        assert!(matches!(outcome, Outcome::Success(_)), "{primitive} {args:?}: {outcome}");
    }

    #[track_caller]
    fn fails(&mut self, primitive: &str, args: &[(&str, Value)], kind: &str) {
        let outcome = self.call(primitive, args);
        let is_kind = matches!(&outcome, Outcome::Failure(failure) if failure.kind == kind);
        assert!(is_kind, "{primitive} {args:?}: {outcome}, not {kind}");
    }

    /// Checks the kind of a failure and words of its text.
    #[track_caller]
    fn says(&mut self, primitive: &str, args: &[(&str, Value)], kind: &str, words: &str) {
        let outcome = self.call(primitive, args);
        let Outcome::Failure(failure) = &outcome else { panic!("{primitive} {args:?}: {outcome}") };
        let text = failure.text.as_deref().unwrap_or_default();
        assert!(failure.kind == kind && text.contains(words), "{primitive}: {} \"{text}\"", failure.kind);
    }

    #[track_caller]
    fn is(&self, fluent: &str, args: &[&str], expected: bool) {
        assert_eq!(self.sim.holds(fluent, args), Some(expected), "{fluent}{args:?}");
    }
}

fn entity(id: &str) -> Value {
    Value::Entity(id.into())
}

fn text(text: &str) -> Value {
    Value::Text(text.into())
}
