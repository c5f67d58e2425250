//! The canonical printers: AST to either syntax. Reading what they print gives the same tree back, and
//! printing that gives the same text.

mod declaration;
mod expr;
mod json;
mod step;
mod writer;

pub(crate) use json::json_steps;
pub use json::policy_json;

use crate::ast::{Do, Expr, ExprKind, File};
use crate::diagnostic::{Diagnostic, Severity};
use crate::read::read;
use crate::source::{FileId, Source, Syntax};

/// The document as the canonical printer writes it. In the text syntax comments stay where they are, on lines
/// of their own or behind what they follow, and so do single blank lines. Formatting twice is formatting
/// once.
///
/// ```
/// use motet_syntax::{Source, print};
///
/// let source = Source::new("p.motet", "policy p{go(sink)}");
/// assert_eq!(print::format(&source).unwrap(), "policy p {\n    go(sink)\n}\n");
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
            let mut writer = writer::Writer::new(writer::Comments::of(text));
            writer.file(&parsed.file);
            writer.finish()
        }
        Syntax::Json => parsed.file.policies().map(policy_json).collect(),
    })
}

/// A file in the text syntax. Documentation is kept; comments are not part of a tree (see [`format()`]).
#[must_use]
pub fn text(file: &File) -> String {
    let mut writer = writer::Writer::new(writer::Comments::none());
    writer.file(file);
    writer.finish()
}

/// A condition or a term in the text syntax, on one line.
#[must_use]
pub fn expression(expr: &Expr) -> String {
    let mut text = String::new();
    expr::write(&mut text, expr);
    text
}

/// A call as a step on one line, in either syntax. Arguments of the JSON syntax are written under their
/// names.
#[must_use]
pub fn call(step: &Do, form: Syntax) -> String {
    match form {
        Syntax::Json => json::call(step),
        Syntax::Text => {
            let mut text = String::new();
            if let Some(bind) = &step.bind {
                text.push_str("let ");
                expr::name(&mut text, &bind.text);
                text.push_str(" = ");
            }
            let call = Expr { kind: ExprKind::Call(step.call.clone()), span: step.call.span };
            expr::write(&mut text, &call);
            text
        }
    }
}

/// A name in the text syntax, back-quoted where it has to be.
///
/// ```
/// use motet_syntax::print::identifier;
///
/// assert_eq!(identifier("mug_1"), "mug_1");
/// assert_eq!(identifier("red mug"), "`red mug`");
/// ```
#[must_use]
pub fn identifier(name: &str) -> String {
    let mut text = String::new();
    expr::name(&mut text, name);
    text
}
