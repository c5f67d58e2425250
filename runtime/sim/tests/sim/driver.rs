//! The laws of the driver: cancel, hold, safe stop, watches, and the same run for the same seed.

use crate::{Bench, entity};
use motet_graph::Value;
use motet_runtime::{Answer, Driver, DriverEvent, Outcome, Pattern, Query, Time};
use motet_sim::SimOptions;

fn distance() -> Query {
    Query::Measure { measure: "distance".into(), args: vec![entity("kitchen_table")] }
}

fn reading(event: Option<DriverEvent>) -> f64 {
    match event {
        Some(DriverEvent::Observed { answer: Answer::Value(Value::Number(number)), .. }) => number,
        other => panic!("{other:?}"),
    }
}

#[test]
fn sim_watch_follows_the_base() {
    let mut bench = Bench::kitchen();
    bench.sim.watch(bench.now, &distance());
    let first = reading(bench.next(1.0));
    bench.sim.watch(bench.now, &distance());
    assert_eq!(bench.next(1.0), None, "watching twice is watching once");
    bench.start("go", &[("to", entity("kitchen_table"))]);
    assert!(matches!(bench.next(1.0), Some(DriverEvent::Acknowledged { .. })));
    let second = reading(bench.next(1.0));
    let third = reading(bench.next(1.0));
    assert!(first > second && second > third, "{first} {second} {third}");
    bench.sim.unwatch(bench.now, &distance());
    assert!(matches!(bench.next(60.0), Some(DriverEvent::Ended { .. })));
    assert_eq!(bench.next(60.0), None);
}

#[test]
fn sim_observation_is_answered_once() {
    let mut bench = Bench::kitchen();
    let holding = Query::Fact { fluent: "holding".into(), args: vec![Pattern::Any] };
    let unknown = Query::Fact { fluent: "stirred".into(), args: vec![Pattern::Is(entity("mug_1"))] };
    for (query, expected) in [(holding, Answer::Truth(false)), (unknown, Answer::Unknown)] {
        bench.sim.observe(bench.now, &query);
        assert_eq!(bench.next(1.0), Some(DriverEvent::Observed { query, answer: expected }));
        assert_eq!(bench.next(1.0), None);
    }
}

#[test]
fn sim_cancelled_drive_stops_where_it_is() {
    let mut bench = Bench::kitchen();
    let goal = bench.start("go", &[("to", entity("kitchen_table"))]);
    bench.next(1.0);
    assert_eq!(bench.next(3.0), None);
    bench.sim.cancel(bench.now, goal);
    assert_eq!(bench.next(1.0), Some(DriverEvent::Ended { goal, outcome: Outcome::Interrupted }));
    let stance = bench.sim.base();
    assert!((stance.x.hypot(stance.y) - 0.66).abs() < 1e-6, "{stance:?}");
    bench.sim.cancel(bench.now, goal);
    assert_eq!(bench.next(60.0), None);
    assert_eq!(bench.sim.base(), stance);
    bench.sim.safe_stop(bench.now, goal);
    assert_eq!(bench.next(1.0), Some(DriverEvent::Stopped { goal }));
}

#[test]
fn sim_held_goal_waits() {
    for (primitive, args) in
        [("go", [("to", entity("kitchen_table"))]), ("stir", [("what", entity("mug_1"))])]
    {
        let plain = {
            let mut bench = Bench::kitchen();
            bench.call(primitive, &args);
            bench.now
        };
        let mut bench = Bench::kitchen();
        let goal = bench.start(primitive, &args);
        bench.next(1.0);
        assert_eq!(bench.next(2.0), None);
        bench.sim.hold(bench.now, goal);
        assert_eq!(bench.next(60.0), None);
        bench.sim.proceed(bench.now, goal);
        assert!(matches!(bench.next(60.0), Some(DriverEvent::Ended { .. })));
        assert_eq!(bench.now, plain.after(Time::from_secs(60.0)), "{primitive}");
    }
}

#[test]
fn sim_seed_decides_all() {
    let run = |seed| {
        let mut bench = Bench::with(SimOptions { seed, ..SimOptions::default() });
        bench.sim.watch(bench.now, &distance());
        bench.does("go", &[("to", entity("mug_1"))]);
        bench.does("pick", &[("object", entity("mug_1"))]);
        bench.log
    };
    assert_eq!(run(7), run(7));
    assert_ne!(run(7), run(8));
}
