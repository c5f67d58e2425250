//! Diagnostics for code hosting: a SARIF 2.1.0 log, for code scanning services, and workflow commands of
//! GitHub Actions.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::{escaped, escaped_json, region, tool_file};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{Source, Sources, Span};

/// Documentation of one diagnostic code.
#[derive(Clone, Copy, Debug)]
pub struct CodePage<'h> {
    /// Title of a few words.
    pub title: &'h str,
    pub markdown: &'h str,
}

/// One log with one run of the tool `motet`. `help` returns the page of a code, where there is one.
#[must_use]
pub fn sarif<'h>(
    diagnostics: &[Diagnostic],
    sources: &Sources,
    help: &dyn Fn(&str) -> Option<CodePage<'h>>,
) -> String {
    let codes: BTreeMap<&str, usize> = diagnostics.iter().map(|diagnostic| (diagnostic.code.0, 0)).collect();
    let codes: BTreeMap<&str, usize> =
        codes.into_keys().enumerate().map(|(index, code)| (code, index)).collect();
    let rules: Vec<Value> = codes.keys().map(|code| rule(code, help(code))).collect();
    let results: Vec<Value> = diagnostics
        .iter()
        .map(|diagnostic| result(diagnostic, codes.get(diagnostic.code.0).copied(), sources))
        .collect();
    let log = json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": {"driver": {
                "name": "motet",
                "version": env!("CARGO_PKG_VERSION"),
                "rules": rules,
            }},
            "columnKind": "unicodeCodePoints",
            "results": results,
        }],
    });
    let mut text = serde_json::to_string_pretty(&log).unwrap_or_default();
    text.push('\n');
    escaped_json(&text)
}

fn rule(code: &str, help: Option<CodePage<'_>>) -> Value {
    let text = format!("motet explain {code}");
    match help {
        None => json!({"id": code, "help": {"text": text}}),
        Some(help) => json!({
            "id": code,
            "shortDescription": {"text": help.title},
            "help": {"text": text, "markdown": help.markdown},
        }),
    }
}

fn result(diagnostic: &Diagnostic, rule: Option<usize>, sources: &Sources) -> Value {
    let level = match diagnostic.severity {
        Severity::Note => "note",
        Severity::Warning => "warning",
        Severity::Error => "error",
    };
    let message = match &diagnostic.help {
        Some(help) => format!("{} ({help})", diagnostic.message),
        None => diagnostic.message.clone(),
    };
    let mut result = json!({
        "ruleId": diagnostic.code.0,
        "ruleIndex": rule,
        "level": level,
        "message": {"text": message},
        "locations": [location(diagnostic.span, &diagnostic.path, sources)],
    });
    let related: Vec<Value> = diagnostic
        .related
        .iter()
        .filter_map(|related| {
            let mut location = location(related.span?, &related.path, sources);
            location.as_object_mut()?.insert("message".into(), json!({"text": related.message}));
            Some(location)
        })
        .collect();
    let fixes = diagnostic.fix.as_ref().map(|fix| {
        let replacements: Vec<Value> = fix
            .edits
            .iter()
            .map(|edit| {
                let deleted = sarif_region(edit.span, sources);
                json!({"deletedRegion": deleted, "insertedContent": {"text": edit.text}})
            })
            .collect();
        let file = artifact(diagnostic.span, sources);
        let changes = json!([{"artifactLocation": file, "replacements": replacements}]);
        json!([{"description": {"text": fix.title}, "artifactChanges": changes}])
    });
    if let Some(result) = result.as_object_mut() {
        if !related.is_empty() {
            result.insert("relatedLocations".into(), related.into());
        }
        result.extend(fixes.map(|fixes| ("fixes".into(), fixes)));
    }
    result
}

fn location(span: Span, path: &str, sources: &Sources) -> Value {
    let mut location = json!({
        "physicalLocation": {
            "artifactLocation": artifact(span, sources),
            "region": sarif_region(span, sources),
        },
    });
    if let (false, Some(location)) = (path.is_empty(), location.as_object_mut()) {
        location.insert("logicalLocations".into(), json!([{"fullyQualifiedName": path, "kind": "value"}]));
    }
    location
}

/// The file as a relative or absolute URI reference.
fn artifact(span: Span, sources: &Sources) -> Value {
    let mut uri = String::new();
    for byte in tool_file(sources, span).bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'_' | b'-' | b'~' => {
                uri.push(byte.into())
            }
            b'\\' => uri.push('/'),
            other => uri.push_str(&format!("%{other:02X}")),
        }
    }
    json!({"uri": uri})
}

fn sarif_region(span: Span, sources: &Sources) -> Value {
    let [(line, column), (end_line, end_column)] = region(sources, span);
    let mut region = json!({
        "startLine": line,
        "startColumn": column,
        "endLine": end_line,
        "endColumn": end_column,
    });
    // Of a line of a file it is not known how many bytes come before it.
    if let (Some(region), false) =
        (region.as_object_mut(), super::source(sources, span).is_some_and(Source::is_line))
    {
        region.insert("byteOffset".into(), span.start.into());
        region.insert("byteLength".into(), span.end.saturating_sub(span.start).into());
    }
    region
}

/// `::error file=…,line=…,col=…,title=…::message` for each diagnostic.
#[must_use]
pub fn github(diagnostics: &[Diagnostic], sources: &Sources) -> String {
    let mut text = String::new();
    for diagnostic in diagnostics {
        let command = match diagnostic.severity {
            Severity::Note => "notice",
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        let file = property(tool_file(sources, diagnostic.span));
        let [(line, column), (end_line, end_column)] = region(sources, diagnostic.span);
        let message = match &diagnostic.help {
            Some(help) => data(&format!("{}\n{help}", diagnostic.message)),
            None => data(&diagnostic.message),
        };
        let place = format!("file={file},line={line},endLine={end_line},col={column},endColumn={end_column}");
        text.push_str(&format!("::{command} {place},title={}::{message}\n", diagnostic.code));
    }
    text
}

/// Text after the `::`.
fn data(text: &str) -> String {
    escaped(text).replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
