//! Notations of models that the declarations show the meaning of: read with a note, and written by its fix.

use motet_compiler::Session;
use motet_compiler::fix::{FixLimits, fix};
use motet_syntax::ast::Policy;
use motet_syntax::{Diagnostic, FileId, Severity, Source, Sources, read};
use motet_tests::setup;

const FILE: FileId = FileId(9);

fn session() -> Session {
    let (robot, scene) = (setup::robot("hsr"), setup::scene("kitchen"));
    setup::session(Some(&robot), Some(&scene), &mut Sources::default()).0
}

fn document(steps: &str) -> String {
    format!(r#"{{"motet": 1, "policy": "p", "robot": "hsr", "steps": [{steps}]}}"#)
}

fn findings(session: &Session, document: &str) -> Vec<Diagnostic> {
    session.check(&read(&Source::new("p.json", document), FILE))
}

fn policy(document: &str) -> Policy {
    read(&Source::new("p.json", document), FILE).file.policies().next().unwrap().clone()
}

fn said(findings: &[Diagnostic], severity: Severity) -> Vec<&str> {
    findings.iter().filter(|said| said.severity == severity).map(|said| said.message.as_str()).collect()
}

/// Steps in another notation have no error; the notes say how they are read, and their fixes write the form.
#[track_caller]
fn check(session: &Session, steps: &str, form: &str, notes: &[&str]) {
    let (steps, form) = (document(steps), document(form));
    let found = findings(session, &steps);
    assert_eq!(said(&found, Severity::Error), [""; 0], "{steps}");
    assert_eq!(said(&found, Severity::Note), notes, "{steps}");
    let fixed = fix(session, &Source::new("p.json", steps.as_str()), FILE, FixLimits::safe(10));
    assert!(policy(&fixed.text) == policy(&form), "{}\n{form}", fixed.text);
    assert_eq!(said(&fixed.diagnostics, Severity::Note), [""; 0], "{}", fixed.text);
}

#[test]
fn notations_of_arguments_have_one_reading() {
    let session = session();
    let go = r#"{"do": "go", "to": "kitchen_table"}"#;
    let check = |steps: &str, form: &str, notes: &[&str]| check(&session, steps, form, notes);
    check(r#"{"do": "go", "args": ["kitchen_table"]}"#, go, &[r#"`"args": […]` is read as `"to": …`"#]);
    check(r#"{"do": "go", "to": ["kitchen_table"]}"#, go, &["a list of one is read as its value"]);
    check(r#"{"do": "go", "target": "kitchen_table"}"#, go, &["the key `target` is read as `to`"]);
    let placed = r#"{"do": "go", "arg1": "kitchen_table"}"#;
    check(r#"{"go": "kitchen_table"}"#, placed, &[r#"`{"go": …}` is read as `{"do": …}`"#]);
    let held =
        format!(r#"{go}, {{"do": "inspect", "what": "mug_1"}}, {{"do": "pick", "object": "mug_1"}}, "#);
    let notes = [r#"`"arguments": […]` is read as `"object": …, "on": …`"#];
    check(
        &format!(r#"{held}{{"do": "place", "arguments": ["mug_1", "kitchen_table"]}}"#),
        &format!(r#"{held}{{"do": "place", "object": "mug_1", "on": "kitchen_table"}}"#),
        &notes,
    );
    check(
        &format!(r#"{held}{{"do": "place", "object": "mug_1", "in": "kitchen_table"}}"#),
        &format!(r#"{held}{{"do": "place", "object": "mug_1", "on": "kitchen_table"}}"#),
        &["the key `in` is read as `on`"],
    );
}

#[test]
fn notations_of_values_and_facts_have_one_reading() {
    let session = session();
    let look = r#"{"do": "go", "to": "kitchen_table"}, {"do": "detect_all", "what": "mug", "as": "xs"}, "#;
    let first = r#"{"get": "first", "of": "$xs"}"#;
    check(
        &session,
        &format!(r#"{look}{{"do": "inspect", "what": "first($xs)"}}"#),
        &format!(r#"{look}{{"do": "inspect", "what": {first}}}"#),
        &[r#"`"first($xs)"` is read as `{"get": "first", "of": "$xs"}`"#],
    );
    check(
        &session,
        r#"{"if": "not fridge_1.open", "then": [{"do": "home"}]}"#,
        r#"{"if": "not open(fridge_1)", "then": [{"do": "home"}]}"#,
        &["`fridge_1.open` is read as `open(fridge_1)`"],
    );
    check(
        &session,
        r#"{"if": {"not": {"field": "open", "of": "fridge_1"}}, "then": [{"do": "home"}]}"#,
        r#"{"if": {"not": "open(fridge_1)"}, "then": [{"do": "home"}]}"#,
        &["`fridge_1.open` is read as `open(fridge_1)`"],
    );
    // A text stays one.
    let told = findings(&session, &document(&format!(r#"{look}{{"do": "say", "text": "first($xs)"}}"#)));
    assert_eq!(said(&told, Severity::Note), [""; 0]);
}

/// A notation that could be read in several ways is an error: two keys for one parameter, too many values.
#[test]
fn notations_with_several_readings_are_errors() {
    let session = session();
    for steps in [
        r#"{"do": "go", "target": "sink", "location": "kitchen_table"}"#,
        r#"{"do": "go", "args": ["sink", "kitchen_table"]}"#,
        r#"{"do": "go", "to": ["sink", "kitchen_table"]}"#,
        r#"{"do": "go", "to": "sink", "args": ["kitchen_table"]}"#,
        r#"{"do": "search", "what": "mug", "around": ["kitchen"]}"#,
        r#"{"if": "fridge_1.colour", "then": [{"do": "home"}]}"#,
    ] {
        let found = findings(&session, &document(steps));
        assert!(!said(&found, Severity::Error).is_empty(), "{steps}");
    }
}

/// A room is no thing in it: its name becomes none of theirs.
#[test]
fn notations_of_a_room_become_nothing_in_it() {
    let steps = document(r#"{"do": "search", "what": "mug", "around": ["kitchen"]}"#);
    let fixed = fix(&session(), &Source::new("p.json", steps.as_str()), FILE, FixLimits::all(10));
    assert!(!fixed.text.contains("kitchen_table"), "{}", fixed.text);
}

/// A name that nothing binds is told once, also where a text says it, and its fix mends each use.
#[test]
fn notations_of_an_unbound_name_are_told_once() {
    let session = session();
    let uses = r#"{"do": "detect", "what": "red mug", "as": "mug"}, {"do": "inspect", "what": "$mgu"},
        {"do": "inspect", "what": "$mgu"}, {"do": "say", "text": "{mgu}"}"#;
    let found = findings(&session, &document(uses));
    assert_eq!(said(&found, Severity::Error), ["nothing is bound to `mgu` here"]);
    let uses = r#"{"do": "go", "to": "$it"}, {"do": "inspect", "what": "$it"}, {"do": "go", "to": "$them"}"#;
    let found = findings(&session, &document(uses));
    let told = ["nothing is bound to `it` here", "nothing is bound to `them` here"];
    assert_eq!(said(&found, Severity::Error), told);
}

/// All errors of a step are told, and a step of another shape keeps its number for those behind it.
#[test]
fn notations_leave_steps_their_numbers() {
    let session = session();
    let steps = r#"{"do": "home"}, {"foo": 1, "bar": 2}, {"do": "pick", "objct": "mug_1", "frm": "tpo"},
        {"if": "near(", "then": [{"huh": []}, {"do": "go", "to": "sinkk"}]}"#;
    let found = findings(&session, &document(steps));
    let at: Vec<(&str, &str)> = found
        .iter()
        .filter(|said| said.severity == Severity::Error)
        .map(|said| (said.path.as_str(), said.code.0))
        .collect();
    for place in
        ["/steps/1", "/steps/2/objct", "/steps/2/frm", "/steps/3/if", "/steps/3/then/0", "/steps/3/then/1/to"]
    {
        assert!(at.iter().any(|(path, _)| path.starts_with(place)), "{place}: {at:#?}");
    }
    assert!(at.iter().all(|(path, _)| !path.starts_with("/steps/0")), "{at:#?}");
}
