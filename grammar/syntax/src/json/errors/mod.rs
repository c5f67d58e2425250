//! What can be wrong with a JSON document: its syntax, its keys, and the types of its values. Raised by
//! [`super::parse`] and, through [`super::fault`], by everything that is read with [`super::read()`].

mod key;
mod syntax;
mod value;

pub use key::{DuplicateKey, MissingKey, NoForm, RESERVED, ReservedKey, TwoForms, UnknownKey};
pub use syntax::{JsonSyntax, SyntaxFault};
pub use value::{BadName, BadValue, NumberRange, WrongType};

use crate::diagnostic::{Edit, Fix};
use crate::source::Span;

fn replace(span: Span, text: &str, title: &str) -> Fix {
    Fix { title: title.into(), edits: vec![Edit { span, text: text.into() }] }
}
