//! Doors and drawers: how those of the built-in rooms open, and what robots make of them.

use std::collections::BTreeMap;

use motet_geometry::collision::{Shape, Solid};
use motet_geometry::planning::{
    Articulation, InfeasibleReason, MotionAnswer, MotionQuery, QueryContext, SceneState, SearchBudget,
};
use motet_robots::builtin::{BuiltinScene, SCENES};
use motet_robots::scene;

use super::{embedded, machine, verify};

/// A solid with less room to each side, in m.
fn smaller(solid: &Solid, less: f64) -> Solid {
    let Shape::Box(half) = solid.shape else { return *solid };
    Solid { shape: Shape::Box(half.map(|half| (half - less).max(half * 0.1))), ..*solid }
}

#[test]
fn doors_and_drawers_of_the_rooms_open_into_the_open() {
    let (machine, _) = machine("hsr");
    let mut count = 0;
    for BuiltinScene { name: room, .. } in SCENES {
        let scene = embedded(room);
        let world = SceneState::new(&machine, &scene);
        for (id, entity) in scene.entities.iter().filter(|(_, entity)| entity.travel.is_some()) {
            let opening = Articulation::new(entity, &world).unwrap();
            let mut closed = world.clone();
            closed.open.insert(id.clone(), false);
            let around = QueryContext::new(&machine, &scene, &closed);
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
                            "{room}: `{id}` runs into `{other}` at {step}/32"
                        );
                    }
                }
            }
        }
    }
    assert!(count >= 5, "{count}");
}

/// Opens, or closes, what a room has from in front of it; what is feasible has to hold. The answers.
fn at_each(robot: &str, room: &str) -> BTreeMap<String, MotionAnswer> {
    let ((machine, urdf), scene) = (machine(robot), embedded(room));
    let mut answers = BTreeMap::new();
    for (id, entity) in scene.entities.iter().filter(|(_, entity)| entity.travel.is_some()) {
        let start = SceneState::new(&machine, &scene);
        let before = QueryContext::new(&machine, &scene, &start);
        let MotionAnswer::Feasible(way) =
            before.answer(&MotionQuery::GoTo(id.clone()), SearchBudget::default())
        else {
            panic!("{robot} does not come to `{id}`")
        };
        let mut world = before.after_move(&way);
        let is_open = world.is_open(entity);
        let [first, second] = if is_open {
            [MotionQuery::Push, MotionQuery::Pull]
        } else {
            [MotionQuery::Pull, MotionQuery::Push]
        };
        for query in [first(id.clone()), second(id.clone())] {
            let around = QueryContext::new(&machine, &scene, &world);
            let answer = around.answer(&query, SearchBudget::default());
            let mut after = None;
            if let MotionAnswer::Feasible(witness) = &answer {
                let faults = verify::faults_of_pull(&machine, &urdf, &scene, &world, witness);
                assert!(faults.is_empty(), "{robot}, {query}: {:?}", &faults[..faults.len().min(5)]);
                after = around.after_pull(witness);
            }
            answers.insert(query.to_string(), answer);
            let Some(next) = after else { break };
            world = next;
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
fn the_hsr_opens_and_closes_what_there_is() {
    for room in ["kitchen", "lab", "living_room"] {
        let answers = at_each("hsr", room);
        for query in answers.keys() {
            is_feasible(&answers, query);
        }
        assert!(answers.len() >= 2);
    }
}

#[test]
fn the_anymal_opens_what_there_is_room_for() {
    let answers = at_each("anymal_z1", "kitchen");
    for query in ["pull(fridge_1)", "pull(drawer_1)", "push(drawer_1)"] {
        is_feasible(&answers, query);
    }
    is_feasible(&at_each("anymal_z1", "living_room"), "pull(drawer_1)");
}

#[test]
fn what_stands_before_a_drawer_stops_it() {
    let ((machine, _), mut scene) = (machine("hsr"), embedded("kitchen"));
    let mut chair = scene.entities["trash"].clone();
    chair.id = "chair".into();
    chair.pose.as_mut().unwrap().xyz = [2.8, -1.7, 0.4];
    chair.shape = Some(scene::EntityShape::Cylinder { radius: 0.2, height: 0.8 });
    scene.entities.insert(chair.id.clone(), chair);
    let world = SceneState::new(&machine, &scene);
    let room = QueryContext::new(&machine, &scene, &world);
    let answer = room.answer(&MotionQuery::Pull("drawer_1".into()), SearchBudget::default());
    let MotionAnswer::Infeasible(why) = answer else { panic!("{answer:?}") };
    assert_eq!(
        (why.reason, why.certified),
        (InfeasibleReason::BlockedPath { by: Some("chair".into()) }, true)
    );
}

#[test]
fn a_thing_is_pushed_away() {
    let ((machine, urdf), scene) = (machine("hsr"), embedded("kitchen"));
    let world = SceneState::new(&machine, &scene);
    let room = QueryContext::new(&machine, &scene, &world);
    let answer = room.answer(&MotionQuery::Push("mug_1".into()), SearchBudget::default());
    let MotionAnswer::Feasible(witness) = &answer else { panic!("{answer:?}") };
    let faults = verify::faults(&machine, &urdf, &scene, &world, witness, None);
    assert!(faults.is_empty(), "{:?}", &faults[..faults.len().min(5)]);
}

/// Posts in each direction that is tried leave room between them; a wall leaves none.
#[test]
fn a_thing_is_shut_in_only_where_it_is_in_all_directions() {
    let (machine, _) = machine("hsr");
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
        let world = SceneState::new(&machine, &scene);
        let answer = QueryContext::new(&machine, &scene, &world)
            .answer(&MotionQuery::Push("puck".into()), SearchBudget::default());
        let MotionAnswer::Infeasible(why) = answer else { panic!("{answer:?}") };
        assert!(matches!(why.reason, InfeasibleReason::BlockedPath { .. }), "{:?}", why.reason);
        assert_eq!(why.certified, is_proven);
    }
}
