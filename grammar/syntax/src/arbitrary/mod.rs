//! Trees made from bytes, for property tests and fuzzing: every sequence of bytes is a tree, shorter
//! sequences are smaller trees, so what shrinks bytes shrinks trees. Every node kind comes up. The trees mean
//! nothing: names are not declared and types do not fit. Only with the feature `arbitrary`.

mod byte_source;
mod declaration;
mod expr;
mod step;

use byte_source::ByteSource;

use crate::ast::{File, Policy};
use crate::source::Span;

/// Syntax that a tree looks as if it was read from.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flavor {
    /// Names are names.
    Text,
    /// Names are bindings or plain strings, arguments have names, a bare number is a duration in seconds.
    Json,
}

/// A tree as the text front end makes it: the printed text reads back as the same tree.
#[must_use]
pub fn file(bytes: &[u8]) -> File {
    TreeGenerator::new(bytes, Flavor::Text).file()
}

/// A policy as the text front end makes it.
#[must_use]
pub fn text_policy(bytes: &[u8]) -> Policy {
    TreeGenerator::new(bytes, Flavor::Text).policy()
}

/// A policy as the JSON front end makes it: without parameters, every argument named, every binding in scope.
/// The printed JSON reads back as the same tree, also by way of the text form.
#[must_use]
pub fn json_policy(bytes: &[u8]) -> Policy {
    TreeGenerator::new(bytes, Flavor::Json).policy()
}

/// Depth of blocks and expressions in a generated tree.
const DEPTH: usize = 5;

struct TreeGenerator<'b> {
    choice: ByteSource<'b>,
    flavor: Flavor,
    /// Names bound at the current point.
    scope: Vec<smol_str::SmolStr>,
}

impl<'b> TreeGenerator<'b> {
    fn new(bytes: &'b [u8], flavor: Flavor) -> Self {
        Self { choice: ByteSource::new(bytes), flavor, scope: Vec::new() }
    }

    /// Between `least` and three more of something; fewer when the bytes run out.
    fn some<T>(&mut self, least: usize, mut make: impl FnMut(&mut Self) -> T) -> Vec<T> {
        let count = least + self.choice.below(4);
        (0..count).map(|_| make(self)).collect()
    }

    fn maybe<T>(&mut self, make: impl FnOnce(&mut Self) -> T) -> Option<T> {
        if self.choice.is_heads() { Some(make(self)) } else { None }
    }

    fn span(&self) -> Span {
        Span::default()
    }
}
