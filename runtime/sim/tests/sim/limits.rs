//! What the robots' cards say that they can, and what rooms and people ask of them.

use crate::{Bench, entity, sim, text};
use motet_graph::Value;
use motet_runtime::{Answer, Driver, DriverEvent, Outcome, Query};
use motet_sim::SimOptions;

/// The ANYmal in the lab, on its feet.
fn walker() -> Bench {
    let mut bench = Bench::of(sim("anymal_z1", "lab", SimOptions::default()));
    bench.is("standing", &["robot"], false);
    bench.is("arm_home", &["robot"], true);
    bench.does("wake_up", &[]);
    bench.is("standing", &["robot"], true);
    bench
}

#[test]
fn sim_arm_has_postures() {
    let mut bench = walker();
    let mut posture = |primitive: &str, args: &[(&str, Value)], holds: [bool; 3]| {
        bench.does(primitive, args);
        for (fluent, holds) in ["arm_home", "arm_ready", "arm_carry"].into_iter().zip(holds) {
            bench.is(fluent, &["robot"], holds);
        }
    };
    let tool = [("object", entity("screwdriver"))];
    posture("go", &[("to", entity("workbench"))], [true, false, false]);
    posture("start_pose", &[], [false, true, false]);
    posture("detect", &[("what", text("screwdriver"))], [false, true, false]);
    posture("pick", &tool, [false, false, false]);
    posture("lift", &[("by", Value::Number(0.1))], [false, false, true]);
    posture("home", &[], [true, false, false]);
}

#[test]
fn sim_hand_carries_only_so_much() {
    let mut bench = Bench::of(sim("hsr", "lab", SimOptions::default()));
    bench.does("go", &[("to", entity("vise"))]);
    bench.is("reachable", &["vise"], false);
    bench.fails("pick", &[("object", entity("vise"))], "too_heavy");
    bench.is("on", &["vise", "workbench"], true);
}

#[test]
fn sim_what_is_locked_stays_shut() {
    let mut bench = Bench::faulty(r#"{"world": [{"at": 0, "what": {"locks": "drawer_1"}}]}"#);
    bench.does("go", &[("to", entity("drawer_1"))]);
    bench.is("locked", &["drawer_1"], true);
    bench.fails("open", &[("what", entity("drawer_1"))], "refused");
    bench.is("open", &["drawer_1"], false);
}

#[test]
fn sim_person_is_served_from_more_than_half_a_metre() {
    for (robot, room, rim) in [("hsr", "kitchen", 0.23), ("anymal_z1", "lab", 0.55)] {
        let mut bench = Bench::of(sim(robot, room, SimOptions::default()));
        bench.does("go", &[("to", entity("user"))]);
        bench.is("at", &["robot", "user"], true);
        let [x, y, _] = bench.sim.position("user").unwrap();
        let gap = bench.sim.base().distance_to(x, y) - rim - 0.3;
        assert!((0.5..0.7).contains(&gap), "{robot} stands {gap} m from the user");
    }
}

#[test]
fn sim_only_what_the_card_lists_is_observed() {
    for (robot, room, known) in [("hsr", "kitchen", true), ("anymal_z1", "lab", false)] {
        let mut bench = Bench::of(sim(robot, room, SimOptions::default()));
        let force = Query::Measure { measure: "force".into(), args: Vec::new() };
        bench.sim.observe(bench.now, &force);
        let Some(DriverEvent::Observed { answer, .. }) = bench.next(1.0) else { panic!("no answer") };
        assert_eq!(answer != Answer::Unknown, known, "{robot}");
    }
}

#[test]
fn sim_refusal_ends_a_call_before_it_begins() {
    let mut bench = Bench::faulty(r#"{"calls": [{"primitive": "home", "then": {"refuses": "unsafe"}}]}"#);
    let goal = bench.start("home", &[]);
    let refused = DriverEvent::Refused { goal, failure: "unsafe".into() };
    assert_eq!(bench.next(60.0), Some(refused));
    assert_eq!(bench.next(60.0), None);
    assert_eq!(bench.call("start_pose", &[]), Outcome::Success(None));
}
