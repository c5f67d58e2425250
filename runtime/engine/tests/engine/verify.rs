//! Motions that were left to the run: somebody is asked before the call starts, and what they say decides.

use motet_arbitrary::graph::{ReactionSketch, StepSketch, WatchSketch, graph, vocabulary as v};
use motet_graph::{Condition, Graph, Motion, NodeKind, PrimitiveId, Verdict};
use motet_runtime::{
    Answer, CheckId, DriverEvent, Effect, Engine, EngineSettings, Event, Outcome, Pattern, PreparedSwap,
    Query, StartState, Time, Verification,
};

/// The calls of some primitives have a motion that is left to the run.
pub(crate) fn with_motions(mut graph: Graph, of: &[PrimitiveId]) -> Graph {
    for node in &mut graph.nodes {
        if let NodeKind::Call(call) = &mut node.kind
            && of.contains(&call.primitive)
        {
            call.motion = Some(Motion {
                query: "reach".into(),
                args: call.args.clone(),
                verdict: Verdict::Deferred,
                witness: None,
                leaves: None,
                why: None,
            });
        }
    }
    graph
}

/// A run with what the engine wants done since the last look.
struct Scene {
    engine: Engine,
    out: Vec<Effect>,
}

impl Scene {
    fn new(steps: &[StepSketch], verify_within: Option<f64>) -> Self {
        let settings =
            EngineSettings { verify_within: verify_within.map(Time::from_secs), ..EngineSettings::default() };
        let engine = Engine::new(with_motions(graph(steps), &[v::GO]), &StartState::default()).unwrap();
        let mut scene = Self { engine: engine.with_settings(settings), out: Vec::new() };
        scene.feed(0.0, Event::Begin);
        scene
    }

    fn feed(&mut self, at: f64, event: Event) {
        self.engine.handle(Time::from_secs(at), event, &mut self.out);
    }

    fn verdict(&mut self, at: f64, check: CheckId, verdict: Verification) {
        self.feed(at, Event::Verified { check, verdict });
    }

    /// What was started and asked since the last look.
    fn look(&mut self) -> (Vec<String>, Vec<CheckId>) {
        let (mut said, mut checks) = (Vec::new(), Vec::new());
        for effect in self.out.drain(..) {
            match effect {
                Effect::Start { command, .. } => said.push(command.to_string()),
                Effect::Verify { check, motion, .. } => {
                    said.push(format!("verify {motion}"));
                    checks.push(check);
                }
                Effect::Finished(end) => said.push(end.to_string()),
                _ => {}
            }
        }
        (said, checks)
    }
}

fn infeasible() -> Verification {
    Verification::Infeasible { failure: "unreachable".into(), why: "0.14 m too high".into() }
}

fn unknown() -> Verification {
    Verification::Unknown { why: "the search was cut short".into() }
}

#[test]
fn verify_where_nobody_is_to_be_asked_the_driver_will_see() {
    let mut scene = Scene::new(&[StepSketch::go("table")], None);
    assert_eq!(scene.look().0, ["go(to: table)"]);
}

#[test]
fn verify_motion_that_is_found_or_not_known_starts() {
    for verdict in [Verification::Feasible { witness: None, leaves: None }, unknown()] {
        let mut scene = Scene::new(&[StepSketch::go("table")], Some(1.0));
        let (said, checks) = scene.look();
        assert_eq!(said, ["verify reach(table)"]);
        scene.verdict(0.5, checks[0], verdict);
        assert_eq!(scene.look().0, ["go(to: table)"]);
    }
}

#[test]
fn verify_one_that_is_infeasible_fails_and_is_caught() {
    let caught = StepSketch::Try(
        vec![StepSketch::go("table")],
        vec![(Some(vec![v::UNREACHABLE]), vec![StepSketch::say("no")])],
    );
    let mut scene = Scene::new(&[caught], Some(1.0));
    let (_, checks) = scene.look();
    scene.verdict(0.5, checks[0], infeasible());
    assert_eq!(scene.look().0, ["say(text: \"no\")"]);
}

#[test]
fn verify_second_verdict_and_one_that_nobody_waits_for_are_ignored() {
    let mut scene = Scene::new(&[StepSketch::go("table"), StepSketch::go("sink")], Some(1.0));
    let (_, checks) = scene.look();
    scene.verdict(0.5, CheckId::from_number(77), infeasible());
    scene.verdict(0.5, checks[0], Verification::Feasible { witness: None, leaves: None });
    scene.verdict(0.5, checks[0], infeasible());
    assert_eq!(scene.look().0, ["go(to: table)"]);
}

#[test]
fn verify_without_a_verdict_in_time_the_step_starts_all_the_same() {
    let mut scene = Scene::new(&[StepSketch::go("table")], Some(1.0));
    assert_eq!(scene.engine.wake_at(), Some(Time::from_secs(1.0)));
    scene.look();
    scene.feed(1.0, Event::Tick);
    assert_eq!(scene.look().0, ["go(to: table)"]);
}

#[test]
fn verify_what_is_interrupted_meanwhile_asks_anew() {
    let holds = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("cup")]));
    let watch = WatchSketch::new(holds, ReactionSketch::Pause(60.0));
    let mut scene = Scene::new(&[StepSketch::Monitor(vec![watch], vec![StepSketch::go("table")])], Some(1.0));
    let (_, before) = scene.look();
    let holding = |truth| {
        let args = vec![Pattern::Is(motet_graph::Value::Entity("cup".into()))];
        let query = Query::Fact { fluent: "holding".into(), args };
        Event::Driver(DriverEvent::Observed { query, answer: Answer::Truth(truth) })
    };
    scene.feed(0.1, holding(true));
    scene.verdict(0.2, before[0], Verification::Feasible { witness: None, leaves: None });
    assert_eq!(scene.look().0, [""; 0], "it is paused");
    scene.feed(0.3, holding(false));
    let (said, after) = scene.look();
    assert_eq!(said, ["verify reach(table)"]);
    assert_ne!(before, after);
}

#[test]
fn verify_after_a_swap_the_verdict_for_the_policy_before_is_ignored() {
    let mut scene = Scene::new(&[StepSketch::go("table")], Some(1.0));
    let (_, before) = scene.look();
    let mut next = with_motions(graph(&[StepSketch::go("table")]), &[v::GO]);
    next.initial.clear();
    let prepared = PreparedSwap::new(next, &scene.engine.running()).unwrap();
    scene.engine.swap(Time::from_secs(0.1), prepared, &mut scene.out).unwrap();
    let (said, after) = scene.look();
    assert_eq!(said, ["verify reach(table)"]);
    scene.verdict(0.2, before[0], Verification::Feasible { witness: None, leaves: None });
    assert_eq!(scene.look().0, [""; 0]);
    scene.verdict(0.3, after[0], Verification::Feasible { witness: None, leaves: None });
    assert_eq!(scene.look().0, ["go(to: table)"]);
}

#[test]
fn verify_retry_asks_again() {
    let go = motet_arbitrary::graph::CallSketch::new(v::GO, vec![v::entity("table")]).retry(1);
    let mut scene = Scene::new(&[StepSketch::Call(go)], Some(1.0));
    let (_, checks) = scene.look();
    scene.verdict(0.1, checks[0], infeasible());
    let (said, checks) = scene.look();
    assert_eq!(said, ["verify reach(table)"]);
    scene.verdict(0.2, checks[0], Verification::Feasible { witness: None, leaves: None });
    let started = scene.out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let ended = DriverEvent::Ended { goal: started.unwrap(), outcome: Outcome::Success(None) };
    scene.feed(1.0, Event::Driver(ended));
    assert_eq!(scene.look().0, ["go(to: table)", "done"]);
}
