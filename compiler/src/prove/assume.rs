//! Narrowing: the facts after a condition was observed to hold, or was not observed to hold.

use super::Prover;
use super::evaluation::CallFrame;
use crate::facts::{Cause, PathPartition, TruthSet};
use crate::ir::{Condition, Fluent};

/// Maximal number of joins that are remembered.
const MAX_PARTITIONS: usize = 8;
/// Maximal number of paths of a join that are kept apart.
pub(super) const MAX_PATHS: usize = 24;
/// Number of writes after which a join is forgotten.
const MAX_AGE: usize = 1000;

/// Outcome of a test in the run. A condition that stays unknown is neither true nor false.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Outcome {
    True,
    False,
    /// False or unknown: the `else` of an `if`, the next round of a `repeat … until`.
    NotTrue,
    /// True or unknown.
    NotFalse,
}

impl Outcome {
    /// Outcome of the negated condition.
    fn not(self) -> Self {
        match self {
            Self::True => Self::False,
            Self::False => Self::True,
            Self::NotTrue => Self::NotFalse,
            Self::NotFalse => Self::NotTrue,
        }
    }

    /// The truth value that the condition has if it is known.
    fn truth(self) -> bool {
        matches!(self, Self::True | Self::NotFalse)
    }

    /// Returns whether the condition may also stay unknown.
    fn is_weak(self) -> bool {
        matches!(self, Self::NotTrue | Self::NotFalse)
    }

    /// The values of a fact that this outcome leaves; `None` if there are none.
    fn narrow(self, known: TruthSet, cause: Cause) -> Option<TruthSet> {
        let seen = known.narrow(self.truth(), cause)?;
        Some(if self.is_weak() { seen.join(TruthSet::open(known.open)) } else { seen })
    }
}

impl Prover<'_> {
    /// Remembers the paths of a join.
    pub(crate) fn remember(&mut self, partition: PathPartition) {
        if (2..=MAX_PATHS).contains(&partition.paths().count()) {
            if self.state.partitions.len() >= MAX_PARTITIONS {
                self.state.partitions.remove(0);
            }
            self.state.partitions.push(partition);
        }
    }

    /// Narrows the facts to those in which `condition` has an outcome; returns false if there are none, so
    /// that the path is dead.
    ///
    /// Paths of earlier joins on which the condition cannot hold are ruled out: facts of one path alone are
    /// known again once a test shows that it was taken.
    pub(crate) fn assume(
        &mut self,
        condition: &Condition,
        outcome: Outcome,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        for index in (0..self.state.partitions.len()).rev() {
            let Some(slot) = self.state.partitions.get_mut(index) else { break };
            let partition = std::mem::take(slot);
            let passes = self.retrace(&partition, condition, outcome, cause, frame);
            if let Some(slot) = self.state.partitions.get_mut(index) {
                *slot = partition;
            }
            if !passes {
                return false;
            }
        }
        self.narrow(condition, outcome, cause, frame)
    }

    /// Rules out the paths of a join on which `condition` cannot have an outcome; returns false if that is
    /// all of them.
    fn retrace(
        &mut self,
        partition: &PathPartition,
        condition: &Condition,
        outcome: Outcome,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        let here = self.state.facts.mark();
        if here > partition.since + MAX_AGE
            || !partition.differs(|fluent| mentions(condition, fluent) || self.is_tested(condition, fluent))
        {
            return true;
        }
        // What was written since holds on every path.
        let later = self.state.facts.delta(partition.since);
        let (mut open, mut all) = (Vec::new(), 0_usize);
        for path in partition.paths() {
            all += 1;
            for ((fluent, key), value) in path {
                self.state.facts.set(fluent, key, value);
            }
            self.state.facts.replay(&later);
            if self.narrow(condition, outcome, cause, frame) {
                open.push(self.state.facts.delta(here));
            }
            self.state.facts.back_to(here);
        }
        if open.len() < all {
            self.state.facts.join(&open);
        }
        !open.is_empty()
    }

    /// As [`assume`](Self::assume), without the paths of earlier joins.
    pub(super) fn narrow(
        &mut self,
        condition: &Condition,
        outcome: Outcome,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        let truth = outcome.truth();
        match condition {
            Condition::Literal(value) => *value == truth,
            Condition::Unknown | Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) => true,
            Condition::Not(inner) => self.narrow(inner, outcome.not(), cause, frame),
            Condition::Compare(op, left, right) => {
                let is_possible = possible(self.evaluate(condition, frame), truth);
                if is_possible {
                    self.note((*op, left, right), truth, cause);
                }
                is_possible
            }
            Condition::Fact(fact) => {
                let known = self.evaluate(condition, frame);
                if !possible(known, truth) {
                    return false;
                }
                let derived = self.library.fluent(fact.fluent).is_some_and(|def| def.derived);
                let Some(key) = self.key(fact, frame).filter(|_| !derived) else { return true };
                if key.is_pattern() {
                    // Some entity has it, but which is not known; none has it, and that is known of all.
                    let is_seen = !outcome.is_weak() || !known.open.is_some();
                    if !truth && is_seen && !known.is_false() {
                        self.learn(fact.fluent, key, TruthSet::no(cause));
                    }
                    return true;
                }
                match outcome.narrow(known, cause) {
                    Some(narrowed) => {
                        if narrowed != known {
                            self.learn(fact.fluent, key, narrowed);
                        }
                        true
                    }
                    None => false,
                }
            }
            Condition::All(parts) => self.narrow_all(parts, outcome, cause, frame),
            Condition::AnyOf(parts) => self.narrow_any(parts, outcome, cause, frame),
        }
    }

    fn narrow_all(
        &mut self,
        parts: &[Condition],
        outcome: Outcome,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        if outcome.truth() {
            return parts.iter().all(|part| self.narrow(part, outcome, cause, frame));
        }
        // Not all hold: if all but one certainly do, it is that one.
        let mut doubtful = parts.iter().filter(|part| !self.evaluate(part, frame).is_true());
        match (doubtful.next(), doubtful.next()) {
            (None, _) => false,
            (Some(only), None) => self.narrow(only, outcome, cause, frame),
            (Some(_), Some(_)) => true,
        }
    }

    fn narrow_any(
        &mut self,
        parts: &[Condition],
        outcome: Outcome,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        if !outcome.truth() {
            return parts.iter().all(|part| self.narrow(part, outcome, cause, frame));
        }
        let mut doubtful = parts.iter().filter(|part| !self.evaluate(part, frame).is_false());
        match (doubtful.next(), doubtful.next()) {
            (None, _) => false,
            (Some(only), None) => self.narrow(only, outcome, cause, frame),
            (Some(_), Some(_)) => true,
        }
    }
}

/// Returns whether a condition with these values can be `truth`.
fn possible(value: TruthSet, truth: bool) -> bool {
    let known = if truth { value.yes } else { value.no };
    known.is_some() || value.open.is_some()
}

/// Returns whether a condition mentions a fluent.
pub(crate) fn mentions(condition: &Condition, fluent: Fluent) -> bool {
    condition.any(&|part| matches!(part, Condition::Fact(fact) if fact.fluent == fluent))
}
