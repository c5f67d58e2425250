//! What is known of all facts at one point of a policy, with a trail to go back on.
//!
//! A fluent's table holds single facts and patterns with `any` in some places. A pattern says what holds of every fact
//! that it covers and that has no entry of its own; writing one drops the entries that it covers. So `not on(cup, any)`
//! costs what is known of it, not the size of the world.

use std::collections::hash_map::Entry as MapEntry;

use rustc_hash::FxHashMap;
use smol_str::SmolStr;

use super::value::Value;
use crate::ir::{Entity, Fluent};

/// Arguments of a fact, 16 bits each, the first lowest.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Debug)]
pub(crate) struct Key(pub(crate) u64);

/// `any` in a key.
pub(crate) const ANY: u16 = u16::MAX;

impl Key {
    /// Every fact of a fluent.
    pub(crate) const ALL: Self = Self(u64::MAX);

    pub(crate) fn new(args: impl Iterator<Item = u16>) -> Self {
        Self(args.take(4).enumerate().fold(0, |key, (index, arg)| key | (u64::from(arg) << (16 * index))))
    }

    pub(crate) fn arg(self, index: usize) -> u16 {
        u16::try_from((self.0 >> (16 * index.min(3))) & 0xffff).unwrap_or(ANY)
    }

    /// The key with one argument replaced.
    pub(crate) fn with(self, index: usize, arg: u16) -> Self {
        let shift = 16 * index.min(3);
        Self((self.0 & !(0xffff << shift)) | (u64::from(arg) << shift))
    }

    /// Bits of the arguments that are not `any`.
    fn concrete(self) -> u64 {
        (0..4).filter(|index| self.arg(*index) != ANY).fold(0, |bits, index| bits | (0xffff << (16 * index)))
    }

    pub(crate) fn is_pattern(self) -> bool {
        self.concrete() != u64::MAX
    }

    /// Whether every fact of `other` is one of this pattern.
    pub(crate) fn covers(self, other: Self) -> bool {
        (self.0 ^ other.0) & self.concrete() == 0
    }
}

#[derive(Clone, Debug)]
struct Table {
    single: FxHashMap<Key, Value>,
    /// Later ones win.
    patterns: Vec<(Key, Value)>,
    default: Value,
}

/// One write, so that it can be taken back.
#[derive(Clone, Copy, Debug)]
struct Entry {
    fluent: Fluent,
    key: Key,
    undo: Undo,
    /// What was known before, also where there was no entry.
    before: Value,
}

#[derive(Clone, Copy, Debug)]
enum Undo {
    /// Put the single entry back, or drop it.
    Single(Option<Value>),
    /// Drop the newest pattern.
    Pattern,
    /// Put a pattern back in its place.
    Removed(usize, Value),
}

/// A fact as the tables know it.
pub(crate) type Atom = (Fluent, Key);

/// The facts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Facts {
    tables: Vec<Table>,
    trail: Vec<Entry>,
}

impl Facts {
    /// Tables for `fluents` fluents, of which nothing is known but `default`.
    pub(crate) fn new(fluents: usize, default: Value) -> Self {
        let table = Table { single: FxHashMap::default(), patterns: Vec::new(), default };
        Self { tables: vec![table; fluents], trail: Vec::new() }
    }

    /// Adds a table; its fluent is the next index.
    pub(crate) fn add_table(&mut self, default: Value) -> Fluent {
        let id = Fluent(u16::try_from(self.tables.len()).unwrap_or(u16::MAX));
        self.tables.push(Table { single: FxHashMap::default(), patterns: Vec::new(), default });
        id
    }

    /// What is known of a fact; of a pattern, what is known of those it covers that have no entry of their own.
    pub(crate) fn get(&self, fluent: Fluent, key: Key) -> Value {
        let Some(table) = self.tables.get(fluent.index()) else { return Value::NOTHING_KNOWN };
        if let Some(value) = table.single.get(&key) {
            return *value;
        }
        pattern_value(&table.patterns, key).unwrap_or(table.default)
    }

    /// The entry of a single fact, where it has one.
    pub(crate) fn entry(&self, fluent: Fluent, key: Key) -> Option<Value> {
        self.tables.get(fluent.index())?.single.get(&key).copied()
    }

    /// The single facts with an entry that a pattern covers.
    pub(crate) fn entries(&self, fluent: Fluent, pattern: Key) -> impl Iterator<Item = (Key, Value)> + '_ {
        let single = self.tables.get(fluent.index()).map(|table| table.single.iter());
        let all = single.into_iter().flatten().map(|(key, value)| (*key, *value));
        all.filter(move |(key, _)| pattern.covers(*key))
    }

    /// All single facts of all fluents.
    pub(crate) fn all_entries(&self) -> impl Iterator<Item = (Fluent, Key, Value)> + '_ {
        self.tables.iter().enumerate().flat_map(|(index, table)| {
            let fluent = Fluent(u16::try_from(index).unwrap_or(u16::MAX));
            table.single.iter().map(move |(key, value)| (fluent, *key, *value))
        })
    }

    /// Sets a fact, or a pattern and all that it covers.
    pub(crate) fn set(&mut self, fluent: Fluent, key: Key, value: Value) {
        if !key.is_pattern() {
            let Some(table) = self.tables.get_mut(fluent.index()) else { return };
            let (old, before) = match table.single.entry(key) {
                MapEntry::Occupied(mut entry) => {
                    let old = entry.insert(value);
                    (Some(old), old)
                }
                MapEntry::Vacant(entry) => {
                    entry.insert(value);
                    (None, pattern_value(&table.patterns, key).unwrap_or(table.default))
                }
            };
            self.trail.push(Entry { fluent, key, undo: Undo::Single(old), before });
            return;
        }
        let before = self.get(fluent, key);
        let covered: Vec<_> = self.entries(fluent, key).collect();
        let Some(table) = self.tables.get_mut(fluent.index()) else { return };
        for (single, old) in covered {
            table.single.remove(&single);
            self.trail.push(Entry { fluent, key: single, undo: Undo::Single(Some(old)), before: old });
        }
        while let Some(at) = table.patterns.iter().position(|(pattern, _)| key.covers(*pattern)) {
            let (pattern, old) = table.patterns.remove(at);
            self.trail.push(Entry { fluent, key: pattern, undo: Undo::Removed(at, old), before: old });
        }
        table.patterns.push((key, value));
        self.trail.push(Entry { fluent, key, undo: Undo::Pattern, before });
    }

    /// Drops the entry of a single fact: what is known of it is again what its patterns say.
    pub(crate) fn forget(&mut self, fluent: Fluent, key: Key) {
        let Some(table) = self.tables.get_mut(fluent.index()) else { return };
        if let Some(old) = table.single.remove(&key) {
            self.trail.push(Entry { fluent, key, undo: Undo::Single(Some(old)), before: old });
        }
    }

    /// A point to go back to.
    pub(crate) fn mark(&self) -> usize {
        self.trail.len()
    }

    /// Takes back all writes since `mark`.
    pub(crate) fn back_to(&mut self, mark: usize) {
        while self.trail.len() > mark {
            let Some(entry) = self.trail.pop() else { return };
            let Some(table) = self.tables.get_mut(entry.fluent.index()) else { return };
            match entry.undo {
                Undo::Single(Some(old)) => {
                    table.single.insert(entry.key, old);
                }
                Undo::Single(None) => {
                    table.single.remove(&entry.key);
                }
                Undo::Pattern => {
                    table.patterns.pop();
                }
                Undo::Removed(at, old) => {
                    table.patterns.insert(at.min(table.patterns.len()), (entry.key, old))
                }
            }
        }
    }

    /// All writes since `mark`, in order: what was written, and what was known of it just before.
    pub(crate) fn writes(&self, mark: usize) -> impl Iterator<Item = (Fluent, Key, Value)> + '_ {
        let trail = self.trail.get(mark..).unwrap_or_default();
        trail.iter().map(|entry| (entry.fluent, entry.key, entry.before))
    }

    /// The facts and patterns written since `mark`, each once.
    pub(crate) fn touched(&self, mark: usize) -> Vec<Atom> {
        let mut atoms: Vec<Atom> = self.writes(mark).map(|(fluent, key, _)| (fluent, key)).collect();
        atoms.sort_unstable_by_key(order);
        atoms.dedup();
        atoms
    }

    /// The writes since `mark` and what they leave: one way through a fork.
    pub(crate) fn delta(&self, mark: usize) -> Delta {
        let atoms = self.touched(mark).into_iter();
        Delta { written: atoms.map(|atom| (atom, self.get(atom.0, atom.1))).collect() }
    }

    /// Joins the ways through a fork that began where the facts are now. No way leaves the facts as they are.
    pub(crate) fn join(&mut self, ways: &[Delta]) {
        if let [only] = ways {
            self.replay(only);
            return;
        }
        let mut atoms: Vec<Atom> =
            ways.iter().flat_map(|way| way.written.iter().map(|(atom, _)| *atom)).collect();
        atoms.sort_unstable_by_key(order);
        atoms.dedup();
        let values: Vec<_> = atoms
            .iter()
            .map(|atom| {
                let joined = ways.iter().map(|way| way.get(self, *atom)).reduce(Value::join);
                joined.unwrap_or_else(|| self.get(atom.0, atom.1))
            })
            .collect();
        for ((fluent, key), value) in atoms.into_iter().zip(values) {
            if key.is_pattern() || self.get(fluent, key) != value {
                self.set(fluent, key, value);
            }
        }
    }

    /// Goes one way on.
    pub(crate) fn replay(&mut self, way: &Delta) {
        for ((fluent, key), value) in &way.written {
            self.set(*fluent, *key, *value);
        }
    }
}

fn pattern_value(patterns: &[(Key, Value)], key: Key) -> Option<Value> {
    patterns.iter().rev().find(|(pattern, _)| pattern.covers(key)).map(|(_, value)| *value)
}

/// Patterns first, the widest before the others, so that the facts they cover are written after them.
fn order((fluent, key): &Atom) -> (u32, Fluent, Key) {
    (key.concrete().count_ones(), *fluent, *key)
}

/// What one way through a fork left written, in [`order`].
#[derive(Clone, Debug, Default)]
pub(crate) struct Delta {
    written: Vec<(Atom, Value)>,
}

impl Delta {
    pub(crate) fn new(written: impl Iterator<Item = (Atom, Value)>) -> Self {
        let mut written: Vec<_> = written.collect();
        written.sort_unstable_by_key(|(atom, _)| order(atom));
        Self { written }
    }

    /// This way or the other, from the same fork.
    pub(crate) fn or(&self, other: &Self, base: &Facts) -> Self {
        let mut atoms: Vec<_> = self.written.iter().chain(&other.written).map(|(atom, _)| *atom).collect();
        atoms.sort_unstable_by_key(order);
        atoms.dedup();
        let joined = atoms.into_iter().map(|atom| (atom, self.get(base, atom).join(other.get(base, atom))));
        Self { written: joined.collect() }
    }

    /// Whether both ways leave the same sets of values, whatever caused them.
    pub(crate) fn same_sets(&self, other: &Self, base: &Facts) -> bool {
        let mut atoms = self.written.iter().chain(&other.written).map(|(atom, _)| *atom);
        atoms.all(|atom| self.get(base, atom).same_set(other.get(base, atom)))
    }

    /// What this way knows of a fact; `base` is where the fork began.
    pub(crate) fn get(&self, base: &Facts, atom: Atom) -> Value {
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

/// A fact in words: "`on(cup, table)`".
pub(crate) fn show(name: &str, key: Key, arity: usize, arg: impl Fn(usize, u16) -> SmolStr) -> String {
    let args: Vec<_> = (0..arity)
        .map(|index| {
            let value = key.arg(index);
            if value == ANY { SmolStr::new_static("any") } else { arg(index, value) }
        })
        .collect();
    if args.is_empty() { format!("`{name}`") } else { format!("`{name}({})`", args.join(", ")) }
}

/// An entity as an argument.
pub(crate) fn arg(entity: Entity) -> u16 {
    entity.0
}
