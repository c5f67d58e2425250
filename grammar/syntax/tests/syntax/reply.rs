//! Documents in a model's reply.

use motet_syntax::ast::Item;
use motet_syntax::{FileId, Severity, Source, decode, read};

/// The name of the policy that is found, and every diagnostic as `code "text"`.
fn check(reply: &str, name: Option<&str>, expected: &[&str]) {
    let source = Source::new("reply", reply);
    let parsed = read(&source, FileId(0));
    let found: Vec<String> =
        parsed.diagnostics.iter().map(|d| format!("{} {}", d.code, source.slice(d.span))).collect();
    assert_eq!(found, expected, "{reply}");
    let policy = parsed.file.items.iter().find_map(|item| match item {
        Item::Policy(policy) => Some(policy),
        _ => None,
    });
    assert_eq!(policy.map(|policy| policy.name.text.as_str()), name, "{reply}");
    if let Some(policy) = policy {
        let span = policy.name.span;
        assert!(source.slice(span).contains(policy.name.text.as_str()), "the span of the name is right");
    }
}

const JSON: &str = r#"{"motet": 1, "policy": "p", "steps": [{"do": "go", "to": "a"}]}"#;
const TEXT: &str = "policy p { go(a) }";

#[test]
fn reply_finds_a_fenced_document() {
    check(&format!("```json\n{JSON}\n```"), Some("p"), &[]);
    check(&format!("```\n{TEXT}\n```\n"), Some("p"), &[]);
    check(
        &format!("Sure — here it is:\n\n```motet\n{TEXT}\n```\nHope that helps.\nBye."),
        Some("p"),
        &["M0116 Sure — here it is:", "M0116 Hope that helps."],
    );
    check(
        &format!("Scene:\n```json\n{{\"a\": 1}}\n```\nPolicy:\n~~~JSON\n{JSON}\n~~~"),
        Some("p"),
        &["M0116 Scene:"],
    );
    check(&format!("```json\n{JSON}"), Some("p"), &[]);
}

#[test]
fn reply_finds_a_bare_document_in_prose() {
    check(
        &format!("The plan {{as asked}} is {JSON}. Good luck!"),
        Some("p"),
        &["M0116 The plan {as asked} is", "M0116 . Good luck!"],
    );
    check(&format!("{JSON}\n\nThis drives to a."), Some("p"), &["M0116 This drives to a."]);
    check(&format!("{TEXT}\n\nThis drives to a."), Some("p"), &["M0116 This drives to a."]);
    check(
        &format!("Here you go:\n{TEXT}\nIt drives."),
        Some("p"),
        &["M0116 Here you go:", "M0116 It drives."],
    );
}

#[test]
fn reply_finds_steps_without_a_policy() {
    let steps = r#"[{"do": "go", "to": "a"}, {"do": "home"}]"#;
    let parsed = |reply: &str| {
        let parsed = read(&Source::new("reply", reply), FileId(0));
        let codes: Vec<_> = parsed.diagnostics.iter().map(|said| said.code.0).collect();
        let steps = parsed.file.policies().map(|policy| policy.body.steps.len()).sum::<usize>();
        (codes.join(" "), steps)
    };
    assert_eq!(parsed(steps), ("M0122".into(), 2));
    assert_eq!(parsed(&format!("{steps}\nThis drives to a.")), ("M0122 M0116".into(), 2));
    assert_eq!(
        parsed(&format!("Here is [1] the plan: {steps}. Good luck!")),
        ("M0116 M0122 M0116".into(), 2)
    );
    assert_eq!(parsed(&format!("So:\n```json\n{steps}\n```\n")), ("M0116 M0122".into(), 2));
    let plan = r#"{"plan": [{"action": "home"}]}"#;
    assert_eq!(parsed(&format!("The plan is {plan}.")), ("M0116 M0122 M0122 M0122 M0116".into(), 1));
    // A policy comes before an object that only looks like a step.
    assert_eq!(parsed(&format!("Not {{\"action\": \"go\"}} but {JSON}")), ("M0116".into(), 1));
    assert_eq!(parsed("[1] Here is what I think."), ("M0102".into(), 0));
}

#[test]
fn reply_accepts_fences_within_lines() {
    check(&format!("First ```json\n{JSON}\n```"), Some("p"), &["M0116 First"]);
    check(
        &format!("First ```json\n{{\"a\": 1}}\n```\nand then\n```motet\n{TEXT}\n```"),
        Some("p"),
        &["M0116 First ```json"],
    );
    check(&format!("```json\n{JSON}```\nDone."), Some("p"), &["M0116 Done."]);
}

#[test]
fn reply_ignores_braces_of_prose() {
    check(&format!("{TEXT}\nIt says }} and {{ x."), Some("p"), &["M0116 It says } and { x."]);
    check(&format!("{TEXT}\nIt drives (see {{x}})."), Some("p"), &["M0116 It drives (see {x})."]);
    check(
        &format!("Here you go:\n{TEXT}\nNote }} here."),
        Some("p"),
        &["M0116 Here you go:", "M0116 Note } here."],
    );
    // A misspelt declaration is not prose.
    check(&format!("{TEXT}\npolcy q {{ go(b) }}"), None, &["M0101 polcy"]);
}

#[test]
fn reply_reports_a_second_policy() {
    let reply = format!("```motet\n{TEXT}\n```\nor\n```motet\npolicy q {{ go(b) }}\n```");
    check(&reply, Some("p"), &["M0116 or", "M0116 policy q { go(b) }"]);
}

#[test]
fn reply_does_not_take_broken_documents_for_prose() {
    check(&format!("{JSON} {JSON}"), None, &["M0102 {"]);
    check("```json\n{\"motet\": 1, \"policy\": \"p\", \"steps\": [{\"do\": \"go\"", None, &["M0102 "]);
    check(
        "```json\n{\"motet\": 1, \"policy\": \"p\", \"steps\": [\n```\nmore",
        None,
        &["M0102 ", "M0116 more"],
    );
    check("polcy p { go(a) }", None, &["M0101 polcy"]);
    check("I am sorry, I cannot do that.", None, &["M0119 I am sorry, I cannot do that."]);
    check("", None, &["M0115 "]);
    check("// only a comment", None, &["M0115 "]);
    check("\u{feff}policy p { }", Some("p"), &[]);
}

#[test]
fn decode_reads_utf8_and_byte_order_marks() {
    assert_eq!(decode(b"\xef\xbb\xbf{}", FileId(0)).unwrap(), "   {}");
    let error = decode(b"policy \xff", FileId(0)).unwrap_err();
    assert_eq!((error.code.0, error.span.start, error.severity), ("M0114", 7, Severity::Error));
    assert_eq!(error.message, "byte 7 (0xff) is not UTF-8");
    assert_eq!(decode(&vec![b' '; 64 << 20], FileId(0)).unwrap_err().code.0, "M0112");
}
