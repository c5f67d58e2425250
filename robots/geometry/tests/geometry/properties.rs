//! Laws of `reach` for any room and robot: answers stay the same in a moved room, feasible ones without an
//! obstacle, and none contradicts one of a larger budget.

use std::sync::LazyLock;

use motet_geometry::planning::{
    MotionAnswer, MotionQuery, QueryContext, RobotModel, SceneState, SearchBudget,
};
use motet_robots::builtin::{self, RobotWithBody};
use motet_robots::scene::{Entity, EntityShape, Placement, Scene};
use proptest::prelude::*;

const BUDGET: SearchBudget = SearchBudget { candidates: 48, paths: 12, cells: 3_072 };

static ROBOTS: LazyLock<[RobotModel; 3]> = LazyLock::new(|| ["hsr", "anymal_z1", "panda"].map(machine));

fn machine(name: &str) -> RobotModel {
    let RobotWithBody { robot, urdf } = builtin::robot(name).unwrap();
    RobotModel::new(&robot, &urdf)
}

fn entity(id: &str, kind: &str, xyz: [f64; 3], yaw: f64, shape: EntityShape) -> Entity {
    let mut entity = Entity::place(id.into(), Placement { xyz, rpy: [0.0, 0.0, yaw] });
    entity.kind = kind.into();
    entity.shape = Some(shape);
    entity
}

/// A table with a can on it, a board above the can, and boxes around.
fn rooms() -> impl Strategy<Value = (Scene, usize)> {
    (0..3_usize)
        .prop_flat_map(|which| furnished(ROBOTS[which].drives()).prop_map(move |scene| (scene, which)))
}

/// A room with a table, which is within reach of a robot that does not drive.
fn furnished(drives: bool) -> impl Strategy<Value = Scene> {
    let (least, free) = if drives { (0.7, 0.45) } else { (0.35, 0.2) };
    let (far, wide) = if drives { (0.6..2.0_f64, 0.3..1.3_f64) } else { (0.5..0.8, 0.3..0.8) };
    let table = (far, -1.5..1.5_f64, -3.0..3.0_f64, 0.3..1.0_f64, wide);
    let can = (-0.4..0.4_f64, -0.4..0.4_f64, 0.02..0.05_f64, 0.06..0.2_f64, 0.05..0.5_f64);
    let boxes = prop::collection::vec((-2.5..2.5_f64, -2.5..2.5_f64, 0.1..0.5_f64, 0.2..1.5_f64), 0..6);
    (table, can, boxes).prop_map(
        move |((x, y, yaw, height, wide), (off_x, off_y, radius, tall, above), boxes)| {
            let mut scene = Scene::default();
            let mut add = |it: Entity| scene.entities.insert(it.id.clone(), it);
            let y = if drives { y } else { 0.3 * y };
            let far = least + wide / 2.0;
            let (x, y) = if x.hypot(y) < far { (far + x, y) } else { (x, y) };
            add(entity("table", "Place", [x, y, height / 2.0], yaw, EntityShape::Box([0.6, wide, height])));
            let (sin, cos) = yaw.sin_cos();
            let (a, b) = (off_x * 0.6, off_y * wide);
            let at = [x + cos * a - sin * b, y + sin * a + cos * b, height + tall / 2.0 + 0.001];
            add(entity("can", "Object", at, yaw, EntityShape::Cylinder { radius, height: tall }));
            let board = [x, y, height + tall + above];
            add(entity("board", "Place", board, yaw, EntityShape::Box([0.6, wide, 0.02])));
            for ((x, y, side, height), at) in boxes.into_iter().zip(0..) {
                if x.hypot(y) > free + side {
                    let id = format!("box_{at}");
                    add(entity(
                        &id,
                        "Place",
                        [x, y, height / 2.0],
                        0.0,
                        EntityShape::Box([side, side, height]),
                    ));
                }
            }
            scene
        },
    )
}

fn ask(machine: &RobotModel, scene: &Scene, budget: SearchBudget) -> MotionAnswer {
    let world = SceneState::new(machine, scene);
    QueryContext::new(machine, scene, &world).answer(&MotionQuery::Reach("can".into(), None), budget)
}

/// `Some` of whether it is feasible where that is certain.
fn certain(answer: &MotionAnswer) -> Option<bool> {
    match answer {
        MotionAnswer::Feasible(_) => Some(true),
        MotionAnswer::Infeasible(why) => why.certified.then_some(false),
        MotionAnswer::Unknown(_) => None,
    }
}

fn contradict(one: &MotionAnswer, other: &MotionAnswer) -> bool {
    certain(one).zip(certain(other)).is_some_and(|(one, other)| one != other)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(72))]

    #[test]
    fn reach_is_invariant_under_motion_of_the_room(
        (scene, which) in rooms(), x in -5.0..5.0_f64, y in -5.0..5.0_f64, yaw in -3.0..3.0_f64,
    ) {
        let mut moved = scene.clone();
        let (sin, cos) = yaw.sin_cos();
        let turned = |a: f64, b: f64| [x + cos * a - sin * b, y + sin * a + cos * b];
        for entity in moved.entities.values_mut() {
            let pose = entity.pose.as_mut().unwrap();
            let [a, b] = turned(pose.xyz[0], pose.xyz[1]);
            *pose = Placement { xyz: [a, b, pose.xyz[2]], rpy: [0.0, 0.0, pose.rpy[2] + yaw] };
        }
        let [a, b, turn] = scene.robot.base;
        let [a, b] = turned(a, b);
        moved.robot.base = [a, b, turn + yaw];
        prop_assert!(!contradict(&ask(&ROBOTS[which], &scene, BUDGET), &ask(&ROBOTS[which], &moved, BUDGET)));
    }

    #[test]
    fn reach_stays_feasible_without_an_obstacle((scene, which) in rooms(), gone in 0..8_usize) {
        let less: Vec<_> = scene.entities.keys().filter(|id| !matches!(id.as_str(),
            "can" | "table")).collect();
        let mut open = scene.clone();
        if let Some(id) = less.get(gone % less.len().max(1)) {
            open.entities.shift_remove(*id);
        }
        if let MotionAnswer::Feasible(_) = ask(&ROBOTS[which], &scene, BUDGET) {
            prop_assert!(!matches!(ask(&ROBOTS[which], &open, BUDGET), MotionAnswer::Infeasible(_)));
        }
    }

    #[test]
    fn reach_with_a_larger_budget_agrees((scene, which) in rooms()) {
        let answers = [1, 4].map(|factor| ask(&ROBOTS[which], &scene, BUDGET.times(factor)));
        prop_assert!(!contradict(&answers[0], &answers[1]));
        if let MotionAnswer::Feasible(_) = answers[0] {
            prop_assert!(matches!(answers[1], MotionAnswer::Feasible(_)));
        }
    }
}
