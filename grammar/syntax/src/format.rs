//! The formatter: reads a document, and writes it as the canonical printer does.

use crate::diagnostic::{Diagnostic, Severity};
use crate::print;
use crate::read::read;
use crate::source::{FileId, Source, Syntax};

/// The document as the canonical printer writes it. In the text syntax comments stay where they are, on lines
/// of their own or behind what they follow, and so do single blank lines. Formatting twice is formatting
/// once.
///
/// ```
/// use motet_syntax::{Source, format};
///
/// let source = Source::new("p.motet", "policy p{go(sink)}");
/// assert_eq!(format(&source).unwrap(), "policy p {\n    go(sink)\n}\n");
/// ```
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
            print::commented(&parsed.file, text)
        }
        Syntax::Json => parsed.file.policies().map(print::policy_json).collect(),
    })
}
