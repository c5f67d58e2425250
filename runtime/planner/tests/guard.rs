//! A motion that only the run can tell of is checked in the run, just before its step; its verdict stands in the journal, so
//! that a replay needs no geometry.

#![allow(clippy::unwrap_used, clippy::indexing_slicing, clippy::panic, reason = "a test fails by panicking")]

use motet_compiler::{Geometry, Options, Session};
use motet_geometry::query::Budget;
use motet_graph::Graph;
use motet_planner::guard::{Guard, WITHIN};
use motet_robots::card::{self, Robot};
use motet_robots::scene::{self, Placement, Scene, Shape};
use motet_robots::urdf;
use motet_runtime::journal::{Entry, Head, Replay, Step};
use motet_runtime::{
    Control, Driver, Effect, Engine, Event, Happening, Onlooker, RunEnd, Settings, StartState, Time,
    Verifier, run, wire,
};
use motet_sim::{Options as SimOptions, Script, Sim};
use motet_syntax::{FileId, Source, Sources};
use std::sync::Arc;

fn hsr() -> Robot {
    let (_, toml, own) = card::embedded().iter().find(|(name, ..)| *name == "hsr").unwrap();
    card::read(&Source::new("hsr", *toml), FileId(0), *own).0.unwrap()
}

fn kitchen() -> Scene {
    let (_, text) = scene::embedded().iter().find(|(name, _)| *name == "kitchen").unwrap();
    scene::read(&Source::new("kitchen", *text), FileId(0)).0.unwrap()
}

/// The kitchen with walls around the table, higher than the robot.
fn walled() -> Scene {
    let mut scene = kitchen();
    let walls = [(2.2, -0.8, 2.7, 0.1), (2.2, 1.8, 2.7, 0.1), (0.9, 0.5, 0.1, 2.7), (3.5, 0.5, 0.1, 2.7)];
    for ((x, y, along, across), at) in walls.into_iter().zip(0..) {
        let mut wall = scene.entities["shelf"].clone();
        wall.id = format!("wall_{at}").into();
        wall.pose = Some(Placement { xyz: [x, y, 1.0], rpy: [0.0; 3] });
        wall.shape = Some(Shape::Box([along, across, 2.0]));
        scene.entities.insert(wall.id.clone(), wall);
    }
    scene
}

fn session(scene: &Scene) -> Session {
    let robot = hsr();
    let urdf = urdf::read(&Source::new("hsr", card::embedded_urdf("hsr").unwrap()), FileId(0)).0.unwrap();
    let (session, said) =
        Session::new(Some(&robot), &[], Some(scene), None, Options::default(), &mut Sources::default());
    assert!(said.is_empty(), "{said:?}");
    session.with_geometry(Arc::new(Geometry::new(&robot, &urdf, scene, None, Budget::default())))
}

fn compile(session: &Session, policy: &str) -> Graph {
    let compiled = session.compile(&motet_syntax::read(&Source::new("policy", policy), FileId(0)), None);
    compiled.graph.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
}

/// Writes a journal, and has somebody who verifies.
struct Host {
    guard: Guard,
    event: Option<Event>,
    entries: Vec<Entry>,
    told: Vec<String>,
}

impl Onlooker for Host {
    fn event(&mut self, _now: Time, event: &Event) {
        self.event = Some(event.clone());
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> Control {
        let event = self.event.take().map(|event| wire::Event::from(&event));
        let effects = effects.iter().map(wire::Effect::from).collect();
        self.entries.push(Entry::Step(Step { at: now.nanos(), event, effects }));
        Control::GoOn
    }

    fn effect(&mut self, _now: Time, effect: &Effect) {
        match effect {
            Effect::Start { command, .. } => self.told.push(command.to_string()),
            Effect::Verify { motion, .. } => self.told.push(format!("verify {motion}")),
            Effect::Report(record) => {
                if let Happening::Verified { verdict, .. } = &record.what {
                    self.told.push(verdict.to_string());
                }
            }
            _ => {}
        }
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        Some(&mut self.guard)
    }
}

/// Runs a policy in simulation, sees that a replay of its journal gives the same, and returns what happened.
fn play(scene: &Scene, policy: &str) -> (RunEnd, Vec<String>) {
    let session = session(scene);
    let graph = compile(&session, policy);
    let entities = scene.entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone()));
    let start = StartState { entities: entities.collect(), ..StartState::default() };
    let script = Script { answers: vec![Some("red mug".into())] };
    let mut sim = Sim::new(&hsr(), scene, SimOptions { script, ..SimOptions::default() });
    let settings = Settings { verify_within: Some(WITHIN), ..Settings::default() };
    let mut engine = Engine::new(graph.clone(), &start)
        .unwrap()
        .with_capabilities(sim.capabilities())
        .with_settings(settings);
    let head = Head {
        start: (&start).into(),
        settings: settings.into(),
        capabilities: (&sim.capabilities()).into(),
        ..Head::new(&graph)
    };
    let guard = Guard::new(session.course().unwrap());
    let mut host = Host { guard, event: None, entries: Vec::new(), told: Vec::new() };
    let end = run(&mut engine, &mut sim, &mut host, Time::ZERO);
    let mut replay = Replay::new(&head).unwrap();
    for entry in &host.entries {
        assert_eq!(replay.take(entry).unwrap(), None, "the replay differs");
    }
    (end, host.told)
}

/// Only the run can tell which cup is chosen.
const CHOSEN: &str = r#"policy chosen for hsr {
    let cups = detect_all("drinkware")
    let cup = choose("Which of these?", cups)
    try {
        go(cup)
    } catch unreachable {
        say("I cannot get there.")
    }
}"#;

#[test]
fn what_the_run_finds_out_of_reach_is_a_failure_that_can_be_caught() {
    let (end, told) = play(&walled(), CHOSEN);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {told:#?}");
    assert_eq!(told[2], "verify go_to(mug_1)", "{told:#?}");
    assert!(told[3].starts_with("unreachable: "), "{told:#?}");
    assert!(told[4].starts_with("say(") && told.len() == 5, "the robot does not start to go: {told:#?}");
}

#[test]
fn what_can_be_done_is_done() {
    let (end, told) = play(&kitchen(), CHOSEN);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {told:#?}");
    assert_eq!(told[2..4], ["verify go_to(mug_1)", "feasible"], "{told:#?}");
    assert!(told[4].starts_with("go(") && told.len() == 5, "{told:#?}");
}
