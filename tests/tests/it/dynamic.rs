//! The world changes while a policy runs: the six scenarios of `examples/`, in simulation from end to end.

use motet_compiler::{InitialState, Session};
use motet_graph::Graph;
use motet_robots::card::Robot;
use motet_robots::scene::Scene;
use motet_runtime::{
    Driver, Effect, Engine, Observer, PreparedSwap, RetiredGraph, RunEnd, StartState, SwapRefusal, Time,
    TraceEventKind,
};
use motet_sim::{Faults, Sim};
use motet_syntax::{Severity, Source, Sources, Span};
use motet_tests::{examples, setup};
use std::path::Path;
use std::sync::Arc;

/// A robot in a room.
struct RobotInRoom {
    robot: Robot,
    scene: Scene,
}

impl RobotInRoom {
    fn new(scene: &str) -> Self {
        Self { robot: setup::robot("hsr"), scene: setup::scene(scene) }
    }

    /// An example, proved from the scene and what an engine believes.
    fn compile(&self, name: &str, engine: Option<&Engine>) -> Graph {
        let path =
            Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../examples")).join(format!("{name}.motet"));
        let mut sources = Sources::default();
        let facts = engine.map(|engine| engine.snapshot().state()).unwrap_or_default().into_iter();
        let state = InitialState {
            facts: facts.map(|(fact, holds)| (fact, (holds, Span::default()))).collect(),
            ..InitialState::default()
        };
        let session =
            Session::builder().robot(&self.robot).scene(&self.scene).state(&state).build(&mut sources);
        let said = session.input_diagnostics().to_vec();
        assert!(said.is_empty(), "{said:?}");
        let source = Source::new(name, examples::read(&path));
        let id = sources.add(source.clone());
        let compiled = session.compile(&motet_syntax::read(&source, id), None);
        let errors: Vec<_> = compiled
            .diagnostics
            .iter()
            .filter(|said| said.severity == Severity::Error)
            .map(|said| &said.message)
            .collect();
        compiled.graph.unwrap_or_else(|| panic!("{name}: {errors:?}"))
    }
}

/// Writes down what happens, and swaps once.
struct Script<'s> {
    stage: &'s RobotInRoom,
    swap: Option<(Time, &'static str)>,
    log: Vec<String>,
}

impl Observer for Script<'_> {
    fn effect(&mut self, now: Time, effect: &Effect) {
        let line = match effect {
            Effect::Start { command, .. } => format!("start {command}"),
            Effect::Update { command, .. } => format!("update {command}"),
            Effect::Cancel { .. } => "cancel".to_owned(),
            Effect::Hold { .. } => "hold".to_owned(),
            Effect::Proceed { .. } => "proceed".to_owned(),
            Effect::Report(record) => match &record.what {
                TraceEventKind::Swapped { policy } => format!("swapped to {policy}"),
                _ => return,
            },
            Effect::Finished(end) => end.to_string(),
            Effect::SafeStop { .. }
            | Effect::Observe { .. }
            | Effect::Watch { .. }
            | Effect::Unwatch { .. }
            | Effect::Verify { .. } => return,
        };
        self.log.push(format!("{:6.2} {line}", now.secs()));
    }

    fn swap(&mut self, now: Time, engine: &Engine) -> Option<PreparedSwap> {
        let (_, name) = self.swap.take_if(|(at, _)| *at <= now)?;
        Some(PreparedSwap::new(self.stage.compile(name, Some(engine)), &engine.running()).unwrap())
    }

    fn swapped(&mut self, _now: Time, _graph: &Arc<Graph>, result: Result<RetiredGraph, SwapRefusal>) {
        result.unwrap();
    }

    fn at_least_every(&self) -> Time {
        Time::from_secs(0.1)
    }
}

/// Runs an example with these faults. Returns the world and what happened, the end last.
fn play(scene: &str, name: &str, faults: &str, swap: Option<(f64, &'static str)>) -> (Sim, Vec<String>) {
    let stage = RobotInRoom::new(scene);
    let options = motet_sim::SimOptions {
        faults: Faults::from_json(faults).unwrap(),
        ..motet_sim::SimOptions::default()
    };
    let mut sim = Sim::new(&stage.robot, &stage.scene, options);
    let entities = stage.scene.entities.values().map(|entity| (entity.id.clone(), entity.kind.clone()));
    let start = StartState { entities: entities.collect(), ..StartState::default() };
    let graph = stage.compile(name, None);
    let mut engine = Engine::new(graph, &start).unwrap().with_capabilities(sim.capabilities());
    let swap = swap.map(|(at, name)| (Time::from_secs(at), name));
    let mut script = Script { stage: &stage, swap, log: Vec::new() };
    let end = motet_runtime::run(&mut engine, &mut sim, &mut script, Time::ZERO);
    assert_eq!(end, RunEnd::Done { why: None, result: None }, "{:#?}", script.log);
    (sim, script.log)
}

/// Whether these lines come in this order.
#[track_caller]
fn in_order(log: &[String], wanted: &[&str]) {
    let mut lines = log.iter();
    for wanted in wanted {
        assert!(lines.any(|line| line.contains(wanted)), "`{wanted}` is missing:\n{log:#?}");
    }
}

#[test]
fn run_object_is_changed_during_a_handover() {
    let faults = r#"{"calls": [{"primitive": "handover", "nth": 1, "then": {"fails": "refused"}}]}"#;
    let (sim, log) = play("kitchen", "object_changed", faults, None);
    in_order(&log, &["handover(object: mug_1", "place(object: mug_1", "handover(object: apple", "done"]);
    assert_eq!(sim.holds("on", &["mug_1", "kitchen_table"]), Some(true));
    assert_eq!(sim.holds("at", &["apple", "user"]), Some(true));
}

#[test]
fn run_goal_is_changed_during_execution() {
    // On the way to the person with the mug in the hand.
    let (sim, log) = play("kitchen", "object_moved", "{}", Some((15.0, "goal_changed")));
    in_order(
        &log,
        &["start go(to: user)", "swapped to goal_changed", "update go(to: counter)", "place(object: mug_1"],
    );
    assert!(!log.iter().any(|line| line.contains("cancel")), "{log:#?}");
    assert_eq!(sim.holds("on", &["mug_1", "counter"]), Some(true));
}

#[test]
fn run_same_drive_goes_on_in_another_policy() {
    let (sim, log) = play("kitchen", "object_moved", "{}", Some((3.0, "object_slips")));
    in_order(&log, &["swapped to object_slips", "detect", "done"]);
    assert_eq!(log.iter().filter(|line| line.contains("go(to: kitchen_table)")).count(), 1, "{log:#?}");
    assert_eq!(sim.holds("at", &["mug_1", "user"]), Some(true));
}

#[test]
fn run_drawer_is_closed_only_where_it_is_open() {
    let (sim, log) = play("lab", "conditional_drawer_closing", "{}", None);
    in_order(&log, &["close(what: drawer_1)", "done"]);
    assert_eq!(sim.holds("open", &["drawer_1"]), Some(false));
    let closed = r#"{"world": [{"at": 1.0, "what": {"closes": "drawer_1"}}]}"#;
    let (_, log) = play("lab", "conditional_drawer_closing", closed, None);
    assert!(!log.iter().any(|line| line.contains("close(")), "{log:#?}");
}

#[test]
fn run_object_is_moved_while_the_robot_drives() {
    let faults =
        r#"{"world": [{"at": 2.0, "what": {"moves": {"object": "mug_1", "to": {"surface": "counter"}}}}]}"#;
    let (sim, log) = play("kitchen", "object_moved", faults, None);
    in_order(&log, &["detect", "search", "pick", "handover", "done"]);
    assert_eq!(sim.holds("at", &["mug_1", "user"]), Some(true));
}

#[test]
fn run_person_steps_into_the_path() {
    let faults = r#"{"world": [{"at": 1.0, "what": {"walks":
        {"person": "user", "from": [0.8, 1.4], "to": [0.8, -4.0], "speed": 0.5}}}]}"#;
    let (_, log) = play("kitchen", "person_in_the_way", faults, None);
    in_order(&log, &["start go(to: kitchen_table)", "hold", "proceed", "start go(to: counter)", "done"]);
    assert!(!log.iter().any(|line| line.contains("cancel")), "{log:#?}");
}

#[test]
fn run_object_slips_from_the_hand() {
    let faults = r#"{"world": [{"at": 15.0, "what": {"slips": "mug_1"}}]}"#;
    let (sim, log) = play("kitchen", "object_slips", faults, None);
    in_order(&log, &["pick(object: mug_1", "search", "pick(object: mug_1", "handover(object: mug_1", "done"]);
    assert_eq!(sim.holds("at", &["mug_1", "user"]), Some(true));
}

#[test]
fn run_swap_is_the_same_in_every_run() {
    let once = || play("kitchen", "object_moved", "{}", Some((15.0, "goal_changed"))).1;
    assert_eq!(once(), once());
}
