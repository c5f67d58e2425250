//! Diagnostics as JSON objects. These types are the format, and `motet schema diagnostic` describes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{escaped_json, file_name, line_column};
use crate::diagnostic::Diagnostic;
use crate::source::{Sources, Span};

/// One message for the author of a document.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Motet diagnostic", rename = "Diagnostic")]
pub struct DiagnosticRecord {
    /// Code such as `M0501`, which `motet explain M0501` explains.
    pub code: String,
    /// `error`, `warning` or `note`.
    #[schemars(extend("enum" = ["error", "warning", "note"]))]
    pub severity: String,
    /// The mistake, in one clause.
    pub message: String,
    /// The text to write instead, where it is known.
    pub help: Option<String>,
    /// Name of the file.
    pub file: String,
    /// JSON Pointer into the JSON form of the policy, whichever form was read; empty for the whole of it.
    pub path: String,
    /// Range in the file.
    pub span: SpanRecord,
    /// Other ranges that explain the message.
    pub related: Vec<RelatedRecord>,
    /// Edits that repair the mistake, where they are sure.
    pub fix: Option<FixRecord>,
    /// Names that the message is about, for programs that act on it.
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
    /// Parameter of the primitive or policy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub parameter: Option<String>,
    /// The fluent, measure or field on which a condition depends: of several the one that fails.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub subject: Option<String>,
    /// Truth value of the subject that the condition asks for.
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

/// Another range that explains the message.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RelatedRecord {
    /// Remark on the range.
    pub message: String,
    /// The file, where it is another one than the diagnostic's.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// JSON Pointer, as in the diagnostic.
    pub path: String,
    /// Range in the file; `null` for a fact outside any file.
    pub span: Option<SpanRecord>,
}

/// Edits that are all to be made together.
#[derive(Clone, PartialEq, Eq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FixRecord {
    /// Title of the fix.
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
    escaped_json(&text)
}
