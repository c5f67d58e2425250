//! Mistakes of a JSON document whose syntax is right: its keys, the types of its values, its names.

use smol_str::SmolStr;

use super::replacement;
use crate::diagnostic::Related;
use crate::{suggest, words};

crate::mistakes! {
    pub(crate) const CODES;

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
            format!("the key belongs to {owner}; a `do` step has `as`, `within`, `retry` and arguments")
        })
    }

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
