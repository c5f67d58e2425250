//! The literate specs under `spec/` run: each example gives the codes that stand behind its fence, and no
//! others.

use std::collections::BTreeSet;

use motet_compiler::Session;
use motet_syntax::{Source, Sources};

/// A fenced block: the words behind its opening fence, its text, and its line.
struct Fence {
    info: Vec<String>,
    text: String,
    line: usize,
}

fn fences(markdown: &str) -> Vec<Fence> {
    let mut found: Vec<Fence> = Vec::new();
    let mut inside = false;
    for (index, line) in markdown.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if inside => inside = false,
            Some(info) => {
                let info = info.split_whitespace().map(str::to_owned).collect();
                found.push(Fence { info, text: String::new(), line: index + 1 });
                inside = true;
            }
            None if inside => {
                if let Some(fence) = found.last_mut() {
                    fence.text.push_str(line);
                    fence.text.push('\n');
                }
            }
            None => {}
        }
    }
    found
}

fn named<'f>(fences: &'f [Fence], name: &'f str) -> impl Iterator<Item = &'f Fence> {
    fences.iter().filter(move |fence| fence.info.first().map(String::as_str) == Some(name))
}

/// Of the codes that an example gives, only those that `counts` are compared.
fn check(spec: &str, counts: impl Fn(&str) -> bool) {
    let fences = fences(spec);
    let prelude: String = named(&fences, "prelude").map(|fence| fence.text.as_str()).collect();
    let mut sources = Sources::default();
    let domain = Source::new("prelude.motet", prelude);
    let id = sources.add(domain.clone());
    let domain = motet_syntax::read(&domain, id);
    assert!(domain.diagnostics.is_empty(), "{:?}", domain.diagnostics);
    let session = Session::builder().domains(&[domain.file]).build(&mut sources);
    let said = session.input_diagnostics().to_vec();
    assert!(said.is_empty(), "{said:?}");
    let mut wrong = Vec::new();
    for fence in named(&fences, "motet") {
        let source = Source::new("example.motet", fence.text.as_str());
        let id = sources.add(source.clone());
        let said = session.check(&motet_syntax::read(&source, id));
        let codes = said.iter().map(|said| said.code.to_string());
        let found: BTreeSet<String> = codes.filter(|code| counts(code)).collect();
        let expected: BTreeSet<String> = fence.info.iter().skip(1).cloned().collect();
        if found != expected {
            let said: Vec<_> = said.iter().map(|said| format!("{} {}", said.code, said.message)).collect();
            wrong.push(format!("line {}: expected {expected:?}, found {said:#?}", fence.line));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Lints of intent have a spec of their own: elsewhere the examples need not make sense as a whole.
fn is_intent(code: &str) -> bool {
    ("M0905"..="M0912").contains(&code)
}

#[test]
fn spec_prover() {
    check(include_str!("../../spec/prover.md"), |code| !is_intent(code));
}

#[test]
fn spec_lints_of_intent() {
    check(include_str!("../../spec/intent.md"), is_intent);
}

#[test]
fn spec_values() {
    check(include_str!("../../spec/values.md"), |code| !is_intent(code));
}

#[test]
fn spec_scopes() {
    check(include_str!("../../spec/scopes.md"), |code| !is_intent(code));
}

#[test]
fn spec_keep() {
    check(include_str!("../../spec/keep.md"), |code| !is_intent(code));
}

#[test]
fn spec_places() {
    check(include_str!("../../spec/places.md"), |code| !is_intent(code));
}

#[test]
fn spec_failures() {
    check(include_str!("../../spec/failures.md"), |code| !is_intent(code));
}

#[test]
fn spec_results() {
    check(include_str!("../../spec/results.md"), |code| !is_intent(code));
}
