//! Another policy takes over: what goes on, what is updated, what is cancelled and what waits for it; and
//! what is refused.

use crate::check;
use crate::script::Feed::{Ack, Done, Fails, Gives, Interrupted, Lost, Refused, Stop, Stopped, Swap, Tick};
use crate::script::{distance, entity, holding};
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, graph, vocabulary as v};
use motet_graph::{Condition, Fact, FactArg, Graph, InitialFact, Manner, NodeId, Value};
use motet_runtime::{
    Capabilities, DriverEvent, Effect, Engine, Event, Outcome, PreparedSwap, PrimitiveSet, RunEnd,
    StartState, SwapRefusal, Time, Truth,
};

fn pauses(within: f64, steps: Vec<StepSketch>) -> StepSketch {
    StepSketch::Monitor(vec![WatchSketch::new(v::nearer("user", 0.5), ReactionSketch::Pause(within))], steps)
}

#[test]
fn swap_same_call_goes_on() {
    check!(
        [StepSketch::go("table"), StepSketch::say("old")],
        [
            (0.1, Ack(1)),
            (1.0, Swap(vec![StepSketch::go("table"), StepSketch::say("new")])),
            (2.0, Done(1)),
            (3.0, Done(2))
        ]
    );
}

#[test]
fn swap_call_that_was_not_acknowledged_goes_on() {
    check!(
        [StepSketch::go("table")],
        [(1.0, Swap(vec![StepSketch::go("table")])), (1.1, Ack(1)), (11.0, Tick)]
    );
}

#[test]
fn swap_another_target_is_an_update() {
    check!(
        [StepSketch::go("table")],
        [(0.1, Ack(1)), (1.0, Swap(vec![StepSketch::go("shelf"), StepSketch::say("new")])), (2.0, Done(1))]
    );
}

/// A call in another manner is another command.
#[test]
fn swap_another_manner_is_an_update() {
    let manner = Some(Manner { speed: 0.5, acceleration: 0.5 });
    let slowly = StepSketch::Call(CallSketch { manner, ..CallSketch::new(v::GO, vec![v::entity("table")]) });
    check!(
        [StepSketch::go("table")],
        [(0.1, Ack(1)), (1.0, Swap(vec![slowly, StepSketch::say("new")])), (2.0, Done(1))]
    );
}

#[test]
fn swap_what_cannot_be_updated_is_cancelled_and_waited_for() {
    check!(
        [StepSketch::detect("mug"), StepSketch::say("old")],
        [
            (0.1, Ack(1)),
            (1.0, Swap(vec![StepSketch::detect("cup")])),
            (1.5, Interrupted(1)),
            (2.0, Gives(2, entity("cup_1")))
        ]
    );
}

#[test]
fn swap_what_does_not_conflict_starts_at_once() {
    check!(
        [StepSketch::go("table")],
        [
            (0.1, Ack(1)),
            (1.0, Swap(vec![StepSketch::detect("cup")])),
            (1.5, Gives(2, entity("cup_1"))),
            (1.6, Interrupted(1))
        ]
    );
}

#[test]
fn swap_success_after_the_swap_is_respected() {
    let place = CallSketch::new(v::PLACE, vec![v::entity("mug"), v::entity("table")]);
    check!(
        [StepSketch::pick("mug")],
        [(0.1, Ack(1)), (1.0, Swap(vec![StepSketch::Call(place)])), (1.5, Done(1)), (2.0, Done(2))]
    );
}

#[test]
fn swap_failure_after_the_swap_concerns_nobody() {
    check!(
        [StepSketch::go("table")],
        [
            (0.1, Ack(1)),
            (1.0, Swap(vec![StepSketch::say("new")])),
            (1.5, Fails(1, "unreachable")),
            (2.0, Done(2))
        ]
    );
}

#[test]
fn swap_start_that_is_refused_after_the_swap_frees_its_resources() {
    check!(
        [StepSketch::detect("mug")],
        [(1.0, Swap(vec![StepSketch::detect("cup")])), (1.5, Refused(1, "unsafe"))]
    );
}

#[test]
fn swap_cancel_waits_for_the_acknowledgement_also_across_a_swap() {
    check!(
        [StepSketch::detect("mug")],
        [(1.0, Swap(vec![StepSketch::detect("cup")])), (1.1, Ack(1)), (1.2, Interrupted(1)), (1.3, Ack(2))]
    );
}

#[test]
fn swap_in_the_middle_of_a_cancel_the_cancel_is_waited_for() {
    check!(
        [StepSketch::go("table")],
        [
            (0.1, Ack(1)),
            (10.0, Tick),
            (10.1, Swap(vec![StepSketch::go("table")])),
            (10.5, Interrupted(1)),
            (11.0, Done(2))
        ]
    );
}

#[test]
fn swap_safe_stop_that_is_pending_is_waited_for() {
    check!(
        [StepSketch::go("table")],
        [
            (0.1, Ack(1)),
            (10.0, Tick),
            (15.0, Tick),
            (15.1, Swap(vec![StepSketch::go("shelf")])),
            (16.0, Stopped(1))
        ]
    );
}

#[test]
fn swap_unanswered_cancel_of_the_old_policy_becomes_a_safe_stop_and_a_fault() {
    check!(
        [StepSketch::detect("mug")],
        [(0.1, Ack(1)), (1.0, Swap(vec![StepSketch::detect("cup")])), (6.0, Tick), (11.0, Tick)]
    );
}

#[test]
fn swap_goal_of_the_old_policy_that_is_lost() {
    check!(
        [StepSketch::detect("mug")],
        [(0.1, Ack(1)), (1.0, Swap(vec![StepSketch::detect("cup")])), (1.5, Lost(1)), (2.0, Stopped(1))]
    );
}

#[test]
fn swap_held_goal_goes_on_where_nothing_holds_it() {
    check!(
        [pauses(60.0, vec![StepSketch::go("table")])],
        [(0.1, Ack(1)), (1.0, distance(0.3)), (2.0, Swap(vec![StepSketch::go("table")]))]
    );
}

#[test]
fn swap_monitor_of_the_new_policy_is_judged_at_once() {
    check!(
        [pauses(60.0, vec![StepSketch::go("table")])],
        [
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (2.0, Swap(vec![pauses(30.0, vec![StepSketch::go("table")])])),
            (2.5, Interrupted(1)),
            (3.0, distance(0.8))
        ]
    );
}

#[test]
fn swap_what_is_watched_by_both_stays_watched() {
    check!(
        [pauses(60.0, vec![StepSketch::go("table")])],
        [
            (0.1, Ack(1)),
            (1.0, distance(0.8)),
            (2.0, Swap(vec![pauses(30.0, vec![StepSketch::go("table")])])),
            (2.5, distance(0.3))
        ]
    );
}

#[test]
fn swap_out_of_a_parallel_into_a_parallel() {
    let both =
        |go: &str| StepSketch::Parallel(vec![vec![StepSketch::go(go)], vec![StepSketch::detect("mug")]]);
    check!([both("table")], [(0.1, Ack(1)), (0.1, Ack(2)), (1.0, Swap(vec![both("shelf")])), (2.0, Done(1))]);
}

#[test]
fn swap_newest_swap_wins() {
    check!(
        [StepSketch::detect("mug")],
        [
            (0.1, Ack(1)),
            (1.0, Swap(vec![StepSketch::detect("cup")])),
            (1.1, Swap(vec![StepSketch::detect("bowl")])),
            (1.5, Interrupted(1))
        ]
    );
}

#[test]
fn swap_policy_that_is_done_at_once_waits_for_the_goals_of_the_one_before() {
    check!([StepSketch::go("table")], [(0.1, Ack(1)), (1.0, Swap(vec![])), (1.5, Interrupted(1))]);
}

#[test]
fn swap_person_who_stops_is_not_overruled() {
    check!(
        [StepSketch::go("table")],
        [(0.1, Ack(1)), (1.0, Stop), (1.1, Swap(vec![StepSketch::say("no")])), (1.5, Interrupted(1))]
    );
}

#[test]
fn swap_wait_and_a_queue_are_left() {
    let wait = StepSketch::Wait(Condition::Fact(v::fact(v::HOLDING, vec![v::entity("mug")])), 5.0);
    check!([wait], [(1.0, Swap(vec![StepSketch::say("new")])), (1.5, holding("mug", true)), (2.0, Done(1))]);
}

/// Has started to go to the table.
fn going() -> (Engine, Vec<Effect>) {
    let mut engine =
        Engine::new(graph(&[StepSketch::detect("mug"), StepSketch::go("table")]), &StartState::default())
            .unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let goal = out
        .iter()
        .find_map(|effect| if let Effect::Start { goal, .. } = effect { Some(*goal) } else { None });
    let outcome = Outcome::Success(Some(Value::Entity("mug_1".into())));
    let ended = DriverEvent::Ended { goal: goal.unwrap(), outcome };
    engine.handle(Time::from_secs(1.0), Event::Driver(ended), &mut out);
    (engine, out)
}

/// Refused, and nothing has changed: neither what went out nor anything within.
#[track_caller]
fn refused(graph: Graph) -> SwapRefusal {
    refused_by(graph, Capabilities::default())
}

/// The same in front of a driver with these capabilities.
#[track_caller]
fn refused_by(graph: Graph, can: Capabilities) -> SwapRefusal {
    let (engine, mut out) = going();
    let mut engine = engine.with_capabilities(can);
    let prepared = match PreparedSwap::new(graph, &engine.running()) {
        Ok(prepared) => prepared,
        Err(refusal) => return refusal,
    };
    let (before, effects) = (format!("{engine:?}"), out.len());
    let refusal = engine.swap(Time::from_secs(2.0), prepared, &mut out).unwrap_err();
    assert_eq!(format!("{engine:?}"), before);
    assert_eq!(out.len(), effects);
    refusal
}

#[test]
fn swap_invalid_graph_is_refused() {
    let mut graph = graph(&[StepSketch::go("table")]);
    graph.nodes[0].next = Some(NodeId(7));
    assert!(matches!(refused(graph), SwapRefusal::Invalid(_)));
}

#[test]
fn swap_another_robot_is_refused() {
    let mut graph = graph(&[StepSketch::go("table")]);
    graph.robot = "another".into();
    assert_eq!(refused(graph), SwapRefusal::Robot { running: "mock".into(), wanted: "another".into() });
}

#[test]
fn swap_primitive_that_the_driver_lacks_is_refused() {
    let only = |names: &[&str]| PrimitiveSet::Only(names.iter().map(|name| (*name).into()).collect());
    let can = |names: &[&str]| Capabilities { primitives: only(names), ..Capabilities::default() };
    let steps =
        [StepSketch::go("table"), StepSketch::say("a"), StepSketch::detect("mug"), StepSketch::say("b")];
    let refusal = refused_by(graph(&steps), can(&["go"]));
    assert_eq!(refusal.to_string(), "the driver does not have `say` (at /steps/1), `detect` (at /steps/2)");
    assert_eq!(can(&["go", "say", "detect"]).missing(&graph(&steps)), []);
    assert_eq!(Capabilities::default().missing(&graph(&steps)), []);
}

#[test]
fn swap_start_that_does_not_hold_is_refused() {
    let mut graph = graph(&[StepSketch::go("table")]);
    graph.initial = vec![InitialFact { fact: v::fact(v::HOLDING, vec![v::entity("mug")]), value: true }];
    let SwapRefusal::Start { told, believed, .. } = refused(graph) else { panic!("another refusal") };
    assert_eq!((told, believed), (true, Truth::False));
}

#[test]
fn swap_start_that_is_no_longer_known_is_refused() {
    // Where the robot is, is unknown after it was interrupted; so far only that it stands nowhere known is
    // not said.
    let (mut engine, mut out) = going();
    let prepare = |engine: &Engine, initial| {
        let mut graph = graph(&[StepSketch::say("new")]);
        graph.initial = initial;
        PreparedSwap::new(graph, &engine.running()).unwrap()
    };
    let somewhere = vec![InitialFact {
        fact: v::fact(v::AT, vec![v::entity("robot"), v::entity("table")]),
        value: false,
    }];
    let prepared = prepare(&engine, somewhere.clone());
    engine.swap(Time::from_secs(2.0), prepared, &mut out).unwrap();
    let goal = engine.snapshot().goals[0].goal;
    let ended = DriverEvent::Ended { goal, outcome: Outcome::Interrupted };
    engine.handle(Time::from_secs(2.5), Event::Driver(ended), &mut out);
    let prepared = prepare(&engine, somewhere);
    let refusal = engine.swap(Time::from_secs(3.0), prepared, &mut out).unwrap_err();
    assert!(matches!(refusal, SwapRefusal::Start { believed: Truth::Unknown, .. }), "{refusal}");
}

/// A graph that is given the object that the running policy found.
fn given(name: &str) -> Graph {
    let mut graph = graph(&[
        StepSketch::detect("cup"),
        StepSketch::Call(CallSketch::new(v::PICK, vec![CallSketch::NEAREST])),
    ]);
    graph.bindings[0].given = true;
    graph.bindings[0].name = name.into();
    graph.initial =
        vec![InitialFact { fact: Fact { fluent: v::HOLDING, args: vec![FactArg::Any] }, value: false }];
    graph
}

#[test]
fn swap_name_that_is_not_bound_is_refused() {
    assert_eq!(refused(given("nobody")), SwapRefusal::Binding { name: "nobody".into() });
}

#[test]
fn swap_name_is_carried() {
    let (mut engine, mut out) = going();
    let prepared = PreparedSwap::new(given("it'0"), &engine.running()).unwrap();
    engine.swap(Time::from_secs(2.0), prepared, &mut out).unwrap();
    assert_eq!(engine.snapshot().bindings, vec![("it'0".into(), Value::Entity("mug_1".into()))]);
    assert_eq!(engine.revision(), 1);
    assert_eq!(engine.graph_at(0).unwrap().nodes.len(), 2);
}

#[test]
fn swap_host_gives_names_too() {
    assert!(Engine::new(given("it"), &StartState::default()).is_err());
    let bindings = vec![("it".into(), Value::Entity("cup_2".into()))];
    let engine = Engine::new(given("it"), &StartState { bindings, ..StartState::default() }).unwrap();
    assert_eq!(engine.binding(motet_graph::BindingId(0)), Some(&Value::Entity("cup_2".into())));
}

#[test]
fn swap_run_that_is_over_takes_no_swap() {
    let mut engine = Engine::new(graph(&[]), &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    assert!(
        matches!(out.last(), Some(Effect::Finished(end)) if **end == RunEnd::Done { why: None, result: None })
    );
    let prepared = PreparedSwap::new(graph(&[]), &engine.running()).unwrap();
    assert_eq!(engine.swap(Time::ZERO, prepared, &mut out).unwrap_err(), SwapRefusal::Over);
}

#[test]
fn swap_prepared_against_an_older_graph_still_fits() {
    let (mut engine, mut out) = going();
    let first = PreparedSwap::new(given("it'0"), &engine.running()).unwrap();
    let second = PreparedSwap::new(given("it'0"), &engine.running()).unwrap();
    engine.swap(Time::from_secs(2.0), first, &mut out).unwrap();
    engine.swap(Time::from_secs(2.1), second, &mut out).unwrap();
    assert_eq!((engine.revision(), engine.snapshot().bindings.len()), (2, 1));
}

/// The steps of the cleanups that are left.
fn left(engine: &Engine) -> Vec<String> {
    engine.snapshot().pending.iter().flat_map(|pending| pending.steps.clone()).collect()
}

fn ended(engine: &mut Engine, outcome: Outcome) -> Vec<Effect> {
    let goal = engine.snapshot().goals[0].goal;
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Driver(DriverEvent::Acknowledged { goal }), &mut out);
    engine.handle(Time::ZERO, Event::Driver(DriverEvent::Ended { goal, outcome }), &mut out);
    out
}

#[test]
fn swap_cleanups_of_the_old_policy_are_left_until_their_calls_were_carried_out() {
    let finally = |body: StepSketch, cleanup: Vec<StepSketch>| StepSketch::Finally(vec![body], cleanup);
    let first =
        graph(&[finally(StepSketch::go("table"), vec![StepSketch::go("shelf"), StepSketch::say("a")])]);
    let mut engine = Engine::new(first, &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    assert_eq!(left(&engine), ["go(shelf)", "say(\"a\")"]);
    let swap = |engine: &mut Engine, steps: &[StepSketch]| {
        let mut next = graph(steps);
        next.initial.clear();
        let prepared = PreparedSwap::new(next, &engine.running()).unwrap();
        engine.swap(Time::ZERO, prepared, &mut Vec::new()).unwrap();
    };
    let next = [finally(StepSketch::say("b"), vec![StepSketch::say("c")]), StepSketch::go("shelf")];
    swap(&mut engine, &next);
    // Those of the old policy come first.
    assert_eq!(left(&engine), ["go(shelf)", "say(\"a\")", "say(\"c\")"]);
    // Through another swap, through JSON and into another engine.
    swap(&mut engine, &[StepSketch::go("shelf"), StepSketch::say("d")]);
    assert_eq!(left(&engine), ["go(shelf)", "say(\"a\")", "say(\"c\")"]);
    let start = serde_json::to_string(&engine.snapshot().start_state()).unwrap();
    let start: StartState = serde_json::from_str(&start).unwrap();
    let other = Engine::new(graph(&[]), &start).unwrap();
    assert_eq!(left(&other), left(&engine));
    // The goal of the first policy ends before that of the new one begins.
    let goal = engine.snapshot().goals[0].goal;
    engine.handle(Time::ZERO, Event::Driver(DriverEvent::Acknowledged { goal }), &mut out);
    let interrupted = DriverEvent::Ended { goal, outcome: Outcome::Interrupted };
    engine.handle(Time::ZERO, Event::Driver(interrupted), &mut out);
    while engine.snapshot().goals.iter().any(|live| live.command.primitive == "say") {
        ended(&mut engine, Outcome::Success(None));
    }
    ended(&mut engine, Outcome::Success(None));
    assert_eq!(left(&engine), ["say(\"a\")", "say(\"c\")"]);
}

#[test]
fn swap_cleanup_that_a_stop_or_a_lost_driver_kept_from_running_is_left() {
    let policy = [StepSketch::Finally(vec![StepSketch::go("table")], vec![StepSketch::say("a")])];
    for event in [Event::Stop, Event::Driver(DriverEvent::DriverLost)] {
        let mut engine = Engine::new(graph(&policy), &StartState::default()).unwrap();
        let mut out = Vec::new();
        engine.handle(Time::ZERO, Event::Begin, &mut out);
        let goal = engine.snapshot().goals[0].goal;
        engine.handle(Time::ZERO, Event::Driver(DriverEvent::Acknowledged { goal }), &mut out);
        engine.handle(Time::ZERO, event, &mut out);
        engine.handle(Time::ZERO, Event::Driver(DriverEvent::Stopped { goal }), &mut out);
        assert!(engine.is_over());
        assert_eq!(left(&engine), ["say(\"a\")"]);
        assert_eq!(left(&Engine::new(graph(&[]), &engine.snapshot().start_state()).unwrap()), ["say(\"a\")"]);
    }
}
