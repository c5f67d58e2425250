//! The error type of the deserializer: a structured reason, and the node that it is about. It becomes a diagnostic
//! when the reading is over, since only then the pointer is worth computing.

use std::fmt::{self, Display};

use serde::de::{self, Expected, Unexpected};
use smol_str::{SmolStr, format_smolstr};

use super::tree::Tree;
use crate::diagnostic::Diagnostic;
use crate::errors::{BadValue, MissingKey, NoForm, NumberRange, TwoForms, UnknownKey, WrongType};
use crate::suggest;

/// One mistake in a value.
#[derive(Debug)]
pub(crate) struct Fault(Box<Located>);

#[derive(Debug)]
struct Located {
    /// The node that it is about, once it is known.
    at: Option<u32>,
    reason: Reason,
}

/// What is wrong.
#[derive(Debug)]
pub(crate) enum Reason {
    /// Another JSON type than expected.
    Type { found: SmolStr, expected: SmolStr },
    /// A number that does not fit.
    Range { found: SmolStr, expected: SmolStr },
    /// A string that is none of those expected.
    Choice { found: SmolStr, expected: &'static [&'static str] },
    /// A key that does not belong here.
    UnknownKey { key: SmolStr, expected: &'static [&'static str] },
    /// A key that is missing.
    Missing(&'static str),
    /// An object that is none of the forms.
    NoForm(&'static [&'static str]),
    /// An object that is two of the forms; the nodes of the keys.
    TwoForms { first: u32, second: u32 },
    /// Anything else, in words.
    Words(String),
}

impl Fault {
    pub(crate) fn new(reason: Reason, at: u32) -> Self {
        Self(Box::new(Located { at: Some(at), reason }))
    }

    fn unplaced(reason: Reason) -> Self {
        Self(Box::new(Located { at: None, reason }))
    }

    /// The same fault at `at`, unless a deeper node has claimed it.
    pub(crate) fn or_at(mut self, at: u32) -> Self {
        self.0.at.get_or_insert(at);
        self
    }

    /// As a user sees it.
    pub(crate) fn diagnostic(self, tree: &Tree<'_>) -> Diagnostic {
        let at = self.0.at.unwrap_or(0);
        let span = tree.span(at);
        // A whole object is not underlined: its first key stands for it.
        let head = tree.keys(at).next().map_or(span, |key| tree.span(key));
        let mut diagnostic: Diagnostic = match self.0.reason {
            Reason::Type { found, expected } => WrongType { span, expected, found }.into(),
            Reason::Range { found, expected } => NumberRange { span, found, expected: Some(expected) }.into(),
            Reason::Choice { found, expected } => BadValue {
                expected: expected.iter().copied().map(SmolStr::new_static).collect(),
                found: found.clone(),
                ..BadValue::new(span, format!("`{found}` is not known here"))
            }
            .into(),
            Reason::UnknownKey { key, expected } => UnknownKey {
                key,
                span,
                expected: expected.iter().copied().map(SmolStr::new_static).collect(),
            }
            .into(),
            Reason::Missing(key) => MissingKey { key: key.into(), span: head }.into(),
            Reason::NoForm(forms) => {
                let meant = tree.keys(at).find_map(|key| {
                    let text = tree.text(key);
                    let meant = suggest::closest(text, forms.iter().copied())?;
                    Some((key, (SmolStr::new(text), SmolStr::new_static(meant))))
                });
                let span = meant.as_ref().map_or(head, |(key, _)| tree.span(*key));
                NoForm {
                    span,
                    forms: forms.iter().copied().map(SmolStr::new_static).collect(),
                    meant: meant.map(|(_, meant)| meant),
                }
                .into()
            }
            Reason::TwoForms { first, second } => TwoForms {
                span: tree.span(second),
                first: tree.text(first).into(),
                first_span: tree.span(first),
                second: tree.text(second).into(),
            }
            .into(),
            Reason::Words(message) => BadValue::new(span, message).into(),
        };
        diagnostic.path = tree.pointer(at);
        diagnostic
    }
}

/// The type that serde's derived code expects, in words of JSON.
fn expectation(expected: &dyn Expected) -> SmolStr {
    let text = format_smolstr!("{expected}");
    match text.as_str() {
        "f32" | "f64" => "a number".into(),
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number from 0".into(),
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number".into(),
        "a boolean" => "`true` or `false`".into(),
        "a sequence" => "an array".into(),
        "a map" => "an object".into(),
        "unit" => "`null`".into(),
        other if other.starts_with("struct ") => "an object".into(),
        other if other.starts_with("enum ") => "a string or an object".into(),
        other if other.contains("array of length ") || other.contains("tuple of size ") => {
            let size = other.rsplit(' ').next().unwrap_or("");
            format_smolstr!("an array of {size} elements")
        }
        other if other.contains(" with ") && other.contains(" element") => {
            let size = other.split(' ').rev().nth(1).unwrap_or("");
            format_smolstr!("an array of {size} elements")
        }
        _ => text,
    }
}

/// What was found, in words of JSON.
fn finding(found: &Unexpected<'_>) -> SmolStr {
    match found {
        Unexpected::Bool(value) => format_smolstr!("`{value}`"),
        Unexpected::Unsigned(value) => format_smolstr!("the number `{value}`"),
        Unexpected::Signed(value) => format_smolstr!("the number `{value}`"),
        Unexpected::Float(value) => format_smolstr!("the number `{value}`"),
        Unexpected::Str(text) if text.chars().count() <= 40 => format_smolstr!("the string `{text}`"),
        Unexpected::Str(_) | Unexpected::Char(_) | Unexpected::Bytes(_) => "a string".into(),
        Unexpected::Unit | Unexpected::Option => "`null`".into(),
        Unexpected::Seq | Unexpected::TupleVariant => "an array".into(),
        Unexpected::Map | Unexpected::StructVariant => "an object".into(),
        Unexpected::NewtypeStruct
        | Unexpected::Enum
        | Unexpected::NewtypeVariant
        | Unexpected::UnitVariant => "another value".into(),
        Unexpected::Other(words) => SmolStr::new(words),
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0.reason {
            Reason::Type { found, expected } => write!(f, "expected {expected}, found {found}"),
            Reason::Range { found, expected } => write!(f, "`{found}` is out of range, expected {expected}"),
            Reason::Choice { found, .. } => write!(f, "`{found}` is not known here"),
            Reason::UnknownKey { key, .. } => write!(f, "unknown key `{key}`"),
            Reason::Missing(key) => write!(f, "the key `{key}` is missing here"),
            Reason::NoForm(_) => f.write_str("no key says what this object is"),
            Reason::TwoForms { .. } => f.write_str("one object has two forms"),
            Reason::Words(words) => f.write_str(words),
        }
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: Display>(message: T) -> Self {
        Self::unplaced(Reason::Words(message.to_string()))
    }
    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::unplaced(Reason::Type { found: finding(&found), expected: expectation(expected) })
    }
    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let expected = expectation(expected);
        let number = match found {
            Unexpected::Unsigned(value) => format_smolstr!("{value}"),
            Unexpected::Signed(value) => format_smolstr!("{value}"),
            Unexpected::Float(value) => format_smolstr!("{value}"),
            Unexpected::Bool(_)
            | Unexpected::Char(_)
            | Unexpected::Str(_)
            | Unexpected::Bytes(_)
            | Unexpected::Unit
            | Unexpected::Option
            | Unexpected::NewtypeStruct
            | Unexpected::Seq
            | Unexpected::Map
            | Unexpected::Enum
            | Unexpected::UnitVariant
            | Unexpected::NewtypeVariant
            | Unexpected::TupleVariant
            | Unexpected::StructVariant
            | Unexpected::Other(_) => {
                return Self::unplaced(Reason::Type { found: finding(&found), expected });
            }
        };
        Self::unplaced(Reason::Range { found: number, expected })
    }
    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        let found = if length == 1 { "one".into() } else { format_smolstr!("{length}") };
        Self::unplaced(Reason::Type { found, expected: expectation(expected) })
    }
    fn unknown_variant(variant: &str, expected: &'static [&'static str]) -> Self {
        Self::unplaced(Reason::Choice { found: variant.into(), expected })
    }
    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        Self::unplaced(Reason::UnknownKey { key: field.into(), expected })
    }
    fn missing_field(field: &'static str) -> Self {
        Self::unplaced(Reason::Missing(field))
    }
    fn duplicate_field(field: &'static str) -> Self {
        Self::unplaced(Reason::Words(format!("the key `{field}` stands twice in one object")))
    }
}
