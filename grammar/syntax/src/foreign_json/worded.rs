//! Steps that are not written in a form of their own: under a word such as `type`, or in the text syntax.

use crate::ast::Item;
use crate::located::Located;
use crate::print;
use crate::source::FileId;
use crate::text;
use crate::words::is_bare_name;

/// A step that does not name its form by a key of its own.
#[derive(Default)]
pub(super) struct WordedStep<'n, 's> {
    /// Key of the form; empty for an object of another shape.
    pub(super) head: &'static str,
    /// Key whose value is the word for the form: `{"type": "if", …}`.
    pub(super) kind: Option<&'n Located<'s>>,
    /// Other keys, each with the key of the form that it stands for.
    pub(super) renamed: Vec<(&'n Located<'s>, &'static str)>,
    /// True for a group of steps without a name.
    pub(super) is_unnamed: bool,
}

/// Steps in JSON, of steps in the text syntax; a word alone is a call. `None` for any other text.
pub(super) fn text_steps(text: &str) -> Option<String> {
    if is_bare_name(text) {
        return Some(format!("{{\"do\": \"{text}\"}}"));
    }
    if !text.contains(['(', ' ']) {
        return None;
    }
    let (file, found) = text::parse(&format!("policy p {{\n{text}\n}}"), FileId::default());
    match file.items.as_slice() {
        [Item::Policy(policy)]
            if found.is_empty() && policy.cleanup.is_none() && !policy.body.steps.is_empty() =>
        {
            Some(print::json_steps(&policy.body))
        }
        _ => None,
    }
}
