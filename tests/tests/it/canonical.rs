//! The canonical subset: a canonical line means what its policy means, and is a fixed point.

use motet_compiler::Session;
use motet_decode::{Grammar, Modifiers, Subset, canonical};
use motet_syntax::ast::Policy;
use motet_syntax::{Source, Sources, Syntax};
use motet_tests::examples::{examples, read};
use motet_tests::setup;

/// The one policy of a text that must be right.
fn parse(text: &str) -> Policy {
    let parsed = motet_syntax::read(&Source::new("test", text), motet_syntax::FileId(0));
    assert!(parsed.diagnostics.is_empty(), "{text}\n{:#?}", parsed.diagnostics);
    parsed.file.runnable().next().unwrap().clone()
}

/// How many nodes the graph of a document has, and how long it takes.
fn outline(session: &Session, text: &str) -> (usize, String) {
    let mut sources = Sources::default();
    let source = Source::new("test", text);
    let id = sources.add(source.clone());
    let compiled = session.compile(&motet_syntax::read(&source, id), None);
    let graph = compiled.graph.unwrap_or_else(|| panic!("{text}\n{:#?}", compiled.diagnostics));
    (graph.nodes.len(), format!("{:?}", graph.duration))
}

/// The canonical line, which must be that of what it reads as.
fn line(policy: &Policy, grammar: &Grammar) -> String {
    let line =
        canonical(policy, grammar).unwrap_or_else(|outside| panic!("{outside} at {}", outside.span.start));
    let again = canonical(&parse(&line), grammar).unwrap_or_else(|outside| panic!("{outside}\n{line}"));
    assert_eq!(line, again);
    line
}

#[test]
fn example_means_the_same_in_both_canonical_forms() {
    for (path, robot, scene) in examples() {
        let (robot, scene) = (setup::robot(&robot), setup::scene(&scene));
        let (session, _) = setup::session(Some(&robot), Some(&scene), &mut Sources::default());
        let text = read(&path);
        let json = read(&path.with_extension("json"));
        for syntax in [Syntax::Json, Syntax::Text] {
            let subset = Subset { syntax, modifiers: Modifiers::Written, ..Subset::default() };
            let grammar = Grammar::new(&session.signatures(), subset);
            let lines = [&text, &json].map(|document| line(&parse(document), &grammar));
            assert_eq!(lines[0], lines[1], "{path:?}");
            assert_eq!(outline(&session, &text), outline(&session, &lines[0]), "{path:?}");
        }
    }
}
