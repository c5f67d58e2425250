//! Volatile facts: what the world, the reaction of a monitor or a branch beside the present one may change at
//! any moment. Before and after each step, what is known of them is weakened.

use motet_syntax::Span;
use smallvec::SmallVec;

use super::Prover;
use crate::facts::{Atom, FactKey, TruthSet, effort};
use crate::ir::Fluent;

/// A fact that a monitor's reaction, or a branch beside the present one, may change at any moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Volatile {
    pub(crate) fluent: Fluent,
    pub(crate) key: FactKey,
    /// Value that the reaction or the branch leaves.
    pub(crate) value: TruthSet,
    /// Span of the monitor's condition; `None` for a branch.
    pub(crate) when: Option<Span>,
    /// True if only names that may be about the fact feel it: a monitor waits for the world to restore the
    /// fact itself.
    pub(crate) restored: bool,
}

impl Volatile {
    /// Value of a fact that may be the one of this row: on paths where both say the same that, else also
    /// unobserved.
    fn perhaps(&self, known: TruthSet) -> TruthSet {
        let changed = known.join(self.value);
        if changed.same_set(known) {
            return changed;
        }
        let TruthSet { yes, no, open } = self.value;
        known.join(TruthSet::open(open.or(no).or(yes)))
    }
}

impl Prover<'_> {
    /// Weakens the facts that a reaction may just have changed.
    pub(crate) fn erode(&mut self) {
        if self.state.volatile.is_empty() {
            return;
        }
        let rows = std::mem::take(&mut self.state.volatile);
        let own = || rows.iter().filter(|row| !row.restored);
        let patterns: Vec<&Volatile> = own().filter(|row| row.key.is_pattern()).collect();
        // What another reaction or the world may do to all of a pattern, it may do to this one.
        let wider = |row: &Volatile| {
            let (fluent, key, when) = (row.fluent, row.key, row.when);
            let is_wider = move |other: &&&Volatile| {
                other.fluent == fluent && other.when != when && other.key.covers(key)
            };
            patterns.iter().filter(is_wider).map(|other| other.value)
        };
        let single = own().filter(|row| !row.key.is_pattern());
        let single = single.map(|row| {
            let value = self.read(row.fluent, row.key).join(row.value);
            (row, wider(row).fold(value, TruthSet::join))
        });
        let single: Vec<_> = single.collect();
        for row in &patterns {
            // A narrower row of the same reaction says more of what it covers.
            let narrower: SmallVec<[FactKey; 16]> = own()
                .filter(|other| {
                    (other.fluent, other.when) == (row.fluent, row.when)
                        && other.key != row.key
                        && row.key.covers(other.key)
                })
                .map(|other| other.key)
                .collect();
            let is_told = |key: FactKey| narrower.iter().any(|other| other.covers(key));
            self.state.facts.change(row.fluent, row.key, |key, known| {
                if is_told(key) { known } else { known.join(row.value) }
            });
        }
        for (row, value) in single {
            if self.state.facts.get(row.fluent, row.key) != value {
                self.state.facts.set(row.fluent, row.key, value);
            }
        }
        self.erode_names(&rows);
        self.erode_paths(&rows);
        self.state.volatile = rows;
    }

    /// Weakens the facts on the paths that have met. Where the join of the paths stays the same, nothing else
    /// says that each of them has changed.
    fn erode_paths(&mut self, rows: &[Volatile]) {
        let mut partitions = std::mem::take(&mut self.state.partitions);
        let is_volatile = |fluent| rows.iter().any(|row| row.fluent == fluent);
        for partition in partitions.iter_mut().filter(|partition| partition.differs(is_volatile)) {
            partition.change(|(fluent, key), known| {
                let of_fluent = rows.iter().filter(|row| row.fluent == fluent);
                of_fluent.fold(known, |known, row| match row.key.covers(key) {
                    true if row.restored => known,
                    true => known.join(row.value),
                    false if self.is_perhaps(row, (fluent, key), rows) => row.perhaps(known),
                    false => known,
                })
            });
        }
        self.state.partitions = partitions;
    }

    /// Returns whether a row may be about a fact of a name. The rows of a reaction say all of a fact that it
    /// has reached.
    fn is_perhaps(&self, row: &Volatile, (fluent, key): Atom, rows: &[Volatile]) -> bool {
        let params = self.library.fluent(fluent).map_or(&[][..], |def| &def.params);
        let is_own = |other: &Volatile| (other.fluent, other.key, other.when) == (fluent, key, row.when);
        let is_told = row.key.covers(key) || row.when.is_some() && rows.iter().any(is_own);
        !is_told && self.is_name(row, (fluent, key)) && self.may_be_same(params, row.key, key)
    }

    /// Returns whether the fact or the row is about a name. A row about no name says nothing more of a fact
    /// about no name: that fact has its own row. A row that is restored has none for what its name may be.
    fn is_name(&self, row: &Volatile, (fluent, key): Atom) -> bool {
        self.has_symbol(fluent, key) || row.restored && self.has_symbol(fluent, row.key)
    }

    /// Weakens the facts about names that may be what a row is about. A name that the body has bound has no
    /// row of its own.
    fn erode_names(&mut self, rows: &[Volatile]) {
        let has_names = |row: &&Volatile| {
            self.aliased.get(row.fluent.index()).is_some_and(|is| *is)
                || row.restored && self.has_symbol(row.fluent, row.key)
        };
        let mut fluents: Vec<Fluent> = rows.iter().filter(has_names).map(|row| row.fluent).collect();
        fluents.sort_unstable();
        fluents.dedup();
        for fluent in fluents {
            let mut names = Vec::new();
            let of_fluent = || rows.iter().filter(|row| row.fluent == fluent);
            self.state.facts.written_parts(fluent, |key| {
                if of_fluent().any(|row| self.is_name(row, (fluent, key))) {
                    names.push(key);
                }
            });
            // Facts of the start have no entry of their own.
            for row in of_fluent().filter(|row| row.restored) {
                names.extend(
                    self.aliases(fluent, row.key).unwrap_or_else(|| [FactKey::ALL].into_iter().collect()),
                );
            }
            effort::spend(names.len().saturating_mul(rows.len()));
            // The wider first, so that what they cover is written after them.
            names.sort_unstable_by_key(|key| (!key.is_pattern(), *key));
            names.dedup();
            for key in names {
                for row in of_fluent() {
                    if self.is_perhaps(row, (fluent, key), rows) {
                        self.state.facts.change(fluent, key, |_, known| row.perhaps(known));
                    }
                }
            }
        }
    }
}
