//! What is not JSON. Raised by [`super::super::parse`].

use smol_str::SmolStr;

use super::replace;
use crate::diagnostic::{Code, Fix, Mistake, Related};
use crate::source::Span;

/// The text is not JSON.
#[derive(Clone, Debug)]
pub struct JsonSyntax {
    /// The character or word that does not fit.
    pub span: Span,
    /// How it does not fit.
    pub fault: SyntaxFault,
}

/// How a text fails to be JSON.
#[derive(Clone, PartialEq, Debug)]
pub enum SyntaxFault {
    /// The document ends too early; the innermost open bracket, and whether it is a `{`.
    Ended {
        /// The innermost open bracket, and whether it is a `{`.
        opened: Option<(bool, Span)>,
    },
    /// Something after the whole value.
    Trailing,
    /// `,]`
    TrailingComma,
    /// `[1}`
    WrongClosing {
        /// The bracket that is open.
        opened: Span,
        /// Whether it is a `{`.
        is_object: bool,
    },
    /// Neither a comma nor the closing bracket.
    NoComma {
        /// Whether the container is an object.
        is_object: bool,
    },
    /// A key without a colon.
    NoColon,
    /// A key that is not a string.
    KeyNotText,
    /// Something that begins no value.
    NoValue,
    /// `//`, `/*` or `#`.
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

impl Mistake for JsonSyntax {
    const CODE: Code = Code("M0102");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        match &self.fault {
            SyntaxFault::Ended { opened: Some((true, _)) } => "the document ends inside an object".into(),
            SyntaxFault::Ended { opened: Some((false, _)) } => "the document ends inside an array".into(),
            SyntaxFault::Ended { opened: None } => "the document ends where a value should be".into(),
            SyntaxFault::Trailing => "something follows the end of the JSON value".into(),
            SyntaxFault::TrailingComma => "a comma stands before the closing bracket".into(),
            SyntaxFault::WrongClosing { is_object: true, .. } => "an object is closed by `]`".into(),
            SyntaxFault::WrongClosing { is_object: false, .. } => "an array is closed by `}`".into(),
            SyntaxFault::NoComma { is_object: true } => "expected `,` or `}` after a value".into(),
            SyntaxFault::NoComma { is_object: false } => "expected `,` or `]` after an element".into(),
            SyntaxFault::NoColon => "expected `:` after a key".into(),
            SyntaxFault::KeyNotText => "expected a key in double quotes".into(),
            SyntaxFault::NoValue => "expected a JSON value".into(),
            SyntaxFault::Comment => "a comment stands in JSON".into(),
            SyntaxFault::Word(word) => format!("`{word}` is no JSON value"),
            SyntaxFault::Number => "this is not how JSON writes a number".into(),
            SyntaxFault::OpenText => "the string is not closed".into(),
            SyntaxFault::Control(byte) => format!("a string holds the control character U+{byte:04X}"),
            SyntaxFault::Escape => "unknown escape in a string".into(),
            SyntaxFault::LoneSurrogate => "half of a surrogate pair in a string".into(),
        }
    }
    fn help(&self) -> Option<String> {
        match &self.fault {
            SyntaxFault::Ended { opened: Some((true, _)) } => Some("close it with `}`".into()),
            SyntaxFault::Ended { opened: Some((false, _)) } => Some("close it with `]`".into()),
            SyntaxFault::Ended { opened: None } => None,
            SyntaxFault::Trailing => Some("a document is one JSON value: remove the rest, or wrap the values in one".into()),
            SyntaxFault::TrailingComma => Some("remove the comma".into()),
            SyntaxFault::WrongClosing { is_object: true, .. } => Some("write `}`".into()),
            SyntaxFault::WrongClosing { is_object: false, .. } => Some("write `]`".into()),
            SyntaxFault::NoComma { .. } => Some("is a comma, a quote or a bracket missing?".into()),
            SyntaxFault::NoColon => None,
            SyntaxFault::KeyNotText => Some("JSON keys stand in double quotes".into()),
            SyntaxFault::Comment => Some("JSON has no comments: remove it, or write the policy as text".into()),
            SyntaxFault::NoValue => {
                Some("a value is a string in double quotes, a number, `true`, `false`, `null`, `[…]` or `{…}`".into())
            }
            SyntaxFault::Word(word) => {
                Some(word_in_json(word).map_or_else(|| format!("write a text as `\"{word}\"`"), |right| format!("write `{right}`")))
            }
            SyntaxFault::Number => Some("write for example `0.5`, `-3` or `1e-3`: no leading `+`, `.` or `0`".into()),
            SyntaxFault::OpenText => Some("close it with `\"`; a line break inside is written `\\n`".into()),
            SyntaxFault::Control(byte) => Some(format!("write it as `\\u{byte:04x}`")),
            SyntaxFault::Escape => {
                Some("the escapes are `\\\"`, `\\\\`, `\\/`, `\\b`, `\\f`, `\\n`, `\\r`, `\\t` and `\\u` with four hex digits".into())
            }
            SyntaxFault::LoneSurrogate => Some("write both halves, or the character itself".into()),
        }
    }
    fn related(&self) -> Vec<Related> {
        match &self.fault {
            SyntaxFault::Ended { opened: Some((_, span)) }
            | SyntaxFault::WrongClosing { opened: span, .. } => {
                vec![Related::new("opened here", *span)]
            }
            SyntaxFault::Ended { opened: None }
            | SyntaxFault::Trailing
            | SyntaxFault::TrailingComma
            | SyntaxFault::NoComma { .. }
            | SyntaxFault::NoColon
            | SyntaxFault::KeyNotText
            | SyntaxFault::NoValue
            | SyntaxFault::Comment
            | SyntaxFault::Word(_)
            | SyntaxFault::Number
            | SyntaxFault::OpenText
            | SyntaxFault::Control(_)
            | SyntaxFault::Escape
            | SyntaxFault::LoneSurrogate => Vec::new(),
        }
    }
    fn fix(&self) -> Option<Fix> {
        match &self.fault {
            SyntaxFault::TrailingComma => Some(replace(self.span, "", "remove the comma")),
            SyntaxFault::Word(word) => {
                word_in_json(word).map(|right| replace(self.span, right, &format!("write `{right}`")))
            }
            SyntaxFault::Ended { .. }
            | SyntaxFault::Trailing
            | SyntaxFault::WrongClosing { .. }
            | SyntaxFault::NoComma { .. }
            | SyntaxFault::NoColon
            | SyntaxFault::KeyNotText
            | SyntaxFault::NoValue
            | SyntaxFault::Comment
            | SyntaxFault::Number
            | SyntaxFault::OpenText
            | SyntaxFault::Control(_)
            | SyntaxFault::Escape
            | SyntaxFault::LoneSurrogate => None,
        }
    }
}

/// How JSON writes a word of another language.
fn word_in_json(word: &str) -> Option<&'static str> {
    match word {
        "True" | "TRUE" | "yes" => Some("true"),
        "False" | "FALSE" | "no" => Some("false"),
        "None" | "nil" | "undefined" | "NULL" | "Null" => Some("null"),
        _ => None,
    }
}
