//! The mistakes of the syntax stage (M0101 to M0124): one struct and one code each. Raised by
//! [`crate::read()`] and by the front ends for text and JSON; each becomes a [`Diagnostic`].

mod document;
mod json;

pub(crate) use document::{
    BadTextValue, DocumentKind, Empty, IgnoredPart, IgnoredProse, NoDocument, NotUtf8, TextSyntax, TooDeep,
    TooLarge, TooManyMistakes, TooManySteps, TooManyTokens, UnknownUnit,
};
pub(crate) use json::{
    BadName, BadValue, DuplicateKey, JsonSyntax, MissingKey, NoForm, NumberRange, ReadShape, ReservedKey,
    SyntaxFault, TwoForms, UnknownKey, WrongType,
};

use crate::ast::MAX_MISTAKES;
use crate::diagnostic::{Code, Diagnostic, Edit, Fix, Mistake as _, Severity};
use crate::source::Span;

/// Lists of all codes of the syntax stage, one for each kind of mistake.
pub const CODES: [&[Code]; 2] = [document::CODES, json::CODES];

/// Reports a document of more than [`MAX_BYTES`](crate::ast::MAX_BYTES) bytes (M0112).
#[must_use]
pub fn too_large(span: Span, bytes: usize) -> Diagnostic {
    TooLarge { span, bytes }.into()
}

/// Reports brackets that nest deeper than `limit` levels (M0111).
#[must_use]
pub fn too_deep(span: Span, limit: usize) -> Diagnostic {
    TooDeep { span, limit }.into()
}

/// Returns whether a document was not read to its end because it is too long, or too much of it is wrong.
pub(crate) fn is_cut(found: &[Diagnostic]) -> bool {
    let beyond = [TooManySteps::CODE, TooManyTokens::CODE, TooManyMistakes::CODE];
    found.iter().any(|one| beyond.contains(&one.code))
}

/// Leaves out the errors beyond the [`MAX_MISTAKES`] first in the list, and reports that (M0124).
pub fn limit(found: &mut Vec<Diagnostic>) {
    if found.len() <= MAX_MISTAKES {
        return;
    }
    let (mut errors, mut beyond) = (0, None);
    found.retain(|one| {
        let is_error = one.severity == Severity::Error && one.code != TooManyMistakes::CODE;
        errors += usize::from(is_error);
        let stays = !is_error || errors <= MAX_MISTAKES;
        if !stays && beyond.is_none() {
            beyond = Some(one.span);
        }
        stays
    });
    let is_told = |found: &[Diagnostic]| found.iter().any(|one| one.code == TooManyMistakes::CODE);
    if let Some(span) = beyond.filter(|_| !is_told(found)) {
        found.push(TooManyMistakes { span }.into());
    }
}

/// Fix that replaces a span by one word: "write `pick`".
fn replacement(span: Span, text: &str, word: &str) -> Fix {
    Fix { title: format!("write `{word}`"), edits: vec![Edit { span, text: text.into() }] }
}

#[cfg(test)]
mod tests {
    #[test]
    fn codes_are_declared_once() {
        let mut codes: Vec<&str> =
            super::CODES.iter().flat_map(|codes| codes.iter()).map(|code| code.0).collect();
        codes.sort_unstable();
        let count = codes.len();
        codes.dedup();
        assert_eq!(codes.len(), count);
    }
}
