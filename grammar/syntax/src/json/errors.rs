//! What can be wrong with a JSON document: its syntax, its keys, and the types of its values. Raised by
//! [`super::parse`] and, through [`super::fault`], by everything that is read with [`super::read`].

use smol_str::SmolStr;

use crate::diagnostic::{Code, Edit, Fix, Mistake, Related};
use crate::source::Span;
use crate::suggest;

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
            SyntaxFault::KeyNotText => Some("JSON keys stand in double quotes; JSON has no comments".into()),
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

fn replace(span: Span, text: &str, title: &str) -> Fix {
    Fix { title: title.into(), edits: vec![Edit { span, text: text.into() }] }
}

/// A key that does not belong where it stands.
#[derive(Clone, Debug)]
pub struct UnknownKey {
    /// The key as written.
    pub key: SmolStr,
    /// The key.
    pub span: Span,
    /// The keys that do belong there.
    pub expected: &'static [&'static str],
}

impl UnknownKey {
    fn meant(&self) -> Option<&'static str> {
        suggest::closest(&self.key, self.expected.iter().copied())
    }
}

impl Mistake for UnknownKey {
    const CODE: Code = Code("M0103");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("unknown key `{}`", self.key)
    }
    fn help(&self) -> Option<String> {
        match self.meant() {
            Some(meant) => Some(format!("did you mean `{meant}`?")),
            None if self.expected.is_empty() => Some("no keys belong here".into()),
            None => Some(format!("the keys here are {}", suggest::one_of(self.expected.iter().copied()))),
        }
    }
    fn fix(&self) -> Option<Fix> {
        self.meant().map(|meant| replace(self.span, &format!("\"{meant}\""), &format!("write `{meant}`")))
    }
}

/// A key that its object already has.
#[derive(Clone, Debug)]
pub struct DuplicateKey {
    /// The key.
    pub key: SmolStr,
    /// The second of the two.
    pub span: Span,
    /// The first of the two.
    pub first: Span,
}

impl Mistake for DuplicateKey {
    const CODE: Code = Code("M0104");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("the key `{}` stands twice in one object", self.key)
    }
    fn help(&self) -> Option<String> {
        Some("keep one of the two".into())
    }
    fn related(&self) -> Vec<Related> {
        vec![Related::new("first written here", self.first)]
    }
}

/// A key that must be there.
#[derive(Clone, Debug)]
pub struct MissingKey {
    /// The key.
    pub key: &'static str,
    /// The object's first key, or the object.
    pub span: Span,
}

impl Mistake for MissingKey {
    const CODE: Code = Code("M0105");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("the key `{}` is missing here", self.key)
    }
    fn help(&self) -> Option<String> {
        Some(format!("add `\"{}\": …` to this object", self.key))
    }
}

/// A value of another JSON type than the one that belongs there.
#[derive(Clone, Debug)]
pub struct WrongType {
    /// The value.
    pub span: Span,
    /// What belongs there, with its article: "a string".
    pub expected: SmolStr,
    /// What is there.
    pub found: SmolStr,
}

impl Mistake for WrongType {
    const CODE: Code = Code("M0106");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("expected {}, found {}", self.expected, self.found)
    }
    fn help(&self) -> Option<String> {
        Some(format!("write {} here", self.expected))
    }
}

/// A number that does not fit where it stands, or no computer's float.
#[derive(Clone, Debug)]
pub struct NumberRange {
    /// The number.
    pub span: Span,
    /// As written.
    pub found: SmolStr,
    /// What belongs there, with its article.
    pub expected: Option<SmolStr>,
}

impl Mistake for NumberRange {
    const CODE: Code = Code("M0107");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        match &self.expected {
            Some(expected) => format!("the number `{}` is out of range, expected {expected}", self.found),
            None => format!("the number `{}` is out of range", self.found),
        }
    }
    fn help(&self) -> Option<String> {
        match &self.expected {
            Some(expected) => Some(format!("write {expected}")),
            None => Some("numbers lie between -1.8e308 and 1.8e308".into()),
        }
    }
}

/// A value of the right JSON type that means nothing there.
#[derive(Clone, Debug)]
pub struct BadValue {
    /// The value.
    pub span: Span,
    /// What is wrong, as a clause.
    pub message: String,
    /// The values that would do, where they can be listed.
    pub expected: &'static [&'static str],
    /// The value as written, where it is a string.
    pub found: SmolStr,
    /// What to write instead, where no value can be named.
    pub help: Option<String>,
}

impl BadValue {
    fn meant(&self) -> Option<&'static str> {
        suggest::closest(&self.found, self.expected.iter().copied())
    }
}

impl Mistake for BadValue {
    const CODE: Code = Code("M0108");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        self.message.clone()
    }
    fn help(&self) -> Option<String> {
        match self.meant() {
            Some(meant) => Some(format!("did you mean `{meant}`?")),
            None if self.expected.is_empty() => self.help.clone(),
            None => Some(format!("write {}", suggest::one_of(self.expected.iter().copied()))),
        }
    }
    fn fix(&self) -> Option<Fix> {
        self.meant().map(|meant| replace(self.span, &format!("\"{meant}\""), &format!("write `{meant}`")))
    }
}

/// An object none of whose keys says what it is.
#[derive(Clone, Debug)]
pub struct NoForm {
    /// The object's first key, or the object.
    pub span: Span,
    /// The keys of which it needs one.
    pub forms: &'static [&'static str],
    /// The misspelt key, where one is close, and the key that it is close to.
    pub meant: Option<(SmolStr, &'static str)>,
}

impl Mistake for NoForm {
    const CODE: Code = Code("M0109");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        match &self.meant {
            Some((key, _)) => format!("unknown key `{key}`"),
            None => "no key says what this object is".into(),
        }
    }
    fn help(&self) -> Option<String> {
        match &self.meant {
            Some((_, meant)) => Some(format!("did you mean `{meant}`?")),
            None => Some(format!("it has one of the keys {}", suggest::one_of(self.forms.iter().copied()))),
        }
    }
    fn fix(&self) -> Option<Fix> {
        self.meant
            .as_ref()
            .map(|(_, meant)| replace(self.span, &format!("\"{meant}\""), &format!("write `{meant}`")))
    }
}

/// An object with two keys that each say what it is.
#[derive(Clone, Debug)]
pub struct TwoForms {
    /// The second of the two.
    pub span: Span,
    /// The key that came first.
    pub first: SmolStr,
    /// Where it stands.
    pub first_span: Span,
    /// The second key.
    pub second: SmolStr,
}

impl Mistake for TwoForms {
    const CODE: Code = Code("M0110");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("one object cannot be both `{}` and `{}`", self.first, self.second)
    }
    fn help(&self) -> Option<String> {
        Some("write two objects, one after the other or one in the other".into())
    }
    fn related(&self) -> Vec<Related> {
        vec![Related::new(format!("`{}` is here", self.first), self.first_span)]
    }
}

/// A key in a call that belongs to another kind of step and is no parameter of any primitive.
#[derive(Clone, Debug)]
pub struct ReservedKey {
    /// The key.
    pub span: Span,
    /// As written.
    pub key: SmolStr,
}

/// The keys that no parameter bears, and the forms that they belong to.
pub const RESERVED: &[(&str, &str)] = &[
    ("if", "a step of its own"),
    ("then", "`if` and to a monitor's `when`"),
    ("else", "`if`"),
    ("wait", "a step of its own"),
    ("monitor", "a step of its own"),
    ("during", "`monitor`"),
    ("try", "a step of its own"),
    ("catch", "`try`"),
    ("repeat", "a step of its own"),
    ("until", "`repeat`"),
    ("steps", "`sequence`, `repeat` and `each`"),
    ("each", "a step of its own"),
    ("in", "`each`"),
    ("at_most", "`each` and to the reactions"),
    ("parallel", "a step of its own"),
    ("end", "a step of its own"),
    ("why", "`end`"),
    ("sequence", "a step of its own"),
    ("when", "`monitor`"),
    ("for", "a monitor's `when`"),
    ("react", "a monitor's `then`"),
    ("is", "conditions"),
    ("get", "terms"),
    ("field", "terms"),
    ("of", "`field`"),
];

impl Mistake for ReservedKey {
    const CODE: Code = Code("M0117");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        format!("`{}` is no argument of a `do` step", self.key)
    }
    fn help(&self) -> Option<String> {
        let owner = RESERVED.iter().find(|(key, _)| *key == self.key).map(|(_, owner)| *owner);
        owner.map(|owner| {
            format!("the key belongs to {owner}; a `do` step has `as`, `within`, `retry` and arguments")
        })
    }
}

/// A string that cannot be a name.
#[derive(Clone, Debug)]
pub struct BadName {
    /// The string.
    pub span: Span,
    /// As written.
    pub name: SmolStr,
}

impl Mistake for BadName {
    const CODE: Code = Code("M0121");
    fn span(&self) -> Span {
        self.span
    }
    fn message(&self) -> String {
        if self.name.is_empty() { "a name is empty".into() } else { format!("`{}` is not a name", self.name) }
    }
    fn help(&self) -> Option<String> {
        Some(match self.name.strip_prefix('$') {
            Some(rest) => format!("write `{rest}`: `$` marks the use of a binding, not its name"),
            None => "a name has at least one character, and no back-quote and no line break".into(),
        })
    }
    fn fix(&self) -> Option<Fix> {
        let rest = self.name.strip_prefix('$').filter(|rest| crate::text::is_bare_name(rest))?;
        Some(replace(self.span, &format!("\"{rest}\""), &format!("write `{rest}`")))
    }
}
