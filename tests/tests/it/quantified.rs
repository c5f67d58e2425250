//! Quantified needs and effects, and conditions about entities of which nobody knows which they are.

use motet_graph::Verdict;

use crate::soundness::{DOMAIN, session_codes, verdicts};

/// Declarations beside those of [`DOMAIN`](crate::soundness::DOMAIN).
const DECLARED: &str = "
entity box: Container
enum Mode {slow, fast}
fluent ok(e: Entity)
fluent ready()
fluent set(m: Mode)
fluent tuned(o: Object, m: Mode)
perception look_o(what: Text) -> Object
perception look_e(what: Text) -> Entity
perception all(what: Text) -> List<Object>
perception which() -> Mode
action mark(e: Entity)
    makes ok(e)
action needs_ok(e: Entity)
    needs ok(e)
action needs_slow()
    needs not set(fast)
action needs_not_ok(e: Entity)
    needs not ok(e)
";

/// Verdict on the one need of the last call of a primitive.
fn verdict(callee: &str, more: &str, steps: &str) -> Verdict {
    let found = verdicts(callee, &format!("{DECLARED}{more}\npolicy p {{ {steps} }}"));
    assert_eq!(found.len(), 1, "{more}: {steps}");
    found[0]
}

#[test]
fn quantified_need_of_nobody_knows_whom_is_left_to_the_run() {
    let tuned = "action try_it(m: Mode)\n    needs f(o) for each o: Object when tuned(o, m)\n";
    assert_eq!(verdict("try_it", tuned, "let m = which() try_it(m)"), Verdict::Deferred);
    let same = "action try_it(e: Entity)\n    needs ok(c) for each c: Container when c == e\n";
    for steps in ["let e = look_e(\"x\") try_it(e)", "let xs = all(\"x\") try_it(first(xs))"] {
        assert_eq!(verdict("try_it", same, steps), Verdict::Deferred, "{steps}");
    }
    assert_eq!(verdict("try_it", same, "mark(box) try_it(box)"), Verdict::Proven);
    assert_eq!(verdict("try_it", same, "try_it(a)"), Verdict::Proven);
    let at = "fluent at_it(o: Object, e: Entity)\naction try_it(o: Object)\n    \
              needs ok(e) for each e: Entity when at_it(o, e)\n";
    assert_eq!(verdict("try_it", at, "let xs = all(\"x\") try_it(first(xs))"), Verdict::Deferred);
    // In the standard library: what the thing is in has to be open.
    let found = session_codes(
        Some("kitchen"),
        "policy p { go(fridge_1) let xs = detect_all(\"mug\") pick(first(xs)) }",
    );
    assert!(!found.contains(&"M0501"), "{found:?}");
}

#[test]
fn quantified_effect_on_nobody_knows_whom_is_not_lost() {
    let undo = "action unmark(e: Entity)\n    makes not ok(c) for each c: Container when c == e\n\
                action spoil(m: Mode)\n    makes not f(o) for each o: Object when tuned(o, m)\n";
    let steps = "mark(box) let e = look_e(\"x\") unmark(e) needs_ok(box)";
    assert_eq!(verdict("needs_ok", undo, steps), Verdict::Deferred);
    let steps = "make(a) let m = which() spoil(m) use(a)";
    assert_eq!(verdict("use", undo, steps), Verdict::Deferred);
}

#[test]
fn quantified_effect_also_concerns_things_that_nobody_has_named() {
    let spoil = "action spoil()\n    makes not f(a) for each o: Object when not f(o) and ready()\n\
                 action spoil_all()\n    makes not ok(o) for each o: Object when ready() and not f(o)\n";
    assert_eq!(verdict("use", spoil, "make(a) spoil() use(a)"), Verdict::Deferred);
    // The things that have a name keep what is known of them.
    assert_eq!(verdict("needs_ok", spoil, "mark(box) spoil_all() needs_ok(box)"), Verdict::Proven);
    assert_eq!(verdict("needs_ok", spoil, "make(a) mark(a) spoil_all() needs_ok(a)"), Verdict::Proven);
    let found = "make(a) let m = look_o(\"x\") mark(m) spoil_all() needs_ok(m)";
    assert_eq!(verdict("needs_ok", spoil, found), Verdict::Deferred);
    let unmark = format!(
        "{spoil}action unmark(e: Entity)\n    makes not ok(e)\naction mark_all()\n    makes ok(any)\n"
    );
    let found = "make(a) let m = look_o(\"x\") make(m) mark_all() spoil_all() unmark(a) needs_ok(m)";
    assert_eq!(verdict("needs_ok", &unmark, found), Verdict::Deferred);
    let closed = format!("{spoil}closed world\n");
    assert_eq!(verdict("use", &closed, "make(a) spoil() use(a)"), Verdict::Proven);
}

#[test]
fn quantified_over_things_without_a_declaration() {
    let nobody = "kind Part: Entity\nfluent held_part(p: Part)\nperception look_p(what: Text) -> Part\n\
                  action grab(p: Part)\n    makes held_part(p)\naction wash_all()\n    \
                  makes not held_part(p) for each p: Part when ready()\naction keep(p: Part)\n    \
                  needs held_part(p)\n";
    let alone = |when: &str| {
        format!(
            "{DECLARED}{nobody}action alone(p2: Part)\n    needs not held_part(p) for each p: Part{when}\n\
             initially not held_part(any)\n\
             policy p {{ let m = look_p(\"x\") let n = look_p(\"y\") grab(m) alone(n) }}"
        )
    };
    for when in [" when p != p2", " when ready()", " when ready() or set(fast)"] {
        assert_eq!(verdicts("alone", &alone(when)), [Verdict::Deferred], "{when}");
    }
    let found = session_codes(None, &format!("{DOMAIN}\n{}", alone("")));
    assert!(found.contains(&"M0501"), "{found:?}");
    assert_eq!(
        verdict("keep", nobody, "let m = look_p(\"x\") grab(m) wash_all() keep(m)"),
        Verdict::Deferred
    );
}

#[test]
fn quantified_wait_for_nobody_knows_what_changes_what_it_may_be() {
    let start = "initially not set(fast), not ok(a)\n";
    let steps = "let m = which() wait until set(m) needs_slow()";
    assert_eq!(verdict("needs_slow", start, steps), Verdict::Deferred);
    let steps = "let xs = all(\"x\") wait until ok(first(xs)) needs_not_ok(a)";
    assert_eq!(verdict("needs_not_ok", start, steps), Verdict::Deferred);
    let steps = "let m = which() monitor when set(m) then fail \"x\" during { needs_slow() }";
    assert_eq!(verdict("needs_slow", start, steps), Verdict::Deferred);
}

#[test]
fn quantified_effect_moves_each_that_it_may_be_about() {
    let touch = "perception touch(o: Object)\n    makes f(o)\n    lasts until o\n    uses camera\n\
                 action shove()\n    makes g(o) for each o: Object when tuned(o, slow)\n    uses voice\n";
    assert_eq!(verdict("use", touch, "touch(a) shove() use(a)"), Verdict::Deferred);
    let nothing = format!("{touch}initially not tuned(any, any)\n");
    assert_eq!(verdict("use", &nothing, "touch(a) shove() use(a)"), Verdict::Proven);
}
