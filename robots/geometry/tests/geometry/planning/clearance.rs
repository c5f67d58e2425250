//! Clearance: what a motion keeps from obstacles, what may come near, and how a gap that is too narrow is
//! told. And the grasp of an object of which a scene only says that it is held.

use motet_geometry::planning::{
    Gap, InfeasibleReason, MotionAnswer, MotionQuery, MotionWitness, PlaceRules, QueryContext, RobotModel,
    SceneState, SearchBudget, TightGroup,
};
use motet_robots::builtin::{ROBOTS, SCENES};
use motet_robots::clearance::{Clearance, ClearanceOverride};
use motet_robots::scene::{Grip, Placement, Scene};

use super::help::{doorway, refused, wall};
use super::{changed, embedded, isometry_of, model, motion_query};

fn keeping(mut scene: Scene, base_m: f64, arm_m: f64) -> Scene {
    scene.clearance = ClearanceOverride { base_m: Some(base_m), arm_m: Some(arm_m) };
    scene
}

fn witness(model: &RobotModel, scene: &Scene, query: &str) -> Option<MotionWitness> {
    let state = SceneState::new(model, scene);
    let answer =
        QueryContext::new(model, scene, &state).answer(&motion_query(query), SearchBudget::default());
    match answer {
        MotionAnswer::Feasible(witness) => Some(*witness),
        _ => None,
    }
}

/// Least distances of base and arm from all obstacles but some, at 64 places of each edge but the last.
fn distances(model: &RobotModel, scene: &Scene, witness: &MotionWitness, but: &[&str]) -> Clearance {
    let state = SceneState::new(model, scene);
    let context = QueryContext::new(model, scene, &state);
    let carried = &model.hand().unwrap().carried;
    let mut least = Clearance { base_m: f64::INFINITY, arm_m: f64::INFINITY };
    let edges = witness.path.windows(2);
    let count = edges.len() - usize::from(witness.grasp.is_some());
    for (edge, step) in edges.take(count).flat_map(|edge| (0..=64).map(move |step| (edge, step))) {
        let placed = context.robot_at(&edge[0].towards(&edge[1], f64::from(step) / 64.0));
        for (part, solid) in model.body().parts().iter().zip(&placed) {
            let slot = if carried[part.link] { &mut least.arm_m } else { &mut least.base_m };
            for (_, obstacle) in context.obstacles().filter(|(id, _)| !but.contains(&id.as_str())) {
                *slot = slot.min(solid.distance(obstacle));
            }
        }
    }
    least
}

#[test]
fn motions_keep_the_clearance_along_the_whole_path() {
    let (model, _) = model("hsr");
    for (query, near) in [
        ("go_to(counter)", &[][..]),
        ("go_to(fridge_1)", &[]),
        ("reach(mug_1)", &["mug_1", "kitchen_table"]),
        ("reach(coke)", &["coke", "counter"]),
    ] {
        for (base, arm) in [(0.0, 0.0), (0.04, 0.01), (0.08, 0.03)] {
            let scene = keeping(embedded("kitchen"), base, arm);
            let witness = witness(&model, &scene, query).unwrap();
            assert_eq!(witness.margins.required, Clearance { base_m: base, arm_m: arm });
            let kept = distances(&model, &scene, &witness, near);
            assert!(kept.base_m >= base.max(0.002) && kept.arm_m >= arm.max(0.002), "{query}: {kept:?}");
            assert!(witness.margins.clearance >= base.min(arm).max(0.002), "{query}");
        }
    }
}

/// The clearance of the card counts where neither scene nor command gives one.
#[test]
fn clearance_of_the_scene_overrides_the_card() {
    let (model, _) = model("hsr");
    let mut scene = embedded("kitchen");
    let state = SceneState::new(&model, &scene);
    assert_eq!(QueryContext::new(&model, &scene, &state).clearance_kept(), model.card().clearance);
    assert!(model.card().clearance.base_m > model.card().clearance.arm_m);
    scene.clearance.base_m = Some(0.2);
    let kept = QueryContext::new(&model, &scene, &state).clearance_kept();
    assert_eq!(kept, Clearance { base_m: 0.2, ..model.card().clearance });
}

/// A base that begins nearer to a wall than the clearance drives away, and never comes nearer.
#[test]
fn start_within_the_clearance_leads_out_of_it() {
    let (model, _) = model("hsr");
    let scene = changed(|scene| {
        scene.entities.retain(|id, _| id == "mug_1");
        wall(scene, "behind", [-0.3, 0.0, 1.0], [0.1, 3.0, 2.0]);
        wall(scene, "table", [2.5, 0.0, 0.36], [0.6, 1.0, 0.72]);
    });
    let scene = keeping(scene, 0.1, 0.02);
    let state = SceneState::new(&model, &scene);
    let at_start = QueryContext::new(&model, &scene, &state).clearance(&state.robot, Default::default());
    assert!(at_start < 0.1, "{at_start}");
    let witness = witness(&model, &scene, "go_to(table)").unwrap();
    let kept = distances(&model, &scene, &witness, &[]);
    assert!(kept.base_m >= at_start - 0.001_001, "{kept:?} {at_start}");
    // Other obstacles are kept from as far as ever.
    assert!(distances(&model, &scene, &witness, &["behind"]).base_m >= 0.1);
}

#[test]
fn explain_measures_a_gap_that_is_too_narrow() {
    let (model, _) = model("hsr");
    // The gap is 2 × 0.28 m.
    let scene = |base: f64| keeping(doorway(0.28, &[]), base, 0.01);
    assert!(witness(&model, &scene(0.02), "go_to(table)").is_some());
    let (why, _) = refused(&model, &scene(0.1), "go_to(table)");
    assert!(why.certified, "{why:?}");
    let tight = why.tight.clone().unwrap();
    assert_eq!((tight.group, tight.needs), (TightGroup::Base, 0.1));
    let Some(Gap { width, base, .. }) = tight.gap else { panic!("{tight:?}") };
    assert!((width - 0.56).abs() < 1e-6 && (0.3..0.5).contains(&base), "{tight:?}");
    let says = why.says();
    let (one, other) = ("the gap between `left` and `right`", "the gap between `right` and `left`");
    assert!(says.contains(one) || says.contains(other), "{says}");
    let needs = format!(" is 0.56 m; the base needs {base:.2} m and 10 cm clearance on each side");
    assert!(says.ends_with(&needs), "{says}");
}

#[test]
fn explain_tells_how_much_room_the_arm_has() {
    let (model, _) = model("hsr");
    let scene = changed(|scene| {
        scene.entities.retain(|id, _| ["mug_1", "kitchen_table"].contains(&id.as_str()));
        let [x, y, _] = scene.entities["mug_1"].pose.unwrap().xyz;
        // Two boards between which the hand just fits, and a lid above it.
        for (id, side) in [("left", 1.0), ("right", -1.0)] {
            wall(scene, id, [x, y + side * 0.16, 0.9], [0.3, 0.02, 0.34]);
        }
        wall(scene, "lid", [x, y, 1.08], [0.3, 0.34, 0.02]);
        wall(scene, "back", [x + 0.16, y, 0.9], [0.02, 0.34, 0.34]);
    });
    assert!(witness(&model, &keeping(scene.clone(), 0.0, 0.0), "reach(mug_1)").is_some());
    let (why, _) = refused(&model, &keeping(scene, 0.0, 0.2), "reach(mug_1)");
    let tight = why.tight.clone().unwrap();
    assert_eq!(tight.group, TightGroup::Arm);
    assert!(tight.most < 0.2, "{tight:?}");
    assert!(
        why.says().contains("; the arm needs a clearance of 20 cm, and there is room for "),
        "{}",
        why.says()
    );
    assert!(matches!(why.reason, InfeasibleReason::NoFreePose { .. } | InfeasibleReason::BlockedPath { .. }));
}

/// The rule gives the greater distance to a person; a zone is kept from by the clearance of the base.
#[test]
fn kept_regions_have_the_greater_distance() {
    let (model, _) = model("hsr");
    let zone = r#"{"motet_scene": 1, "clearance": {"base": 0.1, "arm": 0.1}, "entities": [
        {"id": "rug", "kind": "Zone", "pose": {"xyz": [1.2, 0, 0]}, "shape": {"box": [0.6, 1.0, 0.1]}},
        {"id": "desk", "kind": "Surface", "pose": {"xyz": [2.6, 0, 0.35]},
         "shape": {"box": [0.6, 1, 0.7]}}]}"#;
    let source = motet_syntax::Source::new("rug.json", zone);
    let scene = motet_robots::scene::read(&source, motet_syntax::FileId(0)).0.unwrap();
    let mut state = SceneState::new(&model, &scene);
    state.kept.extend(state.kept_out_of(&scene.entities["rug"]));
    let column = state.zone(&scene.entities["rug"]).unwrap();
    let context = QueryContext::new(&model, &scene, &state);
    let MotionAnswer::Feasible(witness) =
        context.answer(&MotionQuery::GoTo("desk".into()), SearchBudget::default())
    else {
        panic!("no way round the rug")
    };
    for (edge, step) in witness.path.windows(2).flat_map(|edge| (0..=64).map(move |step| (edge, step))) {
        for solid in context.robot_at(&edge[0].towards(&edge[1], f64::from(step) / 64.0)) {
            assert!(solid.is_farther(&column, 0.0999));
        }
    }
}

/// Every object that a robot grasps in a room is held as `reach` would, and stands upright where it is put.
#[test]
fn held_object_of_a_scene_stands_upright_where_it_is_put() {
    let mut count = 0;
    for (robot, room) in ROBOTS.iter().flat_map(|robot| SCENES.map(|room| (robot.name, room.name))) {
        let ((model, _), scene) = (model(robot), embedded(room));
        for id in scene.entities.values().filter(|it| it.kind == "Object").map(|it| it.id.clone()) {
            let Some(reached) = witness(&model, &scene, &format!("reach({id})")) else { continue };
            let mut holding = scene.clone();
            holding.robot.holding = Some(Some(id.clone()));
            holding.entities[&id].on = None;
            holding.entities[&id].inside = None;
            let state = SceneState::new(&model, &holding);
            let (_, grip) = state.held.clone().unwrap();
            let of_reach = reached.grasp.unwrap().tip_from_object;
            let context = QueryContext::new(&model, &holding, &state);
            let surfaces = holding.entities.values().filter(|it| it.kind == "Surface");
            let put = surfaces
                .map(|on| MotionQuery::Put(id.clone(), on.id.clone(), PlaceRules::default()))
                .find_map(|query| match context.answer(&query, SearchBudget::default()) {
                    MotionAnswer::Feasible(witness) => witness.grasp,
                    _ => None,
                });
            let Some(put) = put else { continue };
            let up = (put.map_from_tip * grip).rotation * nalgebra::Vector3::z();
            assert!(up.z > 0.999, "{robot}, {room}, {id}: {up:?}");
            // As in every grasp of `reach`, the fingers do not point up at an object that stands upright.
            let points = nalgebra::Vector3::from(model.hand().unwrap().card.points);
            let from_below =
                |grip: &nalgebra::Isometry3<f64>| points.dot(&(grip.rotation * nalgebra::Vector3::z()));
            let [held, as_reach] = [from_below(&grip), from_below(&of_reach)];
            assert!(held < 1e-6 && as_reach < 1e-6, "{robot}, {room}, {id}: {held}, {as_reach}");
            count += 1;
        }
    }
    assert!(count >= 20, "{count}");
}

/// A thing that lies flat was grasped from above, since the hand does not reach into what it lay on.
#[test]
fn held_object_that_is_flat_is_put_where_it_lay() {
    let ((model, _), mut scene) = (model("hsr"), embedded("living_room"));
    scene.robot.holding = Some(Some("remote_1".into()));
    scene.entities["remote_1"].on = None;
    let state = SceneState::new(&model, &scene);
    let put = MotionQuery::Put("remote_1".into(), "coffee_table".into(), PlaceRules::default());
    let answer = QueryContext::new(&model, &scene, &state).answer(&put, SearchBudget::default());
    assert!(matches!(answer, MotionAnswer::Feasible(_)), "{answer:?}");
}

#[test]
fn grip_of_a_scene_is_the_grip_of_the_state() {
    let (model, _) = model("hsr");
    let placement = Placement { xyz: [0.0, 0.01, 0.1], rpy: [0.0, 1.2, 0.3] };
    let scene = changed(|scene| {
        scene.robot.holding = Some(Some("mug_1".into()));
        scene.robot.grip = Some(Grip { of: "mug_1".into(), tip_from_object: placement });
        scene.entities["mug_1"].on = None;
    });
    let (_, grip) = SceneState::new(&model, &scene).held.unwrap();
    assert!((grip.translation.vector - nalgebra::Vector3::new(0.0, 0.01, 0.1)).norm() < 1e-12);
    assert!(grip.rotation.angle_to(&isometry_of(&placement).rotation) < 1e-9);
    // That of another object does not count.
    let mut other = scene.clone();
    other.robot.grip.as_mut().unwrap().of = "coke".into();
    assert_ne!(SceneState::new(&model, &other).held.unwrap().1, grip);
}
