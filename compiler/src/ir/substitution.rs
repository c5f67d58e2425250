//! Rewriting of the ids in steps: inlining of a policy that was resolved once, where parameters become
//! arguments and steps and bindings get new numbers, and bindings that become one.

use super::{BindingId, Block, Condition, Reaction, StepId, StepKind, Term};

/// A change of ids and parameters, applied to every place where they stand.
pub(crate) trait Rewrite {
    fn step(&self, id: &mut StepId);
    fn binding(&self, id: &mut BindingId);
    /// Rewrites the parameter with this index, which is `term`.
    fn param(&self, index: u16, term: &mut Term);

    fn block(&self, block: &mut Block) {
        block.iter_mut().for_each(|id| self.step(id));
    }

    fn terms<'t>(&self, terms: impl IntoIterator<Item = &'t mut Term>) {
        terms.into_iter().for_each(|term| self.term(term));
    }

    fn term(&self, term: &mut Term) {
        match term {
            Term::Param(index) => {
                let index = *index;
                self.param(index, term);
            }
            Term::Binding(id) => self.binding(id),
            Term::Caught(kind, text) => [kind, text].into_iter().for_each(|id| self.binding(id)),
            Term::List(terms) | Term::Measure(_, terms) => self.terms(terms),
            Term::Field(of, _) | Term::Count(of) | Term::First(of) => self.term(of),
            Term::Template(parts) => self.terms(parts.iter_mut().map(|(part, _)| part)),
            Term::Arith(_, left, right) => self.terms([&mut **left, &mut **right]),
            Term::Bool(_) | Term::Int(_) | Term::Number(_) | Term::Text(_) | Term::Pose { .. } => {}
            Term::Case(..) | Term::Entity(_) | Term::Result | Term::Each | Term::Unknown => {}
        }
    }

    fn condition(&self, condition: &mut Condition) {
        match condition {
            Condition::Fact(fact) => self.terms(fact.args.iter_mut().flatten()),
            Condition::Compare(_, left, right) => self.terms([left, right]),
            Condition::Not(inner) => self.condition(inner),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                parts.iter_mut().for_each(|part| self.condition(part));
            }
            Condition::Literal(_) | Condition::Unknown => {}
            Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) => {}
        }
    }

    fn kind(&self, kind: &mut StepKind) {
        match kind {
            StepKind::Call(call) => {
                self.terms(&mut call.args);
                call.binds.iter_mut().for_each(|id| self.binding(id));
            }
            StepKind::Let { binding, value } => {
                self.term(value);
                self.binding(binding);
            }
            StepKind::Sequence { body, .. } | StepKind::Inline { body, .. } => self.block(body),
            StepKind::If { condition, then, otherwise, .. } => {
                self.condition(condition);
                self.block(then);
                otherwise.iter_mut().for_each(|block| self.block(block));
            }
            StepKind::Wait { condition, .. } => self.condition(condition),
            StepKind::Delay { .. } => {}
            StepKind::Finally { body, cleanup } => {
                self.block(body);
                self.block(cleanup);
            }
            StepKind::Monitor { whens, body } => {
                for when in whens {
                    self.condition(&mut when.condition);
                    match &mut when.reaction {
                        Reaction::Pause { .. } | Reaction::Timeout | Reaction::Restart { .. } => {}
                        Reaction::Resume { body, .. } => self.block(body),
                        Reaction::End { of, why, .. } => self.end(of, why),
                    }
                }
                self.block(body);
            }
            StepKind::Try { body, catches } => {
                self.block(body);
                for catch in catches {
                    let ids = catch.binds.iter_mut().flat_map(|caught| [&mut caught.kind, &mut caught.text]);
                    ids.for_each(|id| self.binding(id));
                    self.block(&mut catch.body);
                }
            }
            StepKind::Repeat { body, until, .. } => {
                self.block(body);
                until.iter_mut().for_each(|(until, _)| self.condition(until));
            }
            StepKind::Each { item, list, body, .. } => {
                self.binding(item);
                self.term(list);
                self.block(body);
            }
            StepKind::Parallel { branches } => branches.iter_mut().for_each(|block| self.block(block)),
            StepKind::End { of, why, .. } => self.end(of, why),
            StepKind::Unknown => {}
        }
    }

    fn end(&self, of: &mut Option<StepId>, why: &mut Option<Term>) {
        of.iter_mut().for_each(|id| self.step(id));
        self.terms(why);
    }
}

/// Arguments for parameters, and the numbers of the first step and the first binding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Substitution<'a> {
    pub(crate) args: &'a [Term],
    pub(crate) first_step: u32,
    pub(crate) first_binding: u32,
}

impl Rewrite for Substitution<'_> {
    fn step(&self, id: &mut StepId) {
        id.0 = id.0.saturating_add(self.first_step);
    }

    fn binding(&self, id: &mut BindingId) {
        id.0 = id.0.saturating_add(self.first_binding);
    }

    fn param(&self, index: u16, term: &mut Term) {
        *term = self.args.get(usize::from(index)).cloned().unwrap_or(Term::Unknown);
    }
}

/// New ids of the bindings from `first` on.
#[derive(Clone, Debug)]
pub(crate) struct Renumbering {
    pub(crate) first: usize,
    pub(crate) ids: Vec<BindingId>,
}

impl Rewrite for Renumbering {
    fn step(&self, _id: &mut StepId) {}

    fn binding(&self, id: &mut BindingId) {
        let new = id.index().checked_sub(self.first).and_then(|index| self.ids.get(index));
        *id = new.copied().unwrap_or(*id);
    }

    fn param(&self, _index: u16, _term: &mut Term) {}
}
