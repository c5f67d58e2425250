//! What goes wrong when it shall.

use crate::{Bench, entity};
use motet_runtime::{Driver, DriverEvent, Outcome};

#[test]
fn faults_nth_call_fails() {
    let mut bench = Bench::faulty(
        r#"{"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": "slipped"}},
                      {"primitive": "pick", "nth": 3, "then": {"refuses": "unsafe"}}]}"#,
    );
    let mug = [("object", entity("mug_1"))];
    bench.does("go", &[("to", entity("mug_1"))]);
    bench.fails("pick", &mug, "slipped");
    bench.is("on", &["mug_1", "kitchen_table"], true);
    bench.does("pick", &mug);
    let goal = bench.start("pick", &mug);
    assert_eq!(bench.next(1.0), Some(DriverEvent::Refused { goal, failure: "unsafe".into() }));
}

#[test]
fn faults_call_is_slow_or_hangs() {
    let mut bench = Bench::kitchen();
    bench.does("go", &[("to", entity("mug_1"))]);
    let plain = bench.now;
    let mut bench = Bench::faulty(
        r#"{"calls": [{"primitive": "go", "then": {"slower": 2}}, {"primitive": "home", "then": "hangs"}]}"#,
    );
    bench.does("go", &[("to", entity("mug_1"))]);
    assert!((bench.now.secs() - 2.0 * plain.secs()).abs() < 1e-6);
    let goal = bench.start("home", &[]);
    assert_eq!(bench.next(1.0), Some(DriverEvent::Acknowledged { goal }));
    assert_eq!(bench.next(1e6), None);
    bench.sim.cancel(bench.now, goal);
    assert_eq!(bench.next(1.0), Some(DriverEvent::Ended { goal, outcome: Outcome::Interrupted }));
}

#[test]
fn faults_world_changes_by_itself() {
    let mut bench = Bench::faulty(
        r#"{"world": [{"at": 30, "what": {"slips": "mug_1"}},
                      {"at": 60, "what": {"moves": {"object": "mug_2", "to": {"surface": "counter"}}}},
                      {"at": 60, "what": {"opens": "drawer_1"}},
                      {"at": 60, "what": {"battery": 0.2}},
                      {"at": 61, "what": {"closes": "drawer_1"}},
                      {"at": 61, "what": {"moves": {"object": "apple", "to": {"container": "fridge_1"}}}}]}"#,
    );
    bench.does("go", &[("to", entity("mug_1"))]);
    bench.does("pick", &[("object", entity("mug_1"))]);
    assert!(bench.now.secs() < 30.0);
    bench.next(30.5 - bench.now.secs());
    bench.is("holding", &["mug_1"], false);
    assert!(bench.sim.position("mug_1").unwrap()[2] < 0.1);
    bench.is("open", &["drawer_1"], false);
    let closed = bench.sim.position("drawer_1");
    bench.next(60.5 - bench.now.secs());
    bench.is("on", &["mug_2", "counter"], true);
    bench.is("open", &["drawer_1"], true);
    bench.next(1.0);
    bench.is("open", &["drawer_1"], false);
    let (closed, again) = (closed.unwrap(), bench.sim.position("drawer_1").unwrap());
    assert!(closed.iter().zip(again).all(|(a, b)| (a - b).abs() < 1e-9));
    bench.is("in", &["apple", "fridge_1"], true);
    // Nobody saw that: the apple is looked for where it was.
    bench.fails("pick", &[("object", entity("apple"))], "not_found");
    // It fell to the floor before the robot, and can be picked up again.
    bench.does("pick", &[("object", entity("mug_1"))]);
}

#[test]
fn faults_person_walks_away_and_is_followed() {
    let mut bench = Bench::faulty(
        r#"{"world": [{"at": 1, "what": {"walks": {"person": "user", "to": [-1.0, 0.0], "speed": 0.2}}}]}"#,
    );
    bench.does("go", &[("to", entity("user"))]);
    bench.is("at", &["robot", "user"], true);
    assert!(bench.sim.position("user").unwrap()[1] < 2.4);
}
