//! Narrowing: the facts after a condition was observed to hold, or was not observed to hold.

use super::Prover;
use super::effects::FactChange;
use super::evaluation::CallFrame;
use crate::facts::{Atom, Cause, Delta, FactKey, PathPartition, TruthSet, effort};
use crate::ir::{Call, Condition, Fluent, Step, StepId, StepKind};

/// Maximal number of joins that are remembered.
const MAX_PARTITIONS: usize = 8;
/// Maximal number of paths of a join that are kept apart.
pub(super) const MAX_PATHS: usize = 24;
/// Maximal number of paths that are kept apart behind a block, for each of which what follows is walked.
const MAX_SPLIT: usize = 6;
/// Number of writes after which a join is forgotten.
const MAX_AGE: usize = 1000;

/// Changes of facts, call by call.
type Changes = Vec<Vec<FactChange>>;

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

    /// As [`assume`](Self::assume), for the test of an `if`, which looks at the hands: what they held may
    /// have dropped by itself.
    pub(super) fn assume_test(&mut self, id: StepId, condition: &Condition, outcome: Outcome) -> bool {
        let (here, cause, frame) = (self.state.facts.mark(), Cause::step(id), CallFrame::default());
        let mut filled = None;
        let held = self.held_in(id, condition, &mut filled);
        if held.is_empty() {
            return self.assume(condition, outcome, cause, frame);
        }
        let filled = filled.unwrap_or_else(|| self.filled_before(id));
        let partitions = self.state.partitions.clone();
        let mut paths = Vec::with_capacity(2);
        if self.assume(condition, outcome, cause, frame) {
            paths.push(self.state.facts.delta(here));
        }
        // One of them is seen to have dropped, and of the others nothing is known.
        for seen in &held {
            self.back_to(here);
            self.forget_paths(condition);
            self.drop_held(&filled, &held, *seen, cause);
            if self.narrow(condition, outcome, cause, frame) {
                let (fluent, key) = *seen;
                if held.iter().any(|(of, wide)| *of == fluent && wide.covers(key) && *wide != key) {
                    // Which of those that a pattern stands for has dropped is not seen.
                    self.state.facts.set(fluent, key, TruthSet::open(cause));
                }
                self.proof.drops.insert((id, outcome.truth()));
                paths.push(self.state.facts.delta(here));
            }
        }
        self.back_to(here);
        self.state.partitions = partitions;
        self.state.facts.join(&paths);
        !paths.is_empty()
    }

    /// Facts in a condition that say that a hand holds something, and that a drop would make otherwise. Where
    /// they ask for it, `filled` gets the changes of [`Self::filled_before`].
    fn held_in(&mut self, id: StepId, condition: &Condition, filled: &mut Option<Changes>) -> Vec<Atom> {
        let (mut held, mut rest) = (Vec::new(), vec![condition]);
        while let Some(part) = rest.pop() {
            rest.extend(part.parts());
            let Condition::Fact(fact) = part else { continue };
            let Some(of) = self.held_value(fact.fluent) else { continue };
            let is_held = |known: TruthSet| if of { known.yes.is_some() } else { known.no.is_some() };
            let key = self.widest_key(fact, CallFrame::default());
            let atom = (fact.fluent, key);
            let known = self.evaluate(part, CallFrame::default());
            // Where nothing is known, a step may have filled the hand.
            let is_filled = known.open.is_some() && {
                let filled = filled.get_or_insert_with(|| self.filled_before(id));
                filled.iter().flatten().any(|change| self.fills(change, atom))
            };
            let may_hold = |known: TruthSet| is_held(known) || is_filled && known.open.is_some();
            if of && key.is_pattern() {
                // Each of them may drop alone.
                self.state.facts.entries(fact.fluent, key, |key, known| {
                    held.extend(may_hold(known).then_some((fact.fluent, key)));
                });
            }
            // A name may be that of the thing which is held.
            let named = || self.has_symbol(fact.fluent, key).then(|| self.instances(atom));
            if may_hold(known)
                || named().into_iter().flatten().any(|(fluent, key)| may_hold(self.value(fluent, key)))
            {
                held.push(atom);
            }
        }
        held
    }

    /// Changes that each call makes which may have filled a hand before a step.
    fn filled_before(&mut self, id: StepId) -> Changes {
        let (program, grips) = (self.program, self.grips());
        let is_again = |step: &Step| {
            use StepKind::{Each, Monitor, Parallel, Repeat};
            matches!(step.kind, Repeat { .. } | Each { .. } | Monitor { .. } | Parallel { .. })
        };
        let around = program.around(id).filter(|(_, step)| is_again(step)).map(|(around, _)| around);
        let around: Vec<StepId> = around.collect();
        let may_run =
            |grip: &StepId| *grip < id || program.around(*grip).any(|(outer, _)| around.contains(&outer));
        let changes = |grip: StepId| {
            let StepKind::Call(call) = &program.step(grip)?.kind else { return None };
            Some(self.changes_of(call, &self.library.primitive(call.primitive)?.makes))
        };
        grips.iter().copied().filter(may_run).filter_map(changes).collect()
    }

    /// A change may be one that fills the hand of a fact.
    fn fills(&self, change: &FactChange, (fluent, key): Atom) -> bool {
        let is_open = || self.has_symbol(fluent, key) || self.has_symbol(fluent, change.key);
        change.fluent == fluent
            && self.held_value(fluent) == Some(change.truth)
            && (is_open() || key.meets(change.key))
    }

    /// The value that a fact of a fluent has while a hand holds something; `None` for other fluents.
    fn held_value(&self, fluent: Fluent) -> Option<bool> {
        let items = &self.library.lang_items;
        let is = |item: Option<Fluent>| item == Some(fluent);
        is(items.holding).then_some(true).or_else(|| is(items.free).then_some(false))
    }

    /// Makes unknown all that the steps have made which may have filled a hand: the thing may be anywhere,
    /// and what was seen of one hand is known.
    fn drop_held(&mut self, filled: &Changes, held: &[Atom], seen: Atom, cause: Cause) {
        let may_be = |change: &FactChange| held.iter().any(|atom| self.fills(change, *atom));
        let made = filled.iter().filter(|changes| changes.iter().any(may_be));
        let mut made: Vec<FactChange> = made.flatten().copied().collect();
        let unknown = |(fluent, key)| FactChange::unknown(fluent, key);
        if made.is_empty() {
            // It was in the hand from the start.
            made.extend(self.library.lang_items.free.map(|free| unknown((free, FactKey::ALL))));
        }
        let (fluent, key) = seen;
        // A pattern stands for things of which one is seen, unless it says of others that they are held.
        let is_told = |(fluent, pattern): &&Atom| {
            !pattern.is_pattern()
                || key.is_pattern()
                || self.held_value(*fluent) == Some(false)
                || self.state.facts.get(*fluent, *pattern).yes.is_some()
        };
        made.extend(held.iter().filter(is_told).copied().map(unknown));
        self.unsettle(&made, cause);
        let is_free = self.held_value(fluent) == Some(false);
        // Which of several hands is free is not known.
        if !(is_free && key.is_pattern()) {
            self.see_change(fluent, key, TruthSet::of(is_free, cause), cause);
        }
    }

    /// Calls that may fill a hand, each with its arguments once.
    fn grips(&mut self) -> std::rc::Rc<[StepId]> {
        if let Some(known) = &self.grips {
            return known.clone();
        }
        let mut seen: Vec<&Call> = Vec::new();
        let mut grips = Vec::new();
        for (index, step) in self.program.steps.iter().enumerate() {
            let StepKind::Call(call) = &step.kind else { continue };
            let Some(def) = self.library.primitive(call.primitive) else { continue };
            let fills = def.makes.iter().any(|it| self.held_value(it.fact.fluent) == Some(it.value));
            let is_same = |other: &&Call| {
                (other.primitive, &other.args, other.binds) == (call.primitive, &call.args, call.binds)
            };
            effort::spend(1 + if fills { seen.len() } else { 0 });
            if fills && !seen.iter().any(is_same) {
                seen.push(call);
                grips.extend(u32::try_from(index).ok().map(StepId));
            }
        }
        self.grips.insert(grips.into()).clone()
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
        let (mut open, mut all) = (Vec::new(), 0_usize);
        self.on_each_path(partition, |this| {
            all += 1;
            if this.narrow(condition, outcome, cause, frame) {
                open.push(this.state.facts.delta(here));
            }
        });
        if open.len() < all {
            self.state.facts.join(&open);
        }
        !open.is_empty()
    }

    /// Visits the facts as they are if control came along each path of a join.
    fn on_each_path(&mut self, partition: &PathPartition, mut visit: impl FnMut(&mut Self)) {
        let here = self.state.facts.mark();
        // What was written since holds on every path.
        let later = self.state.facts.delta(partition.since);
        for path in partition.paths() {
            for ((fluent, key), value) in path {
                self.state.facts.set(fluent, key, value);
            }
            self.state.facts.replay(&later);
            visit(self);
            self.state.facts.back_to(here);
        }
    }

    /// The paths from a mark to here, along each path of the last join since then that is selected; `None` if
    /// there is none, or there are too many paths.
    pub(super) fn split(
        &mut self,
        mark: usize,
        selects: impl FnMut(&&PathPartition) -> bool,
    ) -> Option<Vec<Delta>> {
        let mut inside = self.state.partitions.iter().rev().take_while(|partition| partition.since > mark);
        let partition = inside.find(selects)?.clone();
        if partition.paths().count() > MAX_SPLIT {
            return None;
        }
        let mut found = Vec::with_capacity(MAX_SPLIT);
        self.on_each_path(&partition, |this| found.push(this.state.facts.delta(mark)));
        Some(found)
    }

    /// Possible values of a condition. One that asks for one of several facts may hold on each path to here,
    /// on each by another fact.
    pub(super) fn evaluate_on_paths(&mut self, condition: &Condition, frame: CallFrame<'_>) -> TruthSet {
        let joined = self.evaluate(condition, frame);
        let is_mixed = joined.no.is_some() && !joined.is_false();
        if !is_mixed || !is_choice(condition) {
            return joined;
        }
        for index in (0..self.state.partitions.len()).rev() {
            let Some(partition) = self.state.partitions.get(index) else { break };
            if self.state.facts.mark() > partition.since + MAX_AGE
                || !partition.differs(|fluent| mentions(condition, fluent))
            {
                continue;
            }
            let partition = partition.clone();
            let mut found: Option<TruthSet> = None;
            self.on_each_path(&partition, |this| {
                let value = this.evaluate(condition, frame);
                found = Some(found.map_or(value, |found| found.join(value)));
            });
            if let Some(found) = found.filter(|found| !found.no.is_some()) {
                return found;
            }
        }
        joined
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
            Condition::All(parts) => self.narrow_parts((parts, true), outcome, cause, frame),
            Condition::AnyOf(parts) => self.narrow_parts((parts, false), outcome, cause, frame),
        }
    }

    /// Narrows by an `and`, whose value of every part is true where it is true, or by an `or`, whose value of
    /// every part is false where it is false.
    fn narrow_parts(
        &mut self,
        (parts, of_all): (&[Condition], bool),
        outcome: Outcome,
        cause: Cause,
        frame: CallFrame<'_>,
    ) -> bool {
        if outcome.truth() == of_all {
            return parts.iter().all(|part| self.narrow(part, outcome, cause, frame));
        }
        // One part decides: if all others certainly do not, it is that one.
        let mut doubtful = parts.iter().filter(|part| {
            let value = self.evaluate(part, frame);
            if of_all { !value.is_true() } else { !value.is_false() }
        });
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

/// Returns whether several facts can each make a condition true.
fn is_choice(condition: &Condition) -> bool {
    condition.any(&|part| match part {
        Condition::AnyOf(_) | Condition::All(_) => true,
        Condition::Fact(fact) => fact.args.contains(&None),
        _ => false,
    })
}

/// Returns whether a condition mentions a fluent.
pub(crate) fn mentions(condition: &Condition, fluent: Fluent) -> bool {
    condition.any(&|part| matches!(part, Condition::Fact(fact) if fact.fluent == fluent))
}
