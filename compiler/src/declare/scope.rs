//! Scope of an expression: the names that are bound at its place.

use motet_syntax::Span;
use smol_str::SmolStr;

use crate::ir::{Term, Ty};

/// Stack of names. A barrier hides the names below it: the body of an inlined policy does not see its caller.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scope {
    entries: Vec<ScopeEntry>,
    barrier: usize,
}

/// Name in scope with its meaning.
#[derive(Clone, Debug)]
pub(crate) struct ScopeEntry {
    pub(crate) name: SmolStr,
    pub(crate) term: Term,
    pub(crate) ty: Ty,
    pub(crate) span: Span,
}

/// State of the stack, to restore later.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScopeMark {
    len: usize,
    barrier: usize,
}

impl Scope {
    pub(crate) fn push(&mut self, name: SmolStr, term: Term, ty: Ty, span: Span) {
        self.entries.push(ScopeEntry { name, term, ty, span });
    }

    pub(crate) fn find(&self, name: &str) -> Option<&ScopeEntry> {
        self.entries.get(self.barrier..)?.iter().rev().find(|entry| entry.name == name)
    }

    pub(crate) fn names(&self) -> impl Iterator<Item = &SmolStr> {
        self.entries.iter().skip(self.barrier).map(|entry| &entry.name)
    }

    pub(crate) fn mark(&self) -> ScopeMark {
        ScopeMark { len: self.entries.len(), barrier: self.barrier }
    }

    pub(crate) fn raise_barrier(&mut self) {
        self.barrier = self.entries.len();
    }

    pub(crate) fn back_to(&mut self, mark: ScopeMark) {
        self.entries.truncate(mark.len);
        self.barrier = mark.barrier;
    }
}
