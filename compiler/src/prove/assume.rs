//! Narrowing: what is known once a condition was seen to hold, or not to.

use smallvec::SmallVec;

use super::Prover;
use super::evaluation::CallFrame;
use crate::facts::PathPartition;
use crate::facts::{Cause, TruthSet};
use crate::ir::{Condition, Fluent};

/// How many meetings of ways are remembered.
const MAX_PARTITIONS: usize = 8;
/// How many ways that met are kept apart.
const MAX_WAYS: usize = 8;
/// After how many writes a meeting is forgotten.
const MAX_AGE: usize = 1000;

impl Prover<'_> {
    /// Remembers ways that have just met.
    pub(crate) fn remember(&mut self, partition: PathPartition) {
        if (2..=MAX_WAYS).contains(&partition.ways().count()) {
            if self.partitions.len() >= MAX_PARTITIONS {
                self.partitions.remove(0);
            }
            self.partitions.push(partition);
        }
    }

    /// Narrows the facts to those in which `condition` is `truth`; false where there are none, so that the way is dead.
    ///
    /// Of the ways that met before, those on which it cannot be so are left out again: what was learnt or done on one way
    /// only is known once a test tells that it was this way.
    pub(crate) fn assume(
        &mut self,
        condition: &Condition,
        truth: bool,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        for index in (0..self.partitions.len()).rev() {
            let Some(slot) = self.partitions.get_mut(index) else { break };
            let partition = std::mem::take(slot);
            let passes = self.retrace(&partition, condition, truth, cause, frame);
            if let Some(slot) = self.partitions.get_mut(index) {
                *slot = partition;
            }
            if !passes {
                return false;
            }
        }
        self.narrow(condition, truth, cause, frame)
    }

    /// Leaves out the ways of a meeting on which `condition` cannot be `truth`; false where that is all of them.
    fn retrace(
        &mut self,
        partition: &PathPartition,
        condition: &Condition,
        truth: bool,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        let here = self.facts.mark();
        if here > partition.since + MAX_AGE || !partition.differs(|fluent| mentions(condition, fluent)) {
            return true;
        }
        // What was written since holds on every way.
        let later = self.facts.delta(partition.since);
        let (mut open, mut all) = (Vec::new(), 0_usize);
        for way in partition.ways() {
            all += 1;
            for ((fluent, key), value) in way {
                self.facts.set(fluent, key, value);
            }
            self.facts.replay(&later);
            if self.narrow(condition, truth, cause, frame) {
                open.push(self.facts.delta(here));
            }
            self.facts.back_to(here);
        }
        if open.len() < all {
            self.facts.join(&open);
        }
        !open.is_empty()
    }

    fn narrow(&mut self, condition: &Condition, truth: bool, cause: Cause, frame: CallFrame<'_>) -> bool {
        match condition {
            Condition::Literal(value) => *value == truth,
            Condition::Unknown | Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) => true,
            Condition::Not(inner) => self.narrow(inner, !truth, cause, frame),
            Condition::Compare(..) => possible(self.evaluate(condition, frame), truth),
            Condition::Fact(fact) => {
                let known = self.evaluate(condition, frame);
                if !possible(known, truth) {
                    return false;
                }
                let derived = self.library.fluent(fact.fluent).is_some_and(|def| def.derived);
                let Some(key) = self.key(fact, frame).filter(|_| !derived) else { return true };
                if key.is_pattern() {
                    // Some entity has it, but which is not known; none has it, and that is known of all.
                    if !truth && !known.is_false() {
                        self.facts.set(fact.fluent, key, TruthSet::no(cause));
                    }
                    return true;
                }
                match known.narrow(truth, cause) {
                    Some(narrowed) => {
                        if narrowed != known {
                            self.facts.set(fact.fluent, key, narrowed);
                        }
                        true
                    }
                    None => false,
                }
            }
            Condition::All(parts) => self.narrow_all(parts, truth, cause, frame),
            Condition::AnyOf(parts) => self.narrow_any(parts, truth, cause, frame),
        }
    }

    fn narrow_all(&mut self, parts: &[Condition], truth: bool, cause: Cause, frame: CallFrame<'_>) -> bool {
        if truth {
            return parts.iter().all(|part| self.narrow(part, true, cause, frame));
        }
        // Not all hold: if all but one certainly do, it is that one.
        let mut doubtful = parts.iter().filter(|part| !self.evaluate(part, frame).is_true());
        match (doubtful.next(), doubtful.next()) {
            (None, _) => false,
            (Some(only), None) => self.narrow(only, false, cause, frame),
            (Some(_), Some(_)) => true,
        }
    }

    fn narrow_any(&mut self, parts: &[Condition], truth: bool, cause: Cause, frame: CallFrame<'_>) -> bool {
        if !truth {
            return parts.iter().all(|part| self.narrow(part, false, cause, frame));
        }
        let mut doubtful = parts.iter().filter(|part| !self.evaluate(part, frame).is_false());
        match (doubtful.next(), doubtful.next()) {
            (None, _) => false,
            (Some(only), None) => self.narrow(only, true, cause, frame),
            (Some(_), Some(_)) => true,
        }
    }
}

/// Whether a condition with these values can be `truth`.
fn possible(value: TruthSet, truth: bool) -> bool {
    let known = if truth { value.yes } else { value.no };
    known.is_some() || value.open.is_some()
}

/// Whether a condition speaks of a fluent.
pub(crate) fn mentions(condition: &Condition, fluent: Fluent) -> bool {
    let mut open: SmallVec<[&Condition; 8]> = SmallVec::new();
    open.push(condition);
    while let Some(part) = open.pop() {
        match part {
            Condition::Fact(fact) if fact.fluent == fluent => return true,
            Condition::Not(inner) => open.push(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => open.extend(parts),
            Condition::Fact(_)
            | Condition::Literal(_)
            | Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => {}
        }
    }
    false
}
