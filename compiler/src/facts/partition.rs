//! The ways that met at a join, kept for a while: a later test that some of them cannot pass tells them apart again.

use super::TruthSet;
use super::{Atom, Delta, FactStore, Rank};

/// Ways that met.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathPartition {
    /// The trail when they had met.
    pub(crate) since: usize,
    atoms: Vec<Atom>,
    /// What each way left of each atom, way by way.
    values: Vec<TruthSet>,
}

impl PathPartition {
    /// Whether the ways differ in a fluent that `asked` picks.
    pub(crate) fn differs(&self, mut asked: impl FnMut(crate::ir::Fluent) -> bool) -> bool {
        let first = self.values.get(..self.atoms.len()).unwrap_or_default();
        self.atoms.iter().enumerate().any(|(index, (fluent, _))| {
            let mut others = self.values.iter().skip(index).step_by(self.atoms.len().max(1));
            asked(*fluent)
                && first.get(index).is_some_and(|first| !others.all(|value| value.same_set(*first)))
        })
    }

    /// The ways, each as what it left.
    pub(crate) fn ways(&self) -> impl Iterator<Item = impl Iterator<Item = (Atom, TruthSet)> + '_> + '_ {
        let ways = self.values.chunks(self.atoms.len().max(1));
        ways.map(|values| self.atoms.iter().copied().zip(values.iter().copied()))
    }
}

impl FactStore<'_> {
    /// Joins the ways through a fork that began where the facts are now, and keeps them apart beside. No way leaves the
    /// facts as they are.
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
