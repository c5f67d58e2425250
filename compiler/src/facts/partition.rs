//! Trace partitions (Mauborgne and Rival 2005): paths that met at a join are kept apart for a while, so that
//! a later test can rule some of them out.

use super::TruthSet;
use super::{Atom, Delta, FactStore, Rank};

/// Paths that met at a join.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathPartition {
    /// Position in the trail after the join.
    pub(crate) since: usize,
    atoms: Vec<Atom>,
    /// Value of each atom at the end of each path, path by path.
    values: Vec<TruthSet>,
}

impl PathPartition {
    /// Returns whether the paths differ in a fluent that `asked` selects.
    pub(crate) fn differs(&self, mut asked: impl FnMut(crate::ir::Fluent) -> bool) -> bool {
        let first = self.values.get(..self.atoms.len()).unwrap_or_default();
        self.atoms.iter().enumerate().any(|(index, (fluent, _))| {
            let mut others = self.values.iter().skip(index).step_by(self.atoms.len().max(1));
            asked(*fluent)
                && first.get(index).is_some_and(|first| !others.all(|value| value.same_set(*first)))
        })
    }

    /// Values of the atoms at the end of each path.
    pub(crate) fn ways(&self) -> impl Iterator<Item = impl Iterator<Item = (Atom, TruthSet)> + '_> + '_ {
        let ways = self.values.chunks(self.atoms.len().max(1));
        ways.map(|values| self.atoms.iter().copied().zip(values.iter().copied()))
    }
}

impl FactStore<'_> {
    /// Joins the paths through a fork that began at the present state, and returns them as partitions.
    /// Without a path the facts stay as they are.
    pub(crate) fn join(&mut self, ways: &[Delta]) -> PathPartition {
        if let [only] = ways {
            self.replay(only);
            return PathPartition::default();
        }
        let ranks = Rank::each_once(ways.iter().flat_map(Delta::ranks));
        let mut values = Vec::with_capacity(ways.len() * ranks.len());
        for way in ways {
            values.extend(ranks.iter().map(|rank| way.at(self, *rank)));
        }
        let atoms: Vec<Atom> = ranks.into_iter().map(Rank::atom).collect();
        for (index, (fluent, key)) in atoms.iter().copied().enumerate() {
            let found = values.iter().skip(index).step_by(atoms.len()).copied().reduce(TruthSet::join);
            let Some(value) = found else { continue };
            if key.is_pattern() || self.get(fluent, key) != value {
                self.set(fluent, key, value);
            }
        }
        PathPartition { since: self.mark(), atoms, values }
    }
}
