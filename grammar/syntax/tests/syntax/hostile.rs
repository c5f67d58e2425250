//! No input panics, overflows the stack or is misplaced: random bytes, mutated documents, documents at the
//! limits.

use motet_arbitrary::syntax as arbitrary;
use motet_syntax::ast::{Item, MAX_BYTES, MAX_NESTING, MAX_STEPS};
use motet_syntax::{FileId, Parsed, Source, Sources, decode, pointer, print, read, render};
use proptest::prelude::*;

/// Reads a text and does everything that can be done with what comes out.
fn torture(text: &str) -> Parsed {
    let mut sources = Sources::default();
    let source = Source::new("test", text);
    let file = sources.add(source.clone());
    let parsed = read(&source, file);
    for diagnostic in &parsed.diagnostics {
        let range = diagnostic.span.range();
        assert!(
            text.get(range.clone()).is_some(),
            "{} at {range:?} of {} bytes",
            diagnostic.code,
            text.len()
        );
        assert!(!diagnostic.message.is_empty());
    }
    let shown = parsed.diagnostics.get(..20).unwrap_or(&parsed.diagnostics);
    let _ = render::human(shown, &sources, render::ColorChoice::Off, 80);
    let _ = render::json(shown, &sources);
    let _ = render::github(shown, &sources);
    let _ = render::sarif(shown, &sources, &|_| None);
    for line in render::llm(shown, &sources).lines() {
        assert!(line.chars().count() <= render::MAX_CHARS, "{line}");
    }
    let _ = print::text(&parsed.file);
    for item in &parsed.file.items {
        if let Item::Policy(policy) = item {
            let _ = print::policy_json(policy);
            for diagnostic in shown {
                let _ = pointer::pointer_to(policy, diagnostic.span, &|_, _| None);
            }
        }
    }
    parsed
}

fn code(text: &str) -> &'static str {
    torture(text).diagnostics.first().map_or("", |diagnostic| diagnostic.code.0)
}

/// A text with pieces cut out, put in and doubled.
fn mutated(text: &str, edits: &[(u16, u8)]) -> String {
    const PIECES: &[&str] = &[
        "{",
        "}",
        "(",
        ")",
        "[",
        "]",
        "\"",
        "`",
        "\\",
        "$",
        "//",
        "///",
        "not ",
        "\u{0}",
        "é",
        "1e999",
        ",",
        ":",
        "..",
        "policy",
        "when",
        "for",
        "\n",
        "```",
        "-",
        "\u{feff}",
        "\"if\":1,",
        "null",
        "%",
    ];
    let mut characters: Vec<char> = text.chars().collect();
    for (at, what) in edits {
        let at = usize::from(*at) % (characters.len() + 1);
        match what % 4 {
            0 => drop(characters.drain(at..(at + usize::from(what / 4) % 7).min(characters.len()))),
            1 => characters.truncate(characters.len() - usize::from(what / 4).min(characters.len())),
            _ => {
                let piece = PIECES[usize::from(what / 4) % PIECES.len()];
                characters.splice(at..at, piece.chars());
            }
        }
    }
    characters.into_iter().collect()
}

/// A word of a random document.
const WORD: &str = "[a-z]{1,3}|[{}()\\[\\],:.=<>+*/-]|policy|not|\"x\"|[0-9]";

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn read_survives_random_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        if let Ok(text) = decode(&bytes, FileId(0)) {
            torture(&text);
        }
        torture(&String::from_utf8_lossy(&bytes));
    }

    #[test]
    fn read_survives_random_tokens(words in proptest::collection::vec(WORD, 0..60)) {
        torture(&words.join(" "));
        torture(&words.concat());
        torture(&format!("policy p {{ {} }}", words.join(" ")));
        torture(&format!("{{\"motet\": 1, \"policy\": \"p\", \"steps\": [{}]}}", words.join(" ")));
    }

    #[test]
    fn read_survives_mutated_documents(
        bytes in proptest::collection::vec(any::<u8>(), 0..200),
        edits in proptest::collection::vec(any::<(u16, u8)>(), 1..6),
    ) {
        torture(&mutated(&print::text(&arbitrary::file(&bytes)), &edits));
        let json = print::policy_json(&arbitrary::json_policy(&bytes));
        torture(&mutated(&json, &edits));
        torture(&mutated(&format!("Here:\n```json\n{json}```\nDone."), &edits));
    }
}

#[test]
fn read_limits_nesting_in_every_construct() {
    let many = 20_000;
    let text = |inside: &str| format!("policy p {{ {inside} }}");
    for (name, document) in [
        ("braces", text(&format!("{}{}", "sequence a { ".repeat(many), "}".repeat(many)))),
        ("open braces", format!("policy p {}", "{".repeat(many))),
        ("parentheses", text(&format!("wait until {}a{}", "(".repeat(many), ")".repeat(many)))),
        ("brackets", text(&format!("go({}{})", "[".repeat(many), "]".repeat(many)))),
        ("calls", text(&format!("go({}{})", "f(".repeat(many), ")".repeat(many)))),
        ("not", text(&format!("wait until {} a", "not ".repeat(many)))),
        ("sums", text(&format!("go({}1)", "1 + ".repeat(many)))),
        ("products", text(&format!("go({}1)", "1 * ".repeat(many)))),
        ("fields", text(&format!("go(a{})", ".b".repeat(many)))),
        ("else if", text(&format!("if a {{}} {}", "else if a {} ".repeat(many)))),
        ("types", format!("fluent f(a: {}a{})", "List<".repeat(many), ">".repeat(many))),
        ("JSON arrays", "[".repeat(many)),
        ("JSON objects", "{\"a\":".repeat(many)),
        (
            "JSON steps",
            format!(
                "{{\"motet\": 1, \"policy\": \"p\", \"steps\": {}",
                "[{\"sequence\":\"a\",\"steps\":".repeat(many)
            ),
        ),
        (
            "JSON conditions",
            json_step(&format!("{{\"wait\": {}true{}}}", "{\"not\":".repeat(100), "}".repeat(100))),
        ),
        ("JSON text conditions", json_step(&format!("{{\"wait\": \"{} a\"}}", "not ".repeat(many)))),
    ] {
        assert_eq!(code(&document), "M0111", "{name}");
    }
    for (name, document) in [
        ("unbalanced", "}".repeat(many)),
        ("wide conjunction", text(&format!("wait until a{}", " and a".repeat(many)))),
        ("wide comparison", text(&format!("wait until a{}", " < a".repeat(many)))),
        ("quotes", "\"".repeat(many)),
        ("back-quotes", "`".repeat(many)),
        ("fences", "```\n".repeat(many)),
        ("backslashes", format!("{{\"{}", "\\".repeat(many))),
        ("keys", format!("{{{}\"a\": 1}}", "\"a\": 1, ".repeat(20_000))),
    ] {
        let parsed = torture(&document);
        assert!(parsed.diagnostics.iter().all(|diagnostic| diagnostic.code.0 != "M0111"), "{name}");
    }
}

fn json_step(step: &str) -> String {
    format!("{{\"motet\": 1, \"policy\": \"p\", \"steps\": [{step}]}}")
}

/// Documents as deep as they may be are read, printed and read again, on the stack of a test thread.
#[test]
fn read_accepts_the_deepest_documents() {
    let blocks = MAX_NESTING - 3;
    for (open, close, levels) in [
        ("sequence a { ", " }", 1),
        ("if a { go(x) } else { go(x) ", " }", 1),
        ("try { } catch any { ", " }", 1),
        ("monitor when a then resume at most 1 { ", " } during { }", 2),
        ("monitor when a then pause during { ", " }", 1),
        ("parallel { { ", " } }", 2),
    ] {
        let depth = blocks / levels;
        let text = format!("policy p {{ {}go(x){} }}", open.repeat(depth), close.repeat(depth));
        let parsed = torture(&text);
        assert_eq!(parsed.diagnostics, [], "{open}");
        let Some(Item::Policy(policy)) = parsed.file.items.first() else { panic!("{open}") };
        assert_eq!(torture(&print::policy_json(policy)).diagnostics, [], "{open}");
    }
    let depth = MAX_NESTING - 4;
    for (open, close) in [("not (", ")"), ("f(", ")"), ("1 - (", ")"), ("a and (b or ", ")"), ("g([", "])")] {
        let depth = if open.len() > 6 || open.starts_with('g') { depth / 2 } else { depth };
        let text = format!("policy p {{ wait until {}f(x){} }}", open.repeat(depth), close.repeat(depth));
        let parsed = torture(&text);
        assert_eq!(parsed.diagnostics, [], "{open}");
        let Some(Item::Policy(policy)) = parsed.file.items.first() else { panic!("{open}") };
        assert_eq!(torture(&print::policy_json(policy)).diagnostics, [], "{open}");
    }
}

#[test]
fn read_names_the_limit_of_large_documents() {
    assert_eq!(code(&" ".repeat(MAX_BYTES + 1)), "M0112");
    assert_eq!(code(&format!("{{{}", " ".repeat(MAX_BYTES))), "M0112");
    let steps = |count: usize| "done ".repeat(count);
    assert_eq!(code(&format!("policy p {{ {} }}", steps(MAX_STEPS))), "");
    assert_eq!(code(&format!("policy p {{ {} }}", steps(MAX_STEPS + 1))), "M0113");
    let json = |count: usize| json_step(&vec!["{\"end\":\"done\"}"; count].join(","));
    assert_eq!(code(&json(MAX_STEPS)), "");
    assert_eq!(code(&json(MAX_STEPS + 1)), "M0113");
    assert_eq!(code(&format!("policy p {{ go([{}1]) }}", "1,".repeat(2_100_000))), "M0118");
    assert_eq!(code(&json_step(&format!("{{\"do\":\"go\",\"a\":[{}1]}}", "1,".repeat(4_100_000)))), "M0118");
}

#[test]
fn read_reports_odd_characters() {
    for (document, expected) in [
        ("policy p { go(\u{0}) }", "M0101"),
        ("policy p { say(\"a\u{0}b\") }", "M0101"),
        ("\u{0}", "M0101"),
        ("\u{feff}", "M0115"),
        ("policy p { say(\"\\q\") }", "M0101"),
        ("policy p { say(\"\\u{110000}\") }", "M0101"),
        ("policy p { say(\"\\u{d800}\") }", "M0101"),
        ("policy p { go(1e999) }", "M0107"),
        ("{\"motet\": 1e999}", "M0107"),
        ("{\"motet\": 1, \"motet\": 1, \"policy\": \"p\", \"steps\": []}", "M0104"),
        ("{\"motet\": 2, \"policy\": \"p\", \"steps\": []}", "M0108"),
        ("{\"motet\": 1, \"policy\": \"\", \"steps\": []}", "M0121"),
        ("{\"motet\": 1, \"policy\": \"p\", \"steps\": [{\"do\": \"go\", \"as\": \"$m\"}]}", "M0122"),
        ("[]", "M0106"),
    ] {
        assert_eq!(code(document), expected, "{document:?}");
    }
}
