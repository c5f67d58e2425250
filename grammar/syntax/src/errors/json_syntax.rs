//! Mistakes of a document that is not JSON. Raised by the JSON parser.

use smol_str::SmolStr;

use super::replacement;
use crate::diagnostic::{Edit, Fix, Related};
use crate::source::Span;

/// Ways in which a text fails to be JSON.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum SyntaxFault {
    /// The document ends too early. `opened` is the innermost open bracket, and true for a `{`.
    Ended { opened: Option<(bool, Span)> },
    /// Something after the whole value.
    Trailing,
    /// A comma before the closing bracket, `,]`.
    TrailingComma,
    /// A container closed by the other bracket, `[1}`.
    WrongClosing { opened: Span, is_object: bool },
    /// Neither a comma nor the closing bracket.
    NoComma { is_object: bool },
    /// A key without a colon.
    NoColon,
    /// A key that is not a string.
    KeyNotText,
    /// Something that begins no value.
    NoValue,
    /// A comment that begins with `//`, `/*` or `#`.
    Comment,
    /// A word that is none of `true`, `false`, `null`.
    Word(SmolStr),
    /// A number that is written otherwise than JSON writes it.
    Number,
    /// A string without its closing quote.
    OpenText,
    /// A raw control character in a string.
    Control(u8),
    /// An unknown or broken escape.
    Escape,
    /// Half of a surrogate pair.
    LoneSurrogate,
}

crate::mistakes! {
    pub(crate) const CODES;

    /// The text is not JSON. The span is the character or word that does not fit.
    JsonSyntax("M0102", Error) { fault: SyntaxFault }
    message(m) {
        match &m.fault {
            SyntaxFault::Ended { opened: Some((true, _)) } => "the document ends inside an object".into(),
            SyntaxFault::Ended { opened: Some((false, _)) } => "the document ends inside an array".into(),
            SyntaxFault::Ended { opened: None } => "the document ends where a value should be".into(),
            SyntaxFault::Trailing => "text follows the end of the JSON value".into(),
            SyntaxFault::TrailingComma => "a comma stands before the closing bracket".into(),
            SyntaxFault::WrongClosing { is_object: true, .. } => "an object is closed by `]`".into(),
            SyntaxFault::WrongClosing { is_object: false, .. } => "an array is closed by `}`".into(),
            SyntaxFault::NoComma { is_object: true } => "expected `,` or `}` after a value".into(),
            SyntaxFault::NoComma { is_object: false } => "expected `,` or `]` after an element".into(),
            SyntaxFault::NoColon => "expected `:` after a key".into(),
            SyntaxFault::KeyNotText => "expected a key in double quotes".into(),
            SyntaxFault::NoValue => "expected a JSON value".into(),
            SyntaxFault::Comment => "JSON has no comments".into(),
            SyntaxFault::Word(word) => format!("`{word}` is not a JSON value"),
            SyntaxFault::Number => "this is not a JSON number".into(),
            SyntaxFault::OpenText => "the string is not closed".into(),
            SyntaxFault::Control(byte) => format!("a string holds the control character U+{byte:04X}"),
            SyntaxFault::Escape => "unknown escape in a string".into(),
            SyntaxFault::LoneSurrogate => "half of a surrogate pair in a string".into(),
        }
    }
    help(m) {
        Some(match &m.fault {
            SyntaxFault::Ended { opened: None } | SyntaxFault::NoColon => return None,
            SyntaxFault::Ended { opened: Some((true, _)) } => "close it with `}`".into(),
            SyntaxFault::Ended { opened: Some((false, _)) } => "close it with `]`".into(),
            SyntaxFault::Trailing => {
                "a document is one JSON value: remove the rest, or wrap the values in one".into()
            }
            SyntaxFault::TrailingComma => "remove the comma".into(),
            SyntaxFault::WrongClosing { is_object: true, .. } => "write `}`".into(),
            SyntaxFault::WrongClosing { is_object: false, .. } => "write `]`".into(),
            SyntaxFault::NoComma { .. } => "is a comma, a quote or a bracket missing?".into(),
            SyntaxFault::KeyNotText => "JSON keys stand in double quotes".into(),
            SyntaxFault::Comment => "remove it, or write the policy as text".into(),
            SyntaxFault::NoValue => {
                "a value is a string in double quotes, a number, `true`, `false`, `null`, `[…]` or `{…}`"
                    .into()
            }
            SyntaxFault::Word(word) => match word_in_json(word) {
                Some(right) => format!("write `{right}`"),
                None => format!("write a text as `\"{word}\"`"),
            },
            SyntaxFault::Number => {
                "write for example `0.5`, `-3` or `1e-3`: no leading `+`, `.` or `0`".into()
            }
            SyntaxFault::OpenText => "close it with `\"`; a line break inside is written `\\n`".into(),
            SyntaxFault::Control(byte) => format!("write it as `\\u{byte:04x}`"),
            SyntaxFault::Escape => "the escapes are `\\\"`, `\\\\`, `\\/`, `\\b`, `\\f`, `\\n`, `\\r`, `\\t`, \
                                    and `\\u` with four hex digits"
                .into(),
            SyntaxFault::LoneSurrogate => "write both halves, or the character itself".into(),
        })
    }
    related(m) {
        match &m.fault {
            SyntaxFault::Ended { opened: Some((_, span)) }
            | SyntaxFault::WrongClosing { opened: span, .. } => vec![Related::new("opened here", *span)],
            _ => Vec::new(),
        }
    }
    fix(m) {
        match &m.fault {
            SyntaxFault::TrailingComma => Some(Fix {
                title: "remove the comma".into(),
                edits: vec![Edit { span: m.span, text: String::new() }],
            }),
            SyntaxFault::Word(word) => word_in_json(word).map(|right| replacement(m.span, right, right)),
            _ => None,
        }
    }
}

/// JSON spelling of a literal of another language.
fn word_in_json(word: &str) -> Option<&'static str> {
    match word {
        "True" | "TRUE" | "yes" => Some("true"),
        "False" | "FALSE" | "no" => Some("false"),
        "None" | "nil" | "undefined" | "NULL" | "Null" => Some("null"),
        _ => None,
    }
}
