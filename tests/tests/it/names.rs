//! Names of unknown things: what happens to a thing is felt by what is known of every name that may be its.

use motet_graph::{NodeKind, Verdict};
use motet_syntax::{FileId, Source, Sources};
use motet_tests::setup;

use crate::soundness::session_codes;

const DOMAIN: &str = "
entity a, b: Object
entity box: Container
fluent ok(e: Entity)
fluent clean(o: Object)
fluent ready()
perception look_o(what: Text) -> Object
perception look_all(what: Text) -> List<Object>
action wash(o: Object)
    makes clean(o)
action soil(o: Object)
    makes not clean(o)
action use(o: Object)
    needs clean(o)
action use_not(o: Object)
    needs not clean(o)
action use_any()
    needs clean(a) or clean(b)
action mark(e: Entity)
    makes ok(e)
action unmark2(e: Entity)
    makes not ok(e)
action needs_ok(e: Entity)
    needs ok(e)
action needs_notok(e: Entity)
    needs not ok(e)
";

/// Verdicts on the calls with needs of a policy over [`DOMAIN`], `true` where proven, in the order of the
/// graph; the codes of the findings where it has no graph.
fn proven(body: &str) -> Result<Vec<bool>, Vec<&'static str>> {
    let (session, _) = setup::session(None, None, &mut Sources::default());
    let source = Source::new("p.motet", format!("{DOMAIN}\npolicy p {{ {body} }}"));
    let compiled = session.compile(&motet_syntax::read(&source, FileId(99)), None);
    let codes = || compiled.diagnostics.iter().map(|found| found.code.0).collect::<Vec<_>>();
    let graph = compiled.graph.as_ref().ok_or_else(codes)?;
    let needs = graph.nodes.iter().filter_map(|node| match &node.kind {
        NodeKind::Call(call) => call.needs.first().map(|need| need.verdict == Verdict::Proven),
        _ => None,
    });
    Ok(needs.collect())
}

#[test]
fn names_feel_what_another_branch_does() {
    for (body, expected) in [
        // Bound in the branch, and used there and behind the block.
        ("parallel { { let m = look_o(\"x\") wash(m) use(m) } { soil(a) } }", vec![false]),
        ("parallel { { let m = look_o(\"x\") wash(m) wait 1 s use(m) } { soil(a) } } use(m)", vec![false; 2]),
        ("parallel { { let m = look_o(\"x\") soil(m) use_not(m) } { wash(a) } } use_not(m)", vec![false; 2]),
        // Two names.
        (
            "parallel { { let m = look_o(\"x\") wash(m) wait 1 s use(m) } \
             { let n = look_o(\"y\") soil(n) } } use(m)",
            vec![false; 2],
        ),
        (
            "let m = look_o(\"x\") let n = look_o(\"y\") \
             parallel { { wash(m) use(m) } { soil(n) use_not(n) } } use(m)",
            vec![false; 3],
        ),
        // A wait sees what the other branch may have changed since.
        ("wash(a) parallel { { soil(b) } { wait until not clean(any) within 3 s use(a) } }", vec![false]),
        // Bound before the block.
        ("let m = look_o(\"x\") wash(m) parallel { { use(m) } { soil(a) } }", vec![false]),
        ("let m = look_o(\"x\") parallel { { wash(m) wait 1 s use(m) } { soil(a) } } use(m)", vec![false; 2]),
        ("let m = look_o(\"x\") wash(m) parallel { { wash(b) } { soil(a) } } use(m)", vec![false]),
        ("let m = look_o(\"x\") parallel { { wash(a) use(a) } { soil(m) } } use(a)", vec![false; 2]),
        ("parallel { { wash(a) use(a) } { let m = look_o(\"x\") soil(m) } } use(a)", vec![false; 2]),
        // The `else` is not ruled out.
        (
            "let m = look_o(\"x\") wash(m) \
             parallel { { if clean(m) { say(\"yes\") } else { use(m) } } { soil(a) } }",
            vec![false],
        ),
        // Nothing that the name can be is changed.
        ("parallel { { let m = look_o(\"x\") wash(m) use(m) } { unmark2(a) } } use(m)", vec![true; 2]),
        ("parallel { { let m = look_o(\"x\") mark(m) needs_ok(m) } { unmark2(box) } }", vec![true]),
    ] {
        assert_eq!(proven(body), Ok(expected), "{body}");
    }
}

#[test]
fn names_feel_what_the_world_does_to_what_is_watched() {
    for (body, expected) in [
        (
            "monitor when clean(a) and ready() then pause during \
             { let m = look_o(\"x\") soil(m) wait 3 s use_not(m) }",
            vec![false],
        ),
        (
            "monitor when clean(a) for 2 s then pause during \
             { let m = look_o(\"x\") soil(m) wait 1 s use_not(m) }",
            vec![false],
        ),
        (
            "let k = look_o(\"y\") monitor when clean(k) and ready() then pause during \
             { let m = look_o(\"x\") soil(m) wait 3 s use_not(m) }",
            vec![false],
        ),
        (
            "let k = look_o(\"y\") monitor when clean(k) and ready() then pause during \
             { soil(a) wait 3 s use_not(a) }",
            vec![false],
        ),
        (
            "monitor when ok(box) and ready() then pause during \
             { let m = look_o(\"x\") unmark2(m) wait 3 s needs_notok(m) }",
            vec![true],
        ),
        // A name may set it off by itself, and then the world restores the fact.
        (
            "wash(a) monitor when not clean(a) then pause during \
             { let m = look_o(\"x\") soil(m) wait 3 s use_not(m) }",
            vec![false],
        ),
        (
            "let k = look_o(\"y\") wash(k) monitor when not clean(k) then pause during \
             { soil(a) wait 3 s use_not(a) }",
            vec![false],
        ),
        ("wash(a) monitor when not clean(a) then pause during { wash(b) wait 3 s use(b) }", vec![true]),
        ("let m = look_o(\"x\") monitor when not clean(m) then pause during { use_not(a) }", vec![false]),
    ] {
        assert_eq!(proven(body), Ok(expected), "{body}");
    }
}

#[test]
fn watched_facts_may_change_while_a_policy_waits() {
    let body = "unmark2(a) monitor when clean(a) and ready() then pause during \
                { if clean(a) { wait 3 s if not clean(a) { mark(a) } } } needs_notok(a)";
    // The second test may find that it is no longer clean.
    assert_eq!(proven(body), Err(vec!["M0501"]));
}

#[test]
fn watched_facts_may_change_on_each_path() {
    let seen = "if clean(a) { let _q = 1 } else { if clean(b) { let _r = 1 } else { cannot \"neither\" } }";
    // One of them is clean, whichever it is, until the world changes that.
    let body = "soil(a) soil(b) if ready() { wash(a) } else { wash(b) } use_any()";
    assert_eq!(proven(body), Ok(vec![true]));
    let whens = "(clean(a) and ready()) or (clean(b) and ready())";
    let body =
        format!("soil(a) soil(b) monitor when {whens} then pause during {{ {seen} wait 5 s use_any() }}");
    assert_eq!(proven(&body), Ok(vec![false]));
}

#[test]
fn names_feel_what_a_reaction_does() {
    for (body, expected) in [
        (
            "monitor when ready() then resume at most 2 { soil(a) } during \
             { let m = look_o(\"x\") wash(m) use(m) }",
            vec![false],
        ),
        (
            "let m = look_o(\"x\") wash(m) monitor when ready() then resume at most 2 { wash(m) } during \
             { use(m) }",
            vec![true],
        ),
    ] {
        assert_eq!(proven(body), Ok(expected), "{body}");
    }
}

#[test]
fn list_has_the_nearest_kind_of_its_elements() {
    for (body, expected) in [
        // An item may be the thing of another kind.
        ("mark(box) each x in [a, box] at most 5 { unmark2(x) } needs_ok(box)", Ok(vec![false])),
        ("mark(box) each x in [a, b] at most 5 { unmark2(x) } needs_ok(box)", Ok(vec![true])),
        ("each x in [a, box] at most 5 { mark(x) needs_ok(x) }", Ok(vec![true])),
        ("each x in [a, box] at most 5 { if x == box { mark(x) } }", Ok(vec![])),
        // No action on an object is carried out on a container.
        ("each x in [a, box] at most 5 { wash(x) }", Err(vec!["M0301"])),
        ("each x in [a, 1 m] at most 5 { mark(x) }", Err(vec!["M0301"])),
    ] {
        assert_eq!(proven(body), expected, "{body}");
    }
}

#[test]
fn each_runs_a_round_for_every_element_that_is_written_out() {
    for (body, expected) in [
        ("soil(a) each x in [a] at most 1 { wash(x) } use(a)", Ok(vec![true])),
        // No round is walked alone: which of them it is about is not known.
        ("soil(a) each x in [a, b] at most 2 { wash(x) } use(a)", Ok(vec![false])),
        ("wash(a) wash(b) each x in [a, b] at most 2 { use(x) soil(x) } use_not(b)", Ok(vec![false; 2])),
        ("mark(box) mark(b) each x in [a] at most 2 { unmark2(x) } needs_ok(b)", Ok(vec![true])),
        // A list that a step finds may be empty.
        (
            "soil(a) let l = look_all(\"x\") each x in l at most 2 { wash(x) wash(a) } use(a)",
            Err(vec!["M0501"]),
        ),
    ] {
        assert_eq!(proven(body), expected, "{body}");
    }
    let doors = "policy p achieves open(drawer_1) and open(cupboard_1) { \
                 each c in [drawer_1, cupboard_1] at most 2 { go(c) open(c) } }";
    let found = session_codes(Some("kitchen"), doors);
    assert!(!found.contains(&"M0503"), "{found:?}");
}
