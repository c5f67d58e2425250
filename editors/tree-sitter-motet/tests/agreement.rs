//! The grammar of the editors against the one of the compiler, on all texts of the repository and on texts
//! that are broken in many ways; and the generated files against their source.

#![allow(
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::string_slice,
    clippy::unwrap_used,
    reason = "a test fails by panicking"
)]

use std::fs;
use std::path::{Path, PathBuf};

use motet_syntax::{FileId, Severity, Source};
use tree_sitter::{Language, Parser, Query};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn parser() -> Parser {
    let mut parser = Parser::new();
    parser.set_language(&Language::new(tree_sitter_motet::LANGUAGE)).unwrap();
    parser
}

/// Returns whether the compiler's grammar accepts a text; what stages behind the grammar say does not count.
fn is_accepted(text: &str) -> bool {
    let parsed = motet_syntax::read(&Source::new("text", text), FileId(0));
    parsed.diagnostics.iter().all(|found| found.severity != Severity::Error)
}

/// First place where the editors' grammar does not accept a text.
fn error(parser: &mut Parser, text: &str) -> Option<String> {
    let tree = parser.parse(text, None).unwrap();
    let mut found = None;
    let mut cursor = tree.walk();
    loop {
        let node = cursor.node();
        if found.is_none() && (node.is_error() || node.is_missing()) {
            let place = node.start_position();
            found = Some(format!("{}:{}", place.row + 1, place.column + 1));
        }
        if node.has_error() && cursor.goto_first_child() || cursor.goto_next_sibling() {
            continue;
        }
        while !cursor.goto_next_sibling() {
            if !cursor.goto_parent() {
                return found;
            }
        }
    }
}

/// Texts of the repository: files of the language, and code blocks of pages.
fn texts() -> Vec<(String, String)> {
    let mut texts = Vec::new();
    let mut folders: Vec<PathBuf> =
        ["examples", "stdlib/motet", "robots/models", "compiler/codes", "docs", "tests"]
            .map(|folder| root().join(folder))
            .into();
    while let Some(folder) = folders.pop() {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        let mut entries: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        for path in entries {
            let name = path.strip_prefix(root()).unwrap().display().to_string();
            match path.extension().and_then(|extension| extension.to_str()) {
                _ if path.is_dir() => folders.push(path),
                Some("motet") => texts.push((name, fs::read_to_string(&path).unwrap())),
                Some("md") => {
                    let page = fs::read_to_string(&path).unwrap();
                    let blocks = page.split("```").skip(1).step_by(2).enumerate();
                    texts.extend(blocks.filter_map(|(index, block)| {
                        let code = block.strip_prefix("motet")?;
                        let (_, code) = code.split_once('\n')?;
                        Some((format!("{name}#{index}"), code.to_owned()))
                    }));
                }
                _ => {}
            }
        }
    }
    texts
}

/// Versions of a text with one token left out, doubled, or replaced by another.
fn variants(text: &str) -> Vec<String> {
    use motet_syntax::text::lexer::tokens;
    let all: Vec<_> = tokens(text, 0).collect();
    let mut variants = Vec::new();
    for (index, token) in all.iter().enumerate() {
        let (before, after) = (&text[..token.start], &text[token.end()..]);
        variants.push(format!("{before}{after}"));
        variants.push(format!("{before}{} {}{after}", token.text, token.text));
        let other = all[(index * 7 + 3) % all.len()].text;
        variants.push(format!("{before}{other}{after}"));
    }
    variants
}

#[test]
fn all_texts_that_the_compiler_accepts_have_no_error() {
    let mut parser = parser();
    let texts = texts();
    let (mut accepted, mut wrong) = (0, Vec::new());
    for (name, text) in &texts {
        if is_accepted(text) {
            accepted += 1;
            wrong.extend(error(&mut parser, text).map(|place| format!("{name} at {place}")));
        }
    }
    assert_eq!(wrong, [""; 0], "{accepted} of {} texts are accepted", texts.len());
    assert!(accepted > 300, "{accepted} of {}", texts.len());
}

#[test]
fn broken_texts_are_judged_alike() {
    let mut parser = parser();
    let (mut both, mut neither, mut only_compiler, mut only_editors) = (0, 0, Vec::new(), Vec::new());
    for (name, text) in texts().iter().filter(|(name, _)| name.starts_with("examples/")) {
        for variant in variants(text) {
            // Of prose with a policy in it, the compiler reads the policy alone.
            let parsed = motet_syntax::read(&Source::new("text", variant.as_str()), FileId(0));
            if parsed.diagnostics.iter().any(|found| found.code.0 == "M0116") {
                continue;
            }
            match (is_accepted(&variant), error(&mut parser, &variant)) {
                (true, None) => both += 1,
                (false, Some(_)) => neither += 1,
                (true, Some(place)) => only_compiler.push(format!("{name} at {place}:\n{variant}")),
                (false, None) => only_editors.push(format!("{name}:\n{variant}")),
            }
        }
    }
    let all = both + neither + only_compiler.len() + only_editors.len();
    let counts = format!(
        "both {both}, neither {neither}, the compiler alone {}, the editors alone {}",
        only_compiler.len(),
        only_editors.len()
    );
    assert!(only_compiler.is_empty(), "{counts}\n{}", only_compiler[0]);
    // What the compiler says beyond its grammar: forms of older languages, empty blocks, bounds.
    assert!(only_editors.len() * 100 <= all, "{counts}\n{}", only_editors.first().unwrap());
    assert!(all > 3000, "{counts}");
}

#[test]
fn queries_fit_the_grammar() {
    let language = Language::new(tree_sitter_motet::LANGUAGE);
    for query in [
        tree_sitter_motet::HIGHLIGHTS_QUERY,
        tree_sitter_motet::FOLDS_QUERY,
        tree_sitter_motet::INDENTS_QUERY,
    ] {
        Query::new(&language, query).unwrap();
    }
}

#[test]
fn generated_parser_is_current() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let json = fs::read_to_string(folder.join("src/grammar.json")).unwrap();
    let optimizations = tree_sitter_generate::OptLevel::default();
    let (_, parser) = tree_sitter_generate::generate_parser_for_grammar(
        &json,
        Some((0, 1, 0)),
        optimizations,
        &mut Vec::new(),
    )
    .unwrap();
    let written = fs::read_to_string(folder.join("src/parser.c")).unwrap();
    assert!(parser == written, "src/parser.c is not what src/grammar.json gives: run `tree-sitter generate`");
}

#[test]
fn words_of_the_grammar_are_those_of_the_compiler() {
    let source = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("grammar.js")).unwrap();
    let (_, list) = source.split_once("const RESERVED = [").unwrap();
    let (list, _) = list.split_once(']').unwrap();
    let mut words: Vec<&str> = list.split('\'').skip(1).step_by(2).collect();
    let mut reserved = motet_syntax::words::RESERVED.to_vec();
    words.sort_unstable();
    reserved.sort_unstable();
    assert_eq!(words, reserved);
}
