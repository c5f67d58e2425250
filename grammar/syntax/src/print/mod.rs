//! The canonical printers: AST to either form. Reading what they print gives the same tree back, and printing
//! that gives the same text.

mod comment;
mod declaration;
mod expr;
mod format;
mod json;
mod layout;
mod step;
mod writer;

pub use format::format;
pub use json::policy_json;

use crate::ast::{Do, Expr, ExprKind, File};
use crate::source::Syntax;

/// A file in the text form. Documentation is kept; comments are not part of a tree (see [`format()`]).
#[must_use]
pub fn text(file: &File) -> String {
    let mut writer = writer::Writer::new(comment::Comments::none());
    writer.file(file);
    writer.finish()
}

/// A condition or a term in the text form, on one line.
#[must_use]
pub fn expression(expr: &Expr) -> String {
    let mut text = String::new();
    expr::write(&mut text, expr);
    text
}

/// A call as a step on one line, in either form. Arguments of the JSON form are written under their names.
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

/// A name in the text form, back-quoted where it has to be.
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
