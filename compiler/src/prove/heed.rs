//! What a proof asks of the facts. A proof that never asks for a fact goes the same way whatever that fact is, so one answer
//! serves all questions that differ in such facts only.
//!
//! Only what can change the way is an asking: what joins, erodes or makes stale moves a fact to itself.

use std::cell::RefCell;

use rustc_hash::FxHashSet;

use super::Prover;
use super::facts::{Atom, Key};
use crate::ir::Fluent;

/// The facts and patterns that a proof asked for.
#[derive(Clone, Debug, Default)]
pub(crate) struct Heeded(FxHashSet<Atom>);

impl Heeded {
    /// Whether it asked for a fact, or for one of a pattern.
    pub(crate) fn has(&self, fluent: Fluent, key: Key) -> bool {
        self.0.iter().any(|(other, asked)| *other == fluent && asked.overlaps(key))
    }
}

/// What a proof has asked for so far, where somebody wants to know.
pub(crate) type Heeds = Option<RefCell<Heeded>>;

impl Prover<'_> {
    /// The proof asks for a fact, or for those of a pattern.
    pub(crate) fn heed(&self, fluent: Fluent, key: Key) {
        if let Some(heeds) = &self.heeds {
            heeds.borrow_mut().0.insert((fluent, key));
        }
    }
}
