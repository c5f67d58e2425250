//! Reading policies of both syntaxes.

use motet_syntax::ast::{Item, StepKind};
use motet_syntax::{FileId, Parsed, Source, Syntax, read};

const TEXT: &str = r#"
/// Brings a mug.
policy fetch_mug for hsr {
    go(kitchen_table)
    let mug = detect("red mug")
    try {
        pick(mug) within 20 s retry 1
    } catch unreachable {
        let answer = ask("I cannot reach the mug. What should I do?")
        replan answer
    }
    monitor {
        when distance(user) < 0.5 m for 200 ms then pause
        when not holding(mug) then replan "the mug was dropped"
    } during {
        go(user)
    }
    handover(mug, user)
    done
}
"#;

const JSON: &str = r#"{
  "motet": 1,
  "policy": "fetch_mug",
  "robot": "hsr",
  "steps": [
    {"do": "go", "to": "kitchen_table"},
    {"do": "detect", "what": "red mug", "as": "mug"},
    {"try": [{"do": "pick", "object": "$mug", "within": 20, "retry": 1}],
     "catch": [{"on": ["unreachable"], "steps": [
        {"do": "ask", "question": "I cannot reach the mug. What should I do?", "as": "answer"},
        {"end": "replan", "why": "$answer"}]}]},
    {"monitor": [
        {"when": {"less": [{"get": "distance", "to": "user"}, 0.5]}, "for": 0.2, "then": {"react": "pause"}},
        {"when": {"not": {"is": "holding", "object": "$mug"}},
         "then": {"end": "replan", "why": "the mug was dropped"}}],
     "during": [{"do": "go", "to": "user"}]},
    {"do": "handover", "object": "$mug", "to": "user"},
    {"end": "done"}
  ]
}"#;

fn parse(text: &str) -> Parsed {
    read(&Source::new("test", text), FileId(0))
}

#[test]
fn read_reads_both_syntaxes_alike() {
    for (document, form) in [(TEXT, Syntax::Text), (JSON, Syntax::Json)] {
        let parsed = parse(document);
        assert_eq!(parsed.diagnostics, []);
        assert_eq!(parsed.syntax, form);
        let [Item::Policy(policy)] = parsed.file.items.as_slice() else { panic!("{:?}", parsed.file) };
        assert_eq!((policy.name.text.as_str(), policy.body.steps.len()), ("fetch_mug", 6));
        let StepKind::Monitor { whens, .. } = &policy.body.steps[3].kind else { panic!("{policy:?}") };
        assert_eq!(whens.len(), 2);
    }
}

#[test]
fn read_reads_the_standard_library() {
    for name in ["world", "motion", "manipulation", "perception", "people", "policies"] {
        let path = format!("{}/../../stdlib/motet/{name}.motet", env!("CARGO_MANIFEST_DIR"));
        #[expect(clippy::disallowed_methods, reason = "a test of files")]
        let text = std::fs::read_to_string(&path).unwrap();
        let parsed = parse(&text);
        assert_eq!(parsed.diagnostics, [], "{name}");
        assert!(!parsed.file.items.is_empty());
    }
}
