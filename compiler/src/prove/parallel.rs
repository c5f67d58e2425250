//! Parallel branches: each is proved while the facts that the others may change are unknown, and their
//! effects must agree.

use rustc_hash::FxHashMap;

use super::Prover;
use super::errors::Conflict;
use crate::facts::{Atom, Delta, show};
use crate::facts::{Cause, TruthSet};
use crate::ir::StepId;

impl Prover<'_> {
    pub(crate) fn parallel(&mut self, id: StepId, branches: &[Vec<StepId>]) {
        if !self.enter_fixpoint(id) {
            return;
        }
        let mark = self.state.facts.mark();
        let said = self.said();
        // What each branch may change, found by proving it alone.
        let mut changed = Vec::with_capacity(branches.len());
        for branch in branches {
            self.block(branch);
            changed.push(self.state.facts.touched(mark));
            self.back_to(mark);
            self.control.live = true;
        }
        self.unsay(said);
        let mut deltas = Vec::with_capacity(branches.len());
        let mut live = true;
        for (index, branch) in branches.iter().enumerate() {
            let others = changed.iter().enumerate().filter(|(other, _)| *other != index);
            for (fluent, key) in others.flat_map(|(_, touched)| touched) {
                self.disturb_by_branch(id, (*fluent, *key));
            }
            self.block(branch);
            live &= self.control.live;
            deltas.push(self.state.facts.delta(mark));
            self.back_to(mark);
            self.control.live = true;
        }
        let joined = self.compose(id, &changed, &deltas);
        self.control.fixpoints -= 1;
        self.state.facts.replay(&joined);
        self.control.live = live;
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

    /// Joins the effects of all branches. Branches that leave different values in a fact are an error.
    fn compose(&mut self, id: StepId, changed: &[Vec<Atom>], deltas: &[Delta]) -> Delta {
        let mut written: FxHashMap<Atom, TruthSet> = FxHashMap::default();
        for (touched, delta) in changed.iter().zip(deltas) {
            for atom in touched.iter().copied() {
                let value = delta.get(&self.state.facts, atom);
                match written.get(&atom).copied() {
                    None => {
                        written.insert(atom, value);
                    }
                    Some(first) if first.same_set(value) => {}
                    Some(first) => {
                        if self.is_conflict(first, value) || self.is_conflict(value, first) {
                            self.conflict(id, atom, first, value);
                        }
                        written.insert(atom, TruthSet::open(Cause::step(id)));
                    }
                }
            }
        }
        Delta::new(written.into_iter())
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
}
