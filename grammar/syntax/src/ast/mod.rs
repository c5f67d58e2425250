//! Syntax tree of policies and declarations, the same for text and JSON. Every node carries its span;
//! equality ignores spans.
//!
//! Nothing here is resolved: a name is text, a call may not exist. Invariant: a tree made by a front end is
//! at most [`MAX_NESTING`] blocks and expressions deep, so recursion over it is safe.

mod decl;
mod expr;
mod step;

pub use decl::*;
pub use expr::*;
pub use step::*;

use derive_where::derive_where;
use smol_str::SmolStr;

use crate::source::Span;

/// Greatest depth of blocks, conditions and brackets in a document of either syntax.
pub const MAX_NESTING: usize = 64;
/// The largest document, in bytes.
pub const MAX_BYTES: usize = 16 * 1024 * 1024;
/// The most steps that one document may hold.
pub const MAX_STEPS: usize = 20_000;
/// The most words, numbers, texts and marks (in JSON: keys and values) that one document may hold.
pub const MAX_TOKENS: usize = 1_000_000;
/// The most mistakes that are told of one document: a stage that finds more leaves out the rest.
pub const MAX_MISTAKES: usize = 1000;

/// An identifier with its range.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
pub struct Name {
    /// Text without back-quotes or `$`.
    pub text: SmolStr,
    #[derive_where(skip)]
    pub span: Span,
}

/// A file of the text syntax: declarations in order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct File {
    pub items: Vec<Item>,
}

impl File {
    /// The policies, in order.
    pub fn policies(&self) -> impl Iterator<Item = &Policy> {
        self.items.iter().filter_map(Item::policy)
    }

    /// The policies without parameters: those that can be run.
    pub fn runnable(&self) -> impl Iterator<Item = &Policy> {
        self.policies().filter(|policy| policy.params.is_empty())
    }
}

/// One declaration of a file.
#[derive(Clone, Debug)]
#[derive_where(PartialEq)]
#[expect(clippy::large_enum_variant, reason = "most items are policies, and files have few")]
pub enum Item {
    Kind(KindDecl),
    Fluent(FluentDecl),
    Measure(MeasureDecl),
    Failure(FailureDecl),
    Enum(EnumDecl),
    /// `action pick(…)` or `perception detect(…)`
    Primitive(PrimitiveDecl),
    Policy(Policy),
    Entities(EntitiesDecl),
    Initially(InitiallyDecl),
    /// The declaration `closed world`: facts that are not given are false.
    ClosedWorld(#[derive_where(skip)] Span),
}

impl Item {
    /// The policy of the declaration; `None` for any other.
    #[must_use]
    pub fn policy(&self) -> Option<&Policy> {
        match self {
            Self::Policy(policy) => Some(policy),
            _ => None,
        }
    }

    /// Range of the whole declaration.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Kind(decl) => decl.span,
            Self::Fluent(decl) => decl.span,
            Self::Measure(decl) => decl.span,
            Self::Failure(decl) => decl.span,
            Self::Enum(decl) => decl.span,
            Self::Primitive(decl) => decl.span,
            Self::Policy(decl) => decl.span,
            Self::Entities(decl) => decl.span,
            Self::Initially(decl) => decl.span,
            Self::ClosedWorld(span) => *span,
        }
    }
}

/// Text of `///` lines above a declaration, joined by line breaks; empty where there is none.
pub type Doc = SmolStr;
