//! The JSON surface: its schema, its canonical layout, pointers into it, and the machine-readable
//! diagnostics.

use motet_arbitrary::syntax as arbitrary;
use motet_syntax::ast::{Item, Policy};
use motet_syntax::{FileId, Source, Sources, Span, pointer, print, read, render};
use proptest::prelude::*;

fn policy(document: &str) -> Policy {
    let parsed = read(&Source::new("test", document), FileId(0));
    assert_eq!(parsed.diagnostics, [], "{document}");
    let Some(Item::Policy(policy)) = parsed.file.items.into_iter().next() else { panic!("{document}") };
    policy
}

/// Pointer of the text `needle` in a document.
fn pointer(document: &str, needle: &str) -> String {
    let start = document.find(needle).unwrap();
    let parameter = |callee: &str, at: usize| (callee == "say" && at == 0).then(|| "text".into());
    pointer::pointer_to(&policy(document), Span::new(FileId(0), start, start + needle.len()), &parameter)
}

const TEXT: &str = r#"
policy p achieves near(to: user) {
    try {
        pick(object: mug, from: `1`) within 20 s
        home()
    } catch slipped {
        say("dropped it")
    }
    monitor {
        when distance(to: user) < 0.5 m and not open(container: drawer) for 1 s
            then resume at most 3 { go(to: sink) }
        when battery() < 10 % then fail "low"
    } during {
        parallel { { done } { go(to: door) wait until lit within 9 s } }
    }
    repeat 3 { replan "again" } until holding(object: any)
    if x { } else if y { each c in cups at most 7 { go(to: c) } }
}
"#;

#[test]
fn pointer_names_each_place() {
    for (needle, expected) in [
        ("user", "/achieves/to"),
        ("pick(object: mug, from: `1`)", "/steps/0/try/0"),
        ("mug", "/steps/0/try/0/object"),
        ("`1`", "/steps/0/try/0/from"),
        ("20 s", "/steps/0/try/0/within"),
        ("home()", "/steps/0/try/1"),
        ("slipped", "/steps/0/catch/0"),
        ("dropped it", "/steps/0/catch/0/steps/0/text"),
        ("0.5 m", "/steps/1/monitor/0/when/all/0/less/1"),
        ("distance", "/steps/1/monitor/0/when/all/0/less/0"),
        ("drawer", "/steps/1/monitor/0/when/all/1/not/container"),
        ("1 s", "/steps/1/monitor/0/for"),
        ("sink", "/steps/1/monitor/0/then/steps/0/to"),
        ("\"low\"", "/steps/1/monitor/1/then/why"),
        ("{ done }", "/steps/1/during/0"),
        ("door", "/steps/1/during/0/parallel/1/0/to"),
        ("lit", "/steps/1/during/0/parallel/1/1/wait"),
        ("again", "/steps/2/steps/0/why"),
        ("any", "/steps/2/until/object"),
        ("7", "/steps/3/else/0/then/0/at_most"),
        ("go(to: c)", "/steps/3/else/0/then/0/steps/0"),
        ("policy", ""),
    ] {
        assert_eq!(pointer(TEXT, needle), expected, "{needle}");
    }
}

#[test]
fn pointer_leads_to_the_same_place_in_json() {
    let json = print::policy_json(&policy(TEXT));
    let value: serde_json::Value = serde_json::from_str(&json).unwrap();
    for (needle, key) in [("door", "to"), ("\"low\"", "why"), ("7", "at_most"), ("mug", "object")] {
        let pointer = pointer(TEXT, needle);
        assert!(pointer.ends_with(key));
        assert!(value.pointer(&pointer).is_some(), "{pointer} in {json}");
    }
}

#[test]
fn policy_json_is_laid_out_for_people() {
    insta::assert_snapshot!(print::policy_json(&policy(TEXT)));
}

#[test]
fn schemas_are_as_recorded() {
    insta::assert_snapshot!(serde_json::to_string_pretty(&motet_syntax::json::policy_schema()).unwrap());
    insta::assert_snapshot!(
        serde_json::to_string_pretty(&schemars::schema_for!(render::DiagnosticRecord)).unwrap()
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn policy_json_fits_the_schema(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let schema = serde_json::to_value(motet_syntax::json::policy_schema()).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        let json = print::policy_json(&arbitrary::json_policy(&bytes));
        let value: serde_json::Value = serde_json::from_str(&json).unwrap();
        let errors: Vec<String> = validator.iter_errors(&value).map(|error| error.to_string()).collect();
        prop_assert!(errors.is_empty(), "{errors:?} {json}");
    }
}

#[test]
fn render_writes_diagnostics_for_tools() {
    let mut sources = Sources::default();
    let source = Source::new(
        "a,b:c%.json",
        "{\"motet\": 1, \"policy\": \"é\",\n \"steps\": [], \"motet\": 2, \"stps\": 1}",
    );
    let file = sources.add(source.clone());
    let found = read(&source, file).diagnostics;
    insta::assert_snapshot!(render::json(&found, &sources));
    insta::assert_snapshot!(render::github(&found, &sources));
    insta::assert_snapshot!(
        render::sarif(&found, &sources, &|_| None).replace(env!("CARGO_PKG_VERSION"), "VERSION")
    );
    for line in render::json(&found, &sources).lines() {
        serde_json::from_str::<render::DiagnosticRecord>(line).unwrap();
    }
}
