//! Fixed points of loops.

use std::hash::{Hash, Hasher};

use super::Prover;
use super::evaluation::CallFrame;
use crate::facts::Cause;
use crate::facts::Delta;
use crate::ir::{Condition, Entity, StepId, StepKind};

/// Kind of a loop.
#[derive(Clone, Copy)]
pub(crate) enum Loop<'p> {
    /// Up to `times` rounds, or until a test holds.
    Repeat { times: u32, until: Option<&'p Condition> },
    /// One round for each item of a list, which has this symbol.
    Each { symbol: Option<Entity> },
}

/// Paths from the end of a loop's body.
#[derive(Default)]
struct Back {
    /// Paths out of the loop.
    ways: Vec<Delta>,
    /// Path back to its head.
    back: Option<Delta>,
}

impl Back {
    fn fingerprint(&self, hasher: &mut impl Hasher) {
        self.ways.iter().chain(&self.back).for_each(|way| way.fingerprint(hasher));
        (self.ways.len(), self.back.is_some()).hash(hasher);
    }
}

impl Prover<'_> {
    /// Proves a loop to its fixed point: the state at its head is the join of the entry and of every back
    /// edge.
    pub(crate) fn looped(&mut self, id: StepId, body: &[StepId], how: Loop<'_>) {
        if !self.enter_fixpoint(id) {
            return;
        }
        let mark = self.state.facts.mark();
        let outer = self.state.head.replace(mark);
        let ways = self.rounds(id, body, how, Delta::default()).ways;
        self.state.head = outer;
        self.control.fixpoints -= 1;
        self.meet(mark, &ways);
    }

    /// Iterates from the state `head` at the head of the loop until no round adds to it, and returns the
    /// exits of the last round. Diagnostics of earlier rounds are dropped.
    fn rounds(&mut self, id: StepId, body: &[StepId], how: Loop<'_>, mut head: Delta) -> Back {
        let (mark, said) = (self.state.facts.mark(), self.said());
        loop {
            self.unsay(said);
            self.state.facts.replay(&head);
            if let Loop::Each { symbol } = how {
                self.forget(symbol);
            }
            self.block(body);
            let mut back = if self.control.live { self.exits(id, how, mark) } else { Back::default() };
            self.back_to(mark);
            let next = back.back.as_ref().map(|way| head.or(way, &self.state.facts));
            if next.as_ref().is_none_or(|next| next.same_sets(&head, &self.state.facts)) {
                if matches!(how, Loop::Each { .. }) {
                    // The list may be empty.
                    back.ways.insert(0, Delta::default());
                }
                return back;
            }
            self.control.live = true;
            head = next.unwrap_or_default();
        }
    }

    /// Paths from the end of a loop's body that was entered at `mark`.
    fn exits(&mut self, id: StepId, how: Loop<'_>, mark: usize) -> Back {
        let here = self.state.facts.mark();
        let (times, until) = match how {
            Loop::Each { .. } => {
                let way = self.state.facts.delta(mark);
                return Back { ways: vec![way.clone()], back: Some(way) };
            }
            Loop::Repeat { times, until: None } => {
                let way = self.state.facts.delta(mark);
                return Back { back: (times > 1).then(|| way.clone()), ways: vec![way] };
            }
            Loop::Repeat { times, until: Some(until) } => (times, until),
        };
        let (cause, mut back) = (Cause::step(id), Back::default());
        if self.assume(until, true, cause, CallFrame::default()) {
            back.ways.push(self.state.facts.delta(mark));
        }
        self.back_to(here);
        if self.assume(until, false, cause, CallFrame::default()) {
            if let Some(kind) = self.library.lang_items.exhausted {
                self.throw(kind, self.control.enclosing.len());
            }
            back.back = (times > 1).then(|| self.state.facts.delta(mark));
        }
        back
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
            StepKind::Each { item, body, .. } => {
                (body, Loop::Each { symbol: self.symbols.of_binding(item.index()) })
            }
            _ => return true,
        };
        let end = body.iter().position(|id| *id == point).unwrap_or(body.len());
        let body = body.get(..end).unwrap_or_default();
        let back = self.exits(id, how, mark);
        self.back_to(mark);
        back.fingerprint(seen);
        let Some(way) = back.back else { return true };
        let entry = Delta::default();
        let head = entry.or(&way, &self.state.facts);
        if !head.same_sets(&entry, &self.state.facts) {
            self.control.fixpoints += 1;
            self.rounds(id, body, how, head).fingerprint(seen);
            self.control.fixpoints -= 1;
        }
        !self.is_refuted()
    }
}
