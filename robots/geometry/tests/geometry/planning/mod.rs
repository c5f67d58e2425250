//! Motion queries: what is feasible holds under an independent check, and what is infeasible says why.

mod clearance;
mod help;
mod narrow;
mod opening;
mod placing;
mod timing;
mod verify;

use std::collections::BTreeMap;

use motet_geometry::planning::{
    AllowedCollisions, Configuration, ContactShare, GraspSide, InfeasibleReason, MotionAnswer, MotionQuery,
    QueryContext, ReachLength, RobotModel, SceneState, SearchBudget, UnknownReason,
};
use motet_robots::builtin::{self, BuiltinRobot, ROBOTS, RobotWithBody};
use motet_robots::scene::{self, Placement, Scene};
use motet_robots::urdf::Urdf;
use motet_syntax::ast::ExprKind;
use motet_syntax::print;
use motet_syntax::text::parse_condition;
use proptest::prelude::*;

/// A query as its display shows it, such as `reach(mug_1, top)`.
fn motion_query(text: &str) -> MotionQuery {
    let ExprKind::Call(call) = parse_condition(text).unwrap().kind else { panic!("{text}") };
    let names: Vec<_> = call.args.iter().map(|arg| print::expression(&arg.value)).collect();
    let side = names.get(1).and_then(|name| GraspSide::from_name(name));
    let ids = names.iter().take(names.len() - usize::from(side.is_some()));
    MotionQuery::from_call(&call.name.text, ids, side).unwrap()
}

fn model(name: &str) -> (RobotModel, Urdf) {
    let RobotWithBody { robot, urdf } = builtin::robot(name).unwrap();
    (RobotModel::new(&robot, &urdf), urdf)
}

/// Pose of a placement in a scene.
fn isometry_of(placement: &Placement) -> nalgebra::Isometry3<f64> {
    let [roll, pitch, yaw] = placement.rpy;
    let rotation = nalgebra::UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    nalgebra::Isometry3::from_parts(placement.xyz.into(), rotation)
}

/// No clearance beyond the padding of every check.
fn bare(mut scene: Scene) -> Scene {
    let none = Some(0.0);
    scene.clearance = motet_robots::clearance::ClearanceOverride { base_m: none, arm_m: none };
    scene
}

fn embedded(name: &str) -> Scene {
    builtin::scene(name).unwrap()
}

#[test]
fn postures_have_no_contact() {
    for BuiltinRobot { name, .. } in ROBOTS {
        let (model, _) = model(name);
        assert!(model.body().uncovered_links().is_empty());
        let scene = Scene::default();
        let mut state = SceneState::new(&model, &scene);
        for posture in model.card().postures.keys() {
            state.robot.joints = model.posture(posture, model.rest()).unwrap();
            let context = QueryContext::new(&model, &scene, &state);
            assert_eq!(
                context.contact(&state.robot, AllowedCollisions::default()),
                None,
                "{name}, {posture}"
            );
        }
    }
}

/// Answers for every entity of a scene, by query; each feasible one is verified.
fn all(robot: &str, scene: &str) -> BTreeMap<String, MotionAnswer> {
    let ((model, urdf), scene) = (model(robot), embedded(scene));
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let mut answers = BTreeMap::new();
    for (id, entity) in &scene.entities {
        let reach = (entity.kind == "Object").then(|| MotionQuery::Reach(id.clone(), None));
        for query in [MotionQuery::GoTo(id.clone())].into_iter().chain(reach) {
            let answer = context.answer(&query, SearchBudget { candidates: 128, ..SearchBudget::default() });
            if let MotionAnswer::Feasible(witness) = &answer {
                let faults = verify::faults(&model, &urdf, &scene, &state, witness, None);
                assert!(faults.is_empty(), "{robot}, {query}: {:?}", &faults[..faults.len().min(5)]);
            }
            answers.insert(query.to_string(), answer);
        }
    }
    answers
}

#[test]
fn reach_and_go_to_of_the_hsr_in_the_kitchen() {
    let answers = all("hsr", "kitchen");
    let is_feasible = |query: &str| matches!(answers[query], MotionAnswer::Feasible(_));
    for object in ["mug_1", "apple", "glass_1", "mug_2", "bottle", "coke"] {
        assert!(
            is_feasible(&format!("reach({object})")),
            "{object}: {:?}",
            answers[&format!("reach({object})")]
        );
    }
    assert!(
        answers.iter().filter(|(query, _)| query.starts_with("go_to")).all(|(query, _)| is_feasible(query))
    );
    // It lies flat: between it and the table there is no room for a finger.
    let MotionAnswer::Infeasible(why) = &answers["reach(plate)"] else { panic!("{answers:?}") };
    let InfeasibleReason::NoFreePose { by: Some(by), share: Some(share) } = &why.reason else {
        panic!("{why:?}")
    };
    assert_eq!(by, "kitchen_table");
    assert!(share.touching > share.tried / 2 && share.touching <= share.tried, "{share:?}");
    assert!(why.certified);
}

#[test]
fn reach_of_the_panda_at_the_workbench() {
    let (model, urdf) = model("panda");
    let mut scene = embedded("lab");
    scene.robot.base = [1.45, 0.8, 0.0];
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let MotionAnswer::Feasible(witness) =
        context.answer(&MotionQuery::Reach("beaker".into(), None), SearchBudget::default())
    else {
        panic!("the beaker")
    };
    let faults = verify::faults(&model, &urdf, &scene, &state, &witness, None);
    assert!(faults.is_empty(), "{:?}", &faults[..faults.len().min(5)]);
    // It stands on another bench.
    let (why, certified) =
        reason(context.answer(&MotionQuery::Reach("sample".into(), None), SearchBudget::default()));
    assert!(
        matches!(why, InfeasibleReason::OutOfReach { length: ReachLength::Distance, .. }) && certified,
        "{why:?}"
    );
}

#[test]
fn reach_and_go_to_of_the_anymal_in_the_living_room() {
    let answers = all("anymal_z1", "living_room");
    let mut drives = answers.iter().filter(|(query, _)| query.starts_with("go_to"));
    assert!(drives.all(|(_, answer)| matches!(answer, MotionAnswer::Feasible(_))));
    for query in ["reach(book)", "reach(bottle_1)", "reach(cup)"] {
        assert!(matches!(answers[query], MotionAnswer::Feasible(_)), "{query}: {:?}", answers[query]);
    }
}

fn changed(change: impl FnOnce(&mut Scene)) -> Scene {
    let mut scene = embedded("kitchen");
    change(&mut scene);
    scene
}

fn ask(scene: &Scene, query: &str) -> MotionAnswer {
    let (model, _) = model("hsr");
    let state = SceneState::new(&model, scene);
    let context = QueryContext::new(&model, scene, &state);
    let query = motion_query(query);
    let answer = context.answer(&query, SearchBudget::default());
    assert_eq!(context.answer(&query, SearchBudget::default()), answer);
    answer
}

fn reason(answer: MotionAnswer) -> (InfeasibleReason, bool) {
    let MotionAnswer::Infeasible(why) = answer else { panic!("{answer:?}") };
    (why.reason, why.certified)
}

/// A batch finds a contact exactly where a single check does, if not the same one.
#[test]
fn contacts_of_a_batch_equal_single_contacts() {
    let ((model, _), scene) = (model("hsr"), embedded("kitchen"));
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let dofs = model.tree().dofs();
    let states: Vec<Configuration> = (0..203)
        .map(|at| {
            let turn = f64::from(at) * 2.4;
            let base = [2.0 * turn.cos() * f64::from(at % 7) / 6.0, 2.0 * turn.sin(), turn];
            Configuration { base, joints: motet_geometry::kinematics::quasi_random(dofs, at as usize) }
        })
        .collect();
    let together = context.contacts(&states, AllowedCollisions::default());
    let alone: Vec<bool> =
        states.iter().map(|state| context.contact(state, AllowedCollisions::default()).is_some()).collect();
    assert_eq!(together.iter().map(Option::is_some).collect::<Vec<_>>(), alone);
    assert!(alone.contains(&true) && alone.contains(&false));
}

#[test]
fn infeasible_answers_give_the_reason() {
    let heavy = changed(|scene| scene.entities["mug_1"].mass_kg = Some(2.0));
    assert_eq!(
        reason(ask(&heavy, "reach(mug_1)")),
        (InfeasibleReason::TooHeavy { needs: 2.0, limit: 1.2 }, true)
    );
    let wide =
        changed(|scene| scene.entities["apple"].shape = Some(scene::EntityShape::Sphere { radius: 0.1 }));
    assert_eq!(
        reason(ask(&wide, "reach(apple)")),
        (InfeasibleReason::TooWide { needs: 0.2, limit: 0.13 }, true)
    );
    let high = changed(|scene| scene.entities["apple"].pose.as_mut().unwrap().xyz[2] = 2.5);
    let (why, certified) = reason(ask(&high, "reach(apple)"));
    assert!(
        matches!(why, InfeasibleReason::OutOfReach { length: ReachLength::Height, needs: 2.5, .. })
            && certified,
        "{why:?}"
    );
    // A wall around the robot, higher than it.
    let walled = changed(|scene| {
        for (at, (x, y)) in [(1.1, 0.0), (-1.1, 0.0), (0.0, 1.1), (0.0, -1.1)].into_iter().enumerate() {
            let mut wall = scene.entities["shelf"].clone();
            wall.id = format!("wall_{at}").into();
            wall.pose.as_mut().unwrap().xyz = [x, y, 1.0];
            wall.shape = Some(scene::EntityShape::Box([0.1 + 2.2 * y.abs(), 0.1 + 2.2 * x.abs(), 2.0]));
            scene.entities.insert(wall.id.clone(), wall);
        }
    });
    assert!(matches!(reason(ask(&walled, "go_to(sink)")).0, InfeasibleReason::BlockedPath { .. }));
    assert!(matches!(
        reason(ask(&walled, "reach(coke)")).0,
        InfeasibleReason::NoFreePose { .. } | InfeasibleReason::BlockedPath { .. }
    ));
}

#[test]
fn unknown_answers_give_the_reason() {
    // Nothing is in the hand yet.
    for query in ["push(drawer_1)", "put(mug_1, sink)", "offer(mug_1, user)", "posture(nowhere)"] {
        let answer = ask(&embedded("kitchen"), query);
        assert!(matches!(answer, MotionAnswer::Unknown(UnknownReason::Because(_))), "{query}: {answer:?}");
    }
}

#[test]
fn put_on_a_surface_is_feasible_from_anywhere() {
    let (model, urdf) = model("hsr");
    let bases = [[0.0, 0.0, 0.0], [0.5, -1.2, 0.0], [0.0, -1.0, 0.0]];
    let places = ["counter", "kitchen_table", "sink", "shelf", "trash"];
    for (base, on) in bases.into_iter().flat_map(|base| places.map(|on| (base, on))) {
        let scene = changed(|scene| {
            scene.robot.base = base;
            scene.robot.holding = Some(Some("mug_1".into()));
            scene.entities["mug_1"].on = None;
        });
        let state = SceneState::new(&model, &scene);
        let context = QueryContext::new(&model, &scene, &state);
        let query = motion_query(&format!("put(mug_1, {on})"));
        let MotionAnswer::Feasible(witness) = context.answer(&query, SearchBudget::default()) else {
            panic!("{base:?}, {query}")
        };
        let faults = verify::faults(&model, &urdf, &scene, &state, &witness, Some(on));
        assert!(faults.is_empty(), "{base:?}, {query}: {:?}", &faults[..faults.len().min(5)]);
    }
}

#[test]
fn put_offer_and_look_follow_a_reach() {
    let ((model, urdf), scene) = (model("hsr"), embedded("kitchen"));
    let answer = |state: &SceneState, query: MotionQuery, support: Option<&str>| {
        let context = QueryContext::new(&model, &scene, state);
        let MotionAnswer::Feasible(witness) = context.answer(&query, SearchBudget::default()) else {
            panic!("{query}")
        };
        let faults = verify::faults(&model, &urdf, &scene, state, &witness, support);
        assert!(faults.is_empty(), "{query}: {:?}", &faults[..faults.len().min(5)]);
        witness
    };
    let gone = |state: &SceneState, to: &str| {
        let witness = answer(state, MotionQuery::GoTo(to.into()), None);
        QueryContext::new(&model, &scene, state).after_move(&witness)
    };
    let at_table = gone(&SceneState::new(&model, &scene), "kitchen_table");
    answer(&at_table, MotionQuery::Look("mug_1".into()), None);
    let reached = answer(&at_table, MotionQuery::Reach("mug_1".into(), None), None);
    let taken = QueryContext::new(&model, &scene, &at_table).after_reach(&reached).unwrap();
    assert!(taken.holds("mug_1") && taken.robot.base == at_table.robot.base);
    for on in ["sink", "trash"] {
        let there = gone(&taken, on);
        let put = answer(&there, motion_query(&format!("put(mug_1, {on})")), Some(on));
        let after = QueryContext::new(&model, &scene, &there).after_put(&put).unwrap();
        assert!(after.held.is_none());
        // It stands on it, its middle within its outline.
        let (mug, support) = (after.moved["mug_1"].translation, scene.entities[on].pose.unwrap().xyz);
        assert!((mug.x - support[0]).abs() < 0.3 && (mug.y - support[1]).abs() < 0.3);
    }
    let at_user = gone(&taken, "user");
    let offered = answer(&at_user, MotionQuery::Offer("mug_1".into(), "user".into()), None);
    assert!(offered.path.iter().all(|state| state.base == at_user.robot.base));
    let given = QueryContext::new(&model, &scene, &at_user).after_offer("user").unwrap();
    assert!(given.held.is_none());
    // What is closed takes nothing, and hides what is in it.
    let at_drawer = gone(&taken, "drawer_1");
    let context = QueryContext::new(&model, &scene, &at_drawer);
    let (why, certified) =
        reason(context.answer(&motion_query("put(mug_1, drawer_1)"), SearchBudget::default()));
    assert_eq!(
        (why, certified),
        (InfeasibleReason::NoFreePose { by: Some("drawer_1".into()), share: None }, true)
    );
}

#[test]
fn look_reports_what_hides_the_target() {
    let hidden = changed(|scene| {
        let shelf = scene.entities["shelf"].pose.unwrap().xyz;
        let mug = scene.entities["mug_1"].pose.as_mut().unwrap();
        mug.xyz = [shelf[0], shelf[1], 0.5];
        scene.robot.base[2] = f64::atan2(shelf[1], shelf[0]);
    });
    let (why, _) = reason(ask(&hidden, "look(mug_1)"));
    assert_eq!(why, InfeasibleReason::NotInView { by: Some("shelf".into()), aside: None });
    let far = changed(|scene| scene.entities["mug_1"].pose.as_mut().unwrap().xyz = [9.0, 0.0, 0.8]);
    assert!(matches!(
        reason(ask(&far, "look(mug_1)")).0,
        InfeasibleReason::OutOfReach { length: ReachLength::Sight, .. }
    ));
}

#[test]
fn reach_keeps_to_the_given_side() {
    for (side, wanted) in [("top", GraspSide::Top), ("side", GraspSide::Side), ("front", GraspSide::Side)] {
        let MotionAnswer::Feasible(witness) = ask(&embedded("kitchen"), &format!("reach(mug_1, {side})"))
        else {
            panic!("{side}")
        };
        assert_eq!(witness.grasp.unwrap().side, wanted);
    }
}

#[test]
fn posture_is_feasible() {
    let MotionAnswer::Feasible(witness) = ask(&embedded("kitchen"), "posture(start)") else { panic!() };
    let (model, _) = model("hsr");
    assert_eq!(witness.path.last().unwrap().joints, model.posture("start", model.rest()).unwrap());
}

fn furniture() -> impl Strategy<Value = Vec<(f64, f64, f64, [f64; 3], bool)>> {
    let size = (0.2..1.2_f64, 0.2..1.2_f64, 0.3..1.4_f64).prop_map(|(x, y, z)| [x, y, z]);
    prop::collection::vec((-2.5..2.5_f64, -2.5..2.5_f64, -3.0..3.0_f64, size, any::<bool>()), 2..8)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    /// Furniture at random, a can on each piece: what is feasible passes the independent check.
    #[test]
    fn feasible_answers_pass_the_independent_check(furniture in furniture()) {
        let (model, urdf) = model("hsr");
        let mut scene = Scene::default();
        let kitchen = embedded("kitchen");
        for ((x, y, yaw, size, has_can), at) in furniture.into_iter().zip(0..) {
            // Not where the robot is.
            if x.hypot(y) < 1.3 {
                continue;
            }
            let mut table = kitchen.entities["kitchen_table"].clone();
            table.id = format!("table_{at}").into();
            table.pose = Some(Placement { xyz: [x, y, size[2] / 2.0], rpy: [0.0, 0.0, yaw] });
            table.shape = Some(scene::EntityShape::Box(size));
            scene.entities.insert(table.id.clone(), table);
            if has_can {
                let mut can = kitchen.entities["coke"].clone();
                can.id = format!("can_{at}").into();
                can.pose = Some(Placement { xyz: [x, y, size[2] + 0.061], rpy: [0.0; 3] });
                scene.entities.insert(can.id.clone(), can);
            }
        }
        let state = SceneState::new(&model, &scene);
        let context = QueryContext::new(&model, &scene, &state);
        for id in scene.entities.keys() {
            for query in [MotionQuery::GoTo(id.clone()), MotionQuery::Reach(id.clone(), None)] {
                if id.starts_with("table") && matches!(query, MotionQuery::Reach(..)) {
                    continue;
                }
                let answer = context.answer(&query, SearchBudget { candidates: 64, paths: 16, cells: 4_096 });
                if let MotionAnswer::Feasible(witness) = &answer {
                    let faults = verify::faults(&model, &urdf, &scene, &state, witness, None);
                    prop_assert!(faults.is_empty(), "{query}: {:?}", &faults[..faults.len().min(5)]);
                }
            }
        }
    }
}

/// The held object can be put on an empty face if the robot reaches any part of it.
#[test]
fn put_uses_the_whole_face() {
    for y in [-2.2, -1.6, -1.1] {
        let scene = changed(|scene| {
            scene.entities.retain(|id, _| id == "mug_1" || id == "counter");
            let counter = scene.entities.get_mut("counter").unwrap();
            counter.pose.as_mut().unwrap().xyz = [1.0, y, 0.45];
            counter.shape = Some(scene::EntityShape::Box([1.6, 0.6, 0.9]));
            scene.entities["mug_1"].on = None;
            scene.robot.holding = Some(Some("mug_1".into()));
        });
        let answer = ask(&scene, "put(mug_1, counter)");
        assert!(matches!(answer, MotionAnswer::Feasible(_)), "{y}: {answer:?}");
    }
}

#[test]
fn suggested_change_is_no_larger_than_known() {
    let at = |height: f64| {
        let scene = changed(|scene| {
            scene.entities.retain(|id, _| id == "mug_1");
            let mug = &mut scene.entities["mug_1"];
            mug.on = None;
            mug.pose.as_mut().unwrap().xyz[2] = height;
        });
        match ask(&scene, "reach(mug_1)") {
            MotionAnswer::Infeasible(why) => (why.reason, why.change),
            other => panic!("{height}: {other:?}"),
        }
    };
    let (InfeasibleReason::OutOfReach { needs, reach, .. }, Some(change)) = at(2.0) else {
        panic!("too high")
    };
    let least = (needs - reach) * 100.0;
    assert_eq!(change, format!("`mug_1` would have to be at least {:.2} m lower", least.ceil() / 100.0));
    // Under the floor no way is up but out of it.
    if let (InfeasibleReason::OutOfReach { needs, reach, .. }, change) = at(-0.6) {
        assert_eq!(change.is_some(), needs - (needs - reach) > 0.0, "{change:?}");
    }
    let told = |share| InfeasibleReason::NoFreePose { by: Some("wall".into()), share }.to_string();
    assert_eq!(told(None), "every candidate configuration collides, most often with `wall`");
    let share = ContactShare { touching: 3, tried: 4 };
    assert!(told(Some(share)).ends_with("most often with `wall` (3 of 4 samples)"));
}
