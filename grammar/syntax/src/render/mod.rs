//! Diagnostics for people and for tools, one format a file. Nothing here prints: the host writes the text
//! out.

mod human;
mod json;
mod llm;
mod sarif;

pub use human::{ColorChoice, human};
pub use json::{DiagnosticRecord, EditRecord, FixRecord, RelatedRecord, SpanRecord, json, record};
pub use llm::{MAX_CHARS, capital, llm};
pub use sarif::{CodePage, github, sarif};

use crate::source::{Source, Sources, Span};

/// The file of a span, where there is one.
fn source(sources: &Sources, span: Span) -> Option<&Source> {
    sources.get(span.file)
}

/// The name of the file of a span; empty where there is none.
fn file_name(sources: &Sources, span: Span) -> &str {
    source(sources, span).map_or("", |source| &source.name)
}

/// Line and column of a span's first byte, from 1.
fn line_column(sources: &Sources, span: Span) -> (usize, usize) {
    source(sources, span).map_or((1, 1), |source| source.line_column(span.start))
}

/// Line and column of the first byte of a span and of one past its last, from 1, in the file that tools open:
/// of a document that is a line of a file that is the whole file.
fn region(sources: &Sources, span: Span) -> [(usize, usize); 2] {
    let Some(source) = source(sources, span) else { return [(1, 1); 2] };
    let (_, before) = source.file();
    [span.start, span.end].map(|offset| {
        let (line, column) = source.line_column(offset);
        (line + before, column)
    })
}

/// The name of the file that tools open; empty where there is none.
fn tool_file(sources: &Sources, span: Span) -> &str {
    source(sources, span).map_or("", |source| source.file().0)
}
