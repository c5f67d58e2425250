//! Keys that are unknown, missing, doubled or in the wrong place.

use smol_str::SmolStr;

use super::replace;
use crate::diagnostic::{Code, Fix, Mistake, Related};
use crate::source::Span;
use crate::suggest;

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
