//! Results of policies: the value that each `done` gives, and the paths that end without one.
//!
//! A `done` with a value is a `let` of the result and the `done` alone, so that later stages know no more
//! than these two.

use motet_syntax::ast::{End, EndKind, Expr, Name, Policy, Reaction, Step, StepKind};
use smallvec::SmallVec;
use smol_str::SmolStr;

use super::diagnostics::{MissingResult, ReactionResult, UnwantedResult};
use super::step::StepResolver;
use crate::declare::elaborator::{Expected, ValueRole};
use crate::declare::unbound::Unbound;
use crate::ir::{self, BindingId, Renumbering, Rewrite as _, StepId, StepPosition, Term, Ty};

/// Result of the policy whose steps are being resolved.
#[derive(Debug, Default)]
pub(super) struct PolicyResult {
    /// Declared type; `None` if the policy gives nothing.
    ty: Option<Ty>,
    /// Binding of the result; `None` if nobody asks for it.
    binding: Option<BindingId>,
    /// Values that a `done` gives, in order.
    values: Vec<Term>,
    /// Steps that bind the result.
    binders: SmallVec<[StepId; 1]>,
    /// Reason for which control came so far without a `done`, where another path has one.
    pub(super) open_path: Option<Unbound>,
}

impl PolicyResult {
    pub(super) fn new(ty: Option<Ty>, binding: Option<BindingId>) -> Self {
        Self { ty, binding, ..Self::default() }
    }

    /// Gives the bindings in the values their new numbers.
    pub(super) fn renumber(&mut self, new: &Renumbering) {
        new.terms(&mut self.values);
    }
}

impl StepResolver<'_> {
    /// Resolves the results of the endings of a step itself to steps that come before it.
    pub(super) fn results(&mut self, step: &Step, position: StepPosition) -> Vec<StepId> {
        let ends: Vec<(&End, bool)> = match &step.kind {
            StepKind::End(end) => vec![(end, false)],
            StepKind::Monitor { whens, .. } => {
                let ends = whens.iter().filter_map(|when| match &when.reaction {
                    Reaction::End(end) => Some((end, true)),
                    Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::Resume { .. } => None,
                });
                ends.collect()
            }
            _ => return Vec::new(),
        };
        let done = ends.into_iter().filter(|(end, _)| end.kind == EndKind::Done);
        done.filter_map(|(end, is_reaction)| self.given(end, is_reaction, position)).collect()
    }

    /// Resolves the result of a `done` to a step that binds it, if somebody asks for it.
    fn given(&mut self, end: &End, is_reaction: bool, position: StepPosition) -> Option<StepId> {
        let policy = self.calls.last().cloned().unwrap_or_default();
        let (given, ty) = match (&end.result, self.result.ty) {
            (None, None) => return None,
            (Some(given), Some(ty)) => (given, ty),
            (Some(given), None) => {
                self.elaborator.term(given, None);
                self.elaborator.report(UnwantedResult { span: given.span, policy });
                return None;
            }
            (None, Some(ty)) => {
                let ty = self.elaborator.library.type_name(ty);
                self.report_once(MissingResult { span: end.span, policy, ty, path: None });
                return None;
            }
        };
        let value = self.value_of(given, ty);
        if is_reaction && !stands_for_itself(&value) && value != Term::Unknown {
            self.elaborator.report(ReactionResult { span: given.span });
        }
        let binding = self.result.binding?;
        self.result.values.push(value.clone());
        let id = self.reserve(given.span, position)?;
        self.result.binders.push(id);
        self.fill(id, ir::StepKind::Let { binding, value })
    }

    fn value_of(&mut self, given: &Expr, ty: Ty) -> Term {
        self.elaborator.term_of(given, Expected { ty, place: ValueRole::Named("the result of a policy") })
    }

    /// Reports a path to the end of a policy that gives no result, behind its steps.
    pub(super) fn check_given(&mut self, policy: &Policy) {
        let Some(ty) = self.result.ty.filter(|_| self.goes_on) else { return };
        if self.elaborator.is_behind_gap {
            return;
        }
        let span = policy.body.steps.last().map_or(policy.name.span, |step| step.span);
        let path = Some(self.result.open_path.take());
        let (policy, ty) = (policy.name.text.clone(), self.elaborator.library.type_name(ty));
        self.report_once(MissingResult { span, policy, ty, path });
    }

    /// Reports a mistake in a policy, which is found again at each call.
    fn report_once(&mut self, mistake: MissingResult) {
        let mistake = mistake.into();
        if !self.elaborator.diagnostics.contains(&mistake) {
            self.elaborator.report(mistake);
        }
    }

    /// Makes the result of a call visible. Where it always is the same name or constant, it stands for that.
    pub(super) fn name_result(&mut self, bind: &Name, ty: Ty, result: PolicyResult) {
        let PolicyResult { binding: Some(binding), values, binders, .. } = result else { return };
        let bindings = &self.elaborator.bindings;
        let described = values.iter().map(|value| match value {
            Term::Binding(id) => bindings.get(id.index())?.descriptions.clone(),
            _ => None,
        });
        let described: Option<Vec<SmallVec<[SmolStr; 1]>>> = described.collect();
        if let Some(bound) = self.elaborator.bindings.get_mut(binding.index()) {
            let all = described.map(|all| all.into_iter().flatten().collect::<SmallVec<[SmolStr; 1]>>());
            bound.descriptions = all.filter(|all| !all.is_empty());
            bound.binders = binders;
        }
        self.name(&bind.text, binding, ty, bind.span);
        if let Some(value) = values.first()
            && stands_for_itself(value)
            && values.iter().all(|other| other == value)
        {
            self.elaborator.scope.stand_for(value.clone());
        }
    }
}

/// Returns whether a name for a value can stand for the value itself: a constant or another name.
pub(super) fn stands_for_itself(value: &Term) -> bool {
    value.is_constant() || matches!(value, Term::Binding(_) | Term::Caught(..))
}
