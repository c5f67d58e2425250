//! Round trips over made trees of every node kind.

use motet_arbitrary::syntax as arbitrary;
use motet_syntax::ast::{File, Item, Policy};
use motet_syntax::{FileId, Source, print, read};
use proptest::prelude::*;

/// The file of a text that must be right.
fn parse(text: &str) -> File {
    let parsed = read(&Source::new("test", text), FileId(0));
    let messages: Vec<String> =
        parsed.diagnostics.iter().map(|d| format!("{} at {}: {}", d.code, d.span.start, d.message)).collect();
    assert!(messages.is_empty(), "{messages:?}\n{text}");
    parsed.file
}

fn parse_policy(text: &str) -> Policy {
    match parse(text).items.pop() {
        Some(Item::Policy(policy)) => policy,
        other => panic!("{other:?}"),
    }
}

fn bytes() -> impl Strategy<Value = Vec<u8>> {
    proptest::collection::vec(any::<u8>(), 0..600)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 800, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn text_round_trips(bytes in bytes()) {
        let file = arbitrary::file(&bytes);
        let text = print::text(&file);
        let again = parse(&text);
        prop_assert!(file == again, "{text}\n{file:?}\n{again:?}");
        prop_assert_eq!(print::text(&again), text);
    }

    #[test]
    fn json_round_trips(bytes in bytes()) {
        let policy = arbitrary::json_policy(&bytes);
        let json = print::policy_json(&policy);
        let again = parse_policy(&json);
        prop_assert!(policy == again, "{json}\n{policy:?}\n{again:?}");
        prop_assert_eq!(print::policy_json(&again), json);
    }

    #[test]
    fn json_round_trips_through_text(bytes in bytes()) {
        let json = print::policy_json(&arbitrary::json_policy(&bytes));
        let text = print::text(&parse(&json));
        let again = parse_policy(&text);
        prop_assert_eq!(print::policy_json(&again), json, "{}", text);
        // What came by way of JSON is in the text syntax the same as what came from text.
        prop_assert_eq!(print::text(&File { items: vec![Item::Policy(again)] }), text);
    }

    #[test]
    fn format_is_idempotent(bytes in bytes(), marks in proptest::collection::vec(any::<u16>(), 0..12)) {
        let text = with_comments(&print::text(&arbitrary::file(&bytes)), &marks);
        let before = parse(&text);
        let once = motet_syntax::format(&Source::new("test", text.as_str())).unwrap();
        let twice = motet_syntax::format(&Source::new("test", once.as_str())).unwrap();
        prop_assert_eq!(&once, &twice, "{}", text);
        prop_assert!(before == parse(&once), "{text}\n{once}");
        for index in 0..marks.len() {
            let comment = format!("// c{index};");
            let counts = [&once, &text].map(|text| text.matches(&comment).count());
            prop_assert_eq!(counts[0], counts[1], "{}\n{}", text, once);
        }
        let json = print::policy_json(&arbitrary::json_policy(&bytes));
        prop_assert_eq!(motet_syntax::format(&Source::new("test", json.as_str())).unwrap(), json);
    }
}

/// A text with comments and blank lines: each mark says after which line and how.
fn with_comments(text: &str, marks: &[u16]) -> String {
    let mut lines: Vec<String> = text.lines().map(String::from).collect();
    let count = lines.len().max(1);
    for (index, mark) in marks.iter().enumerate() {
        let Some(line) = lines.get_mut(usize::from(*mark / 4) % count) else { continue };
        if line.starts_with("///") {
            continue;
        }
        match mark % 4 {
            0 => *line = format!("{line} // c{index};"),
            1 => *line = format!("    // c{index};\n{line}"),
            2 => *line = format!("\n\n\n// c{index};\n\n{line}"),
            _ => *line = format!("\n\n{line}"),
        }
    }
    lines.join("\n")
}
