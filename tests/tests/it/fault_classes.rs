//! Faults of behaviour trees, most of which their engines run without a word: each variant in the table is
//! refused or told by the check, or left to a guard that asks before the step.

use std::fmt::Write as _;

use motet_graph::{NodeKind, Verdict};
use motet_syntax::{FileId, Severity, Source, Sources};
use motet_tests::setup;

use crate::soundness::DOMAIN;

const TABLE: &str = include_str!("../../fault_classes.tsv");
/// Number of classes that the documents name.
const CLASSES: usize = 59;
/// Declarations beside those of the soundness tests.
const MORE: &str = "
action turn_over(o: Object)
    needs f(o)
    makes not f(o), g(o)
    fails slipped
    uses base
";

/// Result of checking and compiling a document.
struct Told {
    codes: Vec<(&'static str, Severity)>,
    /// Primitives of which a call keeps a guard.
    guarded: Vec<String>,
}

fn told(document: &str) -> Told {
    let deep = format!("{}pass(){}", "if f(a) { ".repeat(200), " }".repeat(200));
    let text = document.replace("\\n", "\n").replace("DEEP", &deep);
    let is_json = text.starts_with('{');
    let text = if is_json || text.is_empty() { text } else { format!("{DOMAIN}{MORE}{text}") };
    let source = Source::new(if is_json { "p.json" } else { "p.motet" }, text);
    let (session, _) = setup::session(None, None, &mut Sources::default());
    let parsed = motet_syntax::read(&source, FileId(99));
    let compiled = session.compile(&parsed, None);
    let checked = session.check(&parsed);
    let found = checked.iter().chain(&compiled.diagnostics);
    let codes = found.map(|found| (found.code.0, found.severity)).collect();
    let guarded = compiled.graph.map_or_else(Vec::new, |graph| {
        let calls = graph.nodes.iter().filter_map(|node| match &node.kind {
            NodeKind::Call(call) => Some(call),
            _ => None,
        });
        let kept = calls.filter(|call| call.needs.iter().any(|need| need.verdict == Verdict::Deferred));
        kept.map(|call| graph.primitives[call.primitive.index()].name.to_string()).collect()
    });
    Told { codes, guarded }
}

impl Told {
    fn is(&self, expected: &str) -> bool {
        let is_wrong = self.codes.iter().any(|(_, severity)| *severity == Severity::Error);
        let has = |wanted: &str, is_error: bool| {
            self.codes
                .iter()
                .any(|(code, severity)| *code == wanted && (*severity == Severity::Error) == is_error)
        };
        match expected.split_once(' ') {
            None if expected == "clean" => self.codes.is_empty(),
            None => has(expected, true),
            Some(("tells", code)) => has(code, false),
            Some(("guards", callee)) => !is_wrong && self.guarded.iter().any(|known| known == callee),
            Some(_) => panic!("`{expected}` says nothing of what is told"),
        }
    }
}

#[test]
fn fault_classes_are_told_in_each_variant() {
    let (mut wrong, mut classes) = (String::new(), Vec::new());
    for line in TABLE.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        let Some((expected, document)) = line.split_once('\t') else {
            let (number, _) = line.split_once(' ').unwrap();
            assert_eq!(number.parse(), Ok(classes.len() + 1), "{line}");
            classes.push((line, 0));
            continue;
        };
        let (class, variants) = classes.last_mut().unwrap();
        *variants += usize::from(expected != "clean");
        let told = told(document);
        if !told.is(expected) {
            let (codes, guarded) = (told.codes, told.guarded);
            let _ = writeln!(wrong, "{class}: {document}\n  not {expected}: {codes:?}, guards: {guarded:?}");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
    assert_eq!(classes.len(), CLASSES);
    assert!(classes.iter().all(|(_, variants)| *variants > 0), "{classes:?}");
}
