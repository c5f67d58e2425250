//! The entry point: a document of either form to the AST.

use crate::ast::{File, MAX_BYTES};
use crate::diagnostic::Diagnostic;
use crate::errors::TooLarge;
use crate::source::{FileId, Form, Source, Span};
use crate::{json, text};

/// What a document says, and what is wrong with it.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// The declarations; of a JSON document one policy. After an error whatever could be read.
    pub file: File,
    /// The form that the document is in.
    pub form: Form,
    /// Errors and warnings in the order of the document.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a document. Its first character says which form it is in: JSON begins with `{` or `[`. O(bytes), no recursion
/// deeper than [`crate::ast::MAX_NESTING`] allows, and no panic on any text.
#[must_use]
pub fn read(source: &Source, file: FileId) -> Parsed {
    let document: &str = &source.text;
    let form = form(document);
    if document.len() > MAX_BYTES {
        let mistake = TooLarge { span: Span::new(file, 0, 0), bytes: document.len() };
        return Parsed { file: File::default(), form, diagnostics: vec![mistake.into()] };
    }
    let (file, diagnostics) = match form {
        Form::Text => text::parse(document, file),
        Form::Json => json::read_policy(document, file),
    };
    Parsed { file, form, diagnostics }
}

/// The form of a document by its first character.
fn form(document: &str) -> Form {
    match document.trim_start().bytes().next() {
        Some(b'{' | b'[') => Form::Json,
        Some(_) | None => Form::Text,
    }
}
