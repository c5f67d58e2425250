//! Conversion between the terms of the compiler and those of the protocol: spans, paths, diagnostics.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use motet_syntax::{Diagnostic, Severity, Span};

use crate::lines::{LineIndex, LinePosition};
use crate::protocol::{self, NAME, NumberOrString, Position, Range, Uri};

/// Codes of findings about steps or names that have no effect, which editors show faded.
const UNNECESSARY: [&str; 2] = ["M0901", "M0902"];

/// Location of a span outside the document.
pub(crate) trait Locate {
    /// Location of a span; `None` if its file has none.
    fn location(&self, span: Span) -> Option<protocol::Location>;
}

pub(crate) fn position(position: LinePosition) -> Position {
    Position { line: position.line, character: position.column }
}

pub(crate) fn line_position(position: Position) -> LinePosition {
    LinePosition { line: position.line, column: position.character }
}

pub(crate) fn positions(range: Range) -> (LinePosition, LinePosition) {
    (line_position(range.start), line_position(range.end))
}

pub(crate) fn range(lines: &LineIndex, span: Span) -> Range {
    let (start, end) = lines.range(span);
    Range { start: position(start), end: position(end) }
}

/// File of a `file:` URI.
pub(crate) fn path(uri: &str) -> Option<PathBuf> {
    let rest = uri.strip_prefix("file://")?;
    let path = rest.get(rest.find('/')?..)?;
    let path = path.split(['?', '#']).next()?;
    let mut bytes = Vec::with_capacity(path.len());
    let mut left = path.bytes();
    while let Some(byte) = left.next() {
        bytes.push(match byte {
            b'%' => {
                let digits = [left.next()?, left.next()?];
                u8::from_str_radix(std::str::from_utf8(&digits).ok()?, 16).ok()?
            }
            byte => byte,
        });
    }
    let path = String::from_utf8(bytes).ok()?;
    // `/c:/home` of Windows.
    let is_drive = path.as_bytes().get(2) == Some(&b':') && cfg!(windows);
    Some(PathBuf::from(if is_drive { path.get(1..)? } else { &path }))
}

/// `file:` URI of a path, which is made absolute.
pub(crate) fn uri(path: &Path) -> Option<Uri> {
    let path = std::path::absolute(path).ok()?;
    let mut uri = String::from("file://");
    let text = path.to_str()?.replace('\\', "/");
    if !text.starts_with('/') {
        uri.push('/');
    }
    for byte in text.bytes() {
        match byte {
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'/' | b'-' | b'.' | b'_' | b'~' | b':' => {
                uri.push(char::from(byte));
            }
            byte => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    Uri::from_str(&uri).ok()
}

/// Diagnostic as editors show it: the help and the remarks without a place below the message.
pub(crate) fn diagnostic(found: &Diagnostic, lines: &LineIndex, locate: &dyn Locate) -> protocol::Diagnostic {
    let mut message = found.message.clone();
    if let Some(help) = &found.help {
        message.push_str("\nhelp: ");
        message.push_str(help);
    }
    let mut related = Vec::new();
    for remark in &found.related {
        match remark.span.and_then(|span| locate.location(span)) {
            Some(location) => related
                .push(protocol::DiagnosticRelatedInformation { location, message: remark.message.clone() }),
            None => {
                message.push_str("\nnote: ");
                message.push_str(&remark.message);
            }
        }
    }
    let severity = match found.severity {
        Severity::Error => protocol::DiagnosticSeverity::ERROR,
        Severity::Warning => protocol::DiagnosticSeverity::WARNING,
        Severity::Note => protocol::DiagnosticSeverity::INFORMATION,
    };
    let is_unnecessary = UNNECESSARY.contains(&found.code.0) && found.severity != Severity::Error;
    protocol::Diagnostic {
        range: range(lines, found.span),
        severity: Some(severity),
        code: Some(NumberOrString::String(found.code.0.to_owned())),
        source: Some(NAME.to_owned()),
        message,
        related_information: (!related.is_empty()).then_some(related),
        tags: is_unnecessary.then(|| vec![protocol::DiagnosticTag::UNNECESSARY]),
        ..protocol::Diagnostic::default()
    }
}

/// Error at the beginning of a document that nothing can be checked against.
pub(crate) fn problem(text: &str, lines: &LineIndex) -> protocol::Diagnostic {
    let end = lines.line_end(0);
    protocol::Diagnostic {
        range: Range { start: Position::default(), end: position(end) },
        severity: Some(protocol::DiagnosticSeverity::ERROR),
        source: Some(NAME.to_owned()),
        message: text.to_owned(),
        ..protocol::Diagnostic::default()
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    #[test]
    fn uri_and_path_are_inverse() {
        for path in ["/home/a b/ä😀/x#1?%.motet", "/x.motet"] {
            let uri = super::uri(Path::new(path)).unwrap();
            assert!(uri.as_str().is_ascii());
            assert_eq!(super::path(uri.as_str()).as_deref(), Some(Path::new(path)), "{}", uri.as_str());
        }
        assert_eq!(super::path("file://localhost/x%20y").as_deref(), Some(Path::new("/x y")));
        assert_eq!(super::path("untitled:Untitled-1"), None);
        assert_eq!(super::path("file:///a%zz"), None);
    }
}
