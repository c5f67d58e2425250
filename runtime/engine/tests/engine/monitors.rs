//! Monitors: when they fire, what each reaction does, and which one wins.

use crate::check;
use crate::script::Feed::{Ack, Done, Fails, Interrupted, NotHeld, Stop, Tick};
use crate::script::{distance, holding};
use motet_arbitrary::graph::{CallSketch, ReactionSketch, StepSketch, WatchSketch, vocabulary as v};
use motet_graph::{Condition, Ending};

fn near(limit_m: f64) -> Condition {
    v::nearer("user", limit_m)
}

fn when(condition: Condition, react: ReactionSketch) -> WatchSketch {
    WatchSketch::new(condition, react)
}

fn over(whens: Vec<WatchSketch>, body: Vec<StepSketch>) -> Vec<StepSketch> {
    vec![StepSketch::Monitor(whens, body), StepSketch::say("on")]
}

#[test]
fn monitor_that_never_fires_ends_with_its_body() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::End(Ending::Fail))], vec![StepSketch::go("table")]),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(2.0)), (2.0, Done(1)),]
    );
}

#[test]
fn monitor_condition_that_holds_on_entry_fires_before_the_body() {
    let held = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("mug")]));
    let not_held = Condition::Not(Box::new(held));
    check!(
        over(vec![when(not_held, ReactionSketch::End(Ending::Replan))], vec![StepSketch::go("table")]),
        []
    );
}

#[test]
fn monitor_ending_waits_for_what_runs() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::End(Ending::Fail))], vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.2, distance(3.0)),
            (1.5, Interrupted(1)),
        ]
    );
}

#[test]
fn monitor_ending_of_a_sub_policy() {
    let body = over(vec![when(near(0.5), ReactionSketch::End(Ending::Done))], vec![StepSketch::go("table")]);
    check!(
        [StepSketch::Inline(body), StepSketch::say("after")],
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.5, Interrupted(1))]
    );
}

#[test]
fn monitor_condition_must_hold_without_a_break() {
    let watch =
        WatchSketch { condition: near(0.5), hold_secs: 0.2, react: ReactionSketch::End(Ending::Fail) };
    check!(
        over(vec![watch], vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.0, Ack(1)),
            (1.0, distance(0.3)),
            (1.1, distance(0.6)),
            (2.0, distance(0.3)),
            (2.1, distance(0.2)),
            (2.2, Tick),
        ]
    );
}

#[test]
fn monitor_condition_that_is_unknown_for_too_long_fires() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::End(Ending::Fail))], vec![StepSketch::go("table")]),
        [(0.0, Ack(1)), (0.5, Tick)]
    );
}

#[test]
fn monitor_what_was_unknown_may_have_been_true() {
    let watch =
        WatchSketch { condition: near(0.5), hold_secs: 1.0, react: ReactionSketch::End(Ending::Fail) };
    check!(
        over(vec![watch], vec![StepSketch::go("table")]),
        [(0.0, Ack(1)), (0.9, distance(0.1)), (1.0, Tick)]
    );
}

#[test]
fn monitor_pause_holds_and_goes_on() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (4.0, distance(0.4)),
            (6.0, distance(0.9)),
            (7.0, Done(1)),
        ]
    );
}

#[test]
fn monitor_pause_before_the_acknowledgement_holds_after_it() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![StepSketch::go("table")]),
        [(0.1, distance(0.3)), (0.2, Ack(1)), (0.3, distance(3.0)),]
    );
}

#[test]
fn monitor_what_cannot_be_held_is_cancelled_and_started_again() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.1, NotHeld(1)),
            (1.5, Interrupted(1)),
            (2.0, distance(3.0)),
            (3.0, Done(2)),
        ]
    );
}

#[test]
fn monitor_pause_that_is_over_before_the_cancel_is_answered() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.1, NotHeld(1)),
            (1.2, distance(3.0)),
            (1.5, Interrupted(1)),
        ]
    );
}

#[test]
fn monitor_paused_call_that_ends_lets_no_other_start() {
    check!(
        over(
            vec![when(near(0.5), ReactionSketch::Pause(60.0))],
            vec![StepSketch::go("table"), StepSketch::say("there")]
        ),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.1, Done(1)), (2.0, distance(3.0)),]
    );
}

#[test]
fn monitor_all_pauses_together_are_bounded() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(2.0))], vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (2.0, distance(3.0)),
            (3.0, distance(0.3)),
            (4.0, Tick),
            (4.1, Interrupted(1)),
        ]
    );
}

#[test]
fn monitor_pause_on_entry_starts_nothing() {
    let held = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("mug")]));
    let not_held = Condition::Not(Box::new(held));
    check!(
        over(vec![when(not_held, ReactionSketch::Pause(5.0))], vec![StepSketch::go("table")]),
        [(1.0, holding("mug", true))]
    );
}

#[test]
fn monitor_paused_wait_keeps_its_time() {
    let held = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("mug")]));
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![StepSketch::Wait(held, 10.0)]),
        [(0.0, distance(3.0)), (4.0, distance(0.3)), (14.0, distance(3.0)),]
    );
}

#[test]
fn monitor_restart_begins_the_body_again() {
    check!(
        over(
            vec![when(near(0.5), ReactionSketch::Restart(1))],
            vec![StepSketch::say("a"), StepSketch::go("table")]
        ),
        [
            (0.0, distance(3.0)),
            (0.5, Done(1)),
            (0.6, Ack(2)),
            (1.0, distance(0.3)),
            (1.1, distance(3.0)),
            (1.2, Interrupted(2)),
            (2.0, distance(0.3)),
        ]
    );
}

#[test]
fn monitor_condition_that_still_holds_exhausts_the_restarts() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Restart(2))], vec![StepSketch::go("table")]),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.2, Interrupted(1)),]
    );
}

#[test]
fn monitor_resume_runs_a_block_and_goes_on() {
    check!(
        over(
            vec![when(near(0.5), ReactionSketch::Resume(1, vec![StepSketch::go("shelf")]))],
            vec![StepSketch::go("table")]
        ),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.5, Interrupted(1)),
            (2.0, distance(3.0)),
            (3.0, Done(2)),
            (4.0, Done(3)),
        ]
    );
}

#[test]
fn monitor_resume_after_a_body_that_ended_meanwhile() {
    check!(
        over(
            vec![when(near(0.5), ReactionSketch::Resume(1, vec![StepSketch::say("oh")]))],
            vec![StepSketch::go("table")]
        ),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.5, Done(1)), (2.0, Done(2)),]
    );
}

#[test]
fn monitor_resume_too_often_is_exhausted() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Resume(1, vec![]))], vec![StepSketch::go("table")]),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.5, Interrupted(1)),]
    );
}

#[test]
fn monitor_failing_block_fails_the_monitor() {
    let body = over(
        vec![when(near(0.5), ReactionSketch::Resume(1, vec![StepSketch::go("shelf")]))],
        vec![StepSketch::go("table")],
    );
    check!(
        [StepSketch::Try(body, vec![(Some(vec![v::UNREACHABLE]), vec![StepSketch::say("caught")])])],
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.5, Interrupted(1)),
            (2.0, Fails(2, "unreachable")),
        ]
    );
}

#[test]
fn monitor_pause_covers_the_block_of_another_reaction() {
    let whens = vec![
        when(near(0.2), ReactionSketch::Pause(60.0)),
        when(near(0.5), ReactionSketch::Resume(1, vec![StepSketch::go("shelf")])),
    ];
    check!(
        over(whens, vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.5, Interrupted(1)),
            (1.6, Ack(2)),
            (2.0, distance(0.1)),
            (3.0, Done(2)),
            (4.0, distance(3.0)),
        ]
    );
}

#[test]
fn monitor_outer_monitor_wins() {
    let inner = StepSketch::Monitor(
        vec![when(near(0.5), ReactionSketch::End(Ending::Replan))],
        vec![StepSketch::go("table")],
    );
    check!(
        over(vec![when(near(0.5), ReactionSketch::End(Ending::Fail))], vec![inner]),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.5, Interrupted(1)),]
    );
}

#[test]
fn monitor_earlier_watch_wins() {
    let whens =
        vec![when(near(0.5), ReactionSketch::Restart(1)), when(near(0.5), ReactionSketch::End(Ending::Fail))];
    check!(
        over(whens, vec![StepSketch::go("table")]),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (1.5, distance(2.0))]
    );
}

#[test]
fn monitor_inner_monitor_is_judged_again_after_an_outer_pause() {
    let inner = StepSketch::Monitor(
        vec![when(near(0.8), ReactionSketch::End(Ending::Fail))],
        vec![StepSketch::go("table")],
    );
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![inner]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (2.0, distance(0.6)),
            (2.1, Interrupted(1)),
        ]
    );
}

#[test]
fn monitor_ending_during_a_pause() {
    let whens = vec![
        when(near(0.5), ReactionSketch::Pause(60.0)),
        when(near(0.2), ReactionSketch::End(Ending::Fail)),
    ];
    check!(
        over(whens, vec![StepSketch::go("table")]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (2.0, distance(0.1)),
            (2.5, Interrupted(1)),
        ]
    );
}

#[test]
fn monitor_call_makes_a_monitor_fire_before_the_next_step() {
    let held = Condition::Fact(v::fact(v::HOLDING, vec![v::entity("mug")]));
    let pick = StepSketch::Call(CallSketch::new(v::PICK, vec![v::entity("mug")]).proven());
    check!(
        over(vec![when(held, ReactionSketch::End(Ending::Done))], vec![pick, StepSketch::go("table")]),
        [(1.0, Done(1))]
    );
}

#[test]
fn monitor_person_stops_during_a_pause() {
    check!(
        over(vec![when(near(0.5), ReactionSketch::Pause(60.0))], vec![StepSketch::go("table")]),
        [(0.0, distance(3.0)), (0.1, Ack(1)), (1.0, distance(0.3)), (2.0, Stop), (2.5, Interrupted(1)),]
    );
}

#[test]
fn monitor_one_watch_serves_all_who_need_it() {
    let inner =
        StepSketch::Monitor(vec![when(near(0.2), ReactionSketch::Pause(1.0))], vec![StepSketch::say("a")]);
    check!(
        over(vec![when(near(0.5), ReactionSketch::End(Ending::Fail))], vec![inner, StepSketch::say("b")]),
        [(0.0, distance(3.0)), (1.0, Done(1)), (2.0, Done(2)),]
    );
}

#[test]
fn monitor_block_that_was_about_to_run_is_dropped_when_its_monitor_is_stopped() {
    let inner = StepSketch::Monitor(
        vec![when(near(0.5), ReactionSketch::Resume(1, vec![StepSketch::say("oh")]))],
        vec![StepSketch::go("table")],
    );
    check!(
        over(vec![when(near(0.2), ReactionSketch::Restart(0))], vec![inner]),
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (1.0, distance(0.3)),
            (1.1, distance(0.1)),
            (1.5, Interrupted(1)),
        ]
    );
}

fn deadline(secs: f64, body: Vec<StepSketch>) -> StepSketch {
    let watch = WatchSketch {
        condition: Condition::Literal(true),
        hold_secs: secs,
        react: ReactionSketch::Pause(0.0),
    };
    StepSketch::Monitor(vec![watch], body)
}

fn late(body: StepSketch) -> Vec<StepSketch> {
    vec![StepSketch::Try(vec![body], vec![(Some(vec![v::TIMEOUT]), vec![StepSketch::say("late")])])]
}

#[test]
fn monitor_deadline_interrupts_its_body_and_fails() {
    check!(
        late(deadline(5.0, vec![StepSketch::go("table")])),
        [(0.1, Ack(1)), (5.0, Tick), (5.2, Interrupted(1)), (6.0, Done(2))]
    );
}

#[test]
fn monitor_deadline_is_over_with_its_body() {
    check!(
        [deadline(5.0, vec![StepSketch::go("table")]), StepSketch::go("shelf")],
        [(0.1, Ack(1)), (4.0, Done(1)), (4.1, Ack(2)), (5.0, Tick), (6.0, Done(2))]
    );
}

#[test]
fn monitor_deadline_cleans_up_before_its_handler() {
    let carry = StepSketch::Finally(vec![StepSketch::go("table")], vec![StepSketch::say("clean")]);
    check!(
        late(deadline(5.0, vec![carry])),
        [(0.1, Ack(1)), (5.0, Tick), (5.2, Interrupted(1)), (6.0, Done(2)), (7.0, Done(3))]
    );
}

#[test]
fn monitor_deadline_passes_while_a_pause_holds_the_body() {
    let inner = late(deadline(5.0, vec![StepSketch::go("table")]));
    let outer = StepSketch::Monitor(vec![when(near(0.5), ReactionSketch::Pause(60.0))], inner);
    check!(
        [outer],
        [
            (0.0, distance(3.0)),
            (0.1, Ack(1)),
            (4.0, distance(0.3)),
            (7.0, Tick),
            (8.0, distance(3.0)),
            (8.2, Interrupted(1)),
            (9.0, Done(2)),
        ]
    );
}
