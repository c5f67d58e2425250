//! Both forms of every example say the same: they give the same graph, and each can be turned into the other and back.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test fails by panicking")]

use std::path::{Path, PathBuf};

use motet_compiler::{Session, settle};
use motet_syntax::ast::{File, Item};
use motet_syntax::{Form, Source, Sources, print};
use motet_tests::setup;

const EXAMPLES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples");

/// The examples in text, with the robot and the scene that their first lines name.
fn examples() -> Vec<(PathBuf, String, String)> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(EXAMPLES).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "motet") {
            let text = std::fs::read_to_string(&path).unwrap();
            let (_, rest) = text.split_once("Robot ").unwrap();
            let (robot, rest) = rest.split_once(", scene ").unwrap();
            let (scene, _) = rest.split_once('.').unwrap();
            found.push((path, robot.to_owned(), scene.to_owned()));
        }
    }
    found.sort();
    assert!(found.len() >= 8, "there are {} examples", found.len());
    found
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap()
}

/// The graph of a document, as text.
fn graph(session: &Session, text: &str) -> String {
    let mut sources = Sources::default();
    let source = Source::new("example", text);
    let id = sources.add(source.clone());
    let compiled = session.compile(&motet_syntax::read(&source, id), None);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{text}\n{:#?}", compiled.diagnostics));
    motet_graph::encode(&graph)
}

/// The document in the other form, settled for it.
fn turned(session: &Session, text: &str, form: Form) -> String {
    let mut sources = Sources::default();
    let source = Source::new("example", text);
    let id = sources.add(source.clone());
    let File { mut items } = motet_syntax::read(&source, id).file;
    for item in &mut items {
        if let Item::Policy(policy) = item {
            settle(policy, session.library(), form);
        }
    }
    let file = File { items };
    match form {
        Form::Text => print::text(&file),
        Form::Json => file.policies().map(print::policy_json).collect(),
    }
}

#[test]
fn both_forms_of_an_example_are_one_policy() {
    for (path, robot, scene) in examples() {
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let mut sources = Sources::default();
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut sources);
        let (text, json) = (read(&path), read(&path.with_extension("json")));
        let expected = graph(&session, &text);
        assert_eq!(graph(&session, &json), expected, "{}", path.display());
        let as_json = turned(&session, &text, Form::Json);
        assert_eq!(as_json, json, "{}: the JSON form is that of the text", path.display());
        let back = turned(&session, &as_json, Form::Text);
        assert_eq!(graph(&session, &back), expected, "{}: there and back", path.display());
        assert_eq!(turned(&session, &back, Form::Json), json, "{}: there, back, and there", path.display());
    }
}
