//! Each standard primitive, where it can and where it cannot.

use crate::{Bench, entity, text};
use motet_graph::{Pose, Value};
use motet_runtime::{Outcome, Time};
use motet_sim::{PersonScript, SimOptions};

#[test]
fn sim_fetches_a_mug() {
    let mut bench = Bench::kitchen();
    bench.does("go", &[("to", entity("kitchen_table"))]);
    // 1.8 m to the table's edge at 0.22 m/s, less the room that the base needs.
    assert!((Time::from_secs(5.0)..Time::from_secs(12.0)).contains(&bench.now), "{}", bench.now);
    bench.is("at", &["robot", "kitchen_table"], true);
    bench.is("near", &["kitchen_table"], true);
    let found = bench.call("detect", &[("what", text("the Red_mug"))]);
    assert_eq!(found, Outcome::Success(Some(entity("mug_1"))));
    bench.is("reachable", &["mug_1"], true);
    bench.does("pick", &[("object", entity("mug_1"))]);
    for (fluent, args, holds) in [
        ("holding", &["mug_1"][..], true),
        ("lifted", &["mug_1"], true),
        ("free", &["hand"], false),
        ("on", &["mug_1", "kitchen_table"], false),
    ] {
        bench.is(fluent, args, holds);
    }
    bench.does("go", &[("to", entity("user"))]);
    bench.is("at", &["robot", "user"], true);
    bench.is("at", &["robot", "kitchen_table"], false);
    bench.does("handover", &[("object", entity("mug_1")), ("to", entity("user"))]);
    bench.is("at", &["mug_1", "user"], true);
    bench.is("free", &["hand"], true);
    bench.is("visited", &["kitchen_table"], true);
    bench.is("visited", &["shelf"], false);
}

#[test]
fn sim_everything_on_the_furniture_can_be_taken_and_put_elsewhere() {
    for object in ["mug_1", "apple", "mug_2", "bottle", "coke", "sponge"] {
        let mut bench = Bench::kitchen();
        bench.does("go", &[("to", entity(object))]);
        bench.does("inspect", &[("what", entity(object))]);
        bench.does("pick", &[("object", entity(object))]);
        bench.does("go", &[("to", entity("kitchen_table"))]);
        bench.does("place", &[("object", entity(object)), ("on", entity("kitchen_table"))]);
        bench.is("on", &[object, "kitchen_table"], true);
        bench.is("clear", &["kitchen_table"], false);
        let z = bench.sim.position(object).unwrap()[2];
        assert!((0.72..0.9).contains(&z), "{object} is at {z} m");
        // And again from there.
        bench.does("pick", &[("object", entity(object))]);
    }
}

#[test]
fn sim_drawer_opens_and_closes_about_what_lies_in_it() {
    let mut bench = Bench::kitchen();
    bench.fails("open", &[("what", entity("drawer_1"))], "unreachable");
    bench.does("go", &[("to", entity("mug_1"))]);
    bench.does("pick", &[("object", entity("mug_1"))]);
    bench.does("go", &[("to", entity("drawer_1"))]);
    bench.fails("place", &[("object", entity("mug_1")), ("on", entity("drawer_1"))], "blocked");
    bench.fails("open", &[("what", entity("drawer_1"))], "blocked");
    bench.does("go", &[("to", entity("kitchen_table"))]);
    bench.does("place", &[("object", entity("mug_1")), ("on", entity("kitchen_table"))]);
    bench.does("go", &[("to", entity("drawer_1"))]);
    bench.does("open", &[("what", entity("drawer_1"))]);
    bench.is("open", &["drawer_1"], true);
    bench.does("go", &[("to", entity("mug_1"))]);
    bench.does("pick", &[("object", entity("mug_1"))]);
    bench.does("go", &[("to", entity("drawer_1"))]);
    bench.does("place", &[("object", entity("mug_1")), ("on", entity("drawer_1"))]);
    bench.does("close", &[("what", entity("drawer_1"))]);
    bench.is("in", &["mug_1", "drawer_1"], true);
    bench.is("visible", &["mug_1"], false);
    bench.is("reachable", &["mug_1"], false);
    bench.fails("pick", &[("object", entity("mug_1"))], "blocked");
    bench.fails("inspect", &[("what", entity("mug_1"))], "not_found");
}

#[test]
fn sim_failures_tell_the_truth() {
    let mut bench = Bench::kitchen();
    bench.fails("pick", &[("object", entity("mug_2"))], "unreachable");
    bench.fails("pick", &[("object", entity("unicorn"))], "not_found");
    bench.fails("go", &[("to", entity("unicorn"))], "unreachable");
    bench.does("go", &[("to", entity("mug_1"))]);
    bench.fails("detect", &[("what", text("unicorn"))], "not_found");
    bench.fails("handover", &[("object", entity("mug_1")), ("to", entity("user"))], "slipped");
    bench.does("pick", &[("object", entity("mug_1"))]);
    bench.fails("pick", &[("object", entity("apple"))], "failed");
    bench.fails("place", &[("object", entity("mug_1")), ("on", entity("shelf"))], "unreachable");
    bench.fails("handover", &[("object", entity("mug_1")), ("to", entity("user"))], "unreachable");
}

#[test]
fn sim_looks_for_things_where_it_is_told() {
    let mut bench = Bench::kitchen();
    let found = bench
        .call("search", &[("what", text("water bottle")), ("around", Value::List(vec![entity("counter")]))]);
    assert_eq!(found, Outcome::Success(Some(entity("bottle"))));
    bench.is("at", &["robot", "bottle"], true);
    bench.is("at", &["robot", "counter"], true);
    bench.is("visible", &["bottle"], true);
    let drinks = bench.call("detect_all", &[("what", text("drink"))]);
    assert_eq!(drinks, Outcome::Success(Some(Value::List(vec![entity("bottle"), entity("coke")]))));
    bench.fails("detect", &[("what", text("drink"))], "ambiguous");
    let place = bench.call("locate", &[("object", entity("bottle"))]);
    assert!(matches!(place, Outcome::Success(Some(Value::Pose(pose))) if pose.xyz[2] > 0.9));
}

/// The places of a search in their order: it ends at the first where the thing is.
#[test]
fn sim_looks_at_one_place_after_the_other() {
    let search = |bench: &mut Bench, what: &str, places: &[&str]| {
        let places = places.iter().map(|place| entity(place)).collect();
        bench.call("search", &[("what", text(what)), ("around", Value::List(places))])
    };
    let mut near = Bench::kitchen();
    assert_eq!(search(&mut near, "bottle", &["counter"]), Outcome::Success(Some(entity("bottle"))));
    let mut bench = Bench::kitchen();
    let found = search(&mut bench, "bottle", &["shelf", "counter", "kitchen_table"]);
    assert_eq!(found, Outcome::Success(Some(entity("bottle"))));
    bench.is("at", &["robot", "counter"], true);
    assert!(bench.now > near.now, "{} after the shelf, {} at once", bench.now, near.now);
    for (what, places) in [("a unicorn", &["shelf", "counter"][..]), ("bottle", &[])] {
        let outcome = search(&mut bench, what, places);
        assert!(matches!(&outcome, Outcome::Failure(why) if why.kind == "not_found"), "{what}: {outcome}");
    }
}

#[test]
fn sim_people_answer_from_the_script() {
    let script = PersonScript { answers: vec![Some("tea".into()), Some("blue mug".into()), None] };
    let mut bench = Bench::with(SimOptions { script, ..SimOptions::default() });
    let among = Value::List(vec![entity("mug_1"), entity("mug_2")]);
    let choose = [("question", text("Which?")), ("among", among)];
    let ask = [("question", text("What?"))];
    assert_eq!(bench.call("ask", &ask), Outcome::Success(Some(text("tea"))));
    assert_eq!(bench.call("choose", &choose), Outcome::Success(Some(entity("mug_2"))));
    bench.fails("ask", &ask, "refused");
    assert_eq!(bench.call("choose", &choose), Outcome::Success(Some(entity("mug_1"))));
    bench.does("say", &[("text", text("Here you are."))]);
    assert_eq!(bench.sim.said().last().map(|(_, said)| said.as_str()), Some("Here you are."));
}

#[test]
fn sim_what_it_does_not_know_succeeds() {
    let mut bench = Bench::kitchen();
    assert_eq!(bench.call("stir", &[("what", entity("mug_1"))]), Outcome::Success(None));
    assert!((9.0..11.0).contains(&bench.now.secs()), "{}", bench.now);
    // A primitive of another robot that only has the name of a standard one.
    assert_eq!(bench.call("pick", &[("block", entity("block_a"))]), Outcome::Success(None));
    assert_eq!(bench.sim.holds("stirred", &["mug_1"]), None);
    assert_eq!(bench.sim.holds("on", &["block_a", "block_b"]), None);
}

#[test]
fn sim_what_it_is_told_is_so() {
    let facts = [
        ("holding", &["apple"][..], true),
        ("open", &["drawer_1"], true),
        ("in", &["mug_2", "drawer_1"], true),
        ("on", &["box_1", "counter"], true),
        ("at", &["robot", "counter"], true),
        ("stirred", &["mug_1"], true),
    ];
    let told = facts.iter().map(|(fluent, args, holds)| {
        (((*fluent).into(), args.iter().map(|arg| (*arg).into()).collect()), *holds)
    });
    let options = SimOptions {
        initial_facts: told.collect(),
        entities: vec![("box_1".into(), "Object".into())],
        ..SimOptions::default()
    };
    let bench = Bench::with(options);
    for (fluent, args, holds) in facts {
        bench.is(fluent, args, holds);
    }
    bench.is("on", &["mug_2", "shelf"], false);
    bench.is("on", &["apple", "kitchen_table"], false);
    bench.is("free", &["hand"], false);
}

/// A place by rules, with a step along the table where it has to be.
#[test]
fn sim_puts_things_where_the_rules_allow() {
    let mut bench = Bench::kitchen();
    bench.does("go", &[("to", entity("mug_1"))]);
    let on = ("on", entity("kitchen_table"));
    let gap = |bench: &Bench, other: &str| {
        let [a, b] = ["mug_1", other].map(|id| bench.sim.position(id).unwrap());
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    for (other, radius) in [("apple", 0.038), ("glass_1", 0.035), ("plate", 0.12)] {
        bench.does("pick", &[("object", entity("mug_1"))]);
        bench.does("place", &[("object", entity("mug_1")), on.clone(), ("near", entity(other))]);
        assert!(gap(&bench, other) <= 0.3 + 0.04 + radius, "{other}: {}", gap(&bench, other));
        bench.does("pick", &[("object", entity("mug_1"))]);
        bench.does("place", &[("object", entity("mug_1")), on.clone(), ("beside", entity(other))]);
        let beside = gap(&bench, other) - 0.04 - radius;
        assert!((0.02..=0.15).contains(&beside), "{other}: {beside}");
    }
    bench.does("pick", &[("object", entity("mug_1"))]);
    let far = ("away_from_edge", Value::Number(0.2));
    bench.does("place", &[("object", entity("mug_1")), on.clone(), far]);
    let [x, y, _] = bench.sim.position("mug_1").unwrap();
    assert!((2.04..=2.36).contains(&x) && (0.14..=0.86).contains(&y), "{x} {y}");
    bench.does("pick", &[("object", entity("mug_1"))]);
    bench.fails("place", &[("object", entity("mug_1")), on.clone(), ("near", entity("bottle"))], "blocked");
    bench.fails("place", &[("object", entity("mug_1")), on.clone(), ("beside", entity("coke"))], "blocked");
    bench.is("holding", &["mug_1"], true);
}

#[test]
fn sim_keeps_to_poses() {
    let pose = |x: f64, y: f64, yaw: f64| {
        Value::Pose(Pose { xyz: [x, y, 0.0], quaternion: [0.0, 0.0, (yaw / 2.0).sin(), (yaw / 2.0).cos()] })
    };
    let mut bench = Bench::kitchen();
    bench.fails("go_to_pose", &[("to", pose(2.2, 0.5, 0.0))], "blocked");
    bench.does("go_to_pose", &[("to", pose(1.4, 0.4, 0.3))]);
    let base = bench.sim.base();
    assert!(base.distance_to(1.4, 0.4) < 1e-9 && (base.heading - 0.3).abs() < 1e-9, "{base:?}");
    bench.is("at", &["robot", "kitchen_table"], true);
    bench.does("pick", &[("object", entity("mug_1"))]);
    let put = |x: f64, y: f64| {
        [("object", entity("mug_1")), ("on", entity("kitchen_table")), ("at", pose(x, y, 1.0))]
    };
    bench.fails("place_at", &put(1.0, 0.4), "blocked");
    bench.fails("place_at", &put(1.96, 0.75), "blocked");
    bench.does("place_at", &put(1.9, 0.4));
    let [x, y, _] = bench.sim.position("mug_1").unwrap();
    assert!((x - 1.9).abs() + (y - 0.4).abs() < 1e-9, "{x} {y}");
}
