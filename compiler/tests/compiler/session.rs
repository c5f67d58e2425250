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
        assert_eq!(policy.graph, compiled.graph);
        assert_eq!(policy.skipped_motions, compiled.skipped_motions);
    }
    assert!(check.policies[0].graph.is_some() && check.policies[1].graph.is_none());
}

#[test]
fn check_document_refuses_all_policies_of_a_broken_document() {
    let check = session().check_document(&read("kind Mug: Nothing\npolicy greet { say(\"hello\") }\n"));
    assert!(check.diagnostics.iter().any(|found| found.severity == Severity::Error));
    assert_eq!(check.policies[0].graph, None);
}
