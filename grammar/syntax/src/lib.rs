#![doc = include_str!("../README.md")]

pub mod ast;
pub mod diagnostic;
pub mod diagnostics;
pub mod effort;
mod foreign_json;
mod format;
pub mod json;
pub mod located;
pub mod pointer;
pub mod print;
mod read;
pub mod render;
pub mod source;
pub mod suggest;
pub mod text;
pub mod unit;
pub mod words;
pub mod xml;

pub use diagnostic::{About, Code, Diagnostic, Edit, Fix, Mistake, Related, Severity};
pub use format::format;
pub use read::{Parsed, decode, read};
pub use source::{FileId, Source, Sources, Span, Syntax};
