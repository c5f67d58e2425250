//! Diagnostics for people and for tools, one format a file. Nothing here prints: the host writes the text
//! out.

mod human;
mod json;
mod llm;
mod sarif;

pub use human::{ColorChoice, human};
pub use json::{DiagnosticRecord, EditRecord, FixRecord, RelatedRecord, SpanRecord, json, record};
pub use llm::{MAX_CHARS, capital, llm};
pub use sarif::{CodePage, github, sarif};

use std::sync::Arc;

use crate::source::{Source, Sources, Span};

/// Is `true` for a character that steers a terminal or turns the direction of a text, instead of being shown.
#[must_use]
pub fn is_steering(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
        || letter == '\u{61c}'
}

/// Text for a terminal: what would steer it is escaped (`\u{1b}`), but for line breaks and tabs.
#[must_use]
pub fn escaped(text: &str) -> String {
    if !text.chars().any(is_steering) {
        return text.to_owned();
    }
    let mut shown = String::new();
    for letter in text.chars() {
        match letter {
            '\n' | '\t' => shown.push(letter),
            _ if is_steering(letter) => shown.extend(letter.escape_default()),
            _ => shown.push(letter),
        }
    }
    shown
}

/// Text of JSON documents in which what would steer a terminal is escaped as JSON has it (`\u001b`), but for
/// line breaks and tabs between values: it reads as the same values.
#[must_use]
pub fn escaped_json(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            '\n' | '\t' => shown.push(letter),
            // All of them have four digits.
            _ if is_steering(letter) => shown.push_str(&format!("\\u{:04x}", u32::from(letter))),
            _ => shown.push(letter),
        }
    }
    shown
}

/// Text in which each character that would steer a terminal is `?`, once for each of its bytes: places in it
/// stay where they were. Line breaks and tabs stay.
fn masked(text: &Arc<str>) -> Arc<str> {
    if text.chars().all(|letter| !is_steering(letter) || matches!(letter, '\n' | '\t')) {
        return Arc::clone(text);
    }
    let mut shown = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_shown = match letter {
            '\n' | '\t' => true,
            '\r' => letters.peek() == Some(&'\n'),
            _ => !is_steering(letter),
        };
        if is_shown {
            shown.push(letter);
        } else {
            shown.extend(std::iter::repeat_n('?', letter.len_utf8()));
        }
    }
    shown.into()
}

/// The file of a span, where there is one.
fn source(sources: &Sources, span: Span) -> Option<&Source> {
    sources.get(span.file)
}

/// The name of the file of a span; empty where there is none.
fn file_name(sources: &Sources, span: Span) -> &str {
    source(sources, span).map_or("", |source| &source.name)
}

/// Line and column of a span's first byte, from 1.
fn line_column(sources: &Sources, span: Span) -> (usize, usize) {
    source(sources, span).map_or((1, 1), |source| source.line_column(span.start))
}

/// Line and column of the first byte of a span and of one past its last, from 1, in the file that tools open:
/// of a document that is a line of a file that is the whole file.
fn region(sources: &Sources, span: Span) -> [(usize, usize); 2] {
    let Some(source) = source(sources, span) else { return [(1, 1); 2] };
    let (_, before) = source.file();
    [span.start, span.end].map(|offset| {
        let (line, column) = source.line_column(offset);
        (line + before, column)
    })
}

/// The name of the file that tools open; empty where there is none.
fn tool_file(sources: &Sources, span: Span) -> &str {
    source(sources, span).map_or("", |source| source.file().0)
}

#[cfg(test)]
mod tests {
    use super::{escaped, escaped_json, masked};

    #[test]
    fn escaped_leaves_nothing_that_steers_a_terminal() {
        assert_eq!(
            escaped("a\u{1b}[2J\r\u{9b}b\n\tc\u{202e}\u{61c}"),
            "a\\u{1b}[2J\\r\\u{9b}b\n\tc\\u{202e}\\u{61c}"
        );
    }

    #[test]
    fn escaped_json_reads_as_the_same_values() {
        let value = serde_json::json!({"a": "\u{1b}[2J\u{7f}\u{9b}\u{200f}\u{2028}\u{202e}\u{2069}ä\n\t😀"});
        for text in [value.to_string(), format!("{value:#}")] {
            let shown = escaped_json(&text);
            assert!(!shown.contains(|letter| super::is_steering(letter) && letter != '\n'), "{shown:?}");
            assert_eq!(serde_json::from_str::<serde_json::Value>(&shown).unwrap(), value);
        }
    }

    #[test]
    fn masked_keeps_places_and_line_breaks() {
        let text = "pick(\u{1b}[2J)\r\n\u{202e}x\ry".into();
        assert_eq!(&*masked(&text), "pick(?[2J)\r\n???x?y");
    }
}
