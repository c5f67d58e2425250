//! A host of its own: runs a graph with a toy driver, and lets another policy take over in the middle of an
//! action.
//!
//! `cargo run -p motet-runtime --example embed`

#![allow(clippy::print_stdout, reason = "a program for the terminal")]

use motet_arbitrary::graph::{StepSketch, graph};
use motet_runtime::{
    Capabilities, Command, Driver, DriverEvent, Effect, Engine, Event, GoalId, Outcome, PreparedSwap,
    PrimitiveSet, Query, StartState, Time,
};

/// A robot for which everything takes two seconds, and which can go somewhere else on the way.
#[derive(Default)]
struct Toy {
    /// Pending reports in the order of their times.
    reports: Vec<(Time, DriverEvent)>,
}

impl Toy {
    fn report(&mut self, at: Time, event: DriverEvent) {
        let place = self.reports.partition_point(|(other, _)| *other <= at);
        self.reports.insert(place, (at, event));
    }

    fn forget(&mut self, goal: GoalId) {
        self.reports.retain(|(_, event)| event.goal() != Some(goal));
    }

    fn work(&mut self, now: Time, goal: GoalId) {
        let ended = DriverEvent::Ended { goal, outcome: Outcome::Success(None) };
        self.report(now.after(Time::from_secs(2.0)), ended);
    }
}

impl Driver for Toy {
    fn capabilities(&self) -> Capabilities {
        Capabilities { update: PrimitiveSet::Only(["go".into()].into()), ..Capabilities::default() }
    }
    fn start(&mut self, now: Time, goal: GoalId, _command: &Command) {
        self.report(now, DriverEvent::Acknowledged { goal });
        self.work(now, goal);
    }
    fn update(&mut self, now: Time, goal: GoalId, _command: &Command) {
        self.forget(goal);
        self.work(now, goal);
    }
    fn cancel(&mut self, now: Time, goal: GoalId) {
        self.forget(goal);
        self.report(now, DriverEvent::Ended { goal, outcome: Outcome::Interrupted });
    }
    fn safe_stop(&mut self, now: Time, goal: GoalId) {
        self.forget(goal);
        self.report(now, DriverEvent::Stopped { goal });
    }
    fn hold(&mut self, now: Time, goal: GoalId) {
        self.report(now, DriverEvent::NotHeld { goal });
    }
    fn proceed(&mut self, _now: Time, _goal: GoalId) {}
    fn observe(&mut self, now: Time, query: &Query) {
        let answer = motet_runtime::Answer::Unknown;
        self.report(now, DriverEvent::Observed { query: query.clone(), answer });
    }
    fn watch(&mut self, now: Time, query: &Query) {
        self.observe(now, query);
    }
    fn unwatch(&mut self, _now: Time, _query: &Query) {}
    fn advance(&mut self, until: Time) -> Option<(Time, DriverEvent)> {
        let is_due = self.reports.first().is_some_and(|(at, _)| *at <= until);
        is_due.then(|| self.reports.remove(0))
    }
}

/// Prints the effects and hands those that are commands to the driver.
fn carry_out(engine: &Engine, driver: &mut Toy, now: Time, out: &mut Vec<Effect>) {
    for effect in out.drain(..) {
        println!("{:5.1} s  {}", now.secs(), engine.describe(&effect));
        driver.carry_out(now, &effect);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A host gets its graphs from a compiler, by `motet_graph::decode`. These are drawn by hand.
    let first = graph(&[StepSketch::go("table"), StepSketch::say("I am at the table.")]);
    let second = graph(&[StepSketch::go("shelf"), StepSketch::say("I am at the shelf.")]);

    let mut driver = Toy::default();
    let engine = Engine::new(first, &StartState::default()).map_err(|wrong| format!("{wrong:?}"))?;
    let mut engine = engine.with_capabilities(driver.capabilities());
    let mut out = Vec::new();
    let mut now = Time::ZERO;
    engine.handle(now, Event::Begin, &mut out);
    carry_out(&engine, &mut driver, now, &mut out);

    // Prepared at leisure, perhaps on another thread; committed between two events.
    let mut next = Some(PreparedSwap::new(second, &engine.running())?);
    let swap_at = Time::from_secs(1.0);
    while !engine.is_over() {
        let wake = engine.wake_at().unwrap_or(Time::NEVER);
        let until = if next.is_some() { wake.min(swap_at) } else { wake };
        let (at, event) = match driver.advance(until) {
            Some((at, report)) => (at, Event::Driver(report)),
            None => (until, Event::Tick),
        };
        now = at;
        engine.handle(now, event, &mut out);
        if now >= swap_at
            && let Some(prepared) = next.take()
        {
            match engine.swap(now, prepared, &mut out) {
                // What is left behind is freed where it does not matter how long that takes.
                Ok(retired) => drop(retired),
                Err(refusal) => println!("refused: {refusal}"),
            }
        }
        carry_out(&engine, &mut driver, now, &mut out);
    }
    Ok(())
}
