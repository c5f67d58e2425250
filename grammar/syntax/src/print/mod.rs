//! The canonical printers: AST to either form. Reading what they print gives the same tree back, and printing that gives
//! the same text.

mod comment;
mod declaration;
mod expr;
mod format;
mod json;
mod layout;
mod step;
mod writer;

pub use format::format;
pub use json::{policy_json, policy_wire};

use crate::ast::{Expr, File};

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
