//! Both forms of every example say the same: they give the same graph, and each can be turned into the
//! other and back.

use motet_compiler::{Session, make_explicit};
use motet_syntax::ast::{File, Item};
use motet_syntax::{Source, Sources, Syntax, print};
use motet_tests::examples::{examples, read};
use motet_tests::setup;

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
fn turned(session: &Session, text: &str, form: Syntax) -> String {
    let mut sources = Sources::default();
    let source = Source::new("example", text);
    let id = sources.add(source.clone());
    let File { mut items } = motet_syntax::read(&source, id).file;
    for item in &mut items {
        if let Item::Policy(policy) = item {
            make_explicit(policy, session.library(), form);
        }
    }
    let file = File { items };
    match form {
        Syntax::Text => print::text(&file),
        Syntax::Json => file.policies().map(print::policy_json).collect(),
    }
}

#[test]
fn syntax_both_forms_of_an_example_are_one_policy() {
    for (path, robot, scene) in examples() {
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let mut sources = Sources::default();
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut sources);
        let (text, json) = (read(&path), read(&path.with_extension("json")));
        let expected = graph(&session, &text);
        assert_eq!(graph(&session, &json), expected, "{}", path.display());
        let as_json = turned(&session, &text, Syntax::Json);
        assert_eq!(as_json, json, "{}: the JSON form is that of the text", path.display());
        let back = turned(&session, &as_json, Syntax::Text);
        assert_eq!(graph(&session, &back), expected, "{}: there and back", path.display());
        assert_eq!(turned(&session, &back, Syntax::Json), json, "{}: there, back, and there", path.display());
    }
}
