//! Doors and drawers: how those of the built-in rooms open, and what robots make of them.

use std::collections::BTreeMap;

use motet_geometry::collision::{Shape, Solid};
use motet_geometry::planning::{
    Articulation, InfeasibleReason, MotionAnswer, MotionQuery, QueryContext, SceneState, SearchBudget,
};
use motet_robots::builtin::{BuiltinScene, SCENES};
use motet_robots::scene;

use super::{embedded, model, verify};

/// A solid smaller by this on each side, in m.
fn smaller(solid: &Solid, less: f64) -> Solid {
    let Shape::Box(half) = solid.shape else { return *solid };
    Solid { shape: Shape::Box(half.map(|half| (half - less).max(half * 0.1))), ..*solid }
}

#[test]
fn articulations_of_builtin_scenes_open_freely() {
    let (model, _) = model("hsr");
    let mut count = 0;
    for BuiltinScene { name, .. } in SCENES {
        let scene = embedded(name);
        let state = SceneState::new(&model, &scene);
        for (id, entity) in scene.entities.iter().filter(|(_, entity)| entity.travel.is_some()) {
            let opening = Articulation::new(entity, &state).unwrap();
            let mut closed = state.clone();
            closed.open.insert(id.clone(), false);
            let around = QueryContext::new(&model, &scene, &closed);
            count += 1;
            for step in 0..=32 {
                for moving in opening.moving(f64::from(step) / 32.0).iter().map(|it| smaller(it, 0.004)) {
                    for (other, solid) in around.obstacles() {
                        let inside = scene.entities[&other].inside.as_ref() == Some(id);
                        // Of its own furniture the inner side of the walls counts: there a door and a wall
                        // overlap in the corner.
                        let is_hinged = matches!(entity.travel, Some(scene::Travel::Hinge { .. }));
                        let solid = if other == *id { smaller(solid, 0.012) } else { *solid };
                        if inside || (other == *id && !is_hinged) {
                            continue;
                        }
                        assert!(
                            moving.is_farther(&solid, 0.0),
                            "{name}: `{id}` runs into `{other}` at {step}/32"
                        );
                    }
                }
            }
        }
    }
    assert!(count >= 5, "{count}");
}

/// Opens, or closes, what a room has from in front of it; what is feasible has to hold. The answers.
fn at_each(robot: &str, name: &str) -> BTreeMap<String, MotionAnswer> {
    let ((model, urdf), scene) = (model(robot), embedded(name));
    let mut answers = BTreeMap::new();
    for (id, entity) in scene.entities.iter().filter(|(_, entity)| entity.travel.is_some()) {
        let start = SceneState::new(&model, &scene);
        let before = QueryContext::new(&model, &scene, &start);
        let MotionAnswer::Feasible(way) =
            before.answer(&MotionQuery::GoTo(id.clone()), SearchBudget::default())
        else {
            panic!("{robot} does not come to `{id}`")
        };
        let mut state = before.after_move(&way);
        let is_open = state.is_open(entity);
        let [first, second] = if is_open {
            [MotionQuery::Push, MotionQuery::Pull]
        } else {
            [MotionQuery::Pull, MotionQuery::Push]
        };
        for query in [first(id.clone()), second(id.clone())] {
            let around = QueryContext::new(&model, &scene, &state);
            let answer = around.answer(&query, SearchBudget::default());
            let mut after = None;
            if let MotionAnswer::Feasible(witness) = &answer {
                let faults = verify::faults_of_pull(&model, &urdf, &scene, &state, witness);
                assert!(faults.is_empty(), "{robot}, {query}: {:?}", &faults[..faults.len().min(5)]);
                after = around.after_pull(witness);
            }
            answers.insert(query.to_string(), answer);
            let Some(next) = after else { break };
            state = next;
        }
    }
    answers
}

fn is_feasible(answers: &BTreeMap<String, MotionAnswer>, query: &str) {
    assert!(
        matches!(answers.get(query), Some(MotionAnswer::Feasible(_))),
        "{query}: {:?}",
        answers.get(query)
    );
}

#[test]
fn pull_and_push_of_the_hsr_open_and_close_containers() {
    for name in ["kitchen", "lab", "living_room"] {
        let answers = at_each("hsr", name);
        for query in answers.keys() {
            is_feasible(&answers, query);
        }
        assert!(answers.len() >= 2);
    }
}

#[test]
fn pull_of_the_anymal_opens_containers_with_room() {
    let answers = at_each("anymal_z1", "kitchen");
    for query in ["pull(fridge_1)", "pull(drawer_1)", "push(drawer_1)"] {
        is_feasible(&answers, query);
    }
    is_feasible(&at_each("anymal_z1", "living_room"), "pull(drawer_1)");
}

#[test]
fn pull_is_stopped_by_an_obstacle_before_the_drawer() {
    let ((model, _), mut scene) = (model("hsr"), embedded("kitchen"));
    let mut chair = scene.entities["trash"].clone();
    chair.id = "chair".into();
    chair.pose.as_mut().unwrap().xyz = [2.8, -1.7, 0.4];
    chair.shape = Some(scene::EntityShape::Cylinder { radius: 0.2, height: 0.8 });
    scene.entities.insert(chair.id.clone(), chair);
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let answer = context.answer(&MotionQuery::Pull("drawer_1".into()), SearchBudget::default());
    let MotionAnswer::Infeasible(why) = answer else { panic!("{answer:?}") };
    assert_eq!(
        (why.reason, why.certified),
        (InfeasibleReason::BlockedPath { by: Some("chair".into()) }, true)
    );
}

#[test]
fn push_moves_an_object_away() {
    let ((model, urdf), scene) = (model("hsr"), embedded("kitchen"));
    let state = SceneState::new(&model, &scene);
    let context = QueryContext::new(&model, &scene, &state);
    let answer = context.answer(&MotionQuery::Push("mug_1".into()), SearchBudget::default());
    let MotionAnswer::Feasible(witness) = &answer else { panic!("{answer:?}") };
    let faults = verify::faults(&model, &urdf, &scene, &state, witness, None);
    assert!(faults.is_empty(), "{:?}", &faults[..faults.len().min(5)]);
}

/// Posts in each direction that is tried leave room between them; a wall leaves none.
#[test]
fn push_is_infeasible_only_if_blocked_on_all_sides() {
    let (model, _) = model("hsr");
    let add = |scene: &mut scene::Scene, id: &str, xyz: [f64; 3], shape: scene::EntityShape| {
        let mut entity = scene::Entity::place(id.into(), scene::Placement { xyz, rpy: [0.0; 3] });
        entity.kind = if id == "puck" { "Object".into() } else { "Place".into() };
        entity.fixed = id != "puck";
        entity.shape = Some(shape);
        scene.entities.insert(entity.id.clone(), entity);
    };
    let [mut posts, mut wall] = [0.005, 0.02].map(|radius| {
        let mut scene = scene::Scene::default();
        add(&mut scene, "puck", [1.0, 0.0, 0.051], scene::EntityShape::Cylinder { radius, height: 0.1 });
        scene
    });
    for (at, aside) in [0.0, 0.26, -0.26, 0.52, -0.52, 0.78, -0.78_f64].into_iter().enumerate() {
        let (sin, cos) = aside.sin_cos();
        let at = (format!("post_{at}"), [1.0 + 0.09 * cos, 0.09 * sin, 0.1]);
        add(&mut posts, &at.0, at.1, scene::EntityShape::Cylinder { radius: 0.002, height: 0.2 });
    }
    add(&mut wall, "wall", [1.16, 0.0, 0.5], scene::EntityShape::Box([0.2, 2.0, 1.0]));
    for (scene, is_proven) in [(posts, false), (wall, true)] {
        let state = SceneState::new(&model, &scene);
        let answer = QueryContext::new(&model, &scene, &state)
            .answer(&MotionQuery::Push("puck".into()), SearchBudget::default());
        let MotionAnswer::Infeasible(why) = answer else { panic!("{answer:?}") };
        assert!(matches!(why.reason, InfeasibleReason::BlockedPath { .. }), "{:?}", why.reason);
        assert_eq!(why.certified, is_proven);
    }
}
