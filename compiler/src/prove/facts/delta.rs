//! What one way through a fork changed.

use std::cmp::Reverse;

use super::super::value::Value;
use super::{Atom, Facts, Key};
use crate::ir::Fluent;

/// Patterns first, the widest before the others, so that the facts they cover are written after them.
pub(super) fn order((fluent, key): &Atom) -> (Reverse<u32>, Fluent, Key) {
    (Reverse(key.width()), *fluent, *key)
}

/// What one way through a fork left written, in [`order`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Delta {
    pub(super) written: Vec<(Atom, Value)>,
}

impl Delta {
    pub(crate) fn new(written: impl Iterator<Item = (Atom, Value)>) -> Self {
        let mut written: Vec<_> = written.collect();
        written.sort_unstable_by_key(|(atom, _)| order(atom));
        Self { written }
    }

    /// This way or the other, from the same fork.
    pub(crate) fn or(&self, other: &Self, base: &Facts<'_>) -> Self {
        let mut atoms: Vec<_> = self.written.iter().chain(&other.written).map(|(atom, _)| *atom).collect();
        atoms.sort_unstable_by_key(order);
        atoms.dedup();
        let joined = atoms.into_iter().map(|atom| (atom, self.get(base, atom).join(other.get(base, atom))));
        Self { written: joined.collect() }
    }

    /// Whether both ways leave the same sets of values, whatever caused them.
    pub(crate) fn same_sets(&self, other: &Self, base: &Facts<'_>) -> bool {
        let mut atoms = self.written.iter().chain(&other.written).map(|(atom, _)| *atom);
        atoms.all(|atom| self.get(base, atom).same_set(other.get(base, atom)))
    }

    /// What this way knows of a fact; `base` is where the fork began.
    pub(crate) fn get(&self, base: &Facts<'_>, atom: Atom) -> Value {
        let wanted = order(&atom);
        let written = self.written.binary_search_by_key(&wanted, |(atom, _)| order(atom));
        if let Some((_, value)) = written.ok().and_then(|at| self.written.get(at)) {
            return *value;
        }
        let (fluent, key) = atom;
        // Patterns stand first, the narrowest of them last: that one says most of this fact.
        let patterns = self.written.iter().take_while(|((_, key), _)| key.is_pattern());
        let covering = patterns.filter(|((other, pattern), _)| *other == fluent && pattern.covers(key));
        covering.last().map_or_else(|| base.get(fluent, key), |(_, value)| *value)
    }
}
