//! Interpretation of blocks and steps.

use motet_syntax::Span;
use motet_syntax::ast::EndKind;

use super::MAX_FIXPOINTS;
use super::PolicyEnd;
use super::Prover;
use super::collector::{Collector, Enclosing};
use super::errors::{NeverCaught, TooDeep, Unreached};
use super::evaluation::CallFrame;
use super::loops::Loop;
use crate::facts::Delta;
use crate::facts::{Cause, TruthSet};
use crate::ir::{Catch, Condition, StepId, StepKind, TIMEOUT};

impl Prover<'_> {
    pub(crate) fn block(&mut self, block: &[StepId]) {
        for id in block {
            if !self.control.live || self.is_settled() {
                return;
            }
            self.step(*id);
        }
    }

    pub(crate) fn step(&mut self, id: StepId) {
        if self.target.point == Some(id) {
            self.record_state();
        }
        let program = self.program;
        let Some(step) = program.step(id) else { return };
        if let Some(reached) = self.proof.reached.get_mut(id.index()) {
            *reached = true;
        }
        match &step.kind {
            StepKind::Call(call) => self.call(id, call, step.span),
            StepKind::Sequence { body, .. } if self.target.choice == Some(id) => self.choose(body),
            StepKind::Sequence { body, .. } => self.block(body),
            StepKind::Inline { body, .. } => self.inline(id, body),
            StepKind::If { condition, then, otherwise, .. } => {
                self.branch(id, condition, then, otherwise.as_deref().unwrap_or_default());
            }
            StepKind::Wait { condition, .. } => {
                self.throw(TIMEOUT, self.control.enclosing.len());
                self.await_condition(condition, Cause::step(id));
            }
            StepKind::Monitor { whens, body } => self.monitor(id, whens, body),
            StepKind::Try { body, catches } => self.attempt(body, catches),
            StepKind::Repeat { times, body, until } => {
                let until = until.as_ref().map(|(condition, _)| condition);
                self.looped(id, body, Loop::Repeat { times: *times, until });
            }
            StepKind::Each { item, body, .. } => {
                if let Some(kind) = self.library.lang_items.exhausted {
                    self.throw(kind, self.control.enclosing.len());
                }
                self.looped(id, body, Loop::Each { symbol: self.symbols.of_binding(item.index()) });
            }
            StepKind::Parallel { branches } => self.parallel(id, branches),
            StepKind::End { kind, of, .. } => self.end(Some(id), *kind, *of, step.span),
            StepKind::Unknown => self.forget_all(Cause::step(id)),
        }
    }

    /// Rolls the facts back, with the collectors of states.
    pub(crate) fn back_to(&mut self, mark: usize) {
        self.state.facts.back_to(mark);
        while self.state.partitions.last().is_some_and(|partition| partition.since > mark) {
            self.state.partitions.pop();
        }
        for enclosing in &mut self.control.enclosing {
            enclosing.cut_to(mark);
        }
    }

    /// Joins paths from `mark`; control ends if there is none.
    pub(crate) fn meet(&mut self, mark: usize, ways: &[Delta]) {
        self.back_to(mark);
        self.control.live = !ways.is_empty();
        if self.control.live {
            let partition = self.state.facts.join(ways);
            self.remember(partition);
        }
    }

    fn branch(&mut self, id: StepId, condition: &Condition, then: &[StepId], otherwise: &[StepId]) {
        let mark = self.state.facts.mark();
        let mut ways = Vec::with_capacity(2);
        for (truth, block) in [(true, then), (false, otherwise)] {
            self.control.live = self.assume(condition, truth, Cause::step(id), CallFrame::default());
            if self.control.live {
                self.block(block);
            }
            if self.control.live {
                ways.push(self.state.facts.delta(mark));
            }
            self.back_to(mark);
        }
        self.meet(mark, &ways);
    }

    /// Assumes the condition of a wait, whatever was known before: something outside may have changed it.
    fn await_condition(&mut self, condition: &Condition, cause: Cause) {
        match condition {
            Condition::Fact(fact) => {
                let known = self.evaluate(condition, CallFrame::default());
                let key = self.key(fact, CallFrame::default()).filter(|key| !key.is_pattern());
                if let (Some(key), false) = (key, known.is_true()) {
                    self.state.facts.set(
                        fact.fluent,
                        key,
                        known.narrow(true, cause).unwrap_or(TruthSet::yes(cause)),
                    );
                }
            }
            Condition::All(parts) => parts.iter().for_each(|part| self.await_condition(part, cause)),
            Condition::Not(inner) => {
                if let Condition::Fact(fact) = &**inner
                    && let Some(key) = self.key(fact, CallFrame::default())
                {
                    self.state.facts.set(fact.fluent, key, TruthSet::no(cause));
                }
            }
            Condition::Literal(_)
            | Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::AnyOf(_)
            | Condition::Unknown => {}
        }
    }

    fn inline(&mut self, id: StepId, body: &[StepId]) {
        let mark = self.state.facts.mark();
        self.control.enclosing.push(Enclosing::Inline { step: id, exits: Collector::new(mark) });
        self.block(body);
        let Some(Enclosing::Inline { exits, .. }) = self.control.enclosing.pop() else { return };
        if exits.hit {
            let mut ways = vec![exits.delta()];
            if self.control.live {
                ways.push(self.state.facts.delta(mark));
            }
            self.meet(mark, &ways);
        }
    }

    fn attempt(&mut self, body: &[StepId], catches: &[Catch]) {
        let mark = self.state.facts.mark();
        let collectors = catches.iter().map(|catch| {
            let on = catch.on.as_ref().map(|kinds| kinds.iter().map(|(kind, _)| *kind).collect());
            (on, Collector::new(mark), Vec::new())
        });
        self.control.enclosing.push(Enclosing::Try { catches: collectors.collect() });
        self.block(body);
        let Some(Enclosing::Try { catches: caught }) = self.control.enclosing.pop() else { return };
        let mut ways = Vec::with_capacity(1 + catches.len());
        if self.control.live {
            ways.push(self.state.facts.delta(mark));
        }
        for (catch, (_, states, kinds)) in catches.iter().zip(&caught) {
            for (kind, span) in catch.on.iter().flatten() {
                if !kinds.contains(kind) {
                    let name = self.library.failure_name(*kind).into();
                    self.diagnostics.push(NeverCaught { span: *span, name }.into());
                }
            }
            self.back_to(mark);
            if states.hit {
                self.control.live = true;
                self.state.facts.replay(&states.delta());
                self.block(&catch.body);
                self.check_catch(catch, kinds);
                if self.control.live {
                    ways.push(self.state.facts.delta(mark));
                }
            } else {
                // That nothing is caught was said; its steps need no word of their own.
                self.silence(&catch.body);
            }
        }
        self.meet(mark, &ways);
    }

    fn silence(&mut self, block: &[StepId]) {
        for id in block {
            if let Some(reached) = self.proof.reached.get_mut(id.index()) {
                *reached = true;
            }
        }
    }

    /// Enters a loop or parallel block. Each level is proved at least twice, so the depth is limited.
    pub(crate) fn enter_fixpoint(&mut self, id: StepId) -> bool {
        if self.control.fixpoints >= MAX_FIXPOINTS {
            let span = self.program.step(id).map_or(self.program.span, |step| step.span);
            self.diagnostics.push(TooDeep { span, limit: MAX_FIXPOINTS }.into());
            return false;
        }
        self.control.fixpoints += 1;
        true
    }

    /// Ends the policy, or the inlined policy `of`.
    pub(crate) fn end(&mut self, id: Option<StepId>, kind: EndKind, of: Option<StepId>, span: Span) {
        let depth =
            self.control.enclosing.iter().rposition(
                |enclosing| matches!(enclosing, Enclosing::Inline { step, .. } if Some(*step) == of),
            );
        match (kind, of, depth) {
            (EndKind::Done, None, _) => {
                let end = id.map(PolicyEnd::Before);
                self.check_goal(end);
                self.check_end(end, span);
            }
            (EndKind::Done, Some(_), Some(depth)) => {
                if let Some(Enclosing::Inline { exits, .. }) = self.control.enclosing.get_mut(depth) {
                    exits.see(&self.state.facts);
                }
            }
            (EndKind::Fail, Some(_), Some(depth)) => {
                if let Some(kind) = self.library.lang_items.failed {
                    self.throw(kind, depth);
                }
            }
            (EndKind::Fail | EndKind::Replan, _, _) | (EndKind::Done, Some(_), None) => {}
        }
        self.control.live = false;
    }

    /// Reports the first step of every run of unreachable steps.
    pub(crate) fn report_unreached(&mut self) {
        let program = self.program;
        let reached = |id: &StepId| self.proof.reached.get(id.index()).copied().unwrap_or(true);
        let mut found = Vec::new();
        for (index, step) in program.steps.iter().enumerate() {
            let parent_reached = step.position.parent.as_ref().is_none_or(reached);
            let here = self.proof.reached.get(index).copied().unwrap_or(true);
            let earlier = found.last().is_some_and(|place: &crate::ir::StepPosition| {
                place.parent == step.position.parent && place.slot == step.position.slot
            });
            if parent_reached && !here && !earlier {
                found.push(step.position);
                self.diagnostics.push(Unreached { span: step.span }.into());
            }
        }
    }
}
