//! What is known of one fluent: single facts and patterns, by their first argument.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::super::value::Value;
use super::Key;

/// A fact or a pattern and what is known of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cell {
    pub(super) key: Key,
    pub(super) value: Value,
    /// When it was written: of two patterns that cover a fact the later one wins.
    pub(super) time: u32,
}

/// Facts and patterns with one first argument, in no order.
type Row = SmallVec<[Cell; 2]>;

/// One fluent.
#[derive(Clone, Debug)]
pub(super) struct Table {
    rows: FxHashMap<u16, Row>,
    /// How many patterns there are among the rows.
    patterns: usize,
    /// Patterns whose first argument is `any`.
    wide: Vec<Cell>,
    /// What is known of the rest, where nothing lies below.
    pub(super) default: Value,
}

impl Table {
    pub(super) fn new(default: Value) -> Self {
        Self { rows: FxHashMap::default(), patterns: 0, wide: Vec::new(), default }
    }

    fn row(&self, key: Key) -> &[Cell] {
        match key.head() {
            Some(head) if !self.rows.is_empty() => self.rows.get(&head).map_or(&[], |row| row.as_slice()),
            Some(_) => &[],
            None => &self.wide,
        }
    }

    /// What is known of a fact or a pattern: its own entry, or else that of the latest pattern that covers it.
    pub(super) fn get(&self, key: Key) -> Option<Value> {
        let mut found: Option<&Cell> = None;
        for cell in self.row(key) {
            if cell.key == key {
                return Some(cell.value);
            }
            if self.patterns > 0 && cell.key.covers(key) && found.is_none_or(|found| found.time < cell.time) {
                found = Some(cell);
            }
        }
        let wide = self.wide.iter().filter(|cell| cell.key != key && cell.key.covers(key));
        found.into_iter().chain(wide).max_by_key(|cell| cell.time).map(|cell| cell.value)
    }

    /// What the latest pattern says that covers a fact, whatever its own entry.
    pub(super) fn covering(&self, key: Key) -> Option<Value> {
        let row = if self.patterns > 0 { self.row(key) } else { &[] };
        let patterns = row.iter().chain(&self.wide).filter(|cell| cell.key != key && cell.key.covers(key));
        patterns.max_by_key(|cell| cell.time).map(|cell| cell.value)
    }

    /// The entry of a fact or a pattern itself.
    pub(super) fn entry(&self, key: Key) -> Option<Value> {
        self.row(key).iter().find(|cell| cell.key == key).map(|cell| cell.value)
    }

    /// Hands out the entries that a pattern covers: single facts, patterns, and the pattern itself.
    pub(super) fn covered(&self, pattern: Key, mut take: impl FnMut(&Cell)) {
        let mut visit = |cells: &[Cell]| {
            for cell in cells.iter().filter(|cell| pattern.covers(cell.key)) {
                take(cell);
            }
        };
        if pattern.head().is_none() {
            self.rows.values().for_each(|row| visit(row));
        }
        visit(self.row(pattern));
    }

    /// Hands out what a pattern shares with each other pattern that crosses it.
    pub(super) fn crossings(&self, pattern: Key, mut take: impl FnMut(Key)) {
        let mut visit = |cells: &[Cell]| {
            cells.iter().filter_map(|cell| cell.key.crossing(pattern)).for_each(&mut take);
        };
        visit(&self.wide);
        match pattern.head() {
            _ if self.patterns == 0 => {}
            Some(_) => visit(self.row(pattern)),
            None => self.rows.values().for_each(|row| visit(row)),
        }
    }

    /// Writes the entry of a fact or a pattern, and returns the one that it replaces.
    pub(super) fn put(&mut self, cell: Cell) -> Option<Cell> {
        match cell.key.head() {
            Some(head) => {
                let row = self.rows.entry(head).or_default();
                let old = replace(row, cell);
                if old.is_none() {
                    row.push(cell);
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
    pub(super) fn drop(&mut self, key: Key) -> Option<Cell> {
        let at = self.row(key).iter().position(|cell| cell.key == key)?;
        match key.head() {
            Some(head) => {
                self.patterns -= usize::from(key.is_pattern());
                self.rows.get_mut(&head).map(|row| row.swap_remove(at))
            }
            None => Some(self.wide.swap_remove(at)),
        }
    }

    /// Drops all entries that a pattern covers, and tells of each.
    pub(super) fn drop_covered(&mut self, pattern: Key, mut tell: impl FnMut(Cell)) {
        let patterns = &mut self.patterns;
        let mut keep = |cell: &mut Cell| {
            let stays = !pattern.covers(cell.key);
            if !stays {
                *patterns -= usize::from(cell.key.is_pattern() && cell.key.head().is_some());
                tell(*cell);
            }
            stays
        };
        match pattern.head() {
            Some(head) => {
                if let Some(row) = self.rows.get_mut(&head).filter(|row| !row.is_empty()) {
                    row.retain(keep);
                }
            }
            None => {
                self.rows.values_mut().filter(|row| !row.is_empty()).for_each(|row| row.retain(&mut keep));
                self.wide.retain_mut(keep);
            }
        }
    }
}

/// Writes a cell over the one of the same key.
fn replace(cells: &mut [Cell], cell: Cell) -> Option<Cell> {
    let old = cells.iter_mut().find(|old| old.key == cell.key)?;
    Some(std::mem::replace(old, cell))
}
