//! Values that do not fit where they stand.

use smol_str::SmolStr;

use super::replace;
use crate::diagnostic::{Code, Fix, Mistake};
use crate::source::Span;
use crate::suggest;

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
