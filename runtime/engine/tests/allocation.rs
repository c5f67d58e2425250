//! A steady step allocates nothing: neither a call that ends and the start of the next, nor an idle tick, nor
//! an observation that changes nothing.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "a test fails by panicking")]

use motet_arbitrary::graph::{ReactionSketch, StepSketch, WatchSketch, graph, vocabulary};
use motet_graph::Value;
use motet_runtime::{Answer, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Query, StartState, Time};

fn started(out: &[Effect]) -> Option<GoalId> {
    out.iter().rev().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    })
}

fn begun(steps: &[StepSketch]) -> (Engine, Vec<Effect>) {
    let mut engine = Engine::new(graph(steps), &StartState::default()).unwrap();
    let mut out = Vec::with_capacity(64);
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    (engine, out)
}

#[test]
fn engine_step_of_a_sequence() {
    let (mut engine, mut out) = begun(&vec![StepSketch::say("hello"); 1_000]);
    let mut go_on = |steps: usize| {
        for _ in 0..steps {
            let goal = started(&out).unwrap();
            out.clear();
            let ended = DriverEvent::Ended { goal, outcome: Outcome::Success(None) };
            engine.handle(Time::ZERO, Event::Driver(ended), &mut out);
        }
    };
    go_on(10);
    let allocated = allocation_counter::measure(|| go_on(900));
    assert_eq!(allocated.count_total, 0);
}

#[test]
fn engine_idle_tick_and_a_reading_that_fires_nothing() {
    let watch = WatchSketch::new(vocabulary::nearer("user", 0.5), ReactionSketch::Pause(60.0));
    let (mut engine, mut out) = begun(&[StepSketch::Monitor(vec![watch], vec![StepSketch::go("table")])]);
    let query = Query::Measure { measure: "distance".into(), args: vec![Value::Entity("user".into())] };
    let mut readings: Vec<Event> = (0..100)
        .map(|_| DriverEvent::Observed { query: query.clone(), answer: Answer::Value(Value::Number(2.0)) })
        .map(Event::Driver)
        .collect();
    let mut feed = |readings: &mut Vec<Event>, count: usize| {
        for _ in 0..count {
            out.clear();
            engine.handle(Time::ZERO, Event::Tick, &mut out);
            engine.handle(Time::ZERO, readings.pop().unwrap(), &mut out);
        }
    };
    feed(&mut readings, 10);
    let allocated = allocation_counter::measure(|| feed(&mut readings, 80));
    // What the judge builds to look a measure up, and nothing else.
    assert!(allocated.count_total <= 2 * 80, "{allocated:?}");
}
