//! What names mean where an expression stands, beside entities and cases.

use motet_syntax::Span;
use smol_str::SmolStr;

use crate::ir::{Term, Ty};

/// A stack of names. A barrier hides what lies below it: the body of an inlined policy sees nothing of its caller.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scope {
    entries: Vec<ScopeEntry>,
    barrier: usize,
}

/// A name in scope.
#[derive(Clone, Debug)]
pub(crate) struct ScopeEntry {
    pub(crate) name: SmolStr,
    pub(crate) term: Term,
    pub(crate) ty: Ty,
    pub(crate) span: Span,
}

/// A place in the stack to go back to.
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
