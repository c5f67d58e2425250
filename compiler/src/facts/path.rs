//! Paths through a fork: the changes along one path, and trace partitions (Mauborgne and Rival 2005), which
//! keep paths that met at a join apart for a while, so that a later test can rule some of them out.

use std::hash::{Hash, Hasher};

use super::value::{Atom, Rank, TruthSet};
use super::{FactStore, effort};

impl FactStore<'_> {
    /// Writes since `mark` with their last values: one path through a fork.
    pub(crate) fn delta(&self, mark: usize) -> Delta {
        let known = |rank: Rank| {
            let (fluent, key) = rank.atom();
            // What was forgotten of a name is unknown, also in a closed world.
            (rank, self.get_joined(fluent, key))
        };
        Delta { written: self.ranks(mark).into_iter().map(known).collect() }
    }

    /// Writes the facts of a path.
    pub(crate) fn replay(&mut self, path: &Delta) {
        effort::spend(path.written.len());
        for (rank, value) in &path.written {
            let (fluent, key) = rank.atom();
            self.set(fluent, key, *value);
        }
    }
}

/// Facts that one path through a fork has written, with their last values, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Delta {
    pub(super) written: Vec<(Rank, TruthSet)>,
}

impl Delta {
    pub(crate) fn new(written: impl Iterator<Item = (Atom, TruthSet)>) -> Self {
        let mut written: Vec<_> = written.map(|(atom, value)| (Rank::of(atom), value)).collect();
        written.sort_unstable_by_key(|(rank, _)| *rank);
        Self { written }
    }

    /// Joins two paths from the same fork.
    pub(crate) fn or(&self, other: &Self, base: &FactStore<'_>) -> Self {
        let ranks = Rank::each_once(self.ranks().chain(other.ranks())).into_iter();
        let joined = ranks.map(|rank| (rank, self.at(base, rank).join(other.at(base, rank))));
        Self { written: joined.collect() }
    }

    /// Returns whether both paths leave the same sets of values, which last as long.
    pub(crate) fn same_sets(&self, other: &Self, base: &FactStore<'_>) -> bool {
        let mut ranks = self.ranks().chain(other.ranks());
        ranks.all(|rank| self.at(base, rank).lasts_as(other.at(base, rank)))
    }

    /// Hashes the sets of values that the path leaves, and how long they last.
    pub(crate) fn fingerprint(&self, hasher: &mut impl Hasher) {
        for (rank, value) in &self.written {
            (rank.0, value.known()).hash(hasher);
        }
        self.written.len().hash(hasher);
    }

    /// Facts and patterns that the path has written.
    pub(crate) fn atoms(&self) -> impl Iterator<Item = Atom> {
        self.ranks().map(Rank::atom)
    }

    /// Ranks of the facts and patterns that the path has written.
    pub(super) fn ranks(&self) -> impl Iterator<Item = Rank> {
        self.written.iter().map(|(rank, _)| *rank)
    }

    /// Value of a fact at the end of the path; `base` is the store at the fork.
    pub(crate) fn get(&self, base: &FactStore<'_>, atom: Atom) -> TruthSet {
        self.at(base, Rank::of(atom))
    }

    pub(super) fn at(&self, base: &FactStore<'_>, rank: Rank) -> TruthSet {
        let written = self.written.binary_search_by_key(&rank, |(rank, _)| *rank);
        if let Some((_, value)) = written.ok().and_then(|at| self.written.get(at)) {
            return *value;
        }
        let (fluent, key) = rank.atom();
        // Patterns stand first, the narrowest of them last: that one says most of this fact.
        let count = self.written.partition_point(|(rank, _)| rank.is_pattern());
        effort::spend(count);
        let patterns = self.written.iter().take(count);
        let mut covering = patterns.filter(|(rank, _)| {
            let (other, pattern) = rank.atom();
            other == fluent && pattern.covers(key)
        });
        let covering = covering.next_back().map(|(_, value)| *value);
        if base.is_symbolic(fluent, key) {
            // Without an entry it is what all that it may be agree on.
            let open = TruthSet::NOTHING_KNOWN;
            return covering
                .map_or_else(|| base.entry(fluent, key).unwrap_or(open), |value| value.join(open));
        }
        covering.unwrap_or_else(|| base.get(fluent, key))
    }
}

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

    /// Maps the value of each atom on each path.
    pub(crate) fn change(&mut self, change: impl Fn(Atom, TruthSet) -> TruthSet) {
        effort::spend(self.values.len());
        for (atom, value) in self.atoms.iter().cycle().zip(&mut self.values) {
            *value = change(*atom, *value);
        }
    }

    /// Values of the atoms at the end of each path.
    pub(crate) fn paths(&self) -> impl Iterator<Item = impl Iterator<Item = (Atom, TruthSet)> + '_> + '_ {
        let paths = self.values.chunks(self.atoms.len().max(1));
        paths.map(|values| self.atoms.iter().copied().zip(values.iter().copied()))
    }
}

impl FactStore<'_> {
    /// Joins the paths through a fork that began at the present state, and returns them as partitions.
    /// Without a path the facts stay as they are.
    pub(crate) fn join(&mut self, paths: &[Delta]) -> PathPartition {
        if let [only] = paths {
            self.replay(only);
            return PathPartition::default();
        }
        let ranks = Rank::each_once(paths.iter().flat_map(Delta::ranks));
        effort::spend(paths.len() * ranks.len());
        let mut values = Vec::with_capacity(paths.len() * ranks.len());
        for path in paths {
            values.extend(ranks.iter().map(|rank| path.at(self, *rank)));
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
