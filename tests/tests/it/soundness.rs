//! Needs that only a guard can vouch for: the compiler may not prove them from a test that stayed unknown, or
//! from a guard that has refused.

use motet_compiler::{FactLifetime, InitialState, Session};
use motet_graph::{Graph, NodeKind, Value, Verdict};
use motet_runtime::{
    Answer, DriverEvent, Effect, Engine, Event, GoalId, Outcome, Pattern, PreparedSwap, Query, StartState,
    Time,
};
use motet_syntax::{FileId, Source, Sources, Span};
use motet_tests::setup;

pub(crate) const DOMAIN: &str = "
entity a: Object
fluent f(o: Object)
fluent g(o: Object)
action use(o: Object)
    needs f(o)
action use_both(o: Object)
    needs f(o), not g(o)
action avoid(o: Object)
    needs not f(o)
action undo(o: Object)
    makes not f(o)
    uses base
action shake(o: Object)
    unsettles f(o)
    uses base
action make(o: Object)
    makes f(o), not g(o)
    uses voice
action pass()
    uses voice
action wave()
    uses base
";

/// Graph of a policy over [`DOMAIN`].
pub(crate) fn compiled(policy: &str) -> Graph {
    let (session, _) = setup::session(None, None, &mut Sources::default());
    let source = Source::new("p.motet", format!("{DOMAIN}\n{policy}"));
    let compiled = session.compile(&motet_syntax::read(&source, FileId(99)), None);
    compiled.graph.unwrap_or_else(|| panic!("{policy}: {:#?}", compiled.diagnostics))
}

/// Events that a driver answers an effect with.
pub(crate) type Answers<'a> = &'a mut dyn FnMut(&Effect) -> Vec<DriverEvent>;

/// Requests to the driver in a run, in order. Each effect is answered at once, and each event comes 10 ms
/// after the one before.
pub(crate) fn requests(policy: &str, answers: Answers<'_>) -> Vec<String> {
    requests_of(compiled(policy), answers)
}

fn requests_of(graph: Graph, answers: Answers<'_>) -> Vec<String> {
    requests_from(graph, &StartState::default(), answers)
}

fn requests_from(graph: Graph, start: &StartState, answers: Answers<'_>) -> Vec<String> {
    let mut engine = Engine::new(graph, start).unwrap();
    let (mut events, mut found) = (std::collections::VecDeque::from([Event::Begin]), Vec::new());
    let mut now = 0.0;
    while let Some(event) = events.pop_front() {
        let mut out = Vec::new();
        engine.handle(Time::from_secs(now), event, &mut out);
        now += 0.01;
        for effect in out.iter().filter(|effect| !matches!(effect, Effect::Report(_))) {
            found.push(engine.describe(effect));
            events.extend(answers(effect).into_iter().map(Event::Driver));
        }
    }
    found
}

/// Answer of a driver that carries everything out and observes what `see` says.
pub(crate) fn honest(effect: &Effect, see: impl Fn(&Query) -> Option<bool>) -> Vec<DriverEvent> {
    match effect {
        Effect::Start { goal, .. } => {
            vec![DriverEvent::Ended { goal: *goal, outcome: Outcome::Success(None) }]
        }
        Effect::Observe { query } | Effect::Watch { query } => {
            let answer = see(query).map_or(Answer::Unknown, Answer::Truth);
            vec![DriverEvent::Observed { query: Query::clone(query), answer }]
        }
        _ => Vec::new(),
    }
}

/// Verdicts on the needs of the last call of a primitive in a policy over [`DOMAIN`].
pub(crate) fn verdicts(callee: &str, policy: &str) -> Vec<Verdict> {
    let graph = compiled(policy);
    let mut calls = graph.nodes.iter().filter_map(|node| match &node.kind {
        NodeKind::Call(call) if graph.primitives[call.primitive.index()].name == callee => Some(call),
        _ => None,
    });
    calls.next_back().unwrap().needs.iter().map(|need| need.verdict).collect()
}

#[test]
fn soundness_a_guard_that_refuses_proves_nothing_in_its_handler() {
    for policy in [
        "policy p { try { use(a) } catch any { use(a) } }",
        "policy p { try { use(a) } catch any { } use(a) }",
        "policy p { try { use(a) } catch failed { use(a) } catch any { } }",
    ] {
        assert_eq!(verdicts("use", policy), [Verdict::Deferred], "{policy}");
    }
    // The first need held where the second refused.
    let both = verdicts("use_both", "policy p { try { use_both(a) } catch any { } use_both(a) }");
    assert_eq!(both, [Verdict::Deferred, Verdict::Deferred]);
    // Where nothing catches the refusal, what comes behind stands on the guard.
    assert_eq!(verdicts("use", "policy p { use(a) use(a) }"), [Verdict::Proven]);
}

#[test]
fn soundness_a_test_that_stays_unknown_is_not_false() {
    for policy in [
        "policy p { if f(a) { say(\"yes\") } else { avoid(a) } }",
        "policy p { if g(a) or f(a) { say(\"yes\") } else { avoid(a) } }",
        "policy p { if not (not f(a)) { say(\"yes\") } else { avoid(a) } }",
        "policy p { try { repeat 1 { say(\"x\") } until f(a) } catch exhausted { avoid(a) } }",
        "policy p { if f(a) { done } avoid(a) }",
    ] {
        assert_eq!(verdicts("avoid", policy), [Verdict::Deferred], "{policy}");
    }
    // A test of the opposite was seen to be true.
    assert_eq!(verdicts("avoid", "policy p { if not f(a) { avoid(a) } }"), [Verdict::Proven]);
    // What is known from the start is either true or false.
    let known = "initially f(a)\nclosed world\npolicy p { if not f(a) { say(\"no\") } else { use(a) } }";
    assert_eq!(verdicts("use", known), [Verdict::Proven]);
}

#[test]
fn soundness_a_branch_does_not_trust_what_another_may_change() {
    let tested = "initially f(a)\npolicy p { parallel { { if f(a) { pass() use(a) } } { undo(a) } } }";
    assert_eq!(verdicts("use", tested), [Verdict::Deferred]);
    let waited = "policy p { parallel { { within 5 s { wait until f(a) } use(a) } { undo(a) } } }";
    assert_eq!(verdicts("use", waited), [Verdict::Deferred]);
    let made = "policy p { parallel { { make(a) pass() use(a) } { shake(a) } } }";
    assert_eq!(verdicts("use", made), [Verdict::Deferred]);
    let apart = "policy p { parallel { { make(a) pass() use(a) } { wave() } } }";
    assert_eq!(verdicts("use", apart), [Verdict::Proven]);
}

#[test]
fn soundness_what_a_monitor_watches_the_world_may_change() {
    let watched =
        |begins: &str, monitor: &str| verdicts("use", &format!("{begins}\npolicy p {{ {monitor} }}"));
    // A change that fires the monitor ends the body; that of one part of a conjunction does not.
    let alone = "monitor when not f(a) then fail \"no\" during { pass() use(a) }";
    assert_eq!(watched("initially f(a)", alone), [Verdict::Proven]);
    let part = "monitor when not f(a) and g(a) then fail \"no\" during { pass() use(a) }";
    assert_eq!(watched("initially f(a)", part), [Verdict::Deferred]);
    let held = "monitor when not f(a) for 1 s then fail \"no\" during { pass() use(a) }";
    assert_eq!(watched("initially f(a)", held), [Verdict::Deferred]);
    // The body may end while the monitor pauses it.
    let behind = "monitor when not f(a) then pause during { pass() } use(a)";
    assert_eq!(watched("initially f(a)", behind), [Verdict::Deferred]);
    // A cleanup may run because the pause has taken too long.
    let cleaned = "monitor when not f(a) then pause during { sequence s { pass() } finally { use(a) } }";
    assert_eq!(watched("initially f(a)", cleaned), [Verdict::Deferred]);
    // A monitor also fires when its condition has been unknown for long.
    let reacting = "monitor when f(a) then resume at most 1 { use(a) } during { pass() }";
    assert_eq!(watched("", reacting), [Verdict::Deferred]);
    // Two conditions may begin to hold at once: the first one fires, whatever the other would rule out.
    let resumes = "when g(a) then resume at most 1 { avoid(a) }";
    let fails = "when f(a) then fail \"no\"";
    for policy in [
        format!("monitor {{ {resumes} {fails} }} during {{ pass() }}"),
        format!("undo(a) monitor {{ {resumes} {fails} }} during {{ pass() }}"),
        format!("monitor {{ {resumes} }} during {{ monitor {{ {fails} }} during {{ pass() }} }}"),
    ] {
        let policy = format!("initially not f(a)\npolicy p {{ {policy} }}");
        assert_eq!(verdicts("avoid", &policy), [Verdict::Deferred], "{policy}");
    }
    let first =
        format!("initially not f(a)\npolicy p {{ monitor {{ {fails} {resumes} }} during {{ pass() }} }}");
    assert_eq!(verdicts("avoid", &first), [Verdict::Proven]);
    let goal = "policy p achieves f(a) { monitor { when g(a) then done when f(a) then fail \"no\" } \
                during { cannot \"no\" } }";
    let found = session_codes(None, &format!("{DOMAIN}\n{goal}"));
    assert!(!found.contains(&"M0503"), "{found:?}");
}

#[test]
fn soundness_what_is_waited_for_the_world_may_change() {
    let one_of_two = "initially not f(a), not g(a)\npolicy p { wait until f(a) or g(a) within 3 s avoid(a) }";
    assert_eq!(verdicts("avoid", one_of_two), [Verdict::Deferred]);
    let in_vain = "initially f(a)\npolicy p { try { wait until not f(a) and not g(a) within 3 s } \
                   catch any { use(a) } }";
    assert_eq!(verdicts("use", in_vain), [Verdict::Deferred]);
}

#[test]
fn soundness_an_effect_for_each_of_a_kind_needs_one() {
    let fill = "action fill(o: Object)\n    makes f(o) for each c: Container\n";
    let none = format!("{fill}policy p {{ fill(a) use(a) }}");
    assert_eq!(verdicts("use", &none), [Verdict::Deferred]);
    let one = format!("{fill}entity box: Container\npolicy p {{ fill(a) use(a) }}");
    assert_eq!(verdicts("use", &one), [Verdict::Proven]);
}

/// A proven need is asked again where the step itself may have changed it before it was interrupted.
#[test]
fn soundness_a_step_that_begins_again_asks_what_it_may_have_changed() {
    let policy = "action use_up(o: Object)\n    needs f(o)\n    makes not f(o)\ninitially f(a)\n\
                  policy p { monitor when g(a) then resume at most 1 { pass() } during { use_up(a) } }";
    let mut fired = false;
    let found = requests(policy, &mut |effect| match effect {
        Effect::Start { goal, command, .. } => {
            let mut said = vec![DriverEvent::Acknowledged { goal: *goal }];
            let begins = command.primitive == "use_up" && !std::mem::replace(&mut fired, true);
            said.push(seen_of_a("g", begins));
            if !begins {
                said.push(DriverEvent::Ended { goal: *goal, outcome: Outcome::Success(None) });
            }
            said
        }
        Effect::Cancel { goal } => {
            vec![DriverEvent::Ended { goal: *goal, outcome: Outcome::Interrupted }]
        }
        effect => honest(effect, |query| Some(query.to_string() == "f(a)")),
    });
    let begun: Vec<&String> = found.iter().filter(|request| request.contains("use_up")).collect();
    assert_eq!(begun.len(), 2, "{found:?}");
    assert!(
        found.iter().any(|request| request.starts_with("observe") && request.contains("f(a)")),
        "{found:?}"
    );
}

#[test]
fn soundness_any_beside_a_binding_asks_all_that_it_may_be() {
    let domain = "
entity b: Object
fluent tied(o: Object, to: Entity)
initially tied(a, b), tied(b, a)
closed world
action cut(o: Object)
    needs not tied(o, any)
action tie_all(o: Object)
    makes tied(o, x) for each x: Object
action free_all(o: Object)
    needs not tied(any, o)
action knot(o: Object)
    makes tied(o, o)
perception look(what: Text) -> Object
";
    let policy = |steps: &str| format!("{domain}\npolicy p {{ {steps} }}");
    // Both are tied, whichever it is.
    let found = session_codes(None, &format!("{DOMAIN}\n{}", policy("let m = look(\"thing\") cut(m)")));
    assert!(found.contains(&"M0501"), "{found:?}");
    // The pattern of the effect crosses that of the need.
    let domain = domain.replace("initially tied(a, b), tied(b, a)\n", "");
    let policy = |steps: &str| format!("{domain}\npolicy p {{ {steps} }}");
    let crossed = session_codes(None, &format!("{DOMAIN}\n{}", policy("tie_all(a) free_all(b)")));
    assert!(crossed.contains(&"M0501"), "{crossed:?}");
    // A binding that stands in both places of an effect.
    let knotted = verdicts("cut", &policy("try { let m = look(\"thing\") knot(m) cut(a) } catch any { }"));
    assert_ne!(knotted, [Verdict::Proven]);
}

/// Codes of the findings on a document, perhaps for the HSR in a scene.
pub(crate) fn session_codes(scene: Option<&str>, document: &str) -> Vec<&'static str> {
    let (robot, scene) = (scene.map(|_| setup::robot("hsr")), scene.map(setup::scene));
    let (session, _) = setup::session(robot.as_ref(), scene.as_ref(), &mut Sources::default());
    let parsed = motet_syntax::read(&Source::new("p.motet", document), FileId(99));
    session.check(&parsed).iter().map(|found| found.code.0).collect()
}

#[test]
fn soundness_a_restart_begins_where_its_condition_holds() {
    let restarts = "policy p { go(mug_1) pick(mug_1) monitor when not holding(mug_1) \
                    then restart at most 2 during { lift() go(user) } }";
    let found = session_codes(Some("kitchen"), restarts);
    assert!(found.contains(&"M0501"), "{found:?}");
}

#[test]
fn soundness_a_dropped_thing_can_be_picked_again() {
    let recovers = "policy p { go(mug_1) pick(mug_1) monitor when not holding(mug_1) \
                    then resume at most 2 { go(mug_1) pick(mug_1) } during { go(user) } }";
    let found = session_codes(Some("kitchen"), recovers);
    assert!(!found.contains(&"M0501") && !found.contains(&"M0902"), "{found:?}");
}

/// Effects of a step may be undone by the time that a `wait` ends: the policy can do the step again, and
/// its other effects are asked again.
#[test]
fn soundness_what_was_waited_for_may_have_undone_a_step() {
    let recovers = "policy p { go(mug_1) pick(mug_1) go(counter) wait until not holding(mug_1) within 9 s \
                    go(mug_1) pick(mug_1) go(user) handover(mug_1, user) }";
    let found = session_codes(Some("kitchen"), recovers);
    assert!(!found.contains(&"M0501") && !found.contains(&"M0902"), "{found:?}");
    let take = "action take(o: Object)\n    needs not f(o), not g(o)\n    makes f(o), g(o)\n";
    let again = |between: &str| {
        format!("{take}initially not f(a), not g(a)\npolicy p {{ take(a) {between} take(a) }}")
    };
    let waits = again("wait until not f(a) within 5 s");
    assert_eq!(verdicts("take", &waits), [Verdict::Proven, Verdict::Deferred]);
    let found = requests(&waits, &mut |effect| honest(effect, |_| Some(false)));
    assert_eq!(found.iter().filter(|request| request.starts_with("start")).count(), 2, "{found:?}");
    // A need that still does not hold refuses the step.
    let found = requests(&waits, &mut |effect| honest(effect, |query| Some(query.to_string() == "g(a)")));
    assert_eq!(found.iter().filter(|request| request.starts_with("start")).count(), 1, "{found:?}");
    // Without a wait nothing says that the world has undone it.
    let at_once = session_codes(None, &format!("{DOMAIN}\n{}", again("pass()")));
    assert!(at_once.contains(&"M0501"), "{at_once:?}");
}

#[test]
fn soundness_a_driver_that_cannot_tell_takes_nothing_back() {
    let policy = "initially f(a)\npolicy p { repeat 1 { pass() } until f(a) use(a) }";
    let args = vec![Pattern::Is(Value::Entity("a".into()))];
    let query = Query::Fact { fluent: "f".into(), args };
    let found = requests(policy, &mut |effect| {
        let blind = DriverEvent::Observed { query: query.clone(), answer: Answer::Unknown };
        std::iter::once(blind).chain(honest(effect, |_| None)).collect()
    });
    assert!(found.iter().any(|request| request.contains("use")), "{found:?}");
}

/// Effects in a run of `find("x")`, where a policy of other steps takes over at once. What these test at
/// first is true. Both goals then end in success, the first with `a` as its result.
fn taken_over(declared: &str, later: &str) -> Vec<Effect> {
    let of = |steps: &str| compiled(&format!("{declared}\npolicy p {{ {steps} }}"));
    let (mut engine, mut out) = (Engine::new(of("find(\"x\")"), &StartState::default()).unwrap(), Vec::new());
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let later = PreparedSwap::new(of(later), &engine.running()).unwrap();
    engine.swap(Time::ZERO, later, &mut out).unwrap();
    for effect in out.clone() {
        if let Effect::Observe { query } = effect {
            let query = Query::clone(&query);
            let seen = DriverEvent::Observed { query, answer: Answer::Truth(true) };
            engine.handle(Time::ZERO, Event::Driver(seen), &mut out);
        }
    }
    let goals = out.iter().filter_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let goals: Vec<_> = goals.collect();
    assert_eq!(goals.len(), 2, "{out:?}");
    for (goal, value) in goals.into_iter().zip([Some(Value::Entity("a".into())), None]) {
        let ended = DriverEvent::Ended { goal, outcome: Outcome::Success(value) };
        engine.handle(Time::from_secs(1.0), Event::Driver(ended), &mut out);
    }
    out
}

/// A goal that a swap cancels may end in success, and change what the new policy was proven from.
#[test]
fn soundness_a_policy_that_takes_over_asks_what_the_goals_before_it_change() {
    let find =
        |contract: &str| format!("perception find(what: Text) -> Object\n    {contract}\n    uses base\n");
    let made = format!("{}initially f(a)", find("makes not f(result)"));
    let unsettled = format!("{}closed world", find("unsettles f(result)"));
    let untold = find("unsettles f(result)");
    // What is known to be false is refused at once.
    for (declared, later, asks) in [
        (made, "pass() use(a)", 0),
        (unsettled, "pass() avoid(a)", 1),
        (untold, "if f(a) { pass() use(a) }", 2),
    ] {
        let out = taken_over(&declared, later);
        let starts = out.iter().filter(|effect| matches!(effect, Effect::Start { .. }));
        assert_eq!(starts.count(), 2, "{declared}: {out:#?}");
        let asked = out.iter().filter(|effect| matches!(effect, Effect::Observe { .. }));
        assert_eq!(asked.count(), asks, "{declared}: {out:#?}");
    }
}

/// Domain of needs and effects that are about each object.
const EACH: &str = "
entity b: Object
fluent h(o: Object)
action use_all(o: Object)
    needs f(x) for each x: Object
action rub(o: Object)
    makes not h(o), f(o) when h(o)
    fails slipped
";

/// Returns whether a primitive of [`EACH`] starts beside a driver that observes what `see` says.
fn starts(call: &str, see: impl Fn(&str) -> Option<bool>) -> bool {
    let policy = format!("{EACH}\npolicy p {{ {call} }}");
    let found = requests(&policy, &mut |effect| honest(effect, |query| see(&query.to_string())));
    found.iter().any(|request| request.starts_with("start"))
}

#[test]
fn soundness_a_need_of_each_object_asks_of_those_that_no_step_names() {
    assert!(!starts("use_all(a)", |query| Some(query == "f(a)")));
    // The robot is no object.
    assert!(starts("use_all(a)", |query| Some(query == "f(a)" || query == "f(b)")));
}

#[test]
fn soundness_a_need_under_an_unknown_condition_asks_both() {
    let domain = "
entity b: Object
action use_some(o: Object)
    needs f(x) for each x: Object when g(x)
action use_if(o: Object)
    needs f(o) when g(o)
";
    let starts = |call: &str, see: &dyn Fn(&str) -> Option<bool>| {
        let policy = format!("{domain}\npolicy p {{ {call} }}");
        let found = requests(&policy, &mut |effect| honest(effect, |query| see(&query.to_string())));
        found.iter().any(|request| request.starts_with("start"))
    };
    for call in ["use_some(a)", "use_if(a)"] {
        // Nothing is known of either.
        assert!(!starts(call, &|_| None), "{call}");
        // The condition is unknown, and what it would ask is false.
        assert!(!starts(call, &|query| query.starts_with('f').then_some(false)), "{call}");
        // Either the condition is false or the need holds.
        assert!(starts(call, &|query| query.starts_with('f').then_some(true)), "{call}");
        assert!(starts(call, &|query| query.starts_with('g').then_some(false)), "{call}");
        assert!(!starts(call, &|query| Some(query.starts_with('g'))), "{call}");
    }
    assert!(!starts("use_some(a)", &|query| Some(query == "f(a)" || query == "g(b)")));
    assert!(starts("use_some(a)", &|query| Some(query == "f(b)" || query == "g(b)")));
}

/// Steps that start in a policy for the HSR in the kitchen, beside a driver that finds what `find` gives.
fn started_with(policy: &str, find: impl Fn(&str) -> Option<Value>) -> Vec<String> {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
    let parsed = motet_syntax::read(&Source::new("p.motet", policy), FileId(99));
    let compiled = session.compile(&parsed, None);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{policy}: {:#?}", compiled.diagnostics));
    let mut answers = |effect: &Effect| match effect {
        Effect::Start { goal, command, .. } => {
            vec![DriverEvent::Ended { goal: *goal, outcome: Outcome::Success(find(&command.primitive)) }]
        }
        effect => honest(effect, |_| None),
    };
    requests_of(graph, &mut answers).into_iter().filter(|request| request.starts_with("start")).collect()
}

#[test]
fn soundness_a_person_chooses_what_was_offered() {
    let policy = "policy p { let m = choose(\"which?\", [mug_1, apple]) say(\"this\") go(m) }";
    let chosen = |id: &'static str| {
        started_with(policy, move |callee| (callee == "choose").then(|| Value::Entity(id.into())))
    };
    assert_eq!(chosen("apple").len(), 3);
    assert_eq!(chosen("mug_2").len(), 1);
}

#[test]
fn soundness_what_a_name_stands_for_is_seen_where_it_is_bound() {
    // The proof is about `mug_1`; the first of what the run finds is another thing.
    let policy =
        "policy p { go(kitchen_table) let all = detect_all(\"red mug\") let m = first(all) locate(m) }";
    let found = |id: &'static str| {
        let list = Value::List(vec![Value::Entity(id.into())]);
        started_with(policy, move |callee| match callee {
            "detect_all" => Some(list.clone()),
            "locate" => {
                Some(Value::Pose(motet_graph::Pose { xyz: [0.0; 3], quaternion: [0.0, 0.0, 0.0, 1.0] }))
            }
            _ => None,
        })
    };
    // Its needs are then asked of that one, which nobody has seen.
    assert_eq!(found("bottle").len(), 2, "{:?}", found("bottle"));
}

#[test]
fn soundness_what_a_perception_unsettles_of_its_result_is_asked_again() {
    let policy = "perception find(what: Text) -> Object\n    unsettles f(result)\n\
                  initially f(a)\npolicy p { let m = find(\"it\") use(a) use(m) }";
    let found = requests(policy, &mut |effect| match effect {
        Effect::Start { goal, command, .. } if command.primitive == "find" => {
            let outcome = Outcome::Success(Some(Value::Entity("a".into())));
            vec![DriverEvent::Ended { goal: *goal, outcome }]
        }
        effect => honest(effect, |_| Some(false)),
    });
    assert!(!found.iter().any(|request| request.contains("use")), "{found:#?}");
}

#[test]
fn soundness_that_some_fit_takes_back_that_none_did() {
    let found = requests("policy p { wait until f(any) within 1 s avoid(a) }", &mut |effect| match effect {
        Effect::Watch { query } => [false, true]
            .map(|truth| DriverEvent::Observed { query: Query::clone(query), answer: Answer::Truth(truth) })
            .into(),
        effect => honest(effect, |_| Some(true)),
    });
    assert!(!found.iter().any(|request| request.contains("avoid")), "{found:#?}");
}

#[test]
fn soundness_an_effect_of_a_retry_is_that_of_what_the_try_before_left() {
    let policy = |retry: &str| format!("{EACH}\ninitially h(a)\npolicy p {{ rub(a) {retry} use(a) }}");
    assert_eq!(verdicts("use", &policy("")), [Verdict::Proven]);
    assert_eq!(verdicts("use", &policy("retry 1")), [Verdict::Deferred]);
}

#[test]
fn soundness_an_answer_from_before_a_step_says_nothing_of_what_the_step_unsettles() {
    let policy = "initially f(a)\npolicy p { wait until f(a) within 1 s shake(a) use(a) }";
    // The driver answers the watch of the wait once the step has begun, and then says what is so.
    let mut late = Vec::new();
    let found = requests(policy, &mut |effect| match effect {
        Effect::Watch { query } => {
            late.push(DriverEvent::Observed { query: Query::clone(query), answer: Answer::Truth(true) });
            Vec::new()
        }
        effect => late.drain(..).chain(honest(effect, |_| Some(false))).collect(),
    });
    assert!(!found.iter().any(|request| request.contains("use")), "{found:#?}");
    // A driver that answers nothing late is asked once more, and no more.
    let silent = requests(policy, &mut |effect| match effect {
        Effect::Watch { .. } => Vec::new(),
        effect => honest(effect, |_| Some(true)),
    });
    assert!(silent.iter().any(|request| request.contains("use")), "{silent:#?}");
}

/// Domain with facts of two things, beside [`DOMAIN`].
const PAIRS: &str = "
entity b: Object
fluent tied(o: Object, to: Object)
action cut(o: Object)
    needs not tied(o, any)
action free_pair(o: Object, to: Object)
    needs not tied(o, to)
action loosen(o: Object)
    unsettles tied(b, o)
action untie_selves()
    makes not tied(o, o) for each o: Object
action tie_to_all(o: Object)
    makes tied(o, any)
action serve()
    needs f(b) for each o: Object when tied(o, o)
";

fn of_pairs(callee: &str, policy: &str) -> Vec<Verdict> {
    verdicts(callee, &format!("{PAIRS}\n{policy}"))
}

#[test]
fn soundness_a_binding_of_a_loop_forgets_what_was_said_of_all_beside_it() {
    let policy = "initially tied(b, b)\nclosed world\n\
                  policy p { each o in [a, b] at most 2 { make(a) cut(o) } }";
    assert_eq!(of_pairs("cut", policy), [Verdict::Deferred]);
    let twice = "policy p { let o = choose(\"which?\", [a, b]) cut(o) loosen(o) cut(o) }";
    assert_eq!(of_pairs("cut", twice), [Verdict::Deferred]);
}

#[test]
fn soundness_an_effect_on_each_with_itself_says_nothing_of_pairs() {
    let policy = "policy p { untie_selves() free_pair(a, b) }";
    assert_eq!(of_pairs("free_pair", policy), [Verdict::Deferred]);
    let own = "policy p { untie_selves() free_pair(a, a) }";
    assert_eq!(of_pairs("free_pair", own), [Verdict::Proven]);
}

#[test]
fn soundness_a_need_of_each_asks_those_that_a_pattern_covers() {
    let policy = "initially f(b)\nclosed world\npolicy p { tie_to_all(a) undo(b) serve() }";
    let (session, _) = setup::session(None, None, &mut Sources::default());
    let source = Source::new("p.motet", format!("{DOMAIN}\n{PAIRS}\n{policy}"));
    let compiled = session.compile(&motet_syntax::read(&source, FileId(99)), None);
    assert!(compiled.graph.is_none(), "`tied(a, a)` holds, and `f(b)` does not");
    let made = "initially f(b)\nclosed world\npolicy p { tie_to_all(a) serve() }";
    assert_eq!(of_pairs("serve", made), [Verdict::Proven]);
}

#[test]
fn soundness_a_cleanup_runs_also_behind_a_reaction_that_has_failed() {
    let remake = "action remake(o: Object)\n    makes f(o)\n    fails slipped\n";
    let policy = |reaction: &str| {
        format!(
            "{remake}initially f(a)\npolicy p {{ monitor when g(a) then resume at most 1 {{ {reaction} }} \
             during {{ sequence s {{ pass() }} finally {{ use(a) }} }} }}"
        )
    };
    assert_eq!(verdicts("use", &policy("remake(a)")), [Verdict::Deferred]);
    assert_eq!(verdicts("use", &policy("wave()")), [Verdict::Proven]);
}

#[test]
fn soundness_the_body_of_a_monitor_begins_on_all_paths() {
    let find = "perception find(what: Text) -> Object\n    makes g(result)\n";
    let policy = "let m = find(\"x\") try { wait until not f(any) within 3 s let n = find(\"y\") } \
                  catch any { monitor when g(m) then resume at most 1 { wave() } during { avoid(a) } }";
    assert_eq!(verdicts("avoid", &format!("{find}policy p {{ {policy} }}")), [Verdict::Deferred]);
}

/// The conditions of effects are about the state before the step: what another branch has changed meanwhile
/// does not count.
#[test]
fn soundness_the_condition_of_an_effect_is_not_judged_by_what_came_after_it() {
    let clear = "action clear(o: Object)\n    makes not f(o) when not g(o)\n    uses base\n";
    let policy = "policy p { parallel { { clear(a) avoid(a) } { make(a) } } }";
    let mut goals = Vec::new();
    let found = requests(&format!("{clear}{policy}"), &mut |effect| match effect {
        Effect::Start { goal, command, .. } if command.primitive == "clear" => {
            goals.push(*goal);
            vec![DriverEvent::Acknowledged { goal: *goal }]
        }
        Effect::Start { goal, command, .. } if command.primitive == "make" => {
            // The other branch ends first.
            let ended = |goal| DriverEvent::Ended { goal, outcome: Outcome::Success(None) };
            vec![ended(*goal), ended(goals[0])]
        }
        effect => honest(effect, |_| Some(false)),
    });
    assert!(
        found.iter().any(|request| request.starts_with("observe") && request.contains("f(a)")),
        "{found:?}"
    );
}

/// A branch does not learn what another may change, and then neither knows it behind both.
#[test]
fn soundness_what_branches_only_observe_is_not_known_behind_them() {
    let policy = "policy p { parallel { { avoid(a) } { wait until f(a) within 3 s } } avoid(a) }";
    assert_eq!(verdicts("avoid", policy), [Verdict::Deferred]);
    let policy = "policy p { parallel { { use(a) } { use(a) } } use_both(a) }";
    assert_eq!(verdicts("use_both", policy), [Verdict::Deferred; 2]);
}

/// A driver does not report what it cannot see, even if the engine watches it.
#[test]
fn soundness_an_effect_unsettles_what_is_watched_and_never_seen() {
    let policy = "policy p { monitor when not f(a) for 9 s then fail during { make(a) shake(a) } use(a) }";
    let asked = requests(policy, &mut |effect| honest(effect, |_| None));
    assert!(asked.iter().any(|said| said.starts_with("observe f(a)")), "{asked:?}");
}

/// The world changes a watched fact of one name, and another name may be that of the same thing.
#[test]
fn soundness_what_is_watched_of_one_name_may_change_for_another() {
    let domain = "entity b: Object\nperception find(what: Text) -> Object\n    makes f(result)\n";
    let body = "monitor when f(n) for 2 s then fail during { wait 2 s use(m) }";
    let named = "let m = find(\"x\") let n = choose(\"Which?\", [a, b])";
    let policy = format!("{domain}policy p {{ {named} {body} }}");
    assert_eq!(verdicts("use", &policy), [Verdict::Deferred]);
}

/// Of two things in the hands one may drop, and the other still answers the test.
#[test]
fn soundness_one_of_several_held_things_may_drop_alone() {
    let domain = "fluent holding(o: Object)\nentity b: Object\naction lift(o: Object)\n    makes holding(o)\n\
                  action swing(o: Object)\n    needs holding(o)\n";
    let policy = format!("{domain}policy p {{ lift(a) lift(b) if holding(any) {{ swing(a) }} }}");
    assert_eq!(verdicts("swing", &policy), [Verdict::Deferred]);
    // The engine asks for it, although the hands hold something as before.
    let both = policy.replace("policy p", "initially holding(a), holding(b)\npolicy p");
    let asked = requests(&both, &mut |effect| honest(effect, |_| Some(true)));
    assert!(asked.iter().any(|said| said.starts_with("observe holding(a)")), "{asked:?}");
    let alone =
        format!("{domain}initially not holding(any)\npolicy p {{ lift(a) if holding(any) {{ swing(a) }} }}");
    assert_eq!(verdicts("swing", &alone), [Verdict::Proven]);
}

/// A pattern about a name is unknown where no step has asked for it, although the world is closed.
#[test]
fn soundness_a_pattern_about_a_name_is_unknown_before_a_round_asks() {
    let domain = "closed world\nentity b: Object\nfluent tied(o: Object, p: Object)\ninitially tied(b, b)\n\
                  perception find(what: Text) -> Object\n    takes 1 s .. 2 s\n\
                  action cut(o: Object)\n    needs not tied(any, o)\n";
    let policy = format!("{domain}policy p {{ let m = find(\"thing\") repeat 2 {{ make(a) cut(m) }} }}");
    assert_eq!(verdicts("cut", &policy), [Verdict::Deferred]);
}

/// A step that fills a hand only under a condition may have done so, and what it held may drop.
#[test]
fn soundness_what_a_hand_may_hold_may_drop() {
    let domain = "fluent holding(o: Object)\nentity b: Object\naction lift(o: Object)\n    \
                  makes holding(b) when f(b), ready(o)\nfluent ready(o: Object)\n\
                  action swing(o: Object)\n    needs ready(o)\n";
    let tested = format!("{domain}policy p {{ lift(a) if holding(any) {{ say(\"it holds\") }} swing(a) }}");
    assert_eq!(verdicts("swing", &tested), [Verdict::Deferred]);
    let before = format!("{domain}policy p {{ if holding(any) {{ say(\"it holds\") }} lift(a) swing(a) }}");
    assert_eq!(verdicts("swing", &before), [Verdict::Proven]);
}

/// Each of two branches makes a fact on some of its paths.
#[test]
fn soundness_what_branches_may_make_is_not_made_behind_them() {
    let domain = "initially not f(a)\nfluent h(o: Object)\nfluent k(o: Object)\naction raise(o: Object)\n    \
                  makes f(o)\n    uses base\n";
    let branches = "{ if h(a) { make(a) } } { if k(a) { raise(a) } }";
    let policy = format!("{domain}policy p {{ parallel {{ {branches} }} use(a) }}");
    assert_eq!(verdicts("use", &policy), [Verdict::Deferred]);
    let made = format!("{domain}policy p {{ parallel {{ {{ make(a) }} {{ raise(a) }} }} use(a) }}");
    assert_eq!(verdicts("use", &made), [Verdict::Proven]);
}

/// A guard of a policy that takes over may refuse a need that was proven, and its handler then runs.
#[test]
fn soundness_a_step_that_no_path_reaches_asks_its_needs() {
    let policy = "policy p { try { pass() } catch timeout { wave() } catch any { use_both(a) } }";
    assert_eq!(verdicts("use_both", &format!("initially f(a)\n{policy}")), [Verdict::Deferred; 2]);
}

/// Observation of a fact of `a`.
fn seen_of_a(fluent: &str, truth: bool) -> DriverEvent {
    let args = vec![Pattern::Is(Value::Entity("a".into()))];
    let query = Query::Fact { fluent: fluent.into(), args };
    DriverEvent::Observed { query, answer: Answer::Truth(truth) }
}

/// A step that was interrupted may fail by itself; the reaction's failure is not lost behind it.
#[test]
fn soundness_a_failed_reaction_is_not_handled_as_the_failure_of_the_body() {
    let own = "action mend(o: Object)\n    makes f(o)\n    uses voice\n    fails blocked\n\
               action work(o: Object)\n    uses base\n    fails slipped\n";
    let policy = "initially f(a)\npolicy p { try { monitor when g(a) then resume at most 1 { mend(a) } \
                  during { work(a) } } catch slipped { pass() } use(a) }";
    assert_eq!(verdicts("use", &format!("{own}{policy}")), [Verdict::Proven]);
    let ended = |goal: &GoalId, kind: &str| DriverEvent::Ended {
        goal: *goal,
        outcome: Outcome::Failure(kind.into()),
    };
    let found = requests(&format!("{own}{policy}"), &mut |effect| match effect {
        Effect::Start { goal, command, .. } if command.primitive == "work" => {
            vec![DriverEvent::Acknowledged { goal: *goal }, seen_of_a("g", true)]
        }
        Effect::Cancel { goal, .. } => vec![ended(goal, "slipped")],
        Effect::Start { goal, command, .. } if command.primitive == "mend" => vec![ended(goal, "blocked")],
        effect => honest(effect, |_| Some(false)),
    });
    assert!(found.last().is_some_and(|last| last.contains("blocked")), "{found:?}");
    assert!(!found.iter().any(|request| request.contains("use(")), "{found:?}");
}

/// A hand that lost its thing during a step was not empty before the step.
#[test]
fn soundness_the_condition_of_an_effect_is_not_judged_by_what_was_seen_after_the_step_began() {
    let grow = "action grow(o: Object)\n    makes f(o) when not holding(any)\n    uses base\n";
    let policy = "initially holding(a)\npolicy p { monitor when not holding(a) for 10 s then pause during \
                  { grow(a) } use(a) }";
    assert_eq!(verdicts("use", &format!("{grow}{policy}")), [Verdict::Deferred]);
    let found = requests(&format!("{grow}{policy}"), &mut |effect| match effect {
        Effect::Start { goal, command, .. } if command.primitive == "grow" => {
            let fallen = seen_of_a("holding", false);
            vec![fallen, DriverEvent::Ended { goal: *goal, outcome: Outcome::Success(None) }]
        }
        effect => honest(effect, |_| Some(true)),
    });
    let asks = |request: &String| request.starts_with("observe") && request.contains("f(a)");
    assert!(found.iter().any(asks), "{found:?}");
}

/// In a closed world the engine knows what the proof takes for false.
#[test]
fn soundness_a_closed_world_fires_its_monitors_at_once() {
    let policy = "initially g(a)\nclosed world\npolicy p { monitor when not f(a) then resume at most 1 { \
                  make(a) } during { use(a) } }";
    assert_eq!(verdicts("use", policy), [Verdict::Proven]);
    let found = requests(policy, &mut |effect| honest(effect, |_| None));
    let starts: Vec<&String> = found.iter().filter(|request| request.starts_with("start")).collect();
    assert!(starts[0].contains("make"), "{found:?}");
}

/// A fact that was only seen ends with its lifetime in a run as in the proof, also in a policy that follows.
#[test]
fn soundness_what_was_seen_ends_with_its_lifetime_in_a_run() {
    let declared = "perception peek(o: Object)\n    makes f(o)\n    lasts until base, o\n    uses camera\n\
                    action lift(o: Object)\n    makes g(o)\n    uses voice\n\
                    action shove()\n    makes g(o) for each o: Object when f(o)\n    uses voice\n";
    let graph = |steps: &str| compiled(&format!("{declared}policy p {{ {steps} }}"));
    let uses = |graph: Graph| {
        let found = requests_of(graph, &mut |effect| honest(effect, |_| Some(false)));
        found.iter().filter(|request| request.contains("use(")).count()
    };
    // Nothing is true that is not made: so a step starts only where its guard trusts what was seen.
    for (steps, count) in [
        ("peek(a) use(a)", 1),
        ("peek(a) pass() use(a)", 1),
        ("peek(a) wave() use(a)", 0),
        ("peek(a) lift(a) use(a)", 0),
        ("peek(a) shove() use(a)", 0),
        ("peek(a) make(a) wave() use(a)", 1),
        ("parallel { { peek(a) } { wave() } } use(a)", 0),
        ("parallel { { peek(a) } { pass() wave() } } use(a)", 0),
    ] {
        assert_eq!(uses(graph(steps)), count, "{steps}");
    }
    let mut engine = Engine::new(graph("peek(a) pass()"), &StartState::default()).unwrap();
    let mut out = Vec::new();
    engine.handle(Time::ZERO, Event::Begin, &mut out);
    let first = out.iter().find_map(|effect| match effect {
        Effect::Start { goal, .. } => Some(*goal),
        _ => None,
    });
    let ended = DriverEvent::Ended { goal: first.unwrap(), outcome: Outcome::Success(None) };
    engine.handle(Time::from_secs(1.0), Event::Driver(ended), &mut out);
    let known = engine.snapshot();
    let [lasting] = known.lasting.as_slice() else { panic!("{known:?}") };
    assert_eq!(
        (lasting.uses.as_slice(), lasting.entities.as_slice()),
        (&["base".into()][..], &["a".into()][..])
    );
    let state = InitialState {
        facts: known.state().into_iter().map(|(fact, holds)| (fact, (holds, Span::default()))).collect(),
        lasting: vec![FactLifetime {
            fact: "f(a)".to_owned(),
            uses: lasting.uses.clone(),
            entities: lasting.entities.clone(),
        }],
        ..InitialState::default()
    };
    let mut sources = Sources::default();
    let domain = Source::new("domain", format!("{DOMAIN}{declared}"));
    let domains = [motet_syntax::read(&domain, FileId(98)).file];
    let session = Session::builder().domains(&domains).state(&state).build(&mut sources);
    for (steps, verdict, count) in
        [("pass() use(a)", Verdict::Proven, 1), ("wave() use(a)", Verdict::Deferred, 0)]
    {
        let source = Source::new("p.motet", format!("policy p {{ {steps} }}"));
        let graph = session.compile(&motet_syntax::read(&source, FileId(99)), None).graph.unwrap();
        let last = graph.nodes.iter().rev().find_map(|node| match &node.kind {
            NodeKind::Call(call) => call.needs.first(),
            _ => None,
        });
        assert_eq!(last.unwrap().verdict, verdict, "{steps}");
        let found = requests_from(graph, &known.start_state(), &mut |effect| honest(effect, |_| Some(false)));
        assert_eq!(found.iter().filter(|request| request.contains("use(")).count(), count, "{found:?}");
    }
}
