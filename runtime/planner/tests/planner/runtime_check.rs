//! Checks of deferred motions just before their steps. The verdicts stand in the journal, so that a replay
//! needs no geometry.

use super::common::{hsr, kitchen, session, walled};
use motet_compiler::{Forecast, Session};
use motet_graph::{CallNode, Graph, NodeKind, Pose, Value};
use motet_planner::dialogue::Knowledge;
use motet_planner::runtime_check::{CheckMode, Guard, WITHIN};
use motet_robots::scene::{Entity, Grip, Placement, Scene};
use motet_runtime::journal::{EngineReplay, JournalEntry, JournalHead, StepEntry};
use motet_runtime::{
    CheckId, DeferredMotion, Driver, Effect, Engine, EngineSettings, Event, Moved, Observer, RunControl,
    RunEnd, StartState, Time, TraceEventKind, Verification, Verifier, run,
};
use motet_sim::{PersonScript, Sim, SimOptions};
use motet_syntax::{FileId, Source};
use std::f64::consts::FRAC_1_SQRT_2;
use std::sync::Arc;

fn compile(session: &Session, policy: &str) -> Graph {
    let compiled = session.compile(&motet_syntax::read(&Source::new("policy", policy), FileId(0)), None);
    compiled.graph.unwrap_or_else(|| panic!("{:?}", compiled.diagnostics))
}

/// Time is virtual here, so the run stands still until a verdict has come.
struct Waiting(Guard);

impl Verifier for Waiting {
    fn event(&mut self, now: Time, event: &Event) {
        self.0.event(now, event);
    }

    fn moved(&mut self, moved: &Moved) {
        self.0.moved(moved);
    }

    fn effect(&mut self, effect: &Effect) {
        self.0.effect(effect);
    }

    fn ask(&mut self, check: CheckId, motion: &Arc<DeferredMotion>) {
        self.0.ask(check, motion);
    }

    fn verdict(&mut self) -> Option<(CheckId, Verification)> {
        let mut verdict = self.0.verdict();
        while verdict.is_none() && self.0.is_busy() {
            std::thread::yield_now();
            verdict = self.0.verdict();
        }
        verdict
    }

    fn is_busy(&self) -> bool {
        self.0.is_busy()
    }
}

/// Writes a journal, and has somebody who verifies.
struct Host {
    guard: Waiting,
    event: Option<Event>,
    entries: Vec<JournalEntry>,
    told: Vec<String>,
}

impl Observer for Host {
    fn event(&mut self, _now: Time, event: &Event) {
        self.event = Some(event.clone());
    }

    fn commit(&mut self, now: Time, effects: &[Effect]) -> RunControl {
        let (event, effects) = (self.event.take(), effects.to_vec());
        self.entries.push(JournalEntry::Step(StepEntry { at: now, event, effects }));
        RunControl::Continue
    }

    fn effect(&mut self, _now: Time, effect: &Effect) {
        match effect {
            Effect::Start { command, .. } => self.told.push(command.to_string()),
            Effect::Verify { motion, .. } => self.told.push(format!("verify {motion}")),
            Effect::Report(record) => {
                if let TraceEventKind::Verified { verdict, .. } = &record.what {
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
    play_with(scene, policy, CheckMode::AtOnce)
}

/// The same, where motions are searched for as one likes.
fn play_with(scene: &Scene, policy: &str, verifies: CheckMode) -> (RunEnd, Vec<String>) {
    play_seeing(scene, policy, verifies, Vec::new())
}

/// The same, where things were seen before.
fn play_seeing(scene: &Scene, policy: &str, verifies: CheckMode, seen: Vec<Entity>) -> (RunEnd, Vec<String>) {
    let session = session(scene);
    let graph = compile(&session, policy);
    let entities = scene.entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone()));
    let start = StartState { entities: entities.collect(), ..StartState::default() };
    let script = PersonScript { answers: vec![Some("red mug".into())] };
    let mut sim = Sim::new(&hsr(), scene, SimOptions { script, ..SimOptions::default() });
    let settings = EngineSettings { verify_within: Some(WITHIN), ..EngineSettings::default() };
    let mut engine = Engine::new(graph.clone(), &start)
        .unwrap()
        .with_capabilities(sim.capabilities())
        .with_settings(settings);
    let head = JournalHead {
        start: start.clone(),
        settings,
        capabilities: sim.capabilities(),
        ..JournalHead::new(&graph)
    };
    let mut guard = Guard::new(session.world_tracker().unwrap(), verifies);
    guard.saw(seen);
    let mut host = Host { guard: Waiting(guard), event: None, entries: Vec::new(), told: Vec::new() };
    let end = run(&mut engine, &mut sim, &mut host, Time::ZERO);
    let mut replay = EngineReplay::new(&head).unwrap();
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
fn runtime_check_of_an_unreachable_thing_raises_a_failure() {
    let (end, told) = play(&walled(), CHOSEN);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {told:#?}");
    assert_eq!(told[2], "verify go_to(mug_1)", "{told:#?}");
    assert!(told[3].starts_with("unreachable: "), "{told:#?}");
    assert!(told[4].starts_with("say(") && told.len() == 5, "the robot does not start to go: {told:#?}");
}

#[test]
fn runtime_check_of_a_feasible_motion_lets_the_step_run() {
    let (end, told) = play(&kitchen(), CHOSEN);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {told:#?}");
    assert_eq!(told[2..4], ["verify go_to(mug_1)", "feasible"], "{told:#?}");
    assert!(told[4].starts_with("go(") && told.len() == 5, "{told:#?}");
}

#[test]
fn runtime_check_beside_the_run_gives_the_same_verdicts() {
    for scene in [walled(), kitchen()] {
        let (end, told) = play_with(&scene, CHOSEN, CheckMode::Background);
        assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {told:#?}");
        assert_eq!(told, play(&scene, CHOSEN).1);
    }
}

#[test]
fn runtime_check_follows_what_was_seen() {
    for verifies in [CheckMode::AtOnce, CheckMode::Background] {
        // Behind the walls by the scene, and seen in front of them.
        let mug = walled().entities["mug_1"].clone();
        let floor = Placement { xyz: [0.2, -1.2, 0.05], rpy: [0.0; 3] };
        let there = Entity { pose: Some(floor), on: None, ..mug };
        let (_, told) = play_seeing(&walled(), CHOSEN, verifies, vec![there]);
        assert_eq!(told[2..4], ["verify go_to(mug_1)", "feasible"], "{told:#?}");
        // Walls that no scene has.
        let scene = walled();
        let walls = scene.entities.values().filter(|one| one.id.starts_with("wall_")).cloned().collect();
        let (_, told) = play_seeing(&kitchen(), CHOSEN, verifies, walls);
        assert_eq!(told[2], "verify go_to(mug_1)", "{told:#?}");
        assert!(told[3].starts_with("unreachable: "), "{told:#?}");
    }
}

/// Looks how far time comes while a verdict is awaited.
struct Patient {
    host: Host,
    is_asked: bool,
    glances: usize,
}

impl Observer for Patient {
    fn event(&mut self, _now: Time, event: &Event) {
        if matches!(event, Event::Verified { .. }) {
            self.is_asked = false;
        }
        self.glances += usize::from(self.is_asked && *event == Event::Tick);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        self.is_asked |= matches!(effect, Effect::Verify { .. });
        self.host.effect(now, effect);
    }

    fn verifier(&mut self) -> Option<&mut dyn Verifier> {
        Some(self)
    }
}

/// Takes its time: so many glances until the verdict is there.
impl Verifier for Patient {
    fn event(&mut self, now: Time, event: &Event) {
        self.host.guard.event(now, event);
    }

    fn effect(&mut self, effect: &Effect) {
        self.host.guard.effect(effect);
    }

    fn ask(&mut self, check: CheckId, motion: &Arc<DeferredMotion>) {
        self.host.guard.ask(check, motion);
    }

    fn verdict(&mut self) -> Option<(CheckId, Verification)> {
        (self.glances >= 5).then(|| self.host.guard.verdict()).flatten()
    }

    fn is_busy(&self) -> bool {
        self.is_asked
    }
}

#[test]
fn runtime_check_beside_the_run_does_not_block_the_loop() {
    let session = session(&kitchen());
    let mut sim = Sim::new(&hsr(), &kitchen(), SimOptions::default());
    let settings = EngineSettings { verify_within: Some(WITHIN), ..EngineSettings::default() };
    let entities = kitchen().entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone())).collect();
    let start = StartState { entities, ..StartState::default() };
    let mut engine = Engine::new(compile(&session, CHOSEN), &start).unwrap().with_settings(settings);
    let guard = Guard::new(session.world_tracker().unwrap(), CheckMode::AtOnce);
    let host = Host { guard: Waiting(guard), event: None, entries: Vec::new(), told: Vec::new() };
    let mut patient = Patient { host, is_asked: false, glances: 0 };
    let end = run(&mut engine, &mut sim, &mut patient, Time::ZERO);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {:#?}", patient.host.told);
    assert_eq!(patient.glances, 5, "the world went on meanwhile");
}

/// Grip of the pick of a graph, as its witness says.
fn grip_of(graph: &Graph) -> Pose {
    let mut calls = graph.nodes.iter().filter_map(|node| match &node.kind {
        NodeKind::Call(CallNode { motion: Some(motion), .. }) if motion.query == "reach" => Some(motion),
        _ => None,
    });
    let witness = calls.next().unwrap().witness.as_ref().unwrap();
    witness.grasp.as_ref().unwrap().object.unwrap()
}

#[test]
fn knowledge_after_a_run_has_the_grip_of_what_it_took() {
    let (scene, session) = (kitchen(), session(&kitchen()));
    let graph = compile(&session, "policy take for hsr {\n go(kitchen_table)\n pick(mug_1)\n}");
    let entities = scene.entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone())).collect();
    let start = StartState { entities, ..StartState::default() };
    let mut sim = Sim::new(&hsr(), &scene, SimOptions::default());
    let mut engine = Engine::new(graph.clone(), &start).unwrap().with_capabilities(sim.capabilities());
    let end = run(&mut engine, &mut sim, &mut (), Time::ZERO);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}");
    let mut known = Knowledge::default();
    known.learn(&engine, &session);
    let (placed, _) = known.placed(&scene, [0.0; 3]).unwrap();
    let Pose { xyz, quaternion } = grip_of(&graph);
    assert_eq!(placed.robot.grip, Grip::new("mug_1".into(), xyz, quaternion));
    assert_eq!(known.state().grip, placed.robot.grip);
    // A run that takes nothing leaves the hand as it was; one that takes something else does not.
    let learn = |known: &mut Knowledge, policy: &str| {
        known.learn(&Engine::new(compile(&session, policy), &start).unwrap(), &session);
        known.state().grip
    };
    assert_eq!(learn(&mut known, "policy drive for hsr {\n go(user)\n}"), placed.robot.grip);
    assert_eq!(learn(&mut known, "policy take for hsr {\n go(apple)\n pick(apple)\n}"), None);
}

#[test]
fn knowledge_after_a_handover_has_no_obstacle_in_doubt() {
    let (scene, session) = (kitchen(), session(&kitchen()));
    let policy =
        "policy give for hsr {\n go(kitchen_table)\n pick(mug_1)\n go(user)\n handover(mug_1, user)\n}";
    let entities = scene.entities.iter().map(|(id, entity)| (id.clone(), entity.kind.clone())).collect();
    let start = StartState { entities, ..StartState::default() };
    let mut sim = Sim::new(&hsr(), &scene, SimOptions::default());
    let engine = Engine::new(compile(&session, policy), &start).unwrap();
    let mut engine = engine.with_capabilities(sim.capabilities());
    let end = run(&mut engine, &mut sim, &mut (), Time::ZERO);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}");
    let mut known = Knowledge::default();
    known.learn(&engine, &session);
    let (placed, in_doubt) = known.placed(&scene, [0.0; 3]).unwrap();
    assert_eq!((placed.entities["mug_1"].pose, in_doubt.len()), (None, 0));
}

#[test]
fn runtime_check_behind_an_interrupted_drive_begins_where_the_robot_stands() {
    let policy = "policy turn_back for hsr {
        try { within 2 s { go(kitchen_table) } } catch timeout { go(sink) }
    }";
    let (end, told) = play(&kitchen(), policy);
    assert!(matches!(end, RunEnd::Done { .. }), "{end:?}, {told:#?}");
    assert_eq!(told[1..3], ["verify go_to(sink)", "feasible"], "{told:#?}");
}

#[test]
fn tracker_finds_motions_again_once_it_is_told_where_the_robot_stands() {
    let mut tracker = session(&kitchen()).world_tracker().unwrap();
    let to = Value::Entity("sink".into());
    let args = [("to".into(), to.clone())];
    let motion = |tracker: &motet_compiler::WorldTracker| {
        tracker.motion("go", (&args, None), "go_to", std::slice::from_ref(&to))
    };
    let base = [0.5, 0.25, 0.125];
    for primitive in ["go", "search"] {
        tracker.began(primitive);
        tracker.stands([9.0; 3], &[].into());
        tracker.stopped(primitive, &[]);
        assert!(matches!(motion(&tracker), Forecast::Unknown { .. }), "{primitive}");
        tracker.stands(base, &[("arm_lift_joint".into(), 0.05)].into());
        let Forecast::Feasible { witness, .. } = motion(&tracker) else { panic!("{primitive}") };
        assert_eq!(witness.path[0].base, base, "{primitive}");
    }
    let is_lost = |tracker: &mut motet_compiler::WorldTracker| {
        tracker.stands(base, &[].into());
        matches!(motion(tracker), Forecast::Unknown { .. })
    };
    // No robot stands like that.
    tracker.began("go");
    tracker.stopped("go", &[]);
    tracker.stands(base, &[("arm_lift_joint".into(), 9.0)].into());
    assert!(is_lost(&mut tracker));
    // What the hand holds behind a grasp that broke off is not known, until the driver tells it.
    let pick = [("object".into(), Value::Entity("mug_1".into()))];
    let mut tracker = session(&kitchen()).world_tracker().unwrap();
    tracker.began("pick");
    tracker.stopped("pick", &pick);
    assert!(is_lost(&mut tracker));
    tracker.observed("holding", "mug_1", true);
    assert!(is_lost(&mut tracker));
    tracker.observed("holding", "mug_1", false);
    assert!(!is_lost(&mut tracker));
    // Where the thing is by then is not known.
    let mug = [Value::Entity("mug_1".into())];
    let reach = |tracker: &motet_compiler::WorldTracker| tracker.motion("go", (&args, None), "go_to", &mug);
    assert!(matches!(reach(&tracker), Forecast::Unknown { .. }), "{:?}", reach(&tracker));
    // Nor is it where a grasp has succeeded before the robot's place was known.
    let mut tracker = session(&kitchen()).world_tracker().unwrap();
    tracker.began("go");
    tracker.stopped("go", &[]);
    tracker.began("pick");
    tracker.succeeded("pick", &[("object".into(), Value::Entity("mug_1".into()))], None);
    assert!(is_lost(&mut tracker));
    // A thing was lost on the way.
    let mut tracker = session(&kitchen()).world_tracker().unwrap();
    tracker.began("go");
    tracker.observed("holding", "mug_1", true);
    tracker.stopped("go", &[]);
    assert!(is_lost(&mut tracker));
}

#[test]
fn tracker_motions_hold_the_thing_as_the_robot_felt_it() {
    let entity = |id: &str| Value::Entity(id.into());
    let mut tracker = session(&kitchen()).world_tracker().unwrap();
    let step = |tracker: &mut motet_compiler::WorldTracker, primitive: &str, of: &[(&str, &str)]| {
        let args: Vec<_> = of.iter().map(|(name, id)| ((*name).into(), entity(id))).collect();
        tracker.began(primitive);
        tracker.succeeded(primitive, &args, None);
    };
    step(&mut tracker, "go", &[("to", "kitchen_table")]);
    tracker.began("pick");
    // The driver tells it before the hand is back.
    let turned = [0.0, FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2];
    let upside_down = Grip::new("mug_1".into(), [0.0, 0.0, 0.09], turned).unwrap();
    tracker.felt(upside_down.clone());
    let pick = [("object".into(), entity("mug_1")), ("from".into(), Value::Case("auto".into()))];
    tracker.succeeded("pick", &pick, None);
    step(&mut tracker, "go", &[("to", "user")]);
    let (thing, person) = (entity("mug_1"), entity("user"));
    let args = [("object".into(), thing.clone()), ("to".into(), person.clone())];
    let held = |tracker: &motet_compiler::WorldTracker| {
        let forecast = tracker.motion("handover", (&args, None), "offer", &[thing.clone(), person.clone()]);
        let Forecast::Feasible { witness, .. } = forecast else { panic!("{forecast:?}") };
        let Pose { xyz, quaternion } = witness.grasp.unwrap().object.unwrap();
        Grip::new("mug_1".into(), xyz, quaternion).unwrap().tip_from_object
    };
    let far = |one: Placement, other: Placement| {
        let parts = one.xyz.into_iter().chain(one.rpy).zip(other.xyz.into_iter().chain(other.rpy));
        parts.map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
    };
    assert!(far(held(&tracker), upside_down.tip_from_object) < 1e-3, "{:?}", held(&tracker));
    // The grip of another thing is none of what it holds.
    tracker.felt(Grip { of: "apple".into(), ..upside_down.clone() });
    assert!(far(held(&tracker), upside_down.tip_from_object) < 1e-3);
}
