//! Mistakes of a JSON document: of its syntax, raised by the JSON parser, and of its keys, the types of its
//! values and its names.

use smol_str::SmolStr;

use super::replacement;
use crate::diagnostic::{Edit, Fix, Related};
use crate::source::Span;
use crate::{suggest, words};

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
            SyntaxFault::Escape => "the escapes are `\\\"`, `\\\\`, `\\/`, `\\b`, `\\f`, `\\n`, `\\r`, \
                                    `\\t`, \
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

    /// A key that its object does not know.
    UnknownKey("M0103", Error) { key: SmolStr, expected: Vec<SmolStr> }
    message(m) { format!("unknown key `{}`", m.key) }
    help(m) {
        Some(match m.meant() {
            Some(meant) => format!("did you mean `{meant}`?"),
            None if m.expected.is_empty() => "no keys belong here".into(),
            None => format!("the keys here are {}", suggest::one_of(m.expected.iter().map(SmolStr::as_str))),
        })
    }
    fix(m) { m.meant().map(|meant| replacement(m.span, &format!("\"{meant}\""), meant)) }

    /// A key that its object already has. The span is the second of the two.
    DuplicateKey("M0104", Error) { key: SmolStr, first: crate::Span }
    message(m) { format!("the key `{}` stands twice in one object", m.key) }
    help(_m) { Some("keep one of the two".into()) }
    related(m) { vec![Related::new("first written here", m.first)] }

    /// A required key is missing. The span is the object's first key, or the object where it has none.
    MissingKey("M0105", Error) { key: SmolStr }
    message(m) { format!("the key `{}` is missing here", m.key) }
    help(m) { Some(format!("add `\"{}\": …` to this object", m.key)) }

    /// A value of another JSON type than the one that belongs there. Both types are written with their
    /// article.
    WrongType("M0106", Error) { expected: SmolStr, found: SmolStr }
    message(m) { format!("expected {}, found {}", m.expected, m.found) }
    help(m) { Some(format!("write {} here", m.expected)) }

    /// A number that does not fit where it stands, or exceeds a 64-bit float where `expected` is `None`.
    NumberRange("M0107", Error) { found: SmolStr, expected: Option<SmolStr> }
    message(m) {
        match &m.expected {
            Some(expected) => format!("the number `{}` is out of range, expected {expected}", m.found),
            None => format!("the number `{}` is out of range", m.found),
        }
    }
    help(m) {
        Some(match &m.expected {
            Some(expected) => format!("write {expected}"),
            None => "numbers range from -1.8e308 to 1.8e308".into(),
        })
    }

    /// A value of the right JSON type without a meaning there. `found` is the value where it is a string,
    /// `expected` the values that would do where they can be listed, `otherwise` the help where no value can
    /// be named.
    BadValue("M0108", Error) {
        message: String,
        expected: Vec<SmolStr>,
        found: SmolStr,
        otherwise: Option<String>,
    }
    message(m) { m.message.clone() }
    help(m) {
        match m.meant() {
            Some(meant) => Some(format!("did you mean `{meant}`?")),
            None if m.expected.is_empty() => m.otherwise.clone(),
            None => Some(format!("write {}", suggest::one_of(m.expected.iter().map(SmolStr::as_str)))),
        }
    }
    fix(m) { m.meant().map(|meant| replacement(m.span, &format!("\"{meant}\""), meant)) }

    /// An object without the key that would name its form. `meant` is a misspelt key and the form that it is
    /// close to.
    NoForm("M0109", Error) { forms: Vec<SmolStr>, meant: Option<(SmolStr, SmolStr)> }
    message(m) {
        match &m.meant {
            Some((key, _)) => format!("unknown key `{key}`"),
            None => "no key says what this object is".into(),
        }
    }
    help(m) {
        Some(match &m.meant {
            Some((_, meant)) => format!("did you mean `{meant}`?"),
            None => {
                format!("it has one of the keys {}", suggest::one_of(m.forms.iter().map(SmolStr::as_str)))
            }
        })
    }
    fix(m) { m.meant.as_ref().map(|(_, meant)| replacement(m.span, &format!("\"{meant}\""), meant)) }

    /// An object with two keys that each name a form. The span is the second key.
    TwoForms("M0110", Error) { first: SmolStr, first_span: crate::Span, second: SmolStr }
    message(m) { format!("one object cannot be both `{}` and `{}`", m.first, m.second) }
    help(_m) { Some("write two objects, one after the other or one in the other".into()) }
    related(m) { vec![Related::new(format!("`{}` is here", m.first), m.first_span)] }

    /// A key in a call that belongs to another form and is a parameter of no primitive.
    ReservedKey("M0117", Error) { key: SmolStr }
    message(m) { format!("`{}` is no argument of a `do` step", m.key) }
    help(m) {
        words::json_key_owner(&m.key).map(|owner| {
            let own = "`as`, `manner`, `within`, `retry` and arguments";
            format!("the key belongs to {owner}; a `do` step has {own}")
        })
    }

    /// A part of the document in another shape than the language's, with one reading. `more` counts the
    /// other places of this shape; the fix is about all of them.
    ReadShape("M0122", Note) { written: String, read: String, more: usize, fix: Fix }
    message(m) {
        match m.more {
            0 if m.written.contains("`, `") => format!("{} are read as {}", m.written, m.read),
            0 => format!("{} is read as {}", m.written, m.read),
            more => format!("{} is read as {}, here and {more} more times", m.written, m.read),
        }
    }
    help(_m) { Some("`motet fmt` and `motet check --fix` write the form of the language".into()) }
    fix(m) { Some(m.fix.clone()) }

    /// A string that cannot be a name.
    BadName("M0121", Error) { name: SmolStr }
    message(m) {
        if m.name.is_empty() { "a name is empty".into() } else { format!("`{}` is not a name", m.name) }
    }
    help(m) {
        Some(match m.name.strip_prefix('$') {
            Some(rest) => format!("write `{rest}`: `$` marks the use of a binding, not its name"),
            None => "a name has at least one character, and no back-quote and no line break".into(),
        })
    }
    fix(m) {
        let rest = m.name.strip_prefix('$').filter(|rest| words::is_bare_name(rest))?;
        Some(replacement(m.span, &format!("\"{rest}\""), rest))
    }
}

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

/// JSON spelling of a literal of another language.
fn word_in_json(word: &str) -> Option<&'static str> {
    match word {
        "True" | "TRUE" | "yes" => Some("true"),
        "False" | "FALSE" | "no" => Some("false"),
        "None" | "nil" | "undefined" | "NULL" | "Null" => Some("null"),
        _ => None,
    }
}

impl UnknownKey {
    fn meant(&self) -> Option<&str> {
        suggest::closest(&self.key, self.expected.iter().map(SmolStr::as_str))
    }
}

impl BadValue {
    /// A value that is refused in words, with help that names no value.
    pub(crate) fn new(span: crate::Span, message: impl Into<String>) -> Self {
        Self {
            span,
            message: message.into(),
            expected: Vec::new(),
            found: SmolStr::default(),
            otherwise: None,
        }
    }

    fn meant(&self) -> Option<&str> {
        suggest::closest(&self.found, self.expected.iter().map(SmolStr::as_str))
    }
}
