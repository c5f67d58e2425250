//! The world as it is against what the robot was told: what stands in the way stops it, what is hidden is not
//! seen, and what is not where it was believed to be is not found there.

use crate::{Bench, entity, robot, scene, text};
use motet_graph::{Pose, Value};
use motet_robots::card::CameraMount;
use motet_robots::{builtin, scene::Scene};
use motet_runtime::{Answer, Driver, DriverEvent, Outcome, Pattern, Query, Time};
use motet_sim::{Faults, Sim, SimOptions};

/// The HSR in a room of which it was told something else.
fn in_world(told: &Scene, real: Scene, faults: &str) -> Bench {
    let faults = Faults::from_json(faults).unwrap();
    let options = SimOptions { world: Some(real), faults, ..SimOptions::default() };
    Bench::of(Sim::new(&robot("hsr"), told, options))
}

fn kitchen() -> Scene {
    builtin::scene("kitchen").unwrap()
}

fn moved(mut room: Scene, id: &str, xyz: [f64; 3]) -> Scene {
    let entity = &mut room.entities[id];
    (entity.on, entity.inside) = (None, None);
    entity.pose.as_mut().unwrap().xyz = xyz;
    room
}

/// A room with walls: id, middle and extents.
fn walled(walls: &[(&str, [f64; 2], [f64; 2])], more: &str) -> Scene {
    let wall = |(id, [x, y], [a, b]): &(&str, [f64; 2], [f64; 2])| {
        format!(
            r#"{{"id": "{id}", "kind": "Surface", "pose": {{"xyz": [{x}, {y}, 1]}}, "fixed": true,
                "shape": {{"box": [{a}, {b}, 2]}}}}"#
        )
    };
    let walls: Vec<String> = walls.iter().map(wall).collect();
    scene(&format!(
        r#"{{"motet_scene": 1, "robot": {{"base": [0, 0, 0]}}, "entities": [{}, {more}]}}"#,
        walls.join(", ")
    ))
}

const RING: &[(&str, [f64; 2], [f64; 2])] = &[
    ("wall_east", [1.0, 0.0], [0.1, 2.1]),
    ("wall_west", [-1.0, 0.0], [0.1, 2.1]),
    ("wall_north", [0.0, 1.0], [2.1, 0.1]),
    ("wall_south", [0.0, -1.0], [2.1, 0.1]),
];
const TABLE: &str = r#"{"id": "table", "kind": "Surface", "pose": {"xyz": [3, 0, 0.36]}, "fixed": true,
    "shape": {"box": [0.8, 0.8, 0.72]}}"#;
const BALL: &str = r#"{"id": "ball", "kind": "Object", "names": ["red ball"], "pose": {"xyz": [3, 0, 0.8]},
    "shape": {"sphere": {"radius": 0.08}}, "on": "table"}"#;

#[test]
fn world_ring_of_walls_keeps_the_robot_in() {
    let ring = walled(RING, TABLE);
    let mut bench = Bench::of(Sim::new(&robot("hsr"), &ring, SimOptions::default()));
    bench.says("go", &[("to", entity("table"))], "blocked", "wall");
    assert!(bench.sim.base().distance_to(0.0, 0.0) < 0.8);
    // A wall that nobody told of is met on the way.
    let open = walled(&RING[1..], TABLE);
    let mut bench = in_world(&open, ring, "{}");
    bench.says("go", &[("to", entity("table"))], "blocked", "the wall east");
    let base = bench.sim.base();
    assert!((0.6..0.75).contains(&base.x), "{base:?}");
    // It has felt the wall, and knows now that there is no way.
    bench.says("go", &[("to", entity("table"))], "blocked", "wall");
    assert_eq!(bench.sim.base(), base);
}

#[test]
fn world_robot_goes_round_what_it_knows() {
    let screen = walled(&[("screen", [1.5, 0.0], [0.1, 1.0])], TABLE);
    let mut bench = Bench::of(Sim::new(&robot("hsr"), &screen, SimOptions::default()));
    bench.does("go", &[("to", entity("table"))]);
    bench.is("at", &["robot", "table"], true);
}

#[test]
fn world_can_that_is_elsewhere_is_not_found() {
    for (at, is_far) in [([25.0, -2.0], true), ([1.1, -2.3], false)] {
        let real = moved(kitchen(), "coke", [at[0], at[1], 0.961]);
        let mut bench = in_world(&kitchen(), real, "{}");
        let coke = [("object", entity("coke"))];
        bench.does("go", &[("to", entity("coke"))]);
        // It went to where the can was told to be.
        assert!(bench.sim.base().distance_to(1.1, -2.0) < 1.0, "{:?}", bench.sim.base());
        if !is_far {
            bench.does("pick", &coke);
            continue;
        }
        bench.fails("detect", &[("what", text("coke can"))], "not_found");
        bench.says("pick", &coke, "not_found", "the coke can is not where it was believed to be");
        bench.says("inspect", &[("what", entity("coke"))], "not_found", "the coke can");
        assert_eq!(bench.sim.believed_position("coke"), None);
        bench.sim.observe(bench.now, &on("coke", "counter"));
        let observed = DriverEvent::Observed { query: on("coke", "counter"), answer: Answer::Truth(false) };
        assert_eq!(bench.next(1.0), Some(observed));
    }
}

fn on(id: &str, support: &str) -> Query {
    Query::Fact { fluent: "on".into(), args: vec![Pattern::Is(entity(id)), Pattern::Is(entity(support))] }
}

#[test]
fn world_belief_changes_by_sight_alone() {
    let steals = r#"{"world": [
        {"at": 1, "what": {"moves": {"object": "mug_2", "to": {"container": "fridge_1"}}}},
        {"at": 1, "what": {"moves": {"object": "mug_1", "to": {"surface": "sink"}}}}]}"#;
    let mut bench = in_world(&kitchen(), kitchen(), steals);
    bench.next(2.0);
    let seen = |bench: &mut Bench, id: &str, support: &str| {
        bench.sim.observe(bench.now, &on(id, support));
        matches!(bench.next(1.0), Some(DriverEvent::Observed { answer: Answer::Truth(true), .. }))
    };
    bench.is("on", &["mug_2", "shelf"], false);
    assert!(seen(&mut bench, "mug_2", "shelf"), "the shelf is behind the robot");
    assert!(!seen(&mut bench, "mug_1", "kitchen_table"), "the table is before it");
    assert!(seen(&mut bench, "mug_1", "sink"), "and so is the sink");
    bench.does("go", &[("to", entity("shelf"))]);
    assert!(!seen(&mut bench, "mug_2", "shelf"));
}

#[test]
fn world_thing_behind_a_screen_is_not_seen() {
    let room = |wide: f64| walled(&[("screen", [1.5, 0.0], [0.1, wide])], &format!("{TABLE}, {BALL}"));
    let ball = [("what", text("red ball"))];
    let visible = Query::Fact { fluent: "visible".into(), args: vec![Pattern::Is(entity("ball"))] };
    for (wide, is_seen) in [(1.0, false), (0.02, true)] {
        let mut bench = Bench::of(Sim::new(&robot("hsr"), &room(wide), SimOptions::default()));
        assert_eq!(matches!(bench.call("detect", &ball), Outcome::Success(_)), is_seen, "{wide} m");
        let seen = bench.sim.detections(bench.now);
        let found = seen.iter().find(|seen| seen.entity.as_deref() == Some("ball"));
        assert_eq!(found.is_some(), is_seen, "{wide} m");
        assert!(found.is_none_or(|ball| (0.3..=1.0).contains(&ball.confidence)), "{found:?}");
        bench.sim.observe(bench.now, &visible);
        let answer = Answer::Truth(is_seen);
        assert_eq!(bench.next(1.0), Some(DriverEvent::Observed { query: visible.clone(), answer }));
        // From behind the screen it is seen.
        bench.does("go", &[("to", entity("table"))]);
        bench.does("detect", &ball);
    }
}

#[test]
fn world_hand_closes_where_it_is_told() {
    let pose = |xyz: [f64; 3]| Value::Pose(Pose { xyz, quaternion: [0.0, 0.0, 0.0, 1.0] });
    let mut bench = Bench::kitchen();
    bench.does("go", &[("to", entity("mug_1"))]);
    let mut grasp = |at: Value, why: Option<(&str, &str)>| {
        let args = [("object", entity("mug_1")), ("at", at)];
        match why {
            Some((kind, words)) => bench.says("grasp", &args, kind, words),
            None => bench.does("grasp", &args),
        }
    };
    let base = [2.6, 0.0, 0.0];
    grasp(pose(base), Some(("unreachable", "the hand reaches 0.60 m")));
    grasp(pose([1.75, 0.3, 0.4]), Some(("not_found", "beside the red mug")));
    grasp(pose([1.98, 0.3, 0.8]), None);
    bench.is("holding", &["mug_1"], true);
}

#[test]
fn world_answer_can_change_the_room() {
    let faults = r#"{"world": [{"after_answer": 1, "at": 2, "what": {"opens": "drawer_1"}}]}"#;
    let mut bench = Bench::faulty(faults);
    bench.next(30.0);
    bench.is("open", &["drawer_1"], false);
    bench.does("ask", &[("question", text("May I?"))]);
    bench.is("open", &["drawer_1"], false);
    bench.next(2.5);
    bench.is("open", &["drawer_1"], true);
}

#[test]
fn world_base_stops_before_what_walks_into_its_way() {
    let crosses = r#"{"world": [{"at": 2, "what": {"walks":
        {"person": "user", "from": [1.2, 1.6], "to": [1.2, 0.1], "speed": 0.6}}}]}"#;
    let mut bench = Bench::faulty(crosses);
    bench.says("go", &[("to", entity("kitchen_table"))], "blocked", "`user`");
    let [x, y, _] = bench.sim.position("user").unwrap();
    assert!(bench.sim.base().distance_to(x, y) > 0.5);
    assert!(bench.now < Time::from_secs(12.0), "{}", bench.now);
}

/// A ball in front of the HSR, which was told of it elsewhere and looks ahead.
fn before_camera(tilt: [f64; 2], told: [f64; 3], real: [f64; 3]) -> Bench {
    let room = |[x, y, z]: [f64; 3]| {
        scene(&format!(
            r#"{{"motet_scene": 1, "robot": {{"base": [0, 0, 0]}}, "entities": [
            {{"id": "ball", "kind": "Object", "names": ["red ball"], "pose": {{"xyz": [{x}, {y}, {z}]}},
                "shape": {{"sphere": {{"radius": 0.05}}}}}}]}}"#
        ))
    };
    let eye = Some(CameraMount { tilt, ..CameraMount::free([0.1, 0.0, 1.0]) });
    let options = SimOptions { world: Some(room(real)), eye, ..SimOptions::default() };
    Bench::of(Sim::new(&robot("hsr"), &room(told), options))
}

#[test]
fn world_camera_sees_no_higher_and_lower_than_it_tilts() {
    for (at, tilt, is_seen) in [
        ([0.6, 0.0, 0.05], [-1.57, 0.52], true),
        ([0.6, 0.0, 0.05], [-0.3, 0.52], false),
        ([0.6, 0.0, 1.45], [-1.57, 0.52], true),
        ([0.6, 0.0, 2.0], [-1.57, 0.52], false),
        ([2.6, 0.0, 2.0], [-1.57, 0.52], true),
    ] {
        let mut bench = before_camera(tilt, at, at);
        for (primitive, what) in
            [("detect", ("what", text("red ball"))), ("inspect", ("what", entity("ball")))]
        {
            let found = bench.call(primitive, &[what]);
            assert_eq!(matches!(found, Outcome::Success(_)), is_seen, "{at:?} with {tilt:?}: {found}");
        }
        bench.is("visible", &["ball"], is_seen);
        assert_eq!(bench.sim.detections(bench.now).len(), usize::from(is_seen), "{at:?} with {tilt:?}");
    }
}

#[test]
fn world_robot_notices_by_the_way_what_is_in_the_picture_alone() {
    // Told to be behind the robot. Another goal ends, with the camera level.
    for (at, is_noticed) in [([1.5, 0.0, 0.7], true), ([0.6, 0.0, 0.05], false), ([0.4, 1.2, 1.0], false)] {
        let mut bench = before_camera([-1.57, 0.52], [-2.0, 0.0, 0.5], at);
        let believed = |bench: &Bench| bench.sim.believed_position("ball").unwrap();
        bench.does("say", &[("text", text("hello"))]);
        assert_eq!(believed(&bench) == at, is_noticed, "{at:?}");
        // A look turns the camera to it.
        bench.does("detect", &[("what", text("red ball"))]);
        assert_eq!(believed(&bench), at);
    }
}
