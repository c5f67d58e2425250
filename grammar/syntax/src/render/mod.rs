//! Diagnostics for people and for tools, one format a file. Nothing here prints: the host writes the text out.

mod excerpt;
mod github;
mod human;
mod json;
mod llm;
mod sarif;

pub use github::github;
pub use human::{Color, human};
pub use json::{EditRecord, FixRecord, Record, RelatedRecord, SpanRecord, json, record};
pub use llm::{MAX_CHARS, llm};
pub use sarif::{Help, sarif};

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

/// Line and column of one past a span's last byte, from 1.
fn end_line_column(sources: &Sources, span: Span) -> (usize, usize) {
    source(sources, span).map_or((1, 1), |source| source.line_column(span.end))
}
