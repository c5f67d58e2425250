//! Collectors of states that leave the straight path: where a handler, a reaction or the code after an
//! inlined policy starts. Each holds the join of the states from which control can come.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::facts::TruthSet;
use crate::facts::{Atom, Delta, FactKey, FactStore};
use crate::ir::{Failure, Fluent, StepId};

/// Join of states, as changes since a mark.
#[derive(Clone, Debug)]
pub(crate) struct Collector {
    pub(crate) mark: usize,
    pending: FxHashMap<Atom, TruthSet>,
    /// Patterns among the changes.
    patterns: Vec<Atom>,
    /// True if a state was collected.
    pub(crate) hit: bool,
    /// Lengths of the trail at which a state was collected, in order, as long as the trail was not rolled
    /// back below them: only later writes can be new.
    seen: SmallVec<[usize; 8]>,
}

/// A construct around the step that is being proved, which catches control that leaves the step.
#[derive(Clone, Debug)]
pub(crate) enum Enclosing {
    /// A `try`: for each handler its failures, a collector, and the failures that reach it.
    Try { catches: Vec<(Option<Vec<Failure>>, Collector, Vec<Failure>)> },
    /// An inlined policy, with the states in which it is done.
    Inline { step: StepId, exits: Collector },
    /// A monitor, with all states of its body.
    Monitor { states: Collector },
}

impl Collector {
    pub(crate) fn new(mark: usize) -> Self {
        let (pending, patterns, seen) = (FxHashMap::default(), Vec::new(), SmallVec::new());
        Self { mark, pending, patterns, hit: false, seen }
    }

    /// Collects the present state.
    pub(crate) fn see(&mut self, facts: &FactStore<'_>) {
        let last = self.seen.last().copied();
        if last == Some(facts.mark()) {
            return;
        }
        let from = last.unwrap_or(self.mark);
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
        if self.hit && last.is_none() {
            for ((fluent, key), value) in &mut self.pending {
                *value = value.join(facts.get(*fluent, *key));
            }
        }
        self.hit = true;
        self.seen.push(facts.mark());
    }

    /// Value of a fact that is new here: until now, that of the patterns that cover it.
    fn earlier(&self, fluent: Fluent, key: FactKey, value: TruthSet) -> TruthSet {
        let covering =
            self.patterns.iter().filter(|(other, pattern)| *other == fluent && pattern.covers(key));
        let values = covering.filter_map(|atom| self.pending.get(atom));
        values.fold(value, |value, earlier| value.join(*earlier))
    }

    /// Follows a rollback of the trail to `mark`.
    pub(crate) fn cut_to(&mut self, mark: usize) {
        while self.seen.last().is_some_and(|seen| *seen > mark) {
            self.seen.pop();
        }
    }

    /// The joined state, as a path from the mark.
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
