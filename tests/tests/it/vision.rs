//! What is seen: the laws of the simulator's eyes, detections in a scene, and points of an image lifted
//! into the room.
use motet_graph::Pose;
use motet_planner::vision::{NoPoint, Pointer, ground, lift, point, with_detections};
use motet_runtime::conformance::check_perception;
use motet_runtime::{CameraImage, CameraModel, DepthImage, Detection, Driver, RgbdView, Time};
use motet_sim::{Sim, SimOptions};
use motet_tests::setup;

#[test]
fn vision_simulator_s_eyes_keep_the_laws() {
    let mut sim = Sim::new(&setup::robot("hsr"), &setup::scene("kitchen"), SimOptions::default());
    let _ = sim.advance(Time::from_secs(1.0));
    assert_eq!(
        check_perception(&mut sim, &[Time::from_secs(1.0), Time::from_secs(2.0)]),
        Vec::<String>::new()
    );
    let seen = sim.detections(Time::from_secs(2.0));
    let mug = seen.iter().find(|seen| seen.entity.as_deref() == Some("mug_1")).unwrap();
    assert_eq!(mug.class, "mug");
    assert!(!seen.iter().any(|seen| seen.entity.as_deref() == Some("mug_2")), "behind the robot");
}

#[test]
fn vision_detections_bring_a_scene_up_to_date() {
    let scene = setup::scene("kitchen");
    let seen = |entity: Option<&str>, class: &str, confidence| Detection {
        entity: entity.map(Into::into),
        class: class.into(),
        pose: None,
        extent: None,
        confidence,
        at: Time::ZERO,
    };
    let after = with_detections(
        &scene,
        &[
            seen(Some("coke"), "", 0.9),
            seen(None, "sponge", 0.8),
            seen(None, "mug", 0.9),
            seen(None, "plate", 0.1),
        ],
    );
    let visible = |id: &str| after.entities.get(id).unwrap().visible;
    assert_eq!([visible("coke"), visible("sponge")], [Some(true), Some(true)]);
    assert_eq!(visible("mug_1"), Some(false), "it may have been the other");
    assert_eq!(visible("plate"), Some(false), "hardly sure");
}

fn camera() -> CameraModel {
    // One metre up, looking along the x axis of the room: its z ahead, its x to the right, its y down.
    CameraModel {
        pose: Pose { xyz: [0.0, 0.0, 1.0], quaternion: [-0.5, 0.5, -0.5, 0.5] },
        intrinsics: [100.0, 100.0, 50.0, 40.0],
    }
}

fn depth() -> DepthImage {
    let mut millimetres = vec![2_000; 100 * 80];
    // A hole at the middle, and one without an end in a corner.
    for (index, value) in millimetres.iter_mut().enumerate() {
        let (u, v) = (index % 100, index / 100);
        if (u, v) == (50, 40) || (u < 20 && v < 20) {
            *value = 0;
        }
    }
    DepthImage { width: 100, height: 80, millimetres }
}

#[test]
fn vision_point_is_lifted_along_its_ray() {
    let close = |found: [f64; 3], wanted: [f64; 3]| {
        let off = found.iter().zip(wanted).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(off < 1e-9, "{found:?} {wanted:?}");
    };
    close(lift([50.0, 40.0], &depth(), &camera()).unwrap().xyz, [2.0, 0.0, 1.0]);
    // To the right of the image is to the right of the robot, below is below.
    close(lift([75.4, 60.9], &depth(), &camera()).unwrap().xyz, [2.0, -0.5, 0.6]);
    assert!(matches!(lift([5.0, 5.0], &depth(), &camera()), Err(NoPoint::NoDepth { .. })));
    for outside in [[-1.0, 3.0], [100.0, 3.0], [3.0, 80.0], [f64::NAN, 3.0], [f64::INFINITY, 3.0]] {
        assert!(matches!(lift(outside, &depth(), &camera()), Err(NoPoint::Outside { .. })), "{outside:?}");
    }
    let broken = DepthImage { height: 81, ..depth() };
    assert!(matches!(lift([50.0, 40.0], &broken, &camera()), Err(NoPoint::Camera(_))));
}

#[test]
fn vision_answers_are_read_however_they_come() {
    assert_eq!(point("{\"point\": [12, 34.5]}"), Ok([12.0, 34.5]));
    assert_eq!(point("Sure! ```json\n{\"point\":[1,2]}\n``` It is {the} handle."), Ok([1.0, 2.0]));
    for hostile in [
        "",
        "the handle",
        "[1, 2]",
        "{\"point\": [1]}",
        "{\"point\": [1, 2, 3]}",
        "{\"point\": [\"1\", \"2\"]}",
        "{\"point\": {\"u\": 1}}",
        "{\"point\": [1e999, 2]}",
        "{\"point\": [1, 2",
        &"{".repeat(5_000),
        &format!("{}{{\"point\": [1, 2]}}", "x".repeat(5_000)),
    ] {
        assert!(matches!(point(hostile), Err(NoPoint::Unreadable(_))), "{hostile:.40}");
    }
}

#[test]
fn vision_several_points_are_no_answer() {
    assert_eq!(point("{\"point\": [1, 2]} {\"point\": [3, 4]}"), Err(NoPoint::Several));
    assert_eq!(NoPoint::Several.failure(), "ambiguous");
}

#[test]
fn vision_model_is_asked_for_the_point() {
    struct Says(Result<&'static str, &'static str>);
    impl Pointer for Says {
        fn ask(&mut self, _image: &CameraImage, question: &str) -> Result<String, String> {
            assert!(
                question.contains("on the drawer is the handle") && question.contains("100 x 80"),
                "{question}"
            );
            self.0.map(ToOwned::to_owned).map_err(ToOwned::to_owned)
        }
    }
    let image = CameraImage {
        camera: "head".into(),
        media_type: "image/png".into(),
        bytes: Vec::new(),
        at: Time::ZERO,
    };
    let view = RgbdView { image, depth: depth(), camera: camera() };
    let ask = |says| ground(&mut Says(says), &view, "drawer", "the handle");
    assert!(ask(Ok("{\"point\": [50, 40]}")).is_ok());
    assert!(matches!(ask(Ok("{\"point\": [500, 40]}")), Err(NoPoint::Outside { .. })));
    assert!(matches!(ask(Err("time-out")), Err(NoPoint::Silent(_))));
}
