//! The fact store: known facts at one program point, with a trail of writes to roll back.
//!
//! The table of a fluent holds single facts and patterns, in which some arguments are `any`. A pattern gives
//! the value of every fact that it covers and that has no entry of its own; writing a pattern drops the
//! entries that it covers. So `not on(cup, any)` costs as much as is known about it, and not the size of the
//! environment.
//!
//! All policies share the facts at the start; the writes of a policy lie above them.

pub(crate) mod effort;
mod path;
mod table;
mod value;

use smallvec::SmallVec;

pub(crate) use self::path::{Delta, PathPartition};
use self::table::{FluentTable, TableEntry};
use self::value::Rank;
pub(crate) use self::value::{ANY, Atom, Cause, FactKey, TruthSet, arg, show};
use crate::ir::Fluent;

/// One write, with what is needed to undo it.
#[derive(Clone, Copy, Debug)]
struct TrailEntry {
    fluent: Fluent,
    key: FactKey,
    undo: Undo,
    /// Value before the write, also if there was no entry.
    before: TruthSet,
}

#[derive(Clone, Copy, Debug)]
enum Undo {
    /// Restores the entry with this value and time.
    Put(TruthSet, u32),
    /// Drops the entry.
    Drop,
    /// Nothing: a fact at the start becomes visible again when the entry that hides it is dropped.
    Hidden,
}

/// Known facts, as a layer of writes above the facts at the start.
#[derive(Clone, Debug, Default)]
pub(crate) struct FactStore<'w> {
    /// The facts at the start; never written.
    start: &'w [FluentTable],
    tables: Vec<FluentTable>,
    trail: Vec<TrailEntry>,
    /// The least argument that is a symbol, an entity that may be one of several; the greatest number without
    /// symbols. What is known of such an entity is no entry of its own until a step writes one.
    first_symbol: u16,
}

impl FactStore<'static> {
    /// Empty tables for a number of fluents; every fact has the value `default`.
    pub(crate) fn new(fluents: usize, default: TruthSet) -> Self {
        let tables = vec![FluentTable::new(default); fluents];
        Self { start: &[], tables, trail: Vec::new(), first_symbol: ANY }
    }
}

impl<'w> FactStore<'w> {
    /// A store above the facts at the start, in which the arguments from `first_symbol` on are symbols.
    /// O(fluents).
    pub(crate) fn above(start: &'w FactStore<'static>, first_symbol: u16) -> Self {
        // One more for a table that is added.
        let mut tables = Vec::with_capacity(start.tables.len() + 1);
        tables.extend(start.tables.iter().map(|table| FluentTable::new(table.default)));
        Self { start: &start.tables, tables, trail: Vec::with_capacity(256), first_symbol }
    }

    /// Lays the writes above another start, which must have the same facts as their own.
    pub(crate) fn over<'b>(self, start: &'b FactStore<'static>) -> FactStore<'b> {
        FactStore { start: &start.tables, ..self }
    }

    /// Takes the writes alone, to be laid [`Self::over`] the start again.
    pub(crate) fn lift(self) -> FactStore<'static> {
        FactStore { start: &[], ..self }
    }

    /// Adds a table; its fluent is the next index.
    pub(crate) fn add_table(&mut self, default: TruthSet) -> Fluent {
        let id = Fluent(u16::try_from(self.tables.len()).unwrap_or(u16::MAX));
        self.tables.push(FluentTable::new(default));
        id
    }

    fn table(&self, fluent: Fluent) -> Option<&FluentTable> {
        self.tables.get(fluent.index())
    }

    /// Table of the facts at the start; `None` if it is empty.
    fn below(&self, fluent: Fluent) -> Option<&'w FluentTable> {
        self.start.get(fluent.index()).filter(|table| !table.is_empty())
    }

    /// Value of a fact; for a pattern, the value of the facts that it covers and that have no entry of their
    /// own.
    pub(crate) fn get(&self, fluent: Fluent, key: FactKey) -> TruthSet {
        let Some(table) = self.table(fluent) else { return TruthSet::NOTHING_KNOWN };
        let below = || self.below(fluent)?.get(key);
        table.get(key).or_else(below).unwrap_or(table.default)
    }

    /// Value of a fact or a pattern at a join: one about a symbol without an entry is unknown.
    pub(crate) fn get_joined(&self, fluent: Fluent, key: FactKey) -> TruthSet {
        if self.is_symbolic(fluent, key) {
            return self.entry(fluent, key).unwrap_or(TruthSet::NOTHING_KNOWN);
        }
        self.get(fluent, key)
    }

    /// Returns whether a fact is about a symbol.
    fn is_symbolic(&self, fluent: Fluent, key: FactKey) -> bool {
        // Tables that were added have no entities in their keys.
        fluent.index() < self.start.len()
            && (0..4).any(|index| (self.first_symbol..ANY).contains(&key.arg(index)))
    }

    /// Entry of a single fact, if it has one.
    pub(crate) fn entry(&self, fluent: Fluent, key: FactKey) -> Option<TruthSet> {
        let table = self.table(fluent)?;
        let below = || self.below(fluent)?.entry(key).filter(|_| table.get(key).is_none());
        table.entry(key).or_else(below)
    }

    /// Visits the single facts with an entry that a pattern covers, in no order.
    pub(crate) fn entries(&self, fluent: Fluent, pattern: FactKey, mut take: impl FnMut(FactKey, TruthSet)) {
        let mut single = |cell: &TableEntry| {
            if !cell.key.is_pattern() {
                take(cell.key, cell.value);
            }
        };
        if let Some(table) = self.table(fluent) {
            table.covered(pattern, &mut single);
        }
        self.unhidden(fluent, pattern, single);
    }

    /// Visits the facts and patterns with values of their own that a pattern covers, and where it crosses
    /// another one, in no order; one may come twice.
    pub(crate) fn parts(&self, fluent: Fluent, pattern: FactKey, mut take: impl FnMut(FactKey)) {
        let mut part = |cell: &TableEntry| {
            if cell.key != pattern {
                take(cell.key);
            }
        };
        if let Some(table) = self.table(fluent) {
            table.covered(pattern, &mut part);
        }
        self.unhidden(fluent, pattern, part);
        self.crossings(fluent, pattern, take);
    }

    /// Visits the single facts that were written above the start, in no order.
    pub(crate) fn written(&self, fluent: Fluent, mut take: impl FnMut(FactKey, TruthSet)) {
        if let Some(table) = self.table(fluent) {
            table.singles(|cell| take(cell.key, cell.value));
        }
    }

    /// Visits the facts and patterns that were written above the start, in no order.
    pub(crate) fn written_parts(&self, fluent: Fluent, mut take: impl FnMut(FactKey)) {
        if let Some(table) = self.table(fluent) {
            table.covered(FactKey::ALL, |cell| take(cell.key));
        }
    }

    /// Visits the entries of the start that a pattern covers and no entry hides.
    fn unhidden(&self, fluent: Fluent, pattern: FactKey, mut take: impl FnMut(&TableEntry)) {
        let Some((above, below)) = self.table(fluent).zip(self.below(fluent)) else { return };
        // What hides the pattern hides all that it covers.
        if above.get(pattern).is_none() {
            below.covered(pattern, |cell| {
                if above.get(cell.key).is_none() {
                    take(cell);
                }
            });
        }
    }

    /// Visits the intersections of a pattern with the other patterns that cross it.
    fn crossings(&self, fluent: Fluent, pattern: FactKey, mut take: impl FnMut(FactKey)) {
        for table in self.table(fluent).into_iter().chain(self.below(fluent)) {
            table.crossings(pattern, &mut take);
        }
    }

    /// Sets a fact, or a pattern with all that it covers.
    pub(crate) fn set(&mut self, fluent: Fluent, key: FactKey, value: TruthSet) {
        if !key.is_pattern() {
            return self.set_single(fluent, key, value);
        }
        let before = self.get_joined(fluent, key);
        let mut trail = std::mem::take(&mut self.trail);
        self.unhidden(fluent, key, |cell| {
            let (key, before) = (cell.key, cell.value);
            trail.push(TrailEntry { fluent, key, undo: Undo::Hidden, before });
        });
        self.crossings(fluent, key, |key| {
            trail.push(TrailEntry { fluent, key, undo: Undo::Hidden, before: self.get(fluent, key) });
        });
        self.trail = trail;
        let Some(table) = self.tables.get_mut(fluent.index()) else { return };
        effort::spend(effort::WRITE);
        table.drop_covered(key, |cell| {
            effort::spend(effort::WRITE);
            let undo = Undo::Put(cell.value, cell.time);
            self.trail.push(TrailEntry { fluent, key: cell.key, undo, before: cell.value });
        });
        let time = u32::try_from(self.trail.len()).unwrap_or(u32::MAX);
        let old = table.put(TableEntry { key, value, time });
        let undo = old.map_or(Undo::Drop, |old| Undo::Put(old.value, old.time));
        self.trail.push(TrailEntry { fluent, key, undo, before });
    }

    fn set_single(&mut self, fluent: Fluent, key: FactKey, value: TruthSet) {
        effort::spend(effort::WRITE);
        let time = u32::try_from(self.trail.len()).unwrap_or(u32::MAX);
        let (start, is_symbolic) = (self.start, self.is_symbolic(fluent, key));
        let Some(table) = self.tables.get_mut(fluent.index()) else { return };
        let (undo, before) = match table.put(TableEntry { key, value, time }) {
            Some(old) => (Undo::Put(old.value, old.time), old.value),
            None if is_symbolic => (Undo::Drop, TruthSet::NOTHING_KNOWN),
            None => {
                let below = || start.get(fluent.index())?.get(key);
                (Undo::Drop, table.covering(key).or_else(below).unwrap_or(table.default))
            }
        };
        self.trail.push(TrailEntry { fluent, key, undo, before });
    }

    /// Maps the value of a fact, or of each fact that a pattern covers.
    pub(crate) fn change(
        &mut self,
        fluent: Fluent,
        key: FactKey,
        change: impl Fn(FactKey, TruthSet) -> TruthSet,
    ) {
        let mut apart: SmallVec<[(FactKey, TruthSet); 8]> = SmallVec::new();
        if key.is_pattern() {
            if let Some(table) = self.table(fluent) {
                table.covered(key, |cell| apart.push((cell.key, cell.value)));
            }
            self.unhidden(fluent, key, |cell| apart.push((cell.key, cell.value)));
            self.crossings(fluent, key, |key| apart.push((key, self.get(fluent, key))));
            apart.retain(|(other, _)| *other != key);
            // The wider first, so that what they cover is written after them.
            apart.sort_unstable_by_key(|(key, _)| Rank::of((fluent, *key)));
        }
        let known = self.get(fluent, key);
        let new = change(key, known);
        if new == known && apart.iter().all(|(key, old)| change(*key, *old) == *old) {
            return;
        }
        self.set(fluent, key, new);
        for (key, old) in apart {
            self.set(fluent, key, change(key, old));
        }
    }

    /// Drops the entry of a fact or a pattern, so that wider patterns give its value again.
    pub(crate) fn forget(&mut self, fluent: Fluent, key: FactKey) {
        let Some(table) = self.tables.get_mut(fluent.index()) else { return };
        if let Some(old) = table.drop(key) {
            self.trail.push(TrailEntry {
                fluent,
                key,
                undo: Undo::Put(old.value, old.time),
                before: old.value,
            });
        }
    }

    /// Position in the trail, to roll back to.
    pub(crate) fn mark(&self) -> usize {
        self.trail.len()
    }

    /// Undoes all writes since `mark`.
    pub(crate) fn back_to(&mut self, mark: usize) {
        while self.trail.len() > mark {
            let Some(entry) = self.trail.pop() else { return };
            let Some(table) = self.tables.get_mut(entry.fluent.index()) else { return };
            match entry.undo {
                Undo::Put(value, time) => {
                    table.put(TableEntry { key: entry.key, value, time });
                }
                Undo::Drop => {
                    table.drop(entry.key);
                }
                Undo::Hidden => {}
            }
        }
    }

    /// All writes since `mark`, in order, each with the value before it.
    pub(crate) fn writes(&self, mark: usize) -> impl Iterator<Item = (Fluent, FactKey, TruthSet)> + '_ {
        let trail = self.trail.get(mark..).unwrap_or_default();
        trail.iter().map(|entry| (entry.fluent, entry.key, entry.before))
    }

    fn ranks(&self, mark: usize) -> Vec<Rank> {
        effort::spend(self.trail.len() - mark.min(self.trail.len()));
        Rank::each_once(self.writes(mark).map(|(fluent, key, _)| Rank::of((fluent, key))))
    }

    /// Facts and patterns written since `mark`, without duplicates.
    pub(crate) fn touched(&self, mark: usize) -> Vec<Atom> {
        self.ranks(mark).into_iter().map(Rank::atom).collect()
    }
}
