//! JSON documents: read with their places into ordinary serde types. What a policy looks like in JSON is in `wire`.
//!
//! ```
//! use motet_syntax::json::{self, Spanned};
//! use motet_syntax::{FileId, Source};
//!
//! #[derive(serde::Deserialize)]
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

mod access;
mod convert;
mod convert_term;
mod de;
mod fault;
mod lenient;
mod parse;
mod scan;
mod schema;
mod spanned;
pub(crate) mod term;
mod tree;
pub(crate) mod wire;

use std::cell::RefCell;

use serde::Deserialize;

pub use lenient::Lenient;
pub use spanned::Spanned;
pub(crate) use tree::push_escaped;

use crate::ast::{File, Item, MAX_BYTES, MAX_NESTING};
use crate::diagnostic::Diagnostic;
use crate::errors::{DocumentKind, Empty, TooLarge};
use crate::source::{FileId, Source, Span};

/// How deep brackets may nest in a JSON document. One block of a policy takes up to four: the handlers of a `try` are an
/// object in an array in an object in an array.
pub const MAX_BRACKETS: usize = 4 * MAX_NESTING + 8;

/// Reads a document as a `T`, with everything that is wrong with it.
///
/// A value comes with errors where the reading could go on: a duplicate key (the first counts), an unknown key (it is
/// skipped), a fault in a [`Lenient`]. No value comes without an error. Structs are closed even without
/// `deny_unknown_fields`. Paths are JSON Pointers. O(bytes).
#[must_use]
pub fn read<'s, T: Deserialize<'s>>(source: &'s Source, file: FileId) -> (Option<T>, Vec<Diagnostic>) {
    read_str(&source.text, file)
}

/// [`read`] of a text that is no source of its own.
pub(crate) fn read_str<'s, T: Deserialize<'s>>(text: &'s str, file: FileId) -> (Option<T>, Vec<Diagnostic>) {
    let (value, _, found) = read_tree(text, file);
    (value, found)
}

/// [`read_str`], with the tree where the syntax is right, so that a later stage can find its pointers.
fn read_tree<'s, T: Deserialize<'s>>(
    text: &'s str,
    file: FileId,
) -> (Option<T>, Option<tree::Tree<'s>>, Vec<Diagnostic>) {
    let start = Span::new(file, 0, 0);
    if text.len() > MAX_BYTES {
        return (None, None, vec![TooLarge { span: start, bytes: text.len() }.into()]);
    }
    if text.trim_ascii().is_empty() {
        return (None, None, vec![Empty { span: start, wanted: DocumentKind::Json }.into()]);
    }
    let (tree, mut found) = parse::parse(text, file);
    let Some(tree) = tree else { return (None, None, found) };
    // So far only duplicate keys, which are not in the tree: the first of the two tells where.
    for duplicate in &mut found {
        let first = duplicate.related.first().and_then(|related| related.span);
        duplicate.path = first.map(|span| tree.pointer_at(span)).unwrap_or_default();
    }
    let context = de::Context { tree, sink: RefCell::default() };
    let value = match T::deserialize(de::Value { context: &context, at: 0 }) {
        Ok(value) => Some(value),
        Err(fault) => {
            context.sink.borrow_mut().push(fault);
            None
        }
    };
    let de::Context { tree, sink } = context;
    found.extend(sink.into_inner().into_iter().map(|fault| fault.diagnostic(&tree)));
    found.sort_by_key(|diagnostic| diagnostic.span.start);
    (value, Some(tree), found)
}

/// Reads a policy into a file with one item; none where it could not be read.
pub(crate) fn read_policy(text: &str, file: FileId) -> (File, Vec<Diagnostic>) {
    let (document, tree, mut found) = read_tree::<Spanned<wire::Document>>(text, file);
    let Some(document) = document else { return (File::default(), found) };
    let (policy, mistakes) = convert::policy(document, file);
    found.extend(mistakes);
    for diagnostic in &mut found {
        if let Some(tree) = tree.as_ref().filter(|_| diagnostic.path.is_empty()) {
            diagnostic.path = tree.pointer_at(diagnostic.span);
        }
    }
    found.sort_by_key(|diagnostic| diagnostic.span.start);
    (File { items: vec![Item::Policy(policy)] }, found)
}

/// JSON Schema of a policy: the format that [`crate::read()`] accepts.
#[must_use]
pub fn policy_schema() -> schemars::Schema {
    schemars::schema_for!(wire::Document)
}
