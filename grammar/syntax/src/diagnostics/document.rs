//! Mistakes of a document in the text syntax, and those that a document can have in either syntax: its size,
//! its depth, its encoding, and text around it.

use smol_str::SmolStr;

use super::replacement;
use crate::ast::{MAX_BYTES, MAX_MISTAKES, MAX_NESTING, MAX_STEPS, MAX_TOKENS};
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

    /// What stands in the braces of a text is no value. `fix` is what to write in place of the span for the
    /// braces themselves.
    BadTextValue("M0123", Error) { written: SmolStr, reason: String, fix: Option<String> }
    message(m) { format!("`{}` in a text is no value: {}", m.written, m.reason) }
    help(_m) {
        let value = "a value is a name or a term in braces, such as `{count(cans)}`";
        Some(format!("{value}; a brace itself is written twice: `{{{{`"))
    }
    fix(m) { m.fix.as_ref().map(|text| replacement(m.span, text, text)) }

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

    /// Brackets, blocks or expressions nest deeper than any policy needs. The span is the first that is too
    /// deep.
    TooDeep("M0111", Error) { limit: usize }
    message(m) { format!("this is nested more than {} levels deep", m.limit) }
    help(m) {
        let nodes = if m.limit == MAX_NESTING { "steps, conditions and brackets" } else { "brackets" };
        Some(format!("{nodes} nest at most {} deep: move the inner part to a sub-policy", m.limit))
    }

    /// The document has more than [`MAX_BYTES`] bytes.
    TooLarge("M0112", Error) { bytes: usize }
    message(m) {
        let mebibytes = 1024.0 * 1024.0;
        #[expect(clippy::cast_precision_loss, reason = "shown with one decimal")]
        let (size, limit) = (m.bytes as f64 / mebibytes, MAX_BYTES as f64 / mebibytes);
        format!("the document has {size:.1} MiB, at most {limit:.0} MiB are read")
    }
    help(_m) { Some("split it into several files".into()) }

    /// The document has more than [`MAX_STEPS`] steps. The span is the first step beyond the limit.
    TooManySteps("M0113", Error) {}
    message(_m) { format!("the document has more than {MAX_STEPS} steps") }
    help(_m) {
        Some("use `repeat` or `each` for similar steps, or split the document into several policies".into())
    }

    /// The bytes are not UTF-8. The span is the first bad byte.
    NotUtf8("M0114", Error) { byte: u8 }
    message(m) { format!("byte {} (0x{:02x}) is not UTF-8", m.span.start, m.byte) }
    help(_m) { Some("save the file as UTF-8".into()) }

    /// The document has nothing but white space and comments.
    Empty("M0115", Error) { wanted: DocumentKind }
    message(_m) { "the document is empty".into() }
    help(m) {
        Some(match m.wanted {
            DocumentKind::Policy => format!(
                "{POLICY}; declarations such as `fluent clean(what: Object)` may stand beside it or alone"
            ),
            DocumentKind::Json => {
                let scene = "{\"motet_scene\": 1, \"entities\": [ … ]}";
                format!("write a JSON object here: a scene is `{scene}`, a state `{{\"free(hand)\": true}}`")
            }
        })
    }

    /// A model's reply holds text around its policy. The span is the first line of that text.
    IgnoredProse("M0116", Warning) { part: IgnoredPart }
    message(m) {
        match m.part {
            IgnoredPart::Prose => "text outside the policy is ignored".into(),
            IgnoredPart::Policy => "a second policy is ignored: only one is read".into(),
        }
    }
    help(_m) { Some("reply with the policy alone".into()) }

    /// The document has more than [`MAX_TOKENS`] words and values. The span is the first beyond the limit.
    TooManyTokens("M0118", Error) {}
    message(_m) { format!("the document has more than {MAX_TOKENS} words and values") }
    help(_m) { Some("split it into several files".into()) }

    /// The document has more than [`MAX_MISTAKES`] mistakes. The span is the first that is not told.
    TooManyMistakes("M0124", Error) {}
    message(_m) { format!("there are more than {MAX_MISTAKES} mistakes: the rest is not reported") }
    help(_m) { Some("mend the first of them, and check again".into()) }

    /// A reply holds no policy. The span is its first line.
    NoDocument("M0119", Error) {}
    message(_m) { "there is no policy in this text".into() }
    help(_m) { Some(POLICY.into()) }
}

impl TextSyntax {
    /// A mistake with a message and help.
    pub(crate) fn new(span: Span, message: String, help: impl Into<String>) -> Self {
        Self { span, message, help: Some(help.into()), related: None, fix: None }
    }
}

/// Help for a document without a policy.
const POLICY: &str = "a policy is written `policy name { … }`, or in JSON \
                      `{\"motet\": 1, \"policy\": \"name\", \"steps\": [ … ]}`";

/// Kind of document that the reader was asked for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum DocumentKind {
    /// A policy or declarations, in either syntax.
    Policy,
    /// A document that has a JSON syntax only: a scene, a state, a fault schedule.
    Json,
}

/// Part of a model's reply that the reader ignores.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum IgnoredPart {
    /// Prose before or after the policy.
    Prose,
    /// A policy beside the one that is read.
    Policy,
}
