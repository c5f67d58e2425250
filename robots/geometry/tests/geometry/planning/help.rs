//! Explanations of infeasible answers: the numbers, and the change that would help.

use motet_geometry::planning::{
    Infeasible, InfeasibleReason, MotionAnswer, QueryContext, ReachLength, RobotModel, SceneState,
    SearchBudget,
};
use motet_robots::builtin;
use motet_robots::card;
use motet_robots::scene::{EntityShape, Grip, Placement, Scene, Travel};
use motet_syntax::{FileId, Source};

use super::{bare, changed, embedded, model, motion_query};

/// The HSR with a line of its card replaced.
fn hsr(from: &str, to: &str) -> RobotModel {
    let texts = builtin::robot_texts("hsr").unwrap();
    assert!(texts.card.contains(from));
    let toml = texts.card.replace(from, to);
    let robot = card::read(&Source::new("hsr", toml), FileId(0), texts.declarations).0.unwrap();
    RobotModel::new(&robot, &texts.urdf().unwrap())
}

/// The answer as it is told, and what would help.
fn asked(model: &RobotModel, scene: &Scene, query: &str) -> (MotionAnswer, Option<String>) {
    let state = SceneState::new(model, scene);
    let context = QueryContext::new(model, scene, &state);
    let query = motion_query(query);
    match context.answer(&query, SearchBudget::default()) {
        MotionAnswer::Infeasible(why) => {
            let told = context.explain(&query, &why, SearchBudget::default());
            assert_eq!((told.reason.name(), told.certified), (why.reason.name(), why.certified));
            let change = told.change.clone();
            (MotionAnswer::Infeasible(told), change)
        }
        answer => (answer, None),
    }
}

pub(super) fn refused(model: &RobotModel, scene: &Scene, query: &str) -> (Infeasible, Option<String>) {
    match asked(model, scene, query) {
        (MotionAnswer::Infeasible(why), help) => (why, help),
        (other, _) => panic!("{query}: {other:?}"),
    }
}

/// Only the mug, so far from the robot and so many degrees to its left.
fn aside(far: f64, degrees: f64) -> Scene {
    changed(|scene| {
        scene.entities.retain(|id, _| id == "mug_1");
        let (sin, cos) = degrees.to_radians().sin_cos();
        scene.entities["mug_1"].on = None;
        scene.entities["mug_1"].pose.as_mut().unwrap().xyz = [far * cos, far * sin, 0.8];
        // The arm ahead, where the head does not come.
        scene.robot.joints.insert("arm_flex_joint".into(), -1.3);
    })
}

#[test]
fn look_sees_entities_in_the_view() {
    let (model, _) = model("hsr");
    for degrees in [0.0, 60.0, -60.0, 90.0, -90.0, -120.0] {
        let (answer, _) = asked(&model, &aside(2.0, degrees), "look(mug_1)");
        assert!(matches!(answer, MotionAnswer::Feasible(_)), "{degrees}: {answer:?}");
    }
    // Its neck turns so far to the right, and the card says that it sees 129° to either side.
    for (degrees, told, help) in [
        (
            -170.0,
            "is 170° to the right, the camera sees 129° to either side",
            "turn to the right by at least 41° first",
        ),
        (
            150.0,
            "is 150° to the left, the camera sees 129° to either side",
            "turn to the left by at least 21° first",
        ),
    ] {
        let (why, found) = refused(&model, &aside(2.0, degrees), "look(mug_1)");
        assert_eq!((why.reason.to_string().as_str(), found.as_deref()), (told, Some(help)));
        assert!(!why.certified);
    }
    let narrow = hsr("258 deg", "60 deg");
    assert!(matches!(asked(&narrow, &aside(2.0, 20.0), "look(mug_1)").0, MotionAnswer::Feasible(_)));
    let (why, _) = refused(&narrow, &aside(2.0, 40.0), "look(mug_1)");
    assert!(matches!(why.reason, InfeasibleReason::NotInView { by: None, aside: Some(_) }), "{why:?}");
}

#[test]
fn camera_mount_is_that_of_the_joints_that_turn_it() {
    let mount = |name: &str| model(name).0.camera_mount().unwrap();
    let head = mount("hsr");
    for (one, other) in head.tilt.into_iter().chain(head.rests).zip([-1.57, 0.52, 0.0, -0.5]) {
        assert!((one - other).abs() < 0.03, "{one} is not {other}");
    }
    assert!(!head.is_on_arm && (0.9..1.2).contains(&head.eye[2]), "{head:?}");
    for name in ["anymal_z1", "panda"] {
        let wrist = mount(name);
        assert!(wrist.is_on_arm && wrist.tilt[0] < -1.4 && wrist.tilt[1] > 1.0, "{name}: {wrist:?}");
    }
}

#[test]
fn look_reports_a_distance_beyond_the_range() {
    let (model, _) = model("hsr");
    let (why, help) = refused(&model, &aside(6.0, 0.0), "look(mug_1)");
    let InfeasibleReason::OutOfReach { length: ReachLength::Sight, needs, reach } = why.reason else {
        panic!("{why:?}")
    };
    let least = ((needs - reach) * 100.0).ceil() / 100.0;
    assert_eq!(help.unwrap(), format!("the robot has to be at least {least:.2} m nearer to `mug_1`"));
}

/// Adds a wall to the scene.
pub(super) fn wall(scene: &mut Scene, id: &str, xyz: [f64; 3], extents: [f64; 3]) {
    let mut wall = embedded("kitchen").entities["kitchen_table"].clone();
    wall.id = id.into();
    wall.pose = Some(Placement { xyz, rpy: [0.0; 3] });
    wall.shape = Some(EntityShape::Box(extents));
    scene.entities.insert(wall.id.clone(), wall);
}

/// The mug on a post in an alcove, before which something stands.
fn alcove(is_fixed: bool) -> Scene {
    changed(|scene| {
        wall(scene, "post", [2.5, 0.0, 0.4], [0.2, 0.2, 0.8]);
        wall(scene, "left", [2.5, 0.7, 1.0], [1.4, 0.1, 2.0]);
        wall(scene, "right", [2.5, -0.7, 1.0], [1.4, 0.1, 2.0]);
        wall(scene, "back", [3.2, 0.0, 1.0], [0.1, 1.4, 2.0]);
        wall(scene, "chair", [1.85, 0.0, 0.9], [0.4, 1.2, 1.8]);
        scene.entities["chair"].fixed = is_fixed;
        scene.entities["mug_1"].on = Some("post".into());
        scene.entities["mug_1"].pose.as_mut().unwrap().xyz = [2.5, 0.0, 0.85];
        scene
            .entities
            .retain(|id, _| ["post", "left", "right", "back", "chair", "mug_1"].contains(&id.as_str()));
    })
}

#[test]
fn explain_names_an_obstacle_whose_removal_helps() {
    let (model, _) = model("hsr");
    let (_, help) = refused(&model, &alcove(false), "reach(mug_1)");
    let told = "every path to a place from which `mug_1` is in reach is blocked by `chair`: move it away";
    assert_eq!(help.as_deref(), Some(told));
    let (_, help) = refused(&model, &alcove(false), "go_to(mug_1)");
    assert_eq!(
        help.as_deref(),
        Some("every path to a place within 0.60 m of `mug_1` is blocked by `chair`: move it away")
    );
    // What never moves is not asked away, nor what would not help.
    assert_eq!(refused(&model, &alcove(true), "reach(mug_1)").1, None);
    let mut both = alcove(false);
    wall(&mut both, "front", [1.4, 0.0, 1.0], [0.1, 3.0, 2.0]);
    wall(&mut both, "behind", [1.5, 1.5, 1.0], [4.0, 0.1, 2.0]);
    wall(&mut both, "beside", [1.5, -1.5, 1.0], [4.0, 0.1, 2.0]);
    assert_eq!(refused(&model, &both, "reach(mug_1)").1, None);
}

/// The mug on a table in a closed room, in the only gap of which, so many metres to either side, stands
/// something.
pub(super) fn doorway(gap: f64, chairs: &[(&str, [f64; 2], f64)]) -> Scene {
    changed(|scene| {
        scene.entities.retain(|id, _| id == "mug_1");
        let (middle, wide) = ((2.7 + gap) / 2.0, 2.7 - gap);
        wall(scene, "left", [1.5, middle, 1.0], [0.1, wide, 2.0]);
        wall(scene, "right", [1.5, -middle, 1.0], [0.1, wide, 2.0]);
        wall(scene, "north", [3.5, 2.7, 1.0], [4.1, 0.1, 2.0]);
        wall(scene, "south", [3.5, -2.7, 1.0], [4.1, 0.1, 2.0]);
        wall(scene, "back", [5.5, 0.0, 1.0], [0.1, 5.5, 2.0]);
        wall(scene, "table", [4.0, 0.0, 0.36], [0.6, 1.0, 0.72]);
        for (id, [x, y], deep) in chairs {
            wall(scene, id, [*x, *y, 0.45], [*deep, 0.5, 0.9]);
            scene.entities[*id].fixed = false;
        }
        let mug = &mut scene.entities["mug_1"];
        mug.on = Some("table".into());
        mug.pose.as_mut().unwrap().xyz = [3.8, 0.0, 0.775];
    })
}

#[test]
fn explain_names_the_obstacle_in_the_only_doorway() {
    for (robot, gap) in [("hsr", 0.5), ("anymal_z1", 1.0)] {
        let (model, _) = model(robot);
        for (query, to) in [
            ("go_to(table)", "a place within"),
            ("go_to(mug_1)", "a place within"),
            ("reach(mug_1)", "a place from which `mug_1` is in reach"),
        ] {
            // One far from the doorway, as near to the table, is of no matter.
            let scene = bare(doorway(gap, &[("stool", [4.8, 1.5], 0.3), ("chair", [1.5, 0.0], 0.4)]));
            let (why, help) = refused(&model, &scene, query);
            assert_eq!(
                why.reason,
                InfeasibleReason::BlockedPath { by: Some("chair".into()) },
                "{robot}, {query}"
            );
            let help = help.unwrap();
            assert!(help.starts_with(&format!("every path to {to}")), "{robot}, {query}: {help}");
            assert!(help.ends_with("is blocked by `chair`: move it away"), "{robot}, {query}: {help}");
            // What never moves is told, and not asked away; the thing itself and the robot are never in the
            // way.
            let mut walled = bare(doorway(gap, &[]));
            wall(&mut walled, "board", [1.5, 0.0, 1.0], [0.1, 2.0 * gap, 2.0]);
            let (why, help) = refused(&model, &walled, query);
            assert_eq!(help, None, "{robot}, {query}");
            let InfeasibleReason::BlockedPath { by: Some(by) } = why.reason else {
                panic!("{robot}, {query}: {why:?}")
            };
            assert!(walled.entities[&by].fixed && by != "table", "{robot}, {query}: {by}");
        }
    }
}

#[test]
fn explain_names_two_obstacles_in_a_row() {
    let (model, _) = model("hsr");
    let mut scene = doorway(0.5, &[("chair", [1.5, 0.0], 0.4), ("stool", [2.3, 0.0], 0.4)]);
    for (id, y) in [("inner_left", 0.6), ("inner_right", -0.6)] {
        wall(&mut scene, id, [1.9, y, 1.0], [0.9, 0.2, 2.0]);
    }
    let (why, help) = refused(&model, &scene, "go_to(table)");
    assert_eq!(why.reason, InfeasibleReason::BlockedPath { by: Some("chair".into()) });
    assert!(help.unwrap().ends_with("is blocked by `chair` and `stool`: move them away"));
}

#[test]
fn explain_suggests_a_lift_of_a_flat_object() {
    let (model, _) = model("hsr");
    let scene = embedded("kitchen");
    let (why, help) = refused(&model, &scene, "reach(plate)");
    assert!(matches!(why.reason, InfeasibleReason::NoFreePose { share: Some(_), .. }));
    let help = help.unwrap();
    let up =
        help.strip_prefix("it is feasible with `plate` ").and_then(|rest| rest.strip_suffix(" m higher"));
    let up: f64 = up.unwrap().parse().unwrap();
    let mut higher = scene.clone();
    higher.entities["plate"].pose.as_mut().unwrap().xyz[2] += up;
    assert!(matches!(asked(&model, &higher, "reach(plate)").0, MotionAnswer::Feasible(_)));
}

#[test]
fn explain_suggests_to_open_the_container() {
    let (model, _) = model("hsr");
    let shut = |is_open: bool| {
        changed(|scene| {
            let at = scene.entities["drawer_1"].pose.unwrap().xyz;
            scene.entities["drawer_1"].open = Some(is_open);
            scene.entities["mug_1"].on = None;
            scene.entities["mug_1"].inside = Some("drawer_1".into());
            scene.entities["mug_1"].pose.as_mut().unwrap().xyz = at;
        })
    };
    for query in ["reach(mug_1)", "look(mug_1)"] {
        let (_, help) = refused(&model, &shut(false), query);
        assert_eq!(help.as_deref(), Some("open `drawer_1` first"), "{query}");
    }
    let (_, help) = asked(&model, &shut(true), "reach(mug_1)");
    assert!(help.is_none_or(|help| !help.contains("open")));
}

#[test]
fn explain_suggests_a_place_with_a_view() {
    let (model, _) = model("hsr");
    let scene = changed(|scene| {
        wall(scene, "screen", [1.2, 0.0, 1.0], [0.1, 1.6, 2.0]);
        scene.entities["mug_1"].on = None;
        scene.entities["mug_1"].pose.as_mut().unwrap().xyz = [2.4, 0.0, 0.8];
        scene.entities.retain(|id, _| ["screen", "mug_1"].contains(&id.as_str()));
    });
    let (why, help) = refused(&model, &scene, "look(mug_1)");
    assert_eq!(why.reason, InfeasibleReason::NotInView { by: Some("screen".into()), aside: None });
    assert_eq!(help.as_deref(), Some("go to `mug_1` first"));
}

#[test]
fn explain_reports_heights_for_every_hand_motion() {
    let (model, _) = model("hsr");
    let high = |z: f64, held: bool| {
        changed(|scene| {
            scene.entities.retain(|id, _| ["mug_1", "shelf", "drawer_1"].contains(&id.as_str()));
            scene.entities["mug_1"].on = None;
            scene.entities["mug_1"].inside = None;
            if held {
                scene.robot.holding = Some(Some("mug_1".into()));
            }
            let shelf = &mut scene.entities["shelf"];
            shelf.shape = Some(EntityShape::Box([0.8, 0.4, 0.04]));
            shelf.pose.as_mut().unwrap().xyz[2] = z - 0.02;
            let drawer = &mut scene.entities["drawer_1"];
            (drawer.on, drawer.inside) = (None, None);
            drawer.pose.as_mut().unwrap().xyz[2] = z;
            assert!(matches!(drawer.travel, Some(Travel::Slide { .. })));
        })
    };
    for (query, what, held) in [
        ("put(mug_1, shelf)", "the top of `shelf`", true),
        ("pull(drawer_1)", "the handle of `drawer_1`", false),
    ] {
        let (why, help) = refused(&model, &high(2.4, held), query);
        let InfeasibleReason::OutOfReach { length: ReachLength::Height, needs, reach } = why.reason else {
            panic!("{query}: {why:?}")
        };
        let least = ((needs - reach) * 100.0).ceil() / 100.0;
        assert_eq!(help.unwrap(), format!("{what} would have to be at least {least:.2} m lower"));
        assert!((needs - 2.4).abs() < 0.05, "{query}: {needs}");
        assert!(why.certified, "{query}");
        // Lower by so much, and a little for the way there, it is not too high.
        let lower = asked(&model, &high(2.4 - least, held), query).0;
        assert!(
            !matches!(&lower, MotionAnswer::Infeasible(why) if matches!(why.reason,
                InfeasibleReason::OutOfReach { .. })),
            "{query}: {lower:?}"
        );
    }
}

#[test]
fn look_does_not_see_past_the_held_object() {
    let (model, _) = model("hsr");
    // A board of the given height, held upright before the head, and a mug behind it.
    let behind_a_board = |high: f64| {
        changed(|scene| {
            scene.entities.retain(|id, _| ["mug_1", "book"].contains(&id.as_str()));
            let mut board = scene.entities["mug_1"].clone();
            board.id = "board".into();
            board.shape = Some(EntityShape::Box([high, high, 0.02]));
            (board.on, board.pose) = (None, None);
            scene.entities.insert("board".into(), board);
            let mug = &mut scene.entities["mug_1"];
            (mug.on, mug.pose.as_mut().unwrap().xyz) = (None, [3.0, 0.0, 0.8]);
            scene.robot.holding = Some(Some("board".into()));
            let tip_from_object = Placement { xyz: [0.0, 0.0, 0.15], rpy: [0.0; 3] };
            scene.robot.grip = Some(Grip { of: "board".into(), tip_from_object });
            let joints = [("arm_lift_joint", 0.3), ("arm_flex_joint", -1.57), ("wrist_flex_joint", 0.0)];
            scene.robot.joints.extend(joints.map(|(joint, at)| (joint.into(), at)));
        })
    };
    assert!(matches!(asked(&model, &behind_a_board(0.02), "look(mug_1)").0, MotionAnswer::Feasible(_)));
    let (why, help) = refused(&model, &behind_a_board(0.9), "look(mug_1)");
    assert_eq!(why.reason, InfeasibleReason::NotInView { by: Some("board".into()), aside: None });
    assert_eq!(help.as_deref(), Some("put `board` down first"));
}

#[test]
fn explain_names_the_links_of_a_self_collision() {
    let (model, _) = model("hsr");
    // With the arm as at home the wrist is beside the head.
    let mut scene = aside(2.0, 90.0);
    scene.robot.joints.clear();
    let (why, help) = refused(&model, &scene, "look(mug_1)");
    let told = "the robot itself (`head_tilt_link` and `wrist_roll_link`) blocks the path";
    assert_eq!(why.reason.to_string(), told);
    assert_eq!(help.as_deref(), Some("move the arm to the posture `start` first"));
}
