//! What a model is shown: a fresh picture with every plan, and one with every question for a point.

use std::time::Duration;

use crate::kitchen::{Heard, brisk, planner, right, session, setting};
use crate::server::{Act, Server};
use motet_client::Client;
use motet_graph::{Pose, Value};
use motet_planner::dialogue::{Conversation, NoOperator, Outcome};
use motet_planner::vision::GroundingDriver;
use motet_runtime::{
    CameraImage, CameraModel, DepthImage, Engine, Perception, RgbdView, RunEnd, StartState, Time,
};
use motet_sim::{Faults, Sim, SimOptions};
use motet_syntax::{FileId, Source};

const COKE: &str = "bring me the coke";

/// A picture that says when it was taken.
fn picture(now: Time) -> CameraImage {
    let mut bytes = b"\x89PNG".to_vec();
    bytes.extend(now.nanos().to_be_bytes());
    CameraImage { camera: "head".into(), media_type: "image/png".into(), bytes, at: now }
}

/// Takes a picture each time.
struct Head;

impl Perception for Head {
    fn image(&mut self, now: Time) -> Option<CameraImage> {
        Some(picture(now))
    }
}

#[test]
fn client_fresh_picture_goes_with_every_plan() {
    let setting = setting();
    let server = Server::new(vec![Act::says(right(&setting, COKE))]);
    let faults = r#"{"calls": [{"primitive": "pick", "nth": 1, "then": {"fails": "slipped"}}]}"#;
    let faults = Faults::from_json(faults).unwrap();
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions { faults, ..SimOptions::default() });
    let mut talk = Conversation::new(&setting).with_eyes(Head);
    let heard = Heard::default();
    let mut planner = planner(brisk(&server), &heard);
    let (outcome, _) = talk.carry_out(COKE, &mut planner, &mut sim, &mut NoOperator, &mut (), Time::ZERO);
    assert_eq!(outcome, Outcome::Done, "{:?}", heard.0.borrow());
    let shown = |index: usize| {
        let content = server.heard()[index].body["messages"][1]["content"].clone();
        assert_eq!(content.as_array().unwrap().len(), 2, "a text and a picture: {content}");
        content[1]["image_url"]["url"].as_str().unwrap().to_owned()
    };
    assert_eq!(server.heard().len(), 2);
    assert!(shown(0).starts_with("data:image/png;base64,"));
    assert_ne!(shown(0), shown(1));
}

/// Looks at a wall two metres away.
struct Wall;

impl Perception for Wall {
    fn image(&mut self, now: Time) -> Option<CameraImage> {
        Some(picture(now))
    }

    fn view(&mut self, now: Time, _of: &str) -> Option<RgbdView> {
        Some(RgbdView {
            image: picture(now),
            depth: DepthImage { width: 100, height: 80, millimetres: vec![2_000; 8_000] },
            camera: CameraModel {
                pose: Pose { xyz: [0.0, 0.0, 1.0], quaternion: [-0.5, 0.5, -0.5, 0.5] },
                intrinsics: [100.0, 100.0, 50.0, 40.0],
            },
        })
    }
}

/// Runs a policy that asks for a point; how it ended, and the point.
fn point(server: &Server, within: &str) -> (RunEnd, Option<Value>) {
    let setting = setting();
    let session = session();
    let text =
        format!("policy touch for hsr {{\n    let handle = ground(mug_1, \"the handle\"){within}\n}}\n");
    let compiled = session.compile(&motet_syntax::read(&Source::new("touch.motet", text), FileId(0)), None);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics));
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut sim = Sim::new(&setting.robot, &setting.scene, SimOptions::default());
    let pointer = Box::new(Client::new(brisk(server)).unwrap());
    let mut sight = Wall;
    let mut driver = GroundingDriver::new(&mut sim, &mut sight, &setting.scene, pointer);
    let end = motet_runtime::run(&mut engine, &mut driver, &mut (), Time::ZERO);
    let found = engine.snapshot().bindings.into_iter().find(|(name, _)| name == "handle");
    (end, found.map(|(_, value)| value))
}

fn answered(text: &str) -> (RunEnd, Option<Value>) {
    point(&Server::new(vec![Act::AtOnce { text: text.to_owned() }]), "")
}

#[test]
fn client_model_is_asked_for_a_point_with_the_picture() {
    let server = Server::new(vec![Act::AtOnce { text: "Here: {\"point\": [75.4, 60.9]}".to_owned() }]);
    let (end, found) = point(&server, "");
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}");
    let Some(Value::Pose(pose)) = found else { panic!("{found:?}") };
    let off = pose.xyz.iter().zip([2.0, -0.5, 0.6]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 1e-9, "{pose:?}");
    let body = server.heard()[0].body.clone();
    let content = &body["messages"][0]["content"];
    assert!(content[0]["text"].as_str().unwrap().contains("red mug"), "{content}");
    assert!(content[1]["image_url"]["url"].as_str().unwrap().starts_with("data:image/png;base64,"));
    assert_eq!(body["stream"], false);
}

#[test]
fn client_bad_answer_is_a_failure_of_the_primitive() {
    let failed = |end: &RunEnd| match end {
        RunEnd::Failed { kind, .. } => kind.to_string(),
        other => format!("{other:?}"),
    };
    for (answer, kind) in [
        ("I see no handle.", "not_found"),
        ("{\"point\": [1]}", "not_found"),
        ("{\"point\": [500, 20]}", "not_found"),
        ("{\"point\": [1, 2]} or {\"point\": [30, 4]}", "ambiguous"),
    ] {
        let (end, found) = answered(answer);
        assert_eq!((failed(&end).as_str(), found), (kind, None), "{answer}");
    }
    let refused = Server::new(vec![Act::status("404 Not Found", "")]);
    assert_eq!(failed(&point(&refused, "").0), "not_found");
}

#[test]
fn client_model_that_is_silent_keeps_nobody_waiting() {
    let server = Server::new(vec![Act::Silent]);
    let begun = std::time::Instant::now();
    let (end, _) = point(&server, " within 100 ms");
    let RunEnd::Failed { kind, .. } = &end else { panic!("{end:?}") };
    assert_eq!(kind, "timeout");
    assert!(begun.elapsed() < Duration::from_secs(20), "the server is still silent");
}
