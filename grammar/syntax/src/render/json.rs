//! Diagnostics as JSON objects. These types are the format, and `motet schema diagnostic` describes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{file_name, line_column};
use crate::diagnostic::Diagnostic;
use crate::source::{Sources, Span};

/// One finding.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Motet diagnostic", rename = "Diagnostic")]
pub struct DiagnosticRecord {
    /// Its code, `M0501`: `motet explain M0501` tells more.
    pub code: String,
    /// `error`, `warning` or `note`.
    #[schemars(extend("enum" = ["error", "warning", "note"]))]
    pub severity: String,
    /// What is wrong.
    pub message: String,
    /// What to write instead, where it is known.
    pub help: Option<String>,
    /// The file.
    pub file: String,
    /// JSON Pointer into the JSON form of the policy, whichever form was read; empty for the whole of it.
    pub path: String,
    /// Where in the file.
    pub span: SpanRecord,
    /// Other places that belong to the story.
    pub related: Vec<RelatedRecord>,
    /// Edits that mend it, where they are sure.
    pub fix: Option<FixRecord>,
    /// What it is about, in names, for programs that act on it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub about: Option<AboutRecord>,
}

/// The names that a finding is about.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AboutRecord {
    /// The primitive or policy that is called.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub primitive: Option<String>,
    /// Its parameter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// The fluent, measure or field on which a condition depends: of several the one that fails.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// Whether the condition asks for the subject to hold, or not to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wanted: Option<bool>,
}

/// A range of bytes in a file.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpanRecord {
    /// Offset of the first byte.
    pub start: u32,
    /// Offset of one past the last byte.
    pub end: u32,
    /// Line of the first byte, from 1.
    pub line: usize,
    /// Column of the first byte in characters, from 1.
    pub column: usize,
}

/// Another place.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RelatedRecord {
    /// What is there.
    pub message: String,
    /// The file, where it is another one than the diagnostic's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// JSON Pointer, as in the diagnostic.
    pub path: String,
    /// Where in the file; `null` for something outside any file.
    pub span: Option<SpanRecord>,
}

/// Edits that are all to be made together.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixRecord {
    /// What they do.
    pub title: String,
    /// Replacements that do not overlap.
    pub edits: Vec<EditRecord>,
}

/// The replacement of a range of bytes.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EditRecord {
    /// Offset of the first byte that is replaced.
    pub start: u32,
    /// Offset of one past the last byte that is replaced.
    pub end: u32,
    /// The new text.
    pub text: String,
}

/// A diagnostic as it is written out.
#[must_use]
pub fn record(diagnostic: &Diagnostic, sources: &Sources) -> DiagnosticRecord {
    let span = |span: Span| {
        let (line, column) = line_column(sources, span);
        SpanRecord { start: span.start, end: span.end, line, column }
    };
    let related = diagnostic.related.iter().map(|related| RelatedRecord {
        message: related.message.clone(),
        file: related
            .span
            .filter(|span| span.file != diagnostic.span.file)
            .map(|span| file_name(sources, span).into()),
        path: related.path.clone(),
        span: related.span.map(span),
    });
    let fix = diagnostic.fix.as_ref().map(|fix| FixRecord {
        title: fix.title.clone(),
        edits: fix
            .edits
            .iter()
            .map(|edit| EditRecord { start: edit.span.start, end: edit.span.end, text: edit.text.clone() })
            .collect(),
    });
    DiagnosticRecord {
        code: diagnostic.code.0.into(),
        severity: diagnostic.severity.name().into(),
        message: diagnostic.message.clone(),
        help: diagnostic.help.clone(),
        file: file_name(sources, diagnostic.span).into(),
        path: diagnostic.path.clone(),
        span: span(diagnostic.span),
        related: related.collect(),
        fix,
        about: diagnostic.about.as_ref().map(|about| {
            let name = |name: &Option<smol_str::SmolStr>| name.as_ref().map(ToString::to_string);
            AboutRecord {
                primitive: name(&about.primitive),
                parameter: name(&about.parameter),
                subject: name(&about.subject),
                wanted: about.wanted,
            }
        }),
    }
}

/// All diagnostics, one object a line.
#[must_use]
pub fn json(diagnostics: &[Diagnostic], sources: &Sources) -> String {
    let mut text = String::new();
    for diagnostic in diagnostics {
        // A record is strings and numbers: writing it cannot fail.
        text.push_str(&serde_json::to_string(&record(diagnostic, sources)).unwrap_or_default());
        text.push('\n');
    }
    text
}
