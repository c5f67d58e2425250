//! Mistakes of the text syntax. Raised by the bracket check before parsing, by the explanation of parse
//! errors, and by the builders of the tree.

use smol_str::SmolStr;

use super::replacement;
use crate::diagnostic::{Edit, Fix, Related};
use crate::source::Span;
use crate::suggest;
use crate::unit::Unit;

crate::mistakes! {
    pub(crate) const CODES;

    /// The text does not follow the grammar. `fix` is the text to write in place of the span, where it is
    /// sure to be right.
    TextSyntax("M0101", Error) {
        message: String,
        help: Option<String>,
        related: Option<(&'static str, Span)>,
        fix: Option<String>,
    }
    message(m) { m.message.clone() }
    help(m) { m.help.clone() }
    related(m) { m.related.iter().map(|(words, span)| Related::new(*words, *span)).collect() }
    fix(m) {
        m.fix.as_ref().map(|text| match text.as_str() {
            "" => Fix { title: "remove it".into(), edits: vec![Edit { span: m.span, text: String::new() }] },
            text => replacement(m.span, text, text),
        })
    }

    /// A word after a number that is not a unit.
    UnknownUnit("M0120", Error) { unit: SmolStr }
    message(m) { format!("unknown unit `{}`", m.unit) }
    help(m) {
        Some(match Unit::from_spelling(&m.unit) {
            Some(meant) => format!("did you mean `{}`?", meant.symbol()),
            None => format!("the units are {}", suggest::one_of(Unit::ALL.iter().map(|unit| unit.symbol()))),
        })
    }
    fix(m) { Unit::from_spelling(&m.unit).map(|meant| replacement(m.span, meant.symbol(), meant.symbol())) }
}

impl TextSyntax {
    /// A mistake with a message and help.
    pub(crate) fn new(span: Span, message: String, help: impl Into<String>) -> Self {
        Self { span, message, help: Some(help.into()), related: None, fix: None }
    }
}
