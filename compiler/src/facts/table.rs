//! Table of one fluent: single facts and patterns, by first argument.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{FactKey, TruthSet, effort};

/// Value of a fact or a pattern.
#[derive(Clone, Copy, Debug)]
pub(super) struct TableEntry {
    pub(super) key: FactKey,
    pub(super) value: TruthSet,
    /// Time of the write: of two patterns that cover a fact the later one wins.
    pub(super) time: u32,
}

/// Entries in no order.
type Row = SmallVec<[TableEntry; 4]>;

/// Maximal number of entries in one row; more are separated by their first argument.
const FEW: usize = 16;

/// Entries whose first argument is not `any`.
#[derive(Clone, Debug)]
enum Rows {
    /// All in one row: most policies write few facts of a fluent.
    One(Row),
    Many(FxHashMap<u16, Row>),
}

impl Rows {
    /// Entries with a first argument, perhaps among others.
    fn with(&self, head: u16) -> &[TableEntry] {
        match self {
            Self::One(row) => row,
            Self::Many(rows) => rows.get(&head).map_or(&[], |row| row.as_slice()),
        }
    }

    fn with_mut(&mut self, head: u16) -> Option<&mut Row> {
        match self {
            Self::One(row) => Some(row),
            Self::Many(rows) => rows.get_mut(&head),
        }
    }

    fn for_each(&self, mut visit: impl FnMut(&[TableEntry])) {
        match self {
            Self::One(row) => visit(row),
            Self::Many(rows) => rows.values().for_each(|row| visit(row)),
        }
    }

    fn for_each_mut(&mut self, mut visit: impl FnMut(&mut Row)) {
        match self {
            Self::One(row) => visit(row),
            Self::Many(rows) => rows.values_mut().for_each(visit),
        }
    }

    fn push(&mut self, head: u16, cell: TableEntry) {
        if let Self::One(row) = self {
            if row.len() < FEW {
                return row.push(cell);
            }
            let mut rows: FxHashMap<u16, Row> = FxHashMap::default();
            for cell in row.drain(..) {
                rows.entry(cell.key.arg(0)).or_default().push(cell);
            }
            *self = Self::Many(rows);
        }
        if let Self::Many(rows) = self {
            rows.entry(head).or_default().push(cell);
        }
    }
}

/// Known facts of one fluent.
#[derive(Clone, Debug)]
pub(super) struct FluentTable {
    rows: Rows,
    /// Number of patterns among the rows.
    patterns: usize,
    /// Patterns whose first argument is `any`.
    wide: Vec<TableEntry>,
    /// Mask of the arguments that were ever `any` in a pattern.
    places: u64,
    /// Value of facts without an entry, here and below.
    pub(super) default: TruthSet,
}

impl FluentTable {
    pub(super) fn new(default: TruthSet) -> Self {
        Self { rows: Rows::One(Row::new()), patterns: 0, wide: Vec::new(), places: 0, default }
    }

    /// Returns whether there is no entry.
    pub(super) fn is_empty(&self) -> bool {
        self.wide.is_empty() && matches!(&self.rows, Rows::One(row) if row.is_empty())
    }

    /// Visits all single facts with an entry.
    pub(super) fn singles(&self, mut take: impl FnMut(&TableEntry)) {
        self.rows.for_each(|cells| {
            effort::spend(cells.len());
            cells.iter().filter(|cell| !cell.key.is_pattern()).for_each(&mut take);
        });
    }

    /// Entries with the same first argument as a key, perhaps among others.
    fn row(&self, key: FactKey) -> &[TableEntry] {
        let row = key.head().map_or(self.wide.as_slice(), |head| self.rows.with(head));
        effort::spend(row.len());
        row
    }

    /// Value of a fact or a pattern: its own entry, or else that of the latest pattern that covers it.
    pub(super) fn get(&self, key: FactKey) -> Option<TruthSet> {
        self.entry(key).or_else(|| self.covering(key))
    }

    /// Returns whether there is a pattern.
    #[inline]
    fn has_patterns(&self) -> bool {
        self.patterns > 0 || !self.wide.is_empty()
    }

    /// Value of the latest pattern that covers a fact, whatever its own entry.
    #[inline]
    pub(super) fn covering(&self, key: FactKey) -> Option<TruthSet> {
        if self.has_patterns() { self.latest_covering(key) } else { None }
    }

    fn latest_covering(&self, key: FactKey) -> Option<TruthSet> {
        let mut latest: Option<&TableEntry> = None;
        let row = if self.patterns > 0 { self.row(key) } else { &[] };
        for cells in [row, &self.wide] {
            for cell in cells {
                let covers = cell.key != key && cell.key.covers(key);
                if covers && latest.is_none_or(|latest| latest.time < cell.time) {
                    latest = Some(cell);
                }
            }
        }
        latest.map(|cell| cell.value)
    }

    /// Entry of a fact or a pattern itself.
    pub(super) fn entry(&self, key: FactKey) -> Option<TruthSet> {
        self.row(key).iter().find(|cell| cell.key == key).map(|cell| cell.value)
    }

    /// Visits the entries that a pattern covers: single facts, patterns, and the pattern itself.
    pub(super) fn covered(&self, pattern: FactKey, mut take: impl FnMut(&TableEntry)) {
        let mut visit = |cells: &[TableEntry]| {
            effort::spend(cells.len());
            for cell in cells.iter().filter(|cell| pattern.covers(cell.key)) {
                take(cell);
            }
        };
        if pattern.head().is_none() {
            self.rows.for_each(&mut visit);
        }
        visit(self.row(pattern));
    }

    /// Visits the intersections of a pattern with the other patterns that cross it.
    #[inline]
    pub(super) fn crossings(&self, pattern: FactKey, take: impl FnMut(FactKey)) {
        // Only what is `any` in a place where this one is not.
        if self.places & !pattern.any() != 0 {
            self.each_crossing(pattern, take);
        }
    }

    fn each_crossing(&self, pattern: FactKey, mut take: impl FnMut(FactKey)) {
        let mut visit = |cells: &[TableEntry]| {
            effort::spend(cells.len());
            cells.iter().filter_map(|cell| cell.key.crossing(pattern)).for_each(&mut take);
        };
        visit(&self.wide);
        match pattern.head() {
            _ if self.patterns == 0 => {}
            Some(_) => visit(self.row(pattern)),
            None => self.rows.for_each(visit),
        }
    }

    /// Writes an entry, and returns the one that it replaces.
    pub(super) fn put(&mut self, cell: TableEntry) -> Option<TableEntry> {
        self.places |= cell.key.any();
        match cell.key.head() {
            Some(head) => {
                let old = self.rows.with_mut(head).and_then(|row| replace(row, cell));
                if old.is_none() {
                    self.rows.push(head, cell);
                    self.patterns += usize::from(cell.key.is_pattern());
                }
                old
            }
            None => {
                let old = replace(&mut self.wide, cell);
                if old.is_none() {
                    self.wide.push(cell);
                }
                old
            }
        }
    }

    /// Drops the entry of a fact or a pattern.
    pub(super) fn drop(&mut self, key: FactKey) -> Option<TableEntry> {
        let at = self.row(key).iter().position(|cell| cell.key == key)?;
        match key.head() {
            Some(head) => {
                self.patterns -= usize::from(key.is_pattern());
                self.rows.with_mut(head).map(|row| row.swap_remove(at))
            }
            None => Some(self.wide.swap_remove(at)),
        }
    }

    /// Drops all entries that a pattern covers, and visits each.
    pub(super) fn drop_covered(&mut self, pattern: FactKey, mut tell: impl FnMut(TableEntry)) {
        let patterns = &mut self.patterns;
        let mut keep = |cell: &mut TableEntry| {
            let stays = !pattern.covers(cell.key);
            if !stays {
                *patterns -= usize::from(cell.key.is_pattern() && cell.key.head().is_some());
                tell(*cell);
            }
            stays
        };
        match pattern.head() {
            Some(head) => {
                let covers = |row: &Row| row.iter().any(|cell| pattern.covers(cell.key));
                if let Some(row) = self.rows.with_mut(head).filter(|row| covers(row)) {
                    row.retain(keep);
                }
            }
            None => {
                self.rows.for_each_mut(|row| row.retain(&mut keep));
                self.wide.retain_mut(keep);
            }
        }
    }
}

/// Overwrites the entry with the same key.
fn replace(cells: &mut [TableEntry], cell: TableEntry) -> Option<TableEntry> {
    let old = cells.iter_mut().find(|old| old.key == cell.key)?;
    Some(std::mem::replace(old, cell))
}
