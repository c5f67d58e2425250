//! The life of a call: start, acknowledgement, end; deadlines, retries, guards, results; cancels that are not
//! answered.

use crate::check;
use crate::script::Feed::{
    Ack, Done, DriverGone, DriverLost, Fails, Gives, Interrupted, Lost, NotHeld, Refused, Stop, Stopped, Tick,
};
use crate::script::{at, entity, holding, holding_any, transcript_from, transcript_of};
use motet_arbitrary::graph::{CallSketch, StepSketch, graph, vocabulary as v};
use motet_graph::Value;
use motet_runtime::StartState;

fn pick(object: &str) -> CallSketch {
    CallSketch::new(v::PICK, vec![v::entity(object)])
}

#[test]
fn call_empty_policy_is_done() {
    check!([], []);
}

#[test]
fn call_one_call_after_the_other() {
    check!(
        [StepSketch::go("table"), StepSketch::say("there")],
        [(0.1, Ack(1)), (2.0, Done(1)), (2.0, Ack(2)), (3.0, Done(2))]
    );
}

#[test]
fn call_end_without_an_acknowledgement_counts() {
    check!([StepSketch::go("table")], [(2.0, Done(1))]);
}

#[test]
fn call_failure_that_nothing_catches_ends_the_policy() {
    check!(
        [StepSketch::go("table"), StepSketch::say("there")],
        [(0.1, Ack(1)), (2.0, Fails(1, "unreachable"))]
    );
}

#[test]
fn call_refusal_is_a_failure() {
    check!([StepSketch::go("table")], [(0.1, Refused(1, "unsafe"))]);
}

#[test]
fn call_retries_start_new_goals() {
    let go = CallSketch::new(v::GO, vec![v::entity("table")]).retry(1);
    check!([StepSketch::Call(go)], [(1.0, Fails(1, "unreachable")), (2.0, Fails(2, "unreachable"))]);
}

#[test]
fn call_deadline_cancels_and_is_a_timeout() {
    check!([StepSketch::go("table")], [(0.1, Ack(1)), (10.0, Tick), (10.2, Interrupted(1))]);
}

#[test]
fn call_success_after_the_cancel_is_respected() {
    check!(
        [StepSketch::go("table"), StepSketch::say("there")],
        [(0.1, Ack(1)), (10.0, Tick), (10.2, Done(1))]
    );
}

#[test]
fn call_cancel_waits_for_the_acknowledgement() {
    check!([StepSketch::go("table")], [(10.0, Tick), (10.1, Ack(1)), (10.2, Interrupted(1))]);
}

#[test]
fn call_unanswered_cancel_becomes_a_safe_stop() {
    check!([StepSketch::go("table")], [(0.1, Ack(1)), (10.0, Tick), (15.0, Tick), (16.0, Stopped(1))]);
}

#[test]
fn call_unanswered_safe_stop_is_a_fault() {
    check!([StepSketch::go("table")], [(0.1, Ack(1)), (10.0, Tick), (15.0, Tick), (20.0, Tick)]);
}

#[test]
fn call_late_tick_makes_up_for_what_was_due() {
    check!([StepSketch::go("table")], [(0.1, Ack(1)), (60.0, Tick)]);
}

#[test]
fn call_person_stops() {
    check!(
        [StepSketch::go("table"), StepSketch::say("there")],
        [(0.1, Ack(1)), (1.0, Stop), (1.5, Interrupted(1))]
    );
}

#[test]
fn call_interruption_by_the_driver_is_not_retried() {
    let go = CallSketch::new(v::GO, vec![v::entity("table")]).retry(3);
    check!(
        [StepSketch::Try(vec![StepSketch::Call(go)], vec![(None, vec![])])],
        [(0.1, Ack(1)), (1.0, Interrupted(1))]
    );
}

#[test]
fn call_result_is_bound_and_used() {
    let place = CallSketch::new(v::PLACE, vec![CallSketch::NEAREST, v::entity("table")]).proven();
    check!(
        [StepSketch::detect("mug"), StepSketch::Call(place)],
        [(1.0, Gives(1, entity("mug_3"))), (2.0, Done(2))]
    );
}

#[test]
fn call_result_of_the_wrong_type_is_a_failure() {
    check!([StepSketch::detect("mug")], [(1.0, Gives(1, Value::Int(3)))]);
}

/// A person is no object.
#[test]
fn call_result_of_another_kind_is_a_failure() {
    let found = |id: &str| {
        let steps = [StepSketch::go("table"), StepSketch::detect("mug")];
        let start = StartState {
            entities: vec![("user".into(), "Person".into()), ("mug_1".into(), "Object".into())],
            ..StartState::default()
        };
        transcript_from(graph(&steps), &start, vec![(1.0, Done(1)), (2.0, Gives(2, entity(id)))])
    };
    for (id, is_taken) in [("mug_1", true), ("unheard_of", true), ("user", false)] {
        let transcript = found(id);
        assert_eq!(transcript.contains("finished: done"), is_taken, "{id}\n{transcript}");
    }
}

/// A thing that is none of those that the proofs assume brings back the guards that they spared.
#[test]
fn call_result_other_than_the_proofs_assume_brings_guards_back() {
    let place = CallSketch::new(v::PLACE, vec![CallSketch::NEAREST, v::entity("table")]).proven();
    let found = |id: &str| {
        let mut graph = graph(&[StepSketch::detect("mug"), StepSketch::Call(place.clone())]);
        for binding in &mut graph.bindings {
            binding.among = vec!["mug_1".into(), "mug_2".into()];
        }
        transcript_of(graph, vec![(1.0, Gives(1, entity(id)))])
    };
    for (id, is_proven) in [("mug_1", true), ("mug_2", true), ("mug_3", false), ("unheard_of", false)] {
        let transcript = found(id);
        assert_eq!(!transcript.contains("guard 0 of /steps/1"), is_proven, "{id}\n{transcript}");
    }
}

#[test]
fn call_guard_that_is_known_to_hold_needs_no_observation() {
    check!([StepSketch::Call(pick("mug"))], [(1.0, Done(1))]);
}

#[test]
fn call_guard_that_is_known_not_to_hold_refuses() {
    check!([StepSketch::Call(pick("mug").proven()), StepSketch::Call(pick("cup"))], [(1.0, Done(1))]);
}

#[test]
fn call_guard_that_is_unknown_is_observed() {
    check!(
        [StepSketch::Call(pick("mug").retry(1))],
        [(1.0, Fails(1, "not_found")), (1.1, holding_any(false))]
    );
}

#[test]
fn call_retry_looks_again_at_a_guard_that_refused() {
    check!(
        [StepSketch::Call(pick("mug").proven()), StepSketch::Call(pick("cup").retry(1))],
        [(1.0, Done(1)), (1.1, holding_any(false)), (2.0, Done(2)),]
    );
}

/// `pick` fails, so nothing is known of `holding(mug)`; then `place` needs it.
fn place_after_failed_pick() -> [StepSketch; 1] {
    let place = CallSketch::new(v::PLACE, vec![v::entity("mug"), v::entity("table")]);
    [StepSketch::Try(
        vec![StepSketch::Call(pick("mug").proven())],
        vec![(None, vec![StepSketch::Call(place)])],
    )]
}

#[test]
fn call_guard_that_is_seen_to_hold() {
    check!(
        place_after_failed_pick(),
        [(1.0, Fails(1, "not_found")), (1.1, holding("mug", true)), (2.0, Done(2))]
    );
}

#[test]
fn call_guard_that_stays_unknown_refuses() {
    check!(place_after_failed_pick(), [(1.0, Fails(1, "not_found")), (1.1, holding("mug", None))]);
}

#[test]
fn call_time_to_observe_is_bounded() {
    check!(place_after_failed_pick(), [(1.0, Fails(1, "not_found")), (1.5, Tick)]);
}

#[test]
fn call_events_about_ended_goals_are_ignored() {
    check!(
        [StepSketch::go("table"), StepSketch::say("a")],
        [(1.0, Done(1)), (1.1, Done(1)), (1.2, Ack(1)), (1.3, NotHeld(1))]
    );
}

#[test]
fn call_what_is_seen_in_passing_is_believed() {
    check!([StepSketch::Call(pick("mug"))], [(0.5, at("table", true)), (1.0, Done(1))]);
}

#[test]
fn call_lost_goal_is_stopped_safely_and_fails() {
    let go = CallSketch::new(v::GO, vec![v::entity("table")]).retry(1);
    check!(
        [StepSketch::Call(go)],
        [(0.1, Ack(1)), (1.0, Lost(1)), (1.1, Lost(1)), (1.5, Stopped(1)), (2.0, Lost(2))]
    );
}

#[test]
fn call_lost_driver_loses_every_goal() {
    let both = StepSketch::Parallel(vec![vec![StepSketch::go("table")], vec![StepSketch::detect("mug")]]);
    check!([both], [(0.1, Ack(1)), (1.0, DriverLost), (1.5, Stopped(2)), (1.6, Stopped(1))]);
}

#[test]
fn call_driver_that_is_gone_for_good_ends_a_run_in_which_something_may_move() {
    let both = StepSketch::Parallel(vec![vec![StepSketch::go("table")], vec![StepSketch::detect("mug")]]);
    // The second goal was not told to stop yet.
    check!([both], [(0.1, Ack(1)), (1.0, Lost(1)), (1.2, DriverGone), (1.3, DriverGone)]);
    // Where nothing is live, the next step tries to reach it.
    check!([StepSketch::Delay(1.0), StepSketch::go("table")], [(0.5, DriverGone), (1.0, Tick)]);
}

#[test]
fn call_end_of_a_lost_goal_counts() {
    check!([StepSketch::go("table")], [(1.0, Lost(1)), (1.5, Done(1))]);
}
