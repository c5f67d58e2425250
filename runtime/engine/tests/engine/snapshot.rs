//! The state that an engine hands out, and an engine that starts from it.

use motet_graph::Value;
use motet_graph::arbitrary::{StepSketch, graph};
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
