//! The laws of the driver: cancel, hold, safe stop, watches, and the same run for the same seed.

use crate::{Bench, entity};
use motet_graph::Value;
use motet_runtime::{Answer, Driver, DriverEvent, Moved, Outcome, Pattern, Query, Time};
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

#[test]
fn sim_telemetry_says_what_has_moved_at_most_fifty_times_a_second() {
    let mut bench = Bench::kitchen();
    assert!(bench.sim.capabilities().moved);
    let first = bench.sim.telemetry().unwrap();
    let at =
        |moved: &Moved, id: &str| moved.things.iter().find(|thing| thing.id == id).map(|thing| thing.xyz);
    assert_eq!(at(&first, "mug_1"), bench.sim.position("mug_1"), "the first report has all things");
    assert_eq!(bench.sim.telemetry(), None, "nothing has moved");
    bench.start("go", &[("to", entity("kitchen_table"))]);
    let (mut last, mut count) = (first, 0);
    for step in 1..=200 {
        let now = Time::from_secs(f64::from(step) * 0.005);
        while bench.sim.advance(now).is_some() {}
        while let Some(moved) = bench.sim.telemetry() {
            assert!(moved.at.since(last.at) >= Time::from_secs(0.02), "{moved:?} after {last:?}");
            assert_ne!(moved.base, last.base);
            assert_eq!(moved.things, [], "the robot carries nothing");
            (last, count) = (moved, count + 1);
        }
    }
    assert!((40..=50).contains(&count), "{count} reports in a second");
    bench.now = bench.sim.now();
    while !matches!(bench.next(600.0), Some(DriverEvent::Ended { .. })) {}
    bench.does("pick", &[("object", entity("mug_1"))]);
    bench.does("go", &[("to", entity("counter"))]);
    let carried = bench.sim.telemetry().unwrap();
    assert_eq!(at(&carried, "mug_1"), bench.sim.position("mug_1"));
    assert_eq!(at(&carried, "kitchen_table"), None);
    assert_eq!(Some(carried.base), Driver::base(&bench.sim));
}
