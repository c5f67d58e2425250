//! Check of a card's keys and types: its TOML tree as a located tree, compared with the schema of the wire
//! types, so that every wrong key is reported at once and at its place. Numbers and names are checked later,
//! by the reader.

use motet_syntax::ast::MAX_MISTAKES;
use motet_syntax::located::{Located, LocatedValue, Mismatch, MismatchKind, Number, check_schema};
use motet_syntax::{Diagnostic, FileId, Span, suggest};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::diagnostics::{MissingKey, UnknownKey, UnknownWord, WrongType};
use super::wire::schema;

/// Diagnostics for the parts of a document that do not fit the schema of a card.
pub(super) fn check(document: &Spanned<DeTable<'_>>, file: FileId) -> Vec<Diagnostic> {
    let schema = schema().to_value();
    // A key that the whole card lacks has no place in it: the beginning stands for it.
    let tree = Located { value: table(document.get_ref(), file), span: Span::new(file, 0, 0) };
    check_schema(&tree, &schema).into_iter().map(diagnostic).collect()
}

fn located<'t>(value: &'t Spanned<DeValue<'_>>, file: FileId) -> Located<'t> {
    let located_value = match value.get_ref() {
        DeValue::String(text) => LocatedValue::Text((&**text).into()),
        // Only its kind is looked at here: the value is read by serde.
        DeValue::Integer(_) => LocatedValue::Number(Number::Unsigned(0)),
        DeValue::Float(_) => LocatedValue::Number(Number::Float(0.5)),
        DeValue::Boolean(value) => LocatedValue::Bool(*value),
        DeValue::Datetime(_) => LocatedValue::Date,
        DeValue::Array(items) => LocatedValue::Array(items.iter().map(|item| located(item, file)).collect()),
        DeValue::Table(inner) => table(inner, file),
    };
    Located { value: located_value, span: span(value, file) }
}

fn table<'t>(table: &'t DeTable<'_>, file: FileId) -> LocatedValue<'t> {
    let member = |(key, value): (&'t Spanned<_>, &'t Spanned<DeValue<'_>>)| {
        let text: &'t toml::de::DeString<'_> = key.get_ref();
        (Located { value: LocatedValue::Text((&**text).into()), span: span(key, file) }, located(value, file))
    };
    LocatedValue::Object(table.iter().map(member).collect())
}

fn span<T>(value: &Spanned<T>, file: FileId) -> Span {
    let range = value.span();
    Span::new(file, range.start, range.end)
}

fn diagnostic(mismatch: Mismatch<'_>) -> Diagnostic {
    let Mismatch { node, pointer, kind } = mismatch;
    let (span, key) = (node.span, dotted(&pointer));
    let text = || node.text().unwrap_or("").to_owned();
    let owned = |words: Vec<&str>| words.into_iter().map(str::to_owned).collect();
    let near = |known: &[&str]| suggest::closest(&text(), known.iter().copied()).map(str::to_owned);
    let wrong =
        |wanted: String| WrongType { span, key: key.clone(), found: kind_of(node).to_owned(), wanted }.into();
    match kind {
        MismatchKind::UnknownKey { object, mut known } => {
            let near = near(&known);
            // Of a section with very many keys the first are enough to tell what may be missing.
            let written = object.members().iter().take(MAX_MISTAKES);
            known.retain(|key| !written.clone().any(|(written, _)| written.text() == Some(*key)));
            UnknownKey { span, key: text(), near, known: owned(known) }.into()
        }
        MismatchKind::MissingKey { key: missing } => {
            MissingKey { span, key: missing.to_owned(), section: key }.into()
        }
        MismatchKind::UnknownWord { known } => {
            UnknownWord { span, word: text(), near: near(&known), known: owned(known) }.into()
        }
        MismatchKind::WrongType { types, words, .. } if types.is_empty() => wrong(suggest::one_of(words)),
        MismatchKind::WrongType { types, .. } => {
            let types: Vec<&str> = types.into_iter().map(kind_of_type).collect();
            wrong(types.join(" or "))
        }
        MismatchKind::WrongLength { expected, .. } => wrong(format!("a list of {expected} elements")),
        MismatchKind::OutOfRange { least, .. } => wrong(format!("a whole number from {least}")),
        MismatchKind::NoForm { forms } => wrong(format!("a section with {}", suggest::one_of(forms))),
        MismatchKind::TwoForms { .. } => wrong("a section of one form".to_owned()),
    }
}

/// A JSON Pointer as the dotted key that the author writes; the elements of a list have the key of the list.
fn dotted(pointer: &str) -> String {
    let keys = pointer.split('/').skip(1).filter(|token| token.parse::<usize>().is_err());
    let keys: Vec<String> = keys.map(|token| token.replace("~1", "/").replace("~0", "~")).collect();
    keys.join(".")
}

fn kind_of(node: &Located<'_>) -> &'static str {
    match &node.value {
        LocatedValue::Text(_) => "a text",
        LocatedValue::Number(Number::Float(_)) => "a number",
        LocatedValue::Number(_) => "a whole number",
        LocatedValue::Bool(_) | LocatedValue::Null => "a truth value",
        LocatedValue::Date => "a date",
        LocatedValue::Array(_) => "a list",
        LocatedValue::Object(_) => "a section",
    }
}

fn kind_of_type(kind: &str) -> &str {
    match kind {
        "string" => "a text",
        "integer" | "unsigned" => "a whole number",
        "number" => "a number",
        "boolean" => "a truth value",
        "array" => "a list",
        "object" => "a section",
        other => other,
    }
}
