//! JSON documents: read with their ranges into ordinary serde types. The wire types of a policy are in `wire`
//! and `term`.
//!
//! ```
//! use motet_syntax::json::{self, Spanned};
//! use motet_syntax::{FileId, Source};
//!
//! #[derive(serde::Deserialize, schemars::JsonSchema)]
//! #[serde(deny_unknown_fields)]
//! struct Mug {
//!     name: Spanned<String>,
//!     #[serde(default)]
//!     mass: Option<f64>,
//! }
//!
//! let source = Source::new("mug.json", r#"{"name": "red mug", "mas": 0.3}"#);
//! let (mug, diagnostics) = json::read::<Mug>(&source, FileId(0));
//! let mug = mug.unwrap();
//! assert_eq!(source.slice(mug.name.span), r#""red mug""#);
//! assert_eq!(mug.mass, None);
//! assert_eq!(diagnostics[0].message, "unknown key `mas`");
//! assert_eq!(diagnostics[0].path, "/mas");
//! ```

mod convert;
mod convert_term;
mod edits;
pub(crate) mod term;
pub(crate) mod wire;

use schemars::{JsonSchema, Schema, schema_for};
use serde::Deserialize;
use smol_str::{SmolStr, format_smolstr};

pub(crate) use edits::EditedText;

pub use crate::located::{Fallible, MAX_BRACKETS, Spanned};

use crate::ast::{File, Item, MAX_BYTES};
use crate::diagnostic::{Diagnostic, Severity};
use crate::diagnostics::{
    self, BadValue, DocumentKind, Empty, MissingKey, NoForm, NumberRange, TooLarge, TwoForms, UnknownKey,
    WrongType,
};
use crate::located::{self, Fault, Located, LocatedValue, Mismatch, MismatchKind};
use crate::source::{FileId, Source, Span};
use crate::suggest;

/// Reads a document as a `T`, with all its mistakes.
///
/// A value comes with errors where the reading could go on: a duplicate key (the first counts), an unknown
/// key (it is skipped), a mistake in a [`Fallible`]. No value comes without an error. Structs are closed even
/// without `deny_unknown_fields`. Paths are JSON Pointers. O(bytes).
#[must_use]
pub fn read<'s, T: Deserialize<'s> + JsonSchema>(
    source: &'s Source,
    file: FileId,
) -> (Option<T>, Vec<Diagnostic>) {
    let (tree, mut found) = match parse(&source.text, file) {
        Ok(parsed) => parsed,
        Err(found) => return (None, found),
    };
    let value = deserialize(&tree, &tree, &mut found);
    (value, found)
}

/// JSON Schema of a policy: the format that [`crate::read()`] accepts.
#[must_use]
pub fn policy_schema() -> Schema {
    schema_for!(wire::Document)
}

/// Reading of the shapes of a document: of its tree and text, by the schema of a policy.
pub(crate) type ShapeReading =
    fn(&Located<'_>, &str, &serde_json::Value) -> Option<(EditedText, Vec<Diagnostic>)>;

/// Result of reading a policy.
#[derive(Default)]
pub(crate) struct PolicyDocument {
    /// File with one item; empty where the policy could not be read.
    pub(crate) file: File,
    pub(crate) found: Vec<Diagnostic>,
    /// The document as it is written, if shapes of it were read as others.
    pub(crate) written: Option<Located<'static>>,
}

/// Reads a policy. If the plain reading has errors, `plain_form` reads shapes that models write: it returns
/// the document in the form of the language with a note for each shape, or `None` where it has no shape.
pub(crate) fn read_policy(text: &str, file: FileId, plain_form: ShapeReading) -> PolicyDocument {
    let (tree, found) = match parse(text, file) {
        Ok(parsed) => parsed,
        Err(found) => match objects(text, file) {
            Some(tree) => (tree, Vec::new()),
            None => return PolicyDocument { found, ..PolicyDocument::default() },
        },
    };
    // A duplicate is not in the tree, so its text cannot be edited.
    let has_duplicates = !found.is_empty();
    let plain = policy_of_tree(&tree, &tree, found);
    if has_duplicates || plain.found.iter().all(|found| found.severity != Severity::Error) {
        return plain;
    }
    let schema = policy_schema().to_value();
    let Some((edited, notes)) = plain_form(&tree, text, &schema) else { return plain };
    let moved = |mut found: Vec<Diagnostic>| {
        found.iter_mut().for_each(|found| edited.move_diagnostic(found));
        found
    };
    let mut read = match parse(&edited.text, file) {
        Ok((mut edited_tree, found)) => {
            let found = moved(found);
            edited.move_tree(&mut edited_tree);
            policy_of_tree(&edited_tree, &tree, found)
        }
        Err(found) => PolicyDocument { found: moved(found), ..PolicyDocument::default() },
    };
    read.found.extend(notes);
    read.settle(&tree);
    PolicyDocument { written: Some(tree.into_owned()), ..read }
}

/// Maximal number of objects that are read one after the other.
const MAX_OBJECTS: usize = 256;

/// Objects that stand one after the other, without brackets around them, as a list of them; `None` for
/// anything else, and for policies.
#[cold]
fn objects(text: &str, file: FileId) -> Option<Located<'static>> {
    let mut items: Vec<Located<'static>> = Vec::new();
    let mut at = text.len() - text.trim_start().len();
    while text.get(at..)?.starts_with('{') {
        let end = located::end_of_value(text, at)?;
        // The spans are those of the whole text.
        let before = text.get(..at)?.bytes().map(|byte| if byte == b'\n' { '\n' } else { ' ' });
        let alone: String = before.chain(text.get(at..end)?.chars()).collect();
        let (object, found) = located::parse_json(&alone, file);
        let object = object.filter(|_| found.is_empty())?.into_owned();
        let is_part = |key: &str| ["motet", "policy", "steps"].contains(&key);
        let is_policy = object.members().iter().any(|(key, _)| key.text().is_some_and(is_part));
        if is_policy || items.len() >= MAX_OBJECTS {
            return None;
        }
        items.push(object);
        let rest = text.get(end..)?.trim_start();
        at = text.len() - rest.strip_prefix(',').map_or(rest, str::trim_start).len();
    }
    let (first, last) = (items.first()?, items.last()?);
    let span = first.span.to(last.span);
    (items.len() > 1 && at == text.len()).then_some(Located { span, value: LocatedValue::Array(items) })
}

impl PolicyDocument {
    /// Sorts the diagnostics, and gives each its pointer into the document as it is written.
    fn settle(&mut self, written: &Located<'_>) {
        in_order(&mut self.found);
        for diagnostic in self.found.iter_mut().filter(|diagnostic| diagnostic.path.is_empty()) {
            diagnostic.path = written.pointer_at(diagnostic.span);
        }
    }
}

/// Sorts the diagnostics of a document, and leaves out what is too much.
fn in_order(found: &mut Vec<Diagnostic>) {
    found.sort_by_key(|diagnostic| diagnostic.span.start);
    diagnostics::limit(found);
}

/// Reads the policy of a tree; pointers lead into `written`.
fn policy_of_tree(tree: &Located<'_>, written: &Located<'_>, mut found: Vec<Diagnostic>) -> PolicyDocument {
    let document: Option<Spanned<wire::Document>> = deserialize(tree, written, &mut found);
    let Some(document) = document else { return PolicyDocument { found, ..PolicyDocument::default() } };
    let (policy, mistakes) = convert::policy(document, tree.span.file);
    // The conversion knows more than the schema: of two reports of one mistake its own stays.
    found.retain(|one| !mistakes.iter().any(|other| (other.code, other.span) == (one.code, one.span)));
    found.extend(mistakes);
    let file = File { items: vec![Item::Policy(policy)] };
    let mut read = PolicyDocument { file, found, written: None };
    read.settle(written);
    read
}

/// Parses a document into its tree, with the duplicates of its keys; `Err` if it has no tree.
fn parse(text: &str, file: FileId) -> Result<(Located<'_>, Vec<Diagnostic>), Vec<Diagnostic>> {
    let start = Span::new(file, 0, 0);
    if text.len() > MAX_BYTES {
        return Err(vec![TooLarge { span: start, bytes: text.len() }.into()]);
    }
    if text.trim_ascii().is_empty() {
        return Err(vec![Empty { span: start, wanted: DocumentKind::Json }.into()]);
    }
    match located::parse_json(text, file) {
        (Some(tree), found) => Ok((tree, found)),
        (None, found) => Err(found),
    }
}

/// Deserializes a tree, and adds its mistakes in the order of the document.
fn deserialize<'s, T: Deserialize<'s> + JsonSchema>(
    tree: &Located<'s>,
    written: &Located<'_>,
    found: &mut Vec<Diagnostic>,
) -> Option<T> {
    let (value, faults) = located::deserialize(tree);
    if !faults.is_empty() {
        found.extend(explain::<T>(tree, written, faults));
        in_order(found);
    }
    value
}

/// Reports what serde refused: by the schema of the type, and in serde's words where no schema shows it.
#[cold]
fn explain<T: JsonSchema>(tree: &Located<'_>, written: &Located<'_>, faults: Vec<Fault>) -> Vec<Diagnostic> {
    let schema = schema_for!(T).to_value();
    let mismatches = located::check_schema(tree, &schema);
    let is_shown = !mismatches.is_empty();
    let is_edited = !std::ptr::eq(tree, written);
    let mut found: Vec<Diagnostic> = mismatches
        .into_iter()
        .map(|mut mismatch| {
            if is_edited {
                mismatch.pointer = written.pointer_at(mismatch.node.span);
            }
            diagnostic(mismatch)
        })
        .collect();
    for fault in faults.into_iter().filter(|fault| fault.is_custom || !is_shown) {
        let span = fault.span.unwrap_or(tree.span);
        let mut refused: Diagnostic = BadValue::new(span, fault.message).into();
        refused.path = written.pointer_at(span);
        found.push(refused);
    }
    found
}

fn diagnostic(mismatch: Mismatch<'_>) -> Diagnostic {
    let Mismatch { node, pointer, kind } = mismatch;
    let span = node.span;
    let text = || SmolStr::new(node.text().unwrap_or(""));
    let owned = |words: Vec<&str>| -> Vec<SmolStr> { words.into_iter().map(SmolStr::new).collect() };
    let mut diagnostic: Diagnostic = match kind {
        MismatchKind::UnknownKey { known, .. } => {
            UnknownKey { key: text(), span, expected: owned(known) }.into()
        }
        MismatchKind::MissingKey { key } => MissingKey { key: key.into(), span: node.head() }.into(),
        MismatchKind::WrongType { types, words, name } => {
            let expected = match name {
                Some(name) => format!("an object that is a {}", name.to_lowercase()),
                None => located::phrase(&types, &words),
            };
            WrongType { span, expected: expected.into(), found: phrase(node) }.into()
        }
        MismatchKind::WrongLength { expected, found } => {
            let found = if found == 1 { "one".into() } else { format_smolstr!("{found}") };
            WrongType { span, expected: format_smolstr!("an array of {expected} elements"), found }.into()
        }
        MismatchKind::OutOfRange { least, greatest } => {
            let expected = match greatest {
                Some(greatest) => format_smolstr!("a whole number from {least} to {greatest}"),
                None => format_smolstr!("a whole number from {least}"),
            };
            NumberRange { span, found: number(node), expected: Some(expected) }.into()
        }
        MismatchKind::UnknownWord { known } => {
            let message = format!("`{}` is not known here", text());
            BadValue { expected: owned(known), found: text(), ..BadValue::new(span, message) }.into()
        }
        MismatchKind::NoForm { forms } => {
            let meant = node.members().iter().find_map(|(key, _)| {
                let meant = suggest::closest(key.text()?, forms.iter().copied())?;
                Some((key.span, (SmolStr::new(key.text()?), SmolStr::new(meant))))
            });
            let span = meant.as_ref().map_or(node.head(), |(span, _)| *span);
            NoForm { span, forms: owned(forms), meant: meant.map(|(_, meant)| meant) }.into()
        }
        MismatchKind::TwoForms { first } => TwoForms {
            span,
            first: first.text().unwrap_or("").into(),
            first_span: first.span,
            second: text(),
        }
        .into(),
    };
    diagnostic.path = pointer;
    diagnostic
}

/// A value as a message calls it, with its article.
fn phrase(node: &Located<'_>) -> SmolStr {
    match &node.value {
        LocatedValue::Null => "`null`".into(),
        LocatedValue::Bool(value) => format_smolstr!("`{value}`"),
        LocatedValue::Number(_) => format_smolstr!("the number `{}`", number(node)),
        LocatedValue::Text(text) if text.chars().count() <= 40 => format_smolstr!("the string `{text}`"),
        LocatedValue::Text(_) => "a string".into(),
        LocatedValue::Date => "a date".into(),
        LocatedValue::Array(_) => "an array".into(),
        LocatedValue::Object(_) => "an object".into(),
    }
}

fn number(node: &Located<'_>) -> SmolStr {
    match &node.value {
        LocatedValue::Number(number) => format_smolstr!("{number}"),
        _ => SmolStr::default(),
    }
}
