//! `fmt`: a document in its own form, canonically laid out, with its comments.

use super::comment::Comments;
use super::writer::Writer;
use crate::diagnostic::{Diagnostic, Severity};
use crate::read::read;
use crate::source::{FileId, Source, Syntax};

/// The document as the canonical printer writes it. In the text form comments stay where they are, on lines
/// of their own or behind what they follow, and so do single blank lines. Formatting twice is formatting
/// once.
///
/// # Errors
/// All diagnostics, where one of them is an error: what cannot be read is not formatted.
pub fn format(source: &Source) -> Result<String, Vec<Diagnostic>> {
    let parsed = read(source, FileId(0));
    if parsed.diagnostics.iter().any(|diagnostic| diagnostic.severity == Severity::Error) {
        return Err(parsed.diagnostics);
    }
    Ok(match parsed.syntax {
        Syntax::Text => {
            // A reply is prose with a document in it: what is ignored there has no comments to keep.
            let text: &str = if parsed.diagnostics.is_empty() { &source.text } else { "" };
            let mut writer = Writer::new(Comments::of(text));
            writer.file(&parsed.file);
            writer.finish()
        }
        Syntax::Json => parsed.file.policies().map(super::policy_json).collect(),
    })
}
