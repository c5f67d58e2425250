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

/// Manner, deadline and retries stand behind a call in any order; the printer has one.
#[test]
fn manners_stand_behind_calls() {
    let document = r"policy p {
    go(a) slowly within 9 s retry 1
    let m = pick(b) retry 1 gently within 9 s
    go(c) within 9 s at 30 % retry 1
    slowly(d)
    gently (d)
    at(robot, d)
}
";
    let printed = r"policy p {
    go(a) slowly within 9 s retry 1
    let m = pick(b) gently within 9 s retry 1
    go(c) at 30 % within 9 s retry 1
    slowly(d)
    gently(d)
    at(robot, d)
}
";
    let parsed = parse(document);
    assert_eq!(parsed.diagnostics, []);
    assert_eq!(motet_syntax::print::text(&parsed.file), printed);
    let [Item::Policy(policy)] = parsed.file.items.as_slice() else { panic!("{:?}", parsed.file) };
    let place = |index: usize| match &policy.body.steps[index].kind {
        StepKind::Do(step) => step.manner.as_ref().map(|manner| {
            let span = manner.span();
            &document[span.start as usize..span.end as usize]
        }),
        _ => None,
    };
    let places: Vec<_> = (0..6).map(place).collect();
    assert_eq!(places, [Some("slowly"), Some("gently"), Some("at 30 %"), None, None, None]);
    let json = r#"{"motet": 1, "policy": "p", "steps": [
        {"do": "go", "to": "a", "manner": "slowly"}, {"do": "go", "to": "a", "manner": "gently"},
        {"do": "go", "to": "a", "manner": "30 %"}, {"do": "go", "to": "a", "manner": 0.3},
        {"do": "go", "to": "a", "manner": "at 30 %"}, {"do": "go", "to": "a", "manner": null}]}"#;
    let parsed = parse(json);
    assert_eq!(parsed.diagnostics, []);
    let text = motet_syntax::print::text(&parsed.file);
    let ends: Vec<_> = text.lines().filter_map(|line| line.split_once("a)")).map(|(_, end)| end).collect();
    assert_eq!(ends, [" slowly", " gently", " at 30 %", " at 0.3", " at 30 %", ""]);
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
