//! Every kind of step but calls and monitors.

use crate::check;
use crate::script::Feed::{Ack, Done, Fails, Gives, Interrupted, Tick};
use crate::script::{distance, entity, holding};
use motet_arbitrary::graph::{CallSketch, StepSketch, vocabulary as v};
use motet_graph::{Condition, Ending, Fact, FactArg, Term, Value};
use motet_runtime::{Effect, Engine, EngineSettings, Event, Fault, RunEnd, StartState, Time};

fn held(object: &str) -> Condition {
    Condition::Fact(v::fact(v::HOLDING, vec![v::entity(object)]))
}

fn trusted() -> Condition {
    Condition::Fact(v::fact(v::TRUSTED, vec![v::entity("mug")]))
}

#[test]
fn control_groups_nest() {
    check!(
        [StepSketch::Sequence(vec![StepSketch::Sequence(vec![StepSketch::say("a")]), StepSketch::say("b")])],
        [(1.0, Done(1)), (2.0, Done(2)),]
    );
}

#[test]
fn control_done_ends_the_policy() {
    check!([StepSketch::Sequence(vec![StepSketch::End(Ending::Done), StepSketch::say("never")])], []);
}

#[test]
fn control_fail_ends_the_policy() {
    check!(
        [StepSketch::Try(vec![StepSketch::End(Ending::Fail)], vec![(None, vec![StepSketch::say("never")])])],
        []
    );
}

#[test]
fn control_replan_ends_the_policy() {
    check!([StepSketch::Inline(vec![StepSketch::End(Ending::Replan)]), StepSketch::say("never")], []);
}

#[test]
fn control_done_ends_a_sub_policy() {
    check!(
        [
            StepSketch::Inline(vec![StepSketch::Sequence(vec![
                StepSketch::End(Ending::Done),
                StepSketch::say("never")
            ])]),
            StepSketch::say("on")
        ],
        [(1.0, Done(1)),]
    );
}

#[test]
fn control_fail_fails_a_sub_policy() {
    let part = StepSketch::Inline(vec![StepSketch::End(Ending::Fail)]);
    check!(
        [StepSketch::Try(vec![part], vec![(Some(vec![v::FAILED]), vec![StepSketch::say("caught")])])],
        [(1.0, Done(1))]
    );
}

#[test]
fn control_done_in_a_branch_waits_for_the_other() {
    let part = StepSketch::Inline(vec![StepSketch::Parallel(vec![
        vec![StepSketch::go("table")],
        vec![StepSketch::say("a"), StepSketch::End(Ending::Done)],
    ])]);
    check!([part, StepSketch::say("on")], [(0.1, Ack(1)), (1.0, Done(2)), (1.5, Interrupted(1))]);
}

#[test]
fn control_known_condition_is_tested_at_once() {
    check!(
        [StepSketch::If(held("mug"), vec![StepSketch::say("yes")], Some(vec![StepSketch::say("no")]))],
        []
    );
}

#[test]
fn control_unknown_condition_is_observed_first() {
    let near = StepSketch::If(
        v::nearer("user", 1.0),
        vec![StepSketch::say("yes")],
        Some(vec![StepSketch::say("no")]),
    );
    check!([near], [(0.1, distance(0.4))]);
}

#[test]
fn control_condition_that_stays_unknown_counts_as_false() {
    check!([StepSketch::If(v::nearer("user", 1.0), vec![StepSketch::say("yes")], None)], [(0.5, Tick)]);
}

#[test]
fn control_reading_that_is_no_number_counts_as_unknown() {
    check!(
        [StepSketch::If(v::nearer("user", 1.0), vec![], Some(vec![StepSketch::say("no")]))],
        [(0.1, distance(f64::NAN))]
    );
}

#[test]
fn control_what_nobody_can_observe_counts_as_false_at_once() {
    check!([StepSketch::If(trusted(), vec![], Some(vec![StepSketch::say("no")]))], []);
}

#[test]
fn control_old_reading_does_not_count() {
    let near = || StepSketch::If(v::nearer("user", 1.0), vec![StepSketch::say("near")], None);
    check!([near(), near()], [(0.1, distance(0.4)), (5.0, Done(1)), (5.1, distance(2.0))]);
}

#[test]
fn control_wait_ends_when_its_condition_holds() {
    check!([StepSketch::Wait(v::nearer("user", 1.0), 10.0)], [(0.1, distance(3.0)), (2.0, distance(0.9))]);
}

#[test]
fn control_wait_for_what_holds_is_over_at_once() {
    check!([StepSketch::Wait(Condition::Not(Box::new(held("mug"))), 10.0)], []);
}

#[test]
fn control_wait_times_out() {
    check!([StepSketch::Wait(held("mug"), 10.0)], [(0.1, holding("mug", false)), (10.0, Tick)]);
}

#[test]
fn control_first_handler_that_fits_wins() {
    let handlers = vec![
        (Some(vec![v::NOT_FOUND]), vec![StepSketch::say("not this")]),
        (Some(vec![v::UNREACHABLE, v::TIMEOUT]), vec![StepSketch::say("this")]),
        (None, vec![StepSketch::say("nor this")]),
    ];
    check!(
        [
            StepSketch::Try(vec![StepSketch::go("table"), StepSketch::say("never")], handlers),
            StepSketch::say("on")
        ],
        [(1.0, Fails(1, "unreachable")), (2.0, Done(2)), (3.0, Done(3)),]
    );
}

#[test]
fn control_failure_without_a_handler_goes_on_upwards() {
    let inner = StepSketch::Try(vec![StepSketch::go("table")], vec![(Some(vec![v::NOT_FOUND]), vec![])]);
    check!(
        [StepSketch::Try(vec![inner], vec![(None, vec![StepSketch::say("caught")])])],
        [(1.0, Fails(1, "unreachable"))]
    );
}

#[test]
fn control_failure_in_a_handler_is_not_handled_by_it() {
    check!(
        [StepSketch::Try(vec![StepSketch::go("a")], vec![(None, vec![StepSketch::go("b")])])],
        [(1.0, Fails(1, "unreachable")), (2.0, Fails(2, "unreachable")),]
    );
}

#[test]
fn control_failure_kind_of_the_drivers_own_is_caught_by_any() {
    check!(
        [StepSketch::Try(vec![StepSketch::go("a")], vec![(None, vec![StepSketch::say("caught")])])],
        [(1.0, Fails(1, "puncture"))]
    );
}

#[test]
fn control_loop_without_a_test_runs_so_often() {
    check!([StepSketch::Repeat(2, vec![StepSketch::say("a")], None)], [(1.0, Done(1)), (2.0, Done(2))]);
}

#[test]
fn control_loop_ends_when_its_test_holds() {
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![v::entity("mug")]).proven());
    check!([StepSketch::Repeat(3, vec![pick], Some(held("mug")))], [(1.0, Done(1))]);
}

#[test]
fn control_loop_whose_test_never_holds_is_exhausted() {
    check!([StepSketch::Repeat(2, vec![], Some(held("mug")))], []);
}

#[test]
fn control_test_of_a_loop_is_observed() {
    check!(
        [StepSketch::Repeat(2, vec![], Some(v::nearer("user", 1.0)))],
        [(0.1, distance(3.0)), (0.2, distance(0.3))]
    );
}

#[test]
fn control_each_binds_every_item() {
    let list = Term::List(vec![v::entity("mug"), v::entity("cup")]);
    let go = StepSketch::Call(CallSketch::new(v::GO, vec![CallSketch::NEAREST]));
    check!([StepSketch::Each(list, 2, vec![go])], [(1.0, Done(1)), (2.0, Done(2))]);
}

#[test]
fn control_longer_list_is_exhausted_before_the_first_item() {
    let list = Term::List(vec![v::entity("mug"), v::entity("cup")]);
    check!([StepSketch::Each(list, 1, vec![StepSketch::say("never")])], []);
}

#[test]
fn control_empty_list_is_no_failure() {
    check!([StepSketch::Each(Term::Literal(Value::List(vec![])), 1, vec![StepSketch::say("never")])], []);
}

#[test]
fn control_branches_run_at_once() {
    check!(
        [
            StepSketch::Parallel(vec![
                vec![StepSketch::go("table")],
                vec![StepSketch::detect("mug")],
                vec![]
            ]),
            StepSketch::say("on")
        ],
        [(1.0, Gives(2, entity("mug_1"))), (2.0, Done(1)),]
    );
}

#[test]
fn control_failing_branch_interrupts_the_others() {
    let branches = vec![
        vec![StepSketch::go("table")],
        vec![StepSketch::say("a")],
        vec![StepSketch::detect("mug"), StepSketch::say("never")],
    ];
    check!(
        [StepSketch::Try(vec![StepSketch::Parallel(branches)], vec![(None, vec![StepSketch::go("shelf")])])],
        [
            (0.1, Ack(1)),
            (0.1, Ack(3)),
            (1.0, Fails(2, "timeout")),
            (1.1, Gives(3, entity("mug_1"))),
            (2.0, Interrupted(1)),
            (3.0, Done(4)),
        ]
    );
}

#[test]
fn control_fact_with_any_is_known_by_its_witness() {
    let any = Condition::Fact(Fact { fluent: v::HOLDING, args: vec![FactArg::Any] });
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![v::entity("mug")]).proven());
    let place =
        StepSketch::Call(CallSketch::new(v::PLACE, vec![v::entity("mug"), v::entity("table")]).proven());
    let test = || {
        StepSketch::If(
            any.clone(),
            vec![StepSketch::say("holds one")],
            Some(vec![StepSketch::say("holds none")]),
        )
    };
    check!(
        [test(), pick, test(), place, test()],
        [
            (1.0, Done(1)),
            (2.0, Done(2)),
            (3.0, Done(3)),
            (4.0, Done(4)),
            (4.1, holding("mug", false)),
            (4.5, Tick),
        ]
    );
}

#[test]
fn control_more_transitions_at_one_instant_than_its_budget_end_a_run() {
    let nested = (0..10).fold(StepSketch::say("deep"), |step, _| StepSketch::Sequence(vec![step]));
    let engine = Engine::new(motet_arbitrary::graph::graph(&[nested]), &StartState::default()).unwrap();
    let mut engine = engine.with_settings(EngineSettings { step_budget: 3, ..EngineSettings::default() });
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let fault = RunEnd::Fault(Fault::StepBudget { steps: 3 });
    assert!(matches!(out.last(), Some(Effect::Finished(end)) if **end == fault), "{out:?}");
    assert!(engine.is_over());
}

/// A body and a cleanup that says something.
fn cleaned(body: Vec<StepSketch>) -> StepSketch {
    StepSketch::Finally(body, vec![StepSketch::say("clean")])
}

#[test]
fn control_cleanup_runs_behind_its_body() {
    check!(
        [cleaned(vec![StepSketch::go("table")]), StepSketch::say("on")],
        [(1.0, Done(1)), (2.0, Done(2)),]
    );
}

#[test]
fn control_cleanup_runs_before_a_handler() {
    check!(
        [StepSketch::Try(
            vec![cleaned(vec![StepSketch::go("table")])],
            vec![(None, vec![StepSketch::say("caught")])]
        )],
        [(1.0, Fails(1, "unreachable")), (2.0, Done(2)), (3.0, Done(3))]
    );
}

#[test]
fn control_cleanup_runs_before_an_ending_and_may_fail() {
    check!([cleaned(vec![StepSketch::End(Ending::Cannot)])], [(1.0, Fails(1, "timeout"))]);
}

#[test]
fn control_cleanup_waits_for_its_time() {
    let steps = StepSketch::Finally(vec![StepSketch::go("table")], vec![StepSketch::Delay(2.0)]);
    check!([steps, StepSketch::say("on")], [(1.0, Done(1)), (3.0, Tick)]);
}

#[test]
fn control_person_stops_before_a_cleanup() {
    let graph = motet_arbitrary::graph::graph(&[cleaned(vec![StepSketch::go("table")])]);
    let mut engine = Engine::new(graph, &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    engine.handle(Time::from_secs(1.0), Event::Stop, &mut out);
    let pending = |engine: &Engine| {
        let pending = engine.snapshot().pending;
        pending.iter().map(|due| format!("{} {due}", due.path)).collect::<Vec<_>>()
    };
    assert_eq!(pending(&engine), ["/steps/0 say(\"clean\")"]);
    let goal = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let goal = goal.unwrap();
    let acknowledged = motet_runtime::DriverEvent::Acknowledged { goal };
    let ended = motet_runtime::DriverEvent::Ended { goal, outcome: motet_runtime::Outcome::Interrupted };
    for event in [acknowledged, ended] {
        engine.handle(Time::from_secs(2.0), Event::Driver(event), &mut out);
    }
    assert!(matches!(out.last(), Some(Effect::Finished(end)) if **end == RunEnd::Interrupted), "{out:?}");
    assert_eq!(pending(&engine), ["/steps/0 say(\"clean\")"]);
}

/// Commands and records of a held run, by what stands for them.
fn words(out: &[Effect]) -> Vec<&'static str> {
    let word = |effect: &Effect| match effect {
        Effect::Start { .. } => Some("start"),
        Effect::Cancel { .. } => Some("cancel"),
        Effect::Hold { .. } => Some("hold"),
        Effect::Proceed { .. } => Some("proceed"),
        Effect::Finished(_) => Some("finished"),
        _ => None,
    };
    out.iter().filter_map(word).collect()
}

#[test]
fn control_person_holds_a_run_and_lets_it_go_on() {
    let steps = [StepSketch::go("table"), StepSketch::say("there"), StepSketch::Delay(2.0)];
    let mut engine = Engine::new(motet_arbitrary::graph::graph(&steps), &StartState::default()).unwrap();
    let mut out = Vec::new();
    let mut at = |engine: &mut Engine, secs: f64, event: Event| {
        out.clear();
        engine.handle(Time::from_secs(secs), event, &mut out);
        let goal = out.iter().find_map(|effect| match effect {
            Effect::Start { goal, .. } => Some(*goal),
            _ => None,
        });
        (words(&out), goal)
    };
    let (said, goal) = at(&mut engine, 0.0, Event::Begin);
    assert_eq!(said, ["start"]);
    let goal = goal.unwrap();
    let driver = Event::Driver;
    at(&mut engine, 0.0, driver(motet_runtime::DriverEvent::Acknowledged { goal }));
    assert_eq!(at(&mut engine, 1.0, Event::Hold).0, ["hold"]);
    assert!(engine.is_held());
    assert_eq!(at(&mut engine, 2.0, Event::Hold).0, Vec::<&str>::new(), "it is held once");
    // No deadline runs out meanwhile.
    assert_eq!(engine.wake_at(), None);
    assert_eq!(at(&mut engine, 900.0, Event::Proceed).0, ["proceed"]);
    let ended = motet_runtime::DriverEvent::Ended { goal, outcome: motet_runtime::Outcome::Success(None) };
    let (said, goal) = at(&mut engine, 901.0, driver(ended));
    assert_eq!(said, ["start"]);
    let goal = goal.unwrap();
    at(&mut engine, 901.0, driver(motet_runtime::DriverEvent::Acknowledged { goal }));
    let ended = motet_runtime::DriverEvent::Ended { goal, outcome: motet_runtime::Outcome::Success(None) };
    at(&mut engine, 902.0, driver(ended));
    // A delay is held, too, and a stop ends what is held.
    at(&mut engine, 903.0, Event::Hold);
    assert_eq!(at(&mut engine, 950.0, Event::Tick).0, Vec::<&str>::new());
    assert_eq!(at(&mut engine, 951.0, Event::Stop).0, ["finished"]);
    assert!(!engine.is_held());
}

#[test]
fn control_person_stops_a_held_run() {
    let steps = [StepSketch::go("table"), StepSketch::say("there")];
    let mut engine = Engine::new(motet_arbitrary::graph::graph(&steps), &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let goal = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let goal = goal.unwrap();
    let driver = |event| Event::Driver(event);
    engine.handle(Time::ZERO, driver(motet_runtime::DriverEvent::Acknowledged { goal }), &mut out);
    for event in [Event::Hold, Event::Stop] {
        engine.handle(Time::from_secs(1.0), event, &mut out);
    }
    let ended = motet_runtime::DriverEvent::Ended { goal, outcome: motet_runtime::Outcome::Interrupted };
    engine.handle(Time::from_secs(2.0), driver(ended), &mut out);
    assert_eq!(words(&out), ["start", "hold", "cancel", "finished"]);
}
