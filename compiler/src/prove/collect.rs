//! States that leave the straight way: what a handler, a monitor's reaction or the end of an inlined policy starts from.
//! Each is the join of the states at all points from which control can come.

use rustc_hash::FxHashMap;

use super::facts::{Atom, Delta, Facts, Key};
use super::value::Value;
use crate::ir::{Failure, Fluent, StepId};

/// The join of the states seen so far, as changes since a mark.
#[derive(Clone, Debug)]
pub(crate) struct Collector {
    pub(crate) mark: usize,
    pending: FxHashMap<Atom, Value>,
    /// The patterns among them.
    patterns: Vec<Atom>,
    /// Whether any state was seen.
    pub(crate) hit: bool,
    /// How far the trail has been taken in; only what comes after it can differ, unless the trail was cut back.
    last: usize,
    cut: bool,
}

/// What encloses the step that is being proved, and catches what leaves it.
#[derive(Clone, Debug)]
pub(crate) enum Enclosing {
    /// A `try`: a collector for each handler, with the failures that reach it.
    Try { catches: Vec<(Option<Vec<Failure>>, Collector, Vec<Failure>)> },
    /// An inlined policy: where it is done.
    Inline { step: StepId, exits: Collector },
    /// A monitor: all states of its body.
    Monitor { states: Collector },
}

impl Collector {
    pub(crate) fn new(mark: usize) -> Self {
        Self { mark, pending: FxHashMap::default(), patterns: Vec::new(), hit: false, last: mark, cut: false }
    }

    /// Takes in the state as it is.
    pub(crate) fn see(&mut self, facts: &Facts<'_>) {
        if self.hit && !self.cut && self.last == facts.mark() {
            return;
        }
        let from = if self.hit && !self.cut { self.last } else { self.mark };
        self.pending.reserve(facts.mark().saturating_sub(from));
        // Single facts first: one that is new here had, until now, the values of the patterns that cover it.
        for patterns in [false, true] {
            for (fluent, key, before) in facts.writes(from).filter(|(_, key, _)| key.is_pattern() == patterns)
            {
                let now = facts.get(fluent, key);
                if let Some(value) = self.pending.get_mut(&(fluent, key)) {
                    *value = value.join(now);
                    continue;
                }
                let value = if self.hit { self.earlier(fluent, key, now.join(before)) } else { now };
                if patterns {
                    self.patterns.push((fluent, key));
                }
                self.pending.insert((fluent, key), value);
            }
        }
        if self.cut {
            for ((fluent, key), value) in &mut self.pending {
                *value = value.join(facts.get(*fluent, *key));
            }
        }
        self.hit = true;
        self.cut = false;
        self.last = facts.mark();
    }

    /// A fact that is new here had, until now, the values of the patterns that cover it.
    fn earlier(&self, fluent: Fluent, key: Key, value: Value) -> Value {
        let covering =
            self.patterns.iter().filter(|(other, pattern)| *other == fluent && pattern.covers(key));
        let values = covering.filter_map(|atom| self.pending.get(atom));
        values.fold(value, |value, earlier| value.join(*earlier))
    }

    /// The trail was cut back to `mark`.
    pub(crate) fn cut_to(&mut self, mark: usize) {
        if self.last > mark {
            self.cut = true;
        }
    }

    /// The joined state, as a way from the mark.
    pub(crate) fn delta(&self) -> Delta {
        Delta::new(self.pending.iter().map(|(atom, value)| (*atom, *value)))
    }
}

impl Enclosing {
    pub(crate) fn cut_to(&mut self, mark: usize) {
        match self {
            Self::Try { catches } => catches.iter_mut().for_each(|(_, collector, _)| collector.cut_to(mark)),
            Self::Inline { exits, .. } => exits.cut_to(mark),
            Self::Monitor { states } => states.cut_to(mark),
        }
    }
}
