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
use crate::source::Syntax;

/// A file in the text syntax, with the comments of the text that it was read from.
pub(crate) fn commented(file: &File, text: &str) -> String {
    let mut writer = writer::Writer::new(writer::Comments::of(text));
    writer.file(file);
    writer.finish()
}

/// A file in the text syntax. Documentation is kept; comments are not part of a tree (see [`crate::format`]).
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
