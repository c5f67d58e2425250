//! The prover as an abstract domain: its states are the facts above those at the start, written on a trail,
//! and a path is the changes since a position in the trail.

use std::hash::{Hash, Hasher};

use motet_syntax::Span;
use motet_syntax::ast::PrimitiveKind;
use rustc_hash::{FxHashMap, FxHashSet};

use super::assume::Outcome;
use super::collector::Collector;
use super::diagnostics::{Conflict, NeverCaught, NeverFires, TooDeep, Unreached};
use super::evaluation::CallFrame;
use super::{MAX_FIXPOINTS, PolicyEnd, Prover, Volatile};
use crate::analysis::{Domain, Enclosing, Exit, Loop, Round};
use crate::declare::Library;
use crate::facts::{Atom, Cause, Delta, TruthSet, effort, show};
use crate::ir::{
    BindingId, BlockSlot, Call, Catch, Condition, Failure, Program, StepId, StepKind, StepPosition, TIMEOUT,
    When,
};

impl<'a> Domain<'a> for Prover<'a> {
    type Mark = usize;
    type Path = Delta;
    type Collector = Collector;
    /// Facts and patterns that a branch writes, with their values behind it where it runs alone.
    type Changes = Vec<(Atom, TruthSet)>;

    fn program(&self) -> &'a Program {
        self.program
    }

    fn library(&self) -> &'a Library {
        self.library
    }

    fn enclosing(&mut self) -> &mut Vec<Enclosing<Collector>> {
        &mut self.control.enclosing
    }

    fn is_live(&self) -> bool {
        self.control.live
    }

    fn stop(&mut self) {
        self.control.live = false;
    }

    fn is_over(&self) -> bool {
        !self.control.live || self.is_settled()
    }

    fn mark(&self) -> usize {
        self.state.facts.mark()
    }

    fn restore(&mut self, mark: &usize) {
        self.back_to(*mark);
        self.control.live = true;
    }

    fn path(&self, mark: &usize) -> Delta {
        self.state.facts.delta(*mark)
    }

    /// Keeps the paths apart that differ in the outcome of a test of what cannot change.
    fn paths(&mut self, mark: &usize) -> Vec<Delta> {
        let tested = self.tested.fluent;
        let paths = self.split(*mark, |partition| partition.differs(|fluent| fluent == tested));
        paths.unwrap_or_else(|| vec![self.path(mark)])
    }

    /// Keeps the paths of an `else if` apart.
    fn ends(&mut self, mark: &usize) -> Vec<Delta> {
        let here = self.state.facts.mark();
        let paths = self.split(*mark, |partition| partition.since == here);
        paths.unwrap_or_else(|| vec![self.path(mark)])
    }

    fn follow(&mut self, path: &Delta) {
        self.state.facts.replay(path);
    }

    fn join(&mut self, mark: &usize, paths: &[Delta]) {
        self.back_to(*mark);
        self.control.live = !paths.is_empty();
        if self.control.live {
            let partition = self.state.facts.join(paths);
            self.remember(partition);
        }
    }

    fn widen(&self, head: &Delta, back: &Delta, _round: usize) -> Option<Delta> {
        let next = head.or(back, &self.state.facts);
        (!next.same_sets(head, &self.state.facts)).then_some(next)
    }

    fn collector(&self) -> Collector {
        Collector::new(self.state.facts.mark())
    }

    fn collector_at(&self, other: &Collector) -> Collector {
        Collector::new(other.mark)
    }

    fn collect(&self, into: &mut Collector, exit: Exit) {
        match exit {
            Exit::Failure => into.see_path(&self.state.facts),
            Exit::Done => into.see(&self.state.facts),
        }
    }

    fn collected(&self, states: &Collector) -> Option<Delta> {
        states.hit.then(|| states.delta())
    }

    /// Keeps the paths to a handler apart, so that a test there shows how far the body got.
    fn follow_failures(&mut self, states: &Collector) -> bool {
        match (states.paths(), self.collected(states)) {
            (_, None) => return false,
            (Some(paths), Some(_)) => {
                let partition = self.state.facts.join(paths);
                self.remember(partition);
            }
            (None, Some(joined)) => self.state.facts.replay(&joined),
        }
        true
    }

    fn enter(&mut self, id: StepId) -> bool {
        let visits = 1 + self.state.volatile.len();
        self.control.work += visits;
        effort::spend(effort::VISIT * visits);
        if self.is_exhausted() || self.has_too_many_errors() {
            self.control.given_up.get_or_insert(id);
            return false;
        }
        if self.target.point == Some(id) {
            self.record_state();
        }
        self.skip(&[id]);
        true
    }

    fn transfer(&mut self, id: StepId, call: &Call, span: Span) {
        self.call(id, call, span);
    }

    fn assume_at(&mut self, id: StepId, condition: &Condition, truth: bool) -> bool {
        // What the run does not see to be true may be unknown.
        let outcome = if truth { Outcome::True } else { Outcome::NotTrue };
        if !truth && self.evaluate(condition, CallFrame::default()).open.is_some() {
            self.proof.unknown_tests.insert(id);
        }
        let step = self.program.step(id);
        let is_possible = match step.map(|step| &step.kind) {
            Some(StepKind::If { .. }) => self.assume_test(id, condition, outcome),
            _ => self.assume(condition, outcome, Cause::step(id), CallFrame::default()),
        };
        let step = step.filter(|_| truth && !is_possible && condition.is_constant());
        if let Some(StepKind::Repeat { until: Some((_, span)), .. }) = step.map(|step| &step.kind) {
            let what = "the loop always runs out of rounds";
            self.tell_once(NeverFires { span: *span, what }.into());
        }
        is_possible
    }

    fn fail_wait(&mut self, id: StepId, condition: &Condition) {
        let mark = self.state.facts.mark();
        self.doubt_free(condition, (false, true), Cause::step(id));
        self.see_states();
        self.throw(Some(TIMEOUT), usize::MAX);
        self.back_to(mark);
    }

    fn await_at(&mut self, id: StepId, condition: &Condition) {
        let never = condition.is_constant() && self.evaluate(condition, CallFrame::default()).is_false();
        if let Some(step) = self.program.step(id).filter(|_| never) {
            self.tell_once(NeverFires { span: step.span, what: "the `wait` can only time out" }.into());
            self.control.live = false;
            return;
        }
        self.erode();
        if self.evaluate(condition, CallFrame::default()).no.as_step().is_some() {
            // What is then seen, the world has brought about: it has undone what steps made.
            self.undo(condition, Cause::step(id));
        }
        self.await_condition(condition, true, Cause::step(id));
    }

    fn pass_time(&mut self, id: StepId) {
        self.erode();
        let lasting = self.lasting(id);
        self.check_lasting(&lasting);
    }

    fn lose(&mut self, id: StepId) {
        self.forget_all(Cause::step(id));
    }

    fn monitor(&mut self, id: StepId, whens: &'a [When], body: &'a [StepId]) {
        self.watch_for(id, whens, body);
    }

    /// Proves each branch alone.
    fn branch_changes(&mut self, branches: &'a [Vec<StepId>]) -> Vec<Vec<(Atom, TruthSet)>> {
        let (mark, findings) = (self.mark(), self.findings());
        let mut changes = Vec::with_capacity(branches.len());
        let around = self.control.written.take();
        let mut all = Vec::new();
        for branch in branches {
            self.control.written = Some(Vec::new());
            self.block(branch);
            let mut written = self.control.written.take().unwrap_or_default();
            written.extend(self.state.facts.touched(mark));
            written.sort_unstable();
            written.dedup();
            all.extend(written.iter().copied());
            let alone = |atom: Atom| (atom, self.state.facts.get(atom.0, atom.1));
            changes.push(written.into_iter().map(alone).collect());
            self.restore(&mark);
        }
        self.control.written = around.map(|around| [around, all].concat());
        self.drop_findings(findings);
        changes
    }

    fn disturb(&mut self, id: StepId, changes: &[Vec<(Atom, TruthSet)>], index: usize) {
        self.control.branches.push((self.control.disturbed.len(), self.state.volatile.len()));
        let others = changes.iter().enumerate().filter(|(other, _)| *other != index);
        let touched = others.flat_map(|(_, touched)| touched);
        let touched: Vec<Atom> = touched.flat_map(|(atom, _)| self.instances(*atom)).collect();
        for atom in touched {
            self.disturb_by_branch(id, atom);
            // Of a choice only one step is there, and it may be another.
            if self.target.choice.is_some() {
                continue;
            }
            self.control.disturbed.push(atom);
            let ((fluent, key), value) = (atom, TruthSet::open(Cause::step(id)));
            self.state.volatile.push(Volatile { fluent, key, value, when: None, restored: false });
        }
        // What a perception makes here a step of another branch may make stale at once.
        for (fluent, key) in self.expired_beside(id, changes, index) {
            self.control.disturbed.push((fluent, key));
            let value = TruthSet::open(Cause::step(id));
            self.state.volatile.push(Volatile { fluent, key, value, when: None, restored: false });
        }
        // A name from before the block may be what another branch changes.
        self.erode();
    }

    fn end_branch(&mut self) {
        let (disturbed, volatile) = self.control.branches.pop().unwrap_or_default();
        self.control.disturbed.truncate(disturbed);
        self.state.volatile.truncate(volatile);
    }

    fn compose(&mut self, id: StepId, changes: &[Vec<(Atom, TruthSet)>], paths: &[Delta]) {
        let joined = self.compose_effects(id, changes, paths);
        self.state.facts.replay(&joined);
        for index in 0..changes.len() {
            for (fluent, key) in self.expired_beside(id, changes, index) {
                let value = self.state.facts.get(fluent, key).join(TruthSet::open(Cause::step(id)));
                self.state.facts.set(fluent, key, value);
            }
        }
    }

    fn sequence(&mut self, id: StepId, body: &'a [StepId]) {
        if self.target.choice == Some(id) { self.choose(body) } else { self.block(body) }
    }

    /// Each level is proved at least twice, so the depth is limited.
    fn enter_fixpoint(&mut self, id: StepId) -> bool {
        if self.control.fixpoints >= MAX_FIXPOINTS {
            let span = self.program.step(id).map_or(self.program.span, |step| step.span);
            self.diagnostics.push(TooDeep { span, limit: Some(MAX_FIXPOINTS) }.into());
            return false;
        }
        self.control.fixpoints += 1;
        true
    }

    fn leave_fixpoint(&mut self) {
        self.control.fixpoints -= 1;
    }

    fn replace_head(&mut self, head: Option<usize>) -> Option<usize> {
        std::mem::replace(&mut self.state.head, head)
    }

    fn begin_round(&mut self, item: BindingId) {
        let symbol = self.symbols.of_binding(item.index());
        self.forget(symbol.filter(|entity| self.symbols.get(*entity).is_some()));
        self.forget_tests(item);
    }

    /// Numbers of diagnostics and recorded states.
    fn findings(&self) -> (usize, usize) {
        (self.diagnostics.len(), self.states_at_point.len())
    }

    fn drop_findings(&mut self, (diagnostics, states_at_point): (usize, usize)) {
        if self.is_settled() {
            return;
        }
        self.diagnostics.truncate(diagnostics);
        self.control.settled = self.control.settled.filter(|index| *index < diagnostics);
        self.states_at_point.truncate(states_at_point);
    }

    fn begin_cleanup(&mut self) {
        let watched = std::mem::take(&mut self.state.watched);
        // What has interrupted the step may be a monitor whose condition holds now.
        for by in watched.iter().map(|watched| watched.by) {
            if let Some(StepKind::Monitor { whens, .. }) = self.program.step(by).map(|step| &step.kind) {
                whens.iter().for_each(|when| self.doubt(&when.condition, Cause::step(by)));
                self.doubt_reactions(by);
            }
        }
        self.control.unwatched.push(watched);
    }

    fn end_cleanup(&mut self) {
        self.state.watched = self.control.unwatched.pop().unwrap_or_default();
    }

    fn begin_handler(&mut self, catch: &Catch, kinds: &[Failure]) {
        for (kind, span) in catch.on.iter().flatten() {
            if !kinds.contains(kind) {
                let name = self.library.failure_name(*kind).into();
                self.diagnostics.push(NeverCaught { span: *span, name }.into());
            }
        }
    }

    fn end_handler(&mut self, catch: &Catch, kinds: &[Failure]) {
        self.check_catch(catch, kinds);
    }

    /// Marks steps as reached: a handler that nothing reaches was reported, and its steps need no report of
    /// their own.
    fn skip(&mut self, block: &[StepId]) {
        for id in block {
            if let Some(reached) = self.proof.reached.get_mut(id.index()) {
                *reached = true;
            }
        }
    }

    fn done(&mut self, id: Option<StepId>, span: Span) {
        let end = id.map(PolicyEnd::Before);
        self.check_goal(end);
        self.check_end(end, span);
    }
}

/// Hashes the paths from the end of a loop's body.
fn fingerprint(round: &Round<Delta>, hasher: &mut impl Hasher) {
    round.exits.iter().chain(&round.back).for_each(|path| path.fingerprint(hasher));
    (round.exits.len(), round.back.is_some()).hash(hasher);
}

impl Prover<'_> {
    /// Rolls the facts back, with the collectors of states.
    pub(crate) fn back_to(&mut self, mark: usize) {
        self.state.facts.back_to(mark);
        while self.state.partitions.last().is_some_and(|partition| partition.since > mark) {
            self.state.partitions.pop();
        }
        for collector in self.control.enclosing.iter_mut().flat_map(Enclosing::collectors) {
            collector.cut_to(mark);
        }
    }

    /// Assumes that a condition has become `truth`, whatever was known before: something outside may have
    /// changed it.
    pub(super) fn await_condition(&mut self, condition: &Condition, truth: bool, cause: Cause) {
        match condition {
            Condition::Fact(fact) => {
                // Some entity has it, but which is not known.
                let key = self.key(fact, CallFrame::default()).filter(|key| !(key.is_pattern() && truth));
                let Some(key) = key else { return self.doubt(condition, cause) };
                let known = self.evaluate(condition, CallFrame::default());
                if !(if truth { known.is_true() } else { known.is_false() }) {
                    let new = TruthSet::of(truth, cause);
                    self.see_change(fact.fluent, key, known.narrow(truth, cause).unwrap_or(new), cause);
                }
            }
            Condition::Not(inner) => self.await_condition(inner, !truth, cause),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                if truth == matches!(condition, Condition::All(_)) {
                    parts.iter().for_each(|part| self.await_condition(part, truth, cause));
                } else {
                    self.doubt(condition, cause);
                }
            }
            Condition::Literal(_)
            | Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => {}
        }
    }

    /// Returns whether no need in the body of a loop is refuted when it is repeated from here: the step
    /// `point` at the end of the first round, which began at `mark`. `until` is the test of a `repeat`. Does
    /// not roll the facts back.
    ///
    /// If so, `seen` hashes the facts that the test leaves.
    pub(crate) fn comes_round(
        &mut self,
        point: StepId,
        mark: usize,
        until: Option<&Condition>,
        seen: &mut impl Hasher,
    ) -> bool {
        let program = self.program;
        let around = program.step(point).and_then(|step| step.position.parent);
        let Some((id, step)) = around.and_then(|id| Some((id, program.step(id)?))) else { return true };
        let (body, how) = match &step.kind {
            StepKind::Repeat { times, body, .. } => (body, Loop::Repeat { times: *times, until }),
            StepKind::Each { item, list, body, .. } => (body, Loop::each(*item, list)),
            _ => return true,
        };
        let end = body.iter().position(|id| *id == point).unwrap_or(body.len());
        let body = body.get(..end).unwrap_or_default();
        let round = self.exits(id, how, &mark);
        self.restore(&mark);
        fingerprint(&round, seen);
        let Some(path) = round.back else { return true };
        let entry = Delta::default();
        let head = entry.or(&path, &self.state.facts);
        if !head.same_sets(&entry, &self.state.facts) {
            self.control.fixpoints += 1;
            fingerprint(&self.rounds(id, body, how, head), seen);
            self.control.fixpoints -= 1;
        }
        !self.is_refuted()
    }

    /// Weakens a fact that another branch may change at any moment.
    fn disturb_by_branch(&mut self, id: StepId, (fluent, key): Atom) {
        let open = TruthSet::open(Cause::step(id));
        // Of a choice only one step is there: where it is another, what was known is still so.
        if self.target.choice.is_none() {
            self.state.facts.set(fluent, key, open);
        } else if key.is_pattern() {
            self.state.facts.change(fluent, key, |_, known| known.join(open));
        } else {
            let value = self.read(fluent, key).join(open);
            self.state.facts.set(fluent, key, value);
        }
    }

    /// Facts that perceptions of a branch make and that a step of another branch ends, because it uses a
    /// resource or moves something.
    fn expired_beside(&self, id: StepId, changes: &[Vec<(Atom, TruthSet)>], index: usize) -> Vec<Atom> {
        let of_branch = changes.get(index).into_iter().flatten().map(|(atom, _)| *atom);
        let mut atoms: Vec<Atom> =
            of_branch.filter(|(fluent, _)| self.library.perceived.contains(fluent)).collect();
        let Some(StepKind::Parallel { branches }) = self.program.step(id).map(|step| &step.kind) else {
            return Vec::new();
        };
        if atoms.is_empty() {
            return atoms;
        }
        let (mut used, mut moves, mut seen) = (0, false, Vec::new());
        let mut left: Vec<(bool, StepId)> = Vec::new();
        for (other, branch) in branches.iter().enumerate() {
            left.extend(branch.iter().map(|step| (other == index, *step)));
        }
        while let Some((is_own, step)) = left.pop() {
            effort::spend(1);
            let Some(step) = self.program.step(step) else { continue };
            left.extend(step.kind.blocks().into_iter().flatten().map(|step| (is_own, *step)));
            let StepKind::Call(call) = &step.kind else { continue };
            let Some(def) = self.library.primitive(call.primitive) else { continue };
            if !is_own {
                used |= def.uses;
                moves |= def.form != PrimitiveKind::Perception
                    && !(def.makes.is_empty() && def.unsettles.is_empty());
            } else if let Some(lasts) = &def.lasts {
                seen.push((lasts, def));
            }
        }
        seen.retain(|(lasts, _)| lasts.resources & used != 0 || moves && !lasts.entities.is_empty());
        let made = |fluent| seen.iter().any(|(_, def)| def.makes.iter().any(|it| it.fact.fluent == fluent));
        atoms.retain(|(fluent, _)| made(*fluent));
        atoms
    }

    /// Joins the effects of all branches. Branches that leave different values in a fact are an error.
    fn compose_effects(&mut self, id: StepId, changed: &[Vec<(Atom, TruthSet)>], deltas: &[Delta]) -> Delta {
        // What a branch leaves, whatever the others may do to it meanwhile, if it is not unknown anyway.
        let left = |(value, alone): (TruthSet, TruthSet)| {
            let is_others = value.open.as_step() == Some(id) && !alone.open.is_some();
            if is_others { TruthSet { open: Cause::NONE, ..value } } else { value }
        };
        let mut written: FxHashMap<Atom, (TruthSet, TruthSet)> = FxHashMap::default();
        // Facts that the branches change alone, and those that one has while another disturbs it.
        let known: FxHashSet<Atom> = changed
            .iter()
            .flatten()
            .flat_map(|(atom, _)| self.instances(*atom).into_iter().chain([*atom]))
            .collect();
        for (touched, delta) in changed.iter().zip(deltas) {
            let more = delta.atoms().filter(|atom| !known.contains(atom));
            let more: Vec<_> = more.map(|atom| (atom, delta.get(&self.state.facts, atom))).collect();
            for (atom, alone) in touched.iter().copied().chain(more) {
                let value = delta.get(&self.state.facts, atom);
                let Some(first) = written.get(&atom).copied() else {
                    written.insert(atom, (value, alone));
                    continue;
                };
                let (one, other) = (left(first), left((value, alone)));
                if self.is_conflict(one, other) || self.is_conflict(other, one) {
                    self.conflict(id, atom, one, other);
                }
                // What both branches make on all of their paths is made, whichever ends last.
                let is_made = one.same_set(other) && one.same_set(first.1) && other.same_set(alone);
                let value = if is_made { one } else { TruthSet::open(Cause::step(id)) };
                written.insert(atom, (value, value));
            }
        }
        Delta::new(written.into_iter().map(|(atom, (value, _))| (atom, value)))
    }

    /// Returns whether one branch leaves a fact true that another leaves false; with a choice, whether it
    /// may.
    fn is_conflict(&self, first: TruthSet, second: TruthSet) -> bool {
        if self.target.choice.is_some() {
            return first.yes.is_some() && second.no.is_some();
        }
        first.is_true() && second.is_false()
    }

    fn conflict(&mut self, id: StepId, (fluent, key): Atom, first: TruthSet, second: TruthSet) {
        let Some(def) = self.library.fluent(fluent) else { return };
        let fact =
            show(&def.name, key, def.params.len(), |index, arg| self.argument_name(fluent, index, arg));
        let cause = |value: TruthSet| if value.yes.is_some() { value.yes } else { value.no };
        let span = self.program.step(id).map_or(self.program.span, |step| step.span);
        let (first, second) = (self.cause_span(cause(first)), self.cause_span(cause(second)));
        self.diagnostics.push(Conflict { span, fact, first, second }.into());
    }

    /// Reports the first step of every run of unreachable steps.
    pub(crate) fn report_unreached(&mut self) {
        let program = self.program;
        let reached = |id: &StepId| self.proof.reached.get(id.index()).copied().unwrap_or(true);
        let mut found = Vec::new();
        for (index, step) in program.steps.iter().enumerate() {
            let parent_reached = step.position.parent.as_ref().is_none_or(reached);
            let here = self.proof.reached.get(index).copied().unwrap_or(true);
            let earlier = found.last().is_some_and(|place: &StepPosition| {
                place.parent == step.position.parent && place.slot == step.position.slot
            });
            // What could not be read has a finding of its own, and no span of its own.
            let is_gap = matches!(step.kind, StepKind::Unknown);
            if parent_reached && !here && !earlier && !is_gap {
                found.push(step.position);
                let StepPosition { slot, index, .. } = step.position;
                let is_in_monitor = slot == BlockSlot::During && index == 0;
                self.diagnostics.push(Unreached { span: step.span, is_in_monitor }.into());
            }
        }
    }
}
