//! Collectors of states that leave the straight path: where a handler, a reaction or the code after an
//! inlined policy starts. Each holds the join of the states from which control can come.

use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::Prover;
use super::assume::MAX_PATHS;
use crate::analysis::Enclosing;
use crate::facts::{Atom, Delta, FactKey, FactStore, TruthSet, effort};
use crate::ir::Fluent;

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
    /// Paths to the collected states; none if they are too many to be kept apart.
    paths: Option<Vec<Delta>>,
}

impl Collector {
    pub(crate) fn new(mark: usize) -> Self {
        let (pending, patterns, seen) = (FxHashMap::default(), Vec::new(), SmallVec::new());
        Self { mark, pending, patterns, hit: false, seen, paths: None }
    }

    /// Collects the present state and the path to it.
    pub(crate) fn see_path(&mut self, facts: &FactStore<'_>) {
        if self.seen.last() == Some(&facts.mark()) {
            return;
        }
        if !self.hit {
            self.paths = Some(Vec::new());
        }
        match &mut self.paths {
            Some(paths) if paths.len() < MAX_PATHS => paths.push(facts.delta(self.mark)),
            paths => *paths = None,
        }
        self.see(facts);
    }

    /// Paths to the collected states, if all were kept.
    pub(crate) fn paths(&self) -> Option<&[Delta]> {
        self.paths.as_deref()
    }

    /// Collects the present state.
    pub(crate) fn see(&mut self, facts: &FactStore<'_>) {
        let last = self.seen.last().copied();
        if last == Some(facts.mark()) {
            return;
        }
        let from = last.unwrap_or(self.mark);
        effort::spend(2 * facts.mark().saturating_sub(from));
        self.pending.reserve(facts.mark().saturating_sub(from));
        // Single facts first: one that is new here had, until now, the values of the patterns that cover it.
        for patterns in [false, true] {
            for (fluent, key, before) in facts.writes(from).filter(|(_, key, _)| key.is_pattern() == patterns)
            {
                let now = facts.get_joined(fluent, key);
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
                *value = value.join(facts.get_joined(*fluent, *key));
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

impl Prover<'_> {
    /// Lets enclosing monitors collect the present state, in which they may fire, and enclosing cleanups,
    /// which may begin in it.
    pub(crate) fn see_states(&mut self) {
        let (enclosing, facts) = (&mut self.control.enclosing, &self.state.facts);
        for enclosing in enclosing {
            match enclosing {
                Enclosing::Monitor { states } => states.see(facts),
                Enclosing::Finally(leaving) => {
                    leaving.interrupted.iter_mut().for_each(|states| states.see(facts));
                }
                Enclosing::Try { .. } | Enclosing::Inline { .. } | Enclosing::Cleanup(_) => {}
            }
        }
    }
}
