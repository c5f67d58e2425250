//! Diagnostics as workflow commands of GitHub Actions, one a line.

use super::{region, tool_file};
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::Sources;

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
    text.replace('%', "%25").replace('\r', "%0D").replace('\n', "%0A")
}

/// The value of a property.
fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}
