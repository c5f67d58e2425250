//! A document on its way in: bytes to text, text to the syntax tree.

use motet_syntax::ast::File;
use motet_syntax::errors::too_large;
use motet_syntax::{Diagnostic, FileId, Parsed, Source, Span, Syntax};

use crate::input::{Bytes, Document};
use crate::workbench::DOCUMENT;

/// Turns bytes into a source, with what is wrong with them as text.
#[must_use]
pub(crate) fn decode(name: &str, bytes: &[u8], file: FileId) -> (Source, Vec<Diagnostic>) {
    match motet_syntax::decode(bytes, file) {
        Ok(text) => (Source::new(name, text), Vec::new()),
        Err(said) => (Source::new(name, String::from_utf8_lossy(bytes)), vec![*said]),
    }
}

/// Reads a document.
#[must_use]
pub(crate) fn read(document: &Document) -> (Source, Parsed) {
    match &document.bytes {
        Bytes::All(bytes) => {
            let (source, said) = decode(&document.name, bytes, DOCUMENT);
            let source = in_its_file(source, document);
            let parsed = if said.is_empty() { motet_syntax::read(&source, DOCUMENT) } else { nothing(said) };
            (source, parsed)
        }
        Bytes::TooMany(bytes) => {
            let mistake = too_large(Span::new(DOCUMENT, 0, 0), *bytes);
            (in_its_file(Source::new(document.name.as_str(), ""), document), nothing(vec![mistake]))
        }
    }
}

fn in_its_file(source: Source, document: &Document) -> Source {
    match &document.line_of {
        Some((file, line)) => source.as_line(file.as_str(), *line),
        None => source,
    }
}

/// Whether text stands beside the policy: in a rewritten document it would be missing.
#[must_use]
pub(crate) fn is_reply(parsed: &Parsed) -> bool {
    parsed.diagnostics.iter().any(|said| said.code.0 == "M0116")
}

/// What is read of a document that is no text.
fn nothing(diagnostics: Vec<Diagnostic>) -> Parsed {
    Parsed { file: File::default(), syntax: Syntax::Text, text: Default::default(), diagnostics }
}
