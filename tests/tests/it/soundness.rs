//! Needs that only a guard can vouch for: the compiler may not prove them from a test that stayed unknown, or
//! from a guard that has refused.

use motet_graph::{NodeKind, Verdict};
use motet_syntax::{FileId, Source, Sources};
use motet_tests::setup;

const DOMAIN: &str = "
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

/// Verdicts on the needs of the last call of a primitive in a policy over [`DOMAIN`].
fn verdicts(callee: &str, policy: &str) -> Vec<Verdict> {
    let (session, _) = setup::session(None, None, &mut Sources::default());
    let source = Source::new("p.motet", format!("{DOMAIN}\n{policy}"));
    let checked = session.check_document(&motet_syntax::read(&source, FileId(99)));
    let graph = checked.policies.iter().find_map(|policy| policy.graph.as_ref());
    let graph = graph.unwrap_or_else(|| panic!("{policy}: {:#?}", checked.diagnostics));
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
fn session_codes(scene: Option<&str>, document: &str) -> Vec<&'static str> {
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
