//! Faults of behaviour trees that their engines run without a word: each is refused by the check, or left to
//! a guard that asks before the step.

use motet_graph::Verdict;

use crate::soundness::{DOMAIN, session_codes, verdicts};

/// Codes of the findings on a policy over the domain of the soundness tests, with more declarations.
fn codes(more: &str, policy: &str) -> Vec<&'static str> {
    session_codes(None, &format!("{DOMAIN}\n{more}\n{policy}"))
}

#[track_caller]
fn refused(code: &str, more: &str, policies: &[&str]) {
    for policy in policies {
        let found = codes(more, policy);
        assert!(found.contains(&code), "{policy}: {found:?}");
    }
}

#[track_caller]
fn left_to_a_guard(callee: &str, policies: &[&str]) {
    for policy in policies {
        let found = verdicts(callee, policy);
        assert!(found.contains(&Verdict::Deferred), "{policy}: {found:?}");
    }
}

#[test]
fn fault_control_node_without_children() {
    refused(
        "M0802",
        "",
        &[
            "policy p { if f(a) { } }",
            "policy p { if f(a) { } else { pass() } }",
            "policy p { sequence group { } }",
            "policy p { try { } catch any { pass() } }",
            "policy p { repeat 2 { } }",
            "policy p { each x in [a] at most 1 { } }",
            "policy p { parallel { { pass() } { } } }",
            "policy p { within 5 s { } }",
            "policy p { monitor when f(a) then pause during { } }",
            "policy p { monitor when f(a) then resume at most 1 { } during { pass() } }",
            "policy p { pass() } finally { }",
            "policy p { sequence s { pass() } finally { } }",
        ],
    );
    let clean = [
        "policy p { try { use(a) } catch any { } }",
        "policy p { if f(a) { pass() } else { } }",
        "policy p { }",
    ];
    for policy in clean {
        assert!(!codes("", policy).contains(&"M0802"), "{policy}");
    }
}

#[test]
fn fault_control_node_without_children_in_json() {
    let policy = |step: &str| format!("{{\"motet\":1,\"policy\":\"p\",\"steps\":[{step}]}}");
    let said = |step: &str| {
        let source = motet_syntax::Source::new("p.json", policy(step));
        let (session, _) = motet_tests::setup::session(None, None, &mut motet_syntax::Sources::default());
        let found = session.check(&motet_syntax::read(&source, motet_syntax::FileId(99)));
        found.iter().map(|found| found.code.0).collect::<Vec<_>>()
    };
    for step in [
        r#"{"if":{"is":"free","hand":"any"},"then":[]}"#,
        r#"{"sequence":"group","steps":[]}"#,
        r#"{"try":[],"catch":[{"on":"any","steps":[]}]}"#,
        r#"{"repeat":2,"steps":[]}"#,
        r#"{"parallel":[[{"do":"say","text":"x"}],[]]}"#,
        r#"{"within":5,"steps":[]}"#,
    ] {
        assert!(said(step).contains(&"M0802"), "{step}: {:?}", said(step));
    }
}

#[test]
fn fault_monitor_that_its_own_body_sets_off() {
    refused(
        "M0506",
        "",
        &[
            "policy p { monitor when f(a) then fail \"no\" during { make(a) } }",
            "policy p { monitor when f(a) then restart at most 1 during { make(a) pass() } }",
            "policy p { monitor when f(a) then resume at most 1 { wave() } \
             during { repeat 2 { make(a) pass() } } }",
            "policy p { monitor when f(a) then pause during { parallel { { make(a) pass() } { wave() } } } }",
            "policy p { monitor when not f(a) then pause during { sequence s { undo(a) wave() } } }",
        ],
    );
}

#[test]
fn fault_fact_that_another_branch_undoes() {
    left_to_a_guard(
        "use",
        &[
            "policy p { make(a) parallel { { pass() use(a) } { undo(a) } } }",
            "policy p { parallel { { if f(a) { pass() use(a) } } { shake(a) } } }",
            "policy p { parallel { { make(a) use(a) } { try { undo(a) } catch any { } } } }",
        ],
    );
}

#[test]
fn fault_condition_that_stays_unknown() {
    left_to_a_guard(
        "avoid",
        &[
            "policy p { if f(a) { pass() } else { avoid(a) } }",
            "policy p { if f(a) and g(a) { pass() } else { avoid(a) } }",
            "policy p { try { repeat 2 { pass() } until f(a) } catch exhausted { avoid(a) } }",
        ],
    );
    left_to_a_guard("use", &["policy p { try { wait until f(a) within 1 s } catch timeout { } use(a) }"]);
}

#[test]
fn fault_restart_with_half_done_effects() {
    let domain = "
action turn_over(o: Object)
    needs f(o)
    makes not f(o), g(o)
    fails slipped
    uses base
";
    // The body begins again where the first round has left it.
    for policy in [
        "initially f(a)\npolicy p { monitor when g(a) then restart at most 1 \
         during { use(a) turn_over(a) wave() } }",
        "initially f(a), not g(a)\npolicy p { monitor when holding(any) then restart at most 1 \
         during { turn_over(a) wave() } }",
        "initially f(a)\npolicy p { turn_over(a) retry 1 }",
        "initially f(a)\npolicy p { repeat 2 { turn_over(a) } }",
        "initially f(a)\npolicy p { try { turn_over(a) } catch slipped { turn_over(a) } }",
    ] {
        let policy = format!("{domain}{policy}");
        let is_refused = session_codes(None, &format!("{DOMAIN}{policy}"))
            .iter()
            .any(|code| *code == "M0501" || *code == "M0506");
        assert!(is_refused || verdicts("turn_over", &policy).contains(&Verdict::Deferred), "{policy}");
    }
}
