//! Things to which no simple way leads: down in a box, under the robot's head, behind a passage.

use motet_geometry::planning::{MotionAnswer, MotionQuery, QueryContext, SceneState, SearchBudget};
use motet_robots::scene::{Entity, EntityShape, Placement, Scene};

use super::{bare, model, verify};

/// A scene of boxes, each with its middle, and one thing.
fn scene(boxes: &[(&str, [f64; 3], [f64; 3])], at: [f64; 3], shape: EntityShape) -> Scene {
    let mut scene = Scene::default();
    let things = boxes.iter().map(|(id, at, extents)| (*id, *at, EntityShape::Box(*extents)));
    for (id, xyz, shape) in things.chain([("thing", at, shape)]) {
        let mut entity = Entity::place(id.into(), Placement { xyz, rpy: [0.0; 3] });
        entity.shape = Some(shape);
        scene.entities.insert(id.into(), entity);
    }
    scene
}

/// Asks a robot to reach the thing, which has to be feasible, and the witness to hold.
fn reached(robot: &str, scene: &Scene) {
    let ((model, urdf), scene) = (model(robot), &bare(scene.clone()));
    let state = SceneState::new(&model, scene);
    let context = QueryContext::new(&model, scene, &state);
    let query = MotionQuery::Reach("thing".into(), None);
    let answer = context.answer(&query, SearchBudget::default());
    let MotionAnswer::Feasible(witness) = &answer else { panic!("{answer:?}") };
    let faults = verify::faults(&model, &urdf, scene, &state, witness, None);
    assert!(faults.is_empty(), "{:?}", &faults[..faults.len().min(5)]);
    assert_eq!(context.answer(&query, SearchBudget::default()), answer);
}

/// At the greatest height of the lift the hand slides over the object from beside it.
#[test]
fn reach_grasps_from_above_at_the_greatest_height() {
    let table = ("table", [1.6, 0.0, 0.42], [0.8, 0.8, 0.84]);
    reached("hsr", &scene(&[table], [1.45, 0.0, 0.856], EntityShape::Box([0.05, 0.09, 0.03])));
}

/// Base and arm move together until the hand is out of the box.
#[test]
fn reach_grasps_from_a_box_at_the_greatest_height() {
    let walls = [
        ("table", [1.6, 0.0, 0.34], [0.8, 0.8, 0.68]),
        ("front", [1.25, 0.0, 0.76], [0.01, 0.5, 0.16]),
        ("back", [1.65, 0.0, 0.76], [0.01, 0.5, 0.16]),
        ("left", [1.45, 0.25, 0.76], [0.41, 0.01, 0.16]),
        ("right", [1.45, -0.25, 0.76], [0.41, 0.01, 0.16]),
    ];
    reached("hsr", &scene(&walls, [1.45, 0.0, 0.741], EntityShape::Box([0.06, 0.09, 0.12])));
}

/// Taken for a disc, the robot does not fit between the walls, at the far end of which the thing stands.
#[test]
fn go_to_leads_a_long_robot_between_walls() {
    let walls = [
        ("left", [2.0, 0.5, 0.6], [1.6, 0.1, 1.2]),
        ("right", [2.0, -0.5, 0.6], [1.6, 0.1, 1.2]),
        ("end", [2.85, 0.0, 0.6], [0.1, 1.2, 1.2]),
        ("stand", [2.65, 0.0, 0.2], [0.2, 0.8, 0.4]),
    ];
    reached(
        "anymal_z1",
        &scene(&walls, [2.6, 0.0, 0.461], EntityShape::Cylinder { radius: 0.03, height: 0.12 }),
    );
}
