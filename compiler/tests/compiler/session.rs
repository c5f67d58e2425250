//! Sessions and checks of documents. Guards `src/session.rs` and `src/document.rs`.

use motet_compiler::{Session, WorldTracker};
use motet_syntax::{Severity, Sources};

use crate::read;

fn session() -> Session {
    Session::builder().build(&mut Sources::default())
}

#[test]
fn session_is_send_and_sync() {
    fn check<T: Send + Sync>() {}
    check::<Session>();
    fn check_send<T: Send>() {}
    check_send::<WorldTracker>();
}

#[test]
fn check_document_agrees_with_compile() {
    let session = session();
    let document = read(
        "policy first { say(\"one\") }\n\
         policy second { sya(\"two\") }\n\
         policy third(text: Text) { say(text) }\n",
    );
    let check = session.check_document(&document);
    assert_eq!(check.diagnostics, session.check(&document));
    let names: Vec<_> = check.policies.iter().map(|policy| policy.name.as_str()).collect();
    assert_eq!(names, ["first", "second"]);
    for policy in &check.policies {
        let compiled = session.compile(&document, Some(&policy.name));
        assert_eq!(policy.passes, compiled.graph.is_some());
        assert_eq!(policy.skipped_motions, compiled.skipped_motions);
        let deferred = compiled.graph.as_ref().map_or(0, motet_graph::Graph::deferred_motions);
        assert_eq!(policy.deferred_motions, deferred);
    }
    assert!(check.policies[0].passes && !check.policies[1].passes);
}

#[test]
fn check_document_refuses_all_policies_of_a_broken_document() {
    let check = session().check_document(&read("kind Mug: Nothing\npolicy greet { say(\"hello\") }\n"));
    assert!(check.diagnostics.iter().any(|found| found.severity == Severity::Error));
    assert!(!check.policies[0].passes);
}

fn found(document: &str) -> Vec<(&'static str, String)> {
    let document = read(document);
    let found = session().check_document(&document).diagnostics.into_iter();
    found.map(|found| (found.code.0, found.path)).collect()
}

/// What could not be read may have bound any name and changed any fact, and still has its number.
#[test]
fn check_document_goes_on_behind_a_step_that_cannot_be_read() {
    let json = r#"{"motet": 1, "policy": "p", "steps": [
        {"say": "a", "to": "b"},
        {"do": "pick", "object": "$cup"},
        {"foo": 1},
        {"do": "sya", "text": "hello"},
        {"repeat": 2, "steps": [{"bar": 2}, {"do": "say", "text": "{cup}", "volume": 3}]}
    ]}"#;
    let places = ["/steps/0", "/steps/2", "/steps/3/do", "/steps/4/steps/0", "/steps/4/steps/1/volume"];
    let paths: Vec<_> = found(json).into_iter().map(|(_, path)| path).collect();
    assert_eq!(paths, places);

    let text = "policy p {\n let cup = search(\n say(cup)\n pick(cup)\n sya(\"done\")\n}\n";
    let codes = found(text);
    assert_eq!(codes, [("M0201", "/steps/3/do".to_owned()), ("M0101", String::new())]);
}

#[test]
fn check_document_tells_one_mistake_once() {
    let text = "policy p {\n let cup = detct(\"cup\")\n pick(cup)\n place(cup)\n done\n}\n";
    let codes: Vec<_> = found(text).into_iter().map(|(code, _)| code).collect();
    assert_eq!(codes, ["M0201", "M0303"]);
    let text = "policy p {\n pick($cup)\n pick(mug_1)\n done\n}\n";
    let codes: Vec<_> = found(text).into_iter().map(|(code, _)| code).collect();
    assert_eq!(codes, ["M0203", "M0202"]);
}
