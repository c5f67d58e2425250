//! Entry point of the front end: bytes to text, and a document in either syntax, or a reply that holds one,
//! to the tree.

use std::sync::Arc;

use crate::ast::{File, MAX_BYTES};
use crate::diagnostic::Diagnostic;
use crate::errors::{IgnoredPart, IgnoredProse, NoDocument, NotUtf8, TooLarge};
use crate::reply::{self, Reply};
use crate::source::{FileId, Source, Span, Syntax};
use crate::{json, text};

/// A document after reading, with its diagnostics.
#[derive(Clone, Debug)]
pub struct Parsed {
    /// Declarations; of a JSON document one policy. After an error all that could be read.
    pub file: File,
    pub syntax: Syntax,
    /// Text that the spans refer to.
    pub text: Arc<str>,
    /// Errors and warnings in the order of the document.
    pub diagnostics: Vec<Diagnostic>,
}

/// Reads a document. Its first character says which form it is in: JSON begins with `{` or `[`. A document in
/// a Markdown fence or between prose is found, and what is ignored is a warning. O(bytes), no recursion
/// deeper than [`crate::ast::MAX_NESTING`] allows, and no panic on any text.
#[must_use]
pub fn read(source: &Source, file: FileId) -> Parsed {
    let document: &str = &source.text;
    if document.len() > MAX_BYTES {
        let mistake = TooLarge { span: Span::new(file, 0, 0), bytes: document.len() };
        let (syntax, text) = (syntax_of(document), Arc::clone(&source.text));
        return Parsed { file: File::default(), syntax, text, diagnostics: vec![mistake.into()] };
    }
    let parsed = match document.strip_prefix(BOM) {
        Some(rest) => located(&format!("{BLANK_BOM}{rest}"), file),
        None => located(document, file),
    };
    Parsed { text: Arc::clone(&source.text), ..parsed }
}

/// Decodes a file to text. A byte order mark is blanked out, so that offsets stay those of the bytes.
///
/// # Errors
/// Bytes that are not UTF-8, with the offset of the first, and more than [`MAX_BYTES`] of them.
pub fn decode(bytes: &[u8], file: FileId) -> Result<String, Box<Diagnostic>> {
    if bytes.len() > MAX_BYTES {
        return Err(Box::new(TooLarge { span: Span::new(file, 0, 0), bytes: bytes.len() }.into()));
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(match text.strip_prefix(BOM) {
            Some(rest) => format!("{BLANK_BOM}{rest}"),
            None => text.into(),
        }),
        Err(error) => {
            let at = error.valid_up_to();
            let byte = bytes.get(at).copied().unwrap_or(0);
            Err(Box::new(NotUtf8 { span: Span::new(file, at, at + 1), byte }.into()))
        }
    }
}

const BOM: char = '\u{feff}';
const BLANK_BOM: &str = "   ";

/// Reads a document that may be part of a reply.
fn located(document: &str, file: FileId) -> Parsed {
    match reply::locate(document) {
        Reply::Whole => whole(document, file),
        Reply::Part(found) => {
            let mut parsed = whole(&reply::blanked(document, &found), file);
            let prose = found.ignored.iter().map(|place| (place, IgnoredPart::Prose));
            let ignored = prose.chain(found.others.iter().map(|place| (place, IgnoredPart::Policy)));
            parsed.diagnostics.extend(ignored.map(|((start, end), part)| {
                Diagnostic::from(IgnoredProse { span: Span::new(file, *start, *end), part })
            }));
            parsed.diagnostics.sort_by_key(|diagnostic| diagnostic.span.start);
            parsed
        }
        Reply::Prose => {
            let start = document.len() - document.trim_start().len();
            let line = document.trim_start().lines().next().unwrap_or("").trim_end();
            let mistake = NoDocument { span: Span::new(file, start, start + line.len()) };
            let text = Arc::default();
            Parsed { file: File::default(), syntax: Syntax::Text, text, diagnostics: vec![mistake.into()] }
        }
    }
}

fn whole(document: &str, file: FileId) -> Parsed {
    let syntax = syntax_of(document);
    let (file, diagnostics) = match syntax {
        Syntax::Text => text::parse(document, file),
        Syntax::Json => json::read_policy(document, file),
    };
    Parsed { file, syntax, text: Arc::default(), diagnostics }
}

/// Syntax of a document, by its first character.
fn syntax_of(document: &str) -> Syntax {
    match document.trim_start().bytes().next() {
        Some(b'{' | b'[') => Syntax::Json,
        Some(_) | None => Syntax::Text,
    }
}
