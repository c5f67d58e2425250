//! The state that an engine hands out, and an engine that starts from it.

use motet_arbitrary::graph::{StepSketch, graph};
use motet_graph::{Grasp, Motion, NodeKind, Pose, Term, Value, Verdict, Waypoint, Witness};
use motet_runtime::{
    Answer, DriverEvent, Effect, Engine, Event, Outcome, Pattern, Query, Snapshot, StartState, Time,
};

/// Picks the mug, sees the distance to the user, and looks for the cup.
fn halfway() -> Engine {
    let steps = [StepSketch::pick("mug"), StepSketch::detect("cup"), StepSketch::detect("bowl")];
    let mut engine = Engine::new(graph(&steps), &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    for (secs, value) in [(1.0, None), (2.0, Some(Value::Entity("cup_1".into())))] {
        let goal = out.iter().rev().find_map(|effect| match effect {
            Effect::Start { goal, .. } => Some(*goal),
            _ => None,
        });
        let ended = DriverEvent::Ended { goal: goal.unwrap(), outcome: Outcome::Success(value) };
        engine.handle(Time::from_secs(secs), Event::Driver(ended), &mut out);
    }
    let seen = Query::Fact {
        fluent: "at".into(),
        args: vec![Pattern::Any, Pattern::Is(Value::Entity("shelf".into()))],
    };
    let seen = DriverEvent::Observed { query: seen, answer: Answer::Truth(true) };
    engine.handle(Time::from_secs(2.5), Event::Driver(seen), &mut out);
    engine
}

#[test]
fn snapshot_says_what_is_held_and_bound_and_runs() {
    let snapshot = halfway().snapshot();
    assert_eq!(snapshot.at, Time::from_secs(2.5));
    assert_eq!(snapshot.bindings, vec![("it'0".into(), Value::Entity("cup_1".into()))]);
    assert_eq!(snapshot.some.len(), 1);
    let running: Vec<String> =
        snapshot.goals.iter().map(|goal| format!("{} {}", goal.path, goal.command)).collect();
    assert_eq!(running, ["/steps/2 detect(what: \"bowl\")"]);
    let state = snapshot.state();
    let said = |fact: &str| state.iter().rev().find(|(said, _)| said == fact).map(|(_, truth)| *truth);
    assert_eq!(said("holding(mug)"), Some(Some(true)));
    assert_eq!(said("holding(any)"), Some(Some(false)));
    assert_eq!(said("at(mug, any)"), Some(Some(false)));
}

#[test]
fn snapshot_engine_that_starts_from_it_believes_the_same() {
    let first = halfway();
    let again = Engine::new(first.graph().clone(), &first.snapshot().start_state()).unwrap();
    let beliefs = |snapshot: Snapshot| {
        let mut facts =
            snapshot.facts.iter().map(|(query, truth)| format!("{query} {truth}")).collect::<Vec<_>>();
        facts.dedup();
        (facts, snapshot.some.len())
    };
    assert_eq!(beliefs(again.snapshot()), beliefs(first.snapshot()));
    let shelf = [Pattern::Any, Pattern::Is(Value::Entity("shelf".into()))];
    assert_eq!(again.believes("at", &shelf), first.believes("at", &shelf));
}

#[test]
fn snapshot_words_of_the_language_stand_in_back_quotes() {
    let grammar = include_str!("../../../../grammar/syntax/src/motet.pest");
    let rule = grammar.split("\nreserved = _{").nth(1).and_then(|rest| rest.split("~ !rest").next()).unwrap();
    let words: Vec<&str> = rule.split('"').skip(1).step_by(2).collect();
    assert!(words.len() > 20, "{words:?}");
    let mut engine = halfway();
    for word in &words {
        let args = [*word, "shelf"].map(|id| Pattern::Is(Value::Entity(id.into()))).to_vec();
        let query = Query::Fact { fluent: "at".into(), args };
        let seen = DriverEvent::Observed { query, answer: Answer::Truth(true) };
        engine.handle(Time::from_secs(3.0), Event::Driver(seen), &mut Vec::new());
    }
    let state = engine.snapshot().state();
    for word in words {
        let fact = format!("at(`{word}`, shelf)");
        assert!(state.contains(&(fact.clone(), Some(true))), "{fact} is not among {state:?}");
    }
}

/// Grips in the snapshot after a pick of the mug, whose witness has this one, while the driver told these.
fn grips(planned: Option<Pose>, told: &[Pose]) -> Vec<Value> {
    let mut graph = graph(&[StepSketch::pick("mug")]);
    let witness = planned.map(|object| {
        let grasp =
            Grasp { xyz: [0.0; 3], quaternion: [0.0, 0.0, 0.0, 1.0], width: 0.1, object: Some(object) };
        let path = vec![Waypoint { base: [0.0; 3], joints: vec![], at: 0.0, ramp: 0.0 }];
        let (joints, clearance, keeps) = (vec![], 0.1, motet_graph::Clearance::default());
        Box::new(Witness { joints, path, grasp: Some(grasp), clearance, keeps, limit: None, payload: None })
    });
    let verdict = if witness.is_some() { Verdict::Proven } else { Verdict::Deferred };
    let args = vec![Term::Literal(Value::Entity("mug".into()))];
    let motion = Motion { query: "reach".into(), args, verdict, witness, leaves: None, why: None };
    let NodeKind::Call(call) = &mut graph.nodes[0].kind else { panic!("no call") };
    call.motion = Some(motion);
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let goal = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let (goal, query) = (goal.unwrap(), Query::Field { entity: "mug".into(), field: "grip".into() });
    for pose in told {
        let answer = Answer::Value(Value::Pose(*pose));
        let told = DriverEvent::Observed { query: query.clone(), answer };
        engine.handle(Time::from_secs(1.0), Event::Driver(told), &mut out);
    }
    let ended = DriverEvent::Ended { goal, outcome: Outcome::Success(None) };
    engine.handle(Time::from_secs(2.0), Event::Driver(ended), &mut out);
    let readings = engine.snapshot().readings.into_iter();
    readings.filter(|reading| reading.query == query).map(|reading| reading.value).collect()
}

#[test]
fn snapshot_after_a_grasp_has_the_grip_of_the_driver_or_else_of_the_witness() {
    let pose = |x| Pose { xyz: [x, 0.0, 0.1], quaternion: [0.0, 0.0, 0.0, 1.0] };
    assert_eq!(grips(Some(pose(0.0)), &[]), [Value::Pose(pose(0.0))]);
    assert_eq!(grips(Some(pose(0.0)), &[pose(0.01), pose(0.02)]), [Value::Pose(pose(0.02))]);
    assert_eq!(grips(None, &[pose(0.01)]), [Value::Pose(pose(0.01))]);
    assert_eq!(grips(None, &[]), []);
}
