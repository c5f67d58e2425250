//! What would mend a refutation: calls that bring about what a step needs, found by chaining backwards from the needs to
//! primitives that make them, and trying them on the facts as they are before the step.
//!
//! The search is bounded and greedy, after the manner of means-ends analysis (Newell and Simon 1963); what it finds is a
//! proposal, which [`crate::fix`] verifies by checking the document again.

use motet_syntax::{Code, Diagnostic, Span};

mod makers;
mod search;

use super::Prover;
use super::eval::Frame;
use super::facts::Key;
use crate::ir::{BindingId, Condition, Entity, Fact, Fluent, Primitive, StepId, StepKind, Term};
use crate::library::{NeedDef, PrimitiveDef};

/// How deep needs of needs are followed.
const MAX_DEPTH: usize = 3;
/// The most calls of one proposal.
const MAX_CALLS: usize = 6;
/// The most proposals for one step.
const MAX_PROPOSALS: usize = 4;
/// The most steps of a policy for which proposals are made.
const MAX_OFFERS: usize = 32;
/// How many steps back a call may be inserted.
const MAX_EARLIER: usize = 6;
/// The most calls that are tried for one step.
const MAX_TRIES: usize = 400;

/// Proposals for one finding.
#[derive(Clone, Debug)]
pub(crate) struct Offer {
    pub(crate) code: Code,
    pub(crate) span: Span,
    pub(crate) message: String,
    pub(crate) mends: Vec<Mend>,
}

/// One way to mend a finding.
#[derive(Clone, PartialEq, Debug)]
pub(crate) enum Mend {
    /// Calls before a step.
    Before(StepId, Vec<Proposed>),
    /// Calls behind a step.
    After(StepId, Vec<Proposed>),
    /// The step that bound a value, once more before another step, whose argument then is the new value.
    Again { found: StepId, before: StepId, used: Span },
    /// The step left out.
    Drop(StepId),
    /// A monitor of a fluent without parameters around the step.
    Watch(StepId, Fluent),
}

/// Where a policy is done, and steps may still be added.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum End {
    /// Before a `done`.
    Before(StepId),
    /// Behind the last step.
    After(StepId),
}

/// A call that is not there yet.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Proposed {
    pub(crate) primitive: Primitive,
    pub(crate) args: Vec<Term>,
    /// What a perception is to find.
    pub(crate) result: Option<Entity>,
    /// The binding that it replaces: the value that it gave is stale.
    pub(crate) again: Option<BindingId>,
}

/// A call that brings about a fact.
#[derive(Clone, Debug)]
pub(crate) struct Maker<'l> {
    pub(crate) call: Proposed,
    pub(crate) want: Want,
    /// What the effect stands under, and for which entity.
    pub(crate) when: Option<(&'l Condition, Option<Entity>)>,
}

/// A fact that is asked for: the fluent, its arguments, its truth.
pub(crate) type Want = (Fluent, Key, bool);

impl Prover<'_> {
    /// Offers what would make the needs of a step hold, where nothing is offered for it yet.
    pub(crate) fn offer_before(
        &mut self,
        id: StepId,
        def: &PrimitiveDef,
        frame: Frame<'_>,
        finding: &Diagnostic,
    ) {
        let span = finding.span;
        if self.offers.len() >= MAX_OFFERS
            || self.is_inlined(id)
            || self.offers.iter().any(|offer| offer.span == span)
        {
            return;
        }
        let mut mends = Vec::new();
        if self.is_done(def, frame) {
            mends.push(Mend::Drop(id));
        }
        mends.extend(self.unwatched(def, frame).map(|fluent| Mend::Watch(id, fluent)));
        let plans = self.plans(&def.needs, frame);
        let wants = self.first_refuted(&def.needs, frame);
        let direct: Vec<_> = wants.into_iter().flat_map(|want| self.makers(want)).collect();
        mends.extend(plans.into_iter().map(|calls| Mend::Before(id, self.named(calls, span))));
        // What cannot be done here, since the hand is full, say, may go before an earlier step.
        for earlier in self.siblings_before(id) {
            let place = self.program.step(earlier).map_or(span, |step| step.span);
            for maker in direct.iter().take(MAX_PROPOSALS) {
                mends.push(Mend::Before(earlier, self.named(vec![maker.call.clone()], place)));
            }
        }
        self.offer(finding, mends);
    }

    /// The steps before one in its block, the nearest first.
    fn siblings_before(&self, id: StepId) -> Vec<StepId> {
        let Some(place) = self.program.step(id).map(|step| step.place) else {
            return Vec::new();
        };
        let before = self.program.steps.iter().enumerate().take(id.index()).rev();
        let siblings =
            before.filter(|(_, step)| step.place.parent == place.parent && step.place.slot == place.slot);
        siblings.filter_map(|(index, _)| u32::try_from(index).ok().map(StepId)).take(MAX_EARLIER).collect()
    }

    /// The fluent that no monitor around a step watches, though the step needs one to; only one without parameters,
    /// of which it is plain what there is to watch.
    fn unwatched(&self, def: &PrimitiveDef, frame: Frame<'_>) -> Option<Fluent> {
        let refuted = def.needs.iter().find(|need| self.need(need, frame).0.no.is_some())?;
        let Condition::MonitoredFluent(fluent) = &refuted.condition else { return None };
        self.library.fluent(*fluent).filter(|def| def.params.is_empty()).map(|_| *fluent)
    }

    /// Offers what would undo a fact in which a policy ends: an object in the hand, a container left open.
    pub(crate) fn offer_ended(&mut self, want: Want, end: Option<End>, finding: &Diagnostic) {
        let Some(end) = end.filter(|_| self.live) else { return };
        let (fluent, key, truth) = want;
        let count = self.library.fluent(fluent).map_or(0, |def| def.params.len());
        let args = (0..count).map(|index| Some(Term::Entity(Entity(key.arg(index))))).collect();
        let fact = Condition::Fact(Fact { fluent, args });
        let goal = if truth { fact } else { Condition::Not(Box::new(fact)) };
        self.offer_at_end(goal, end, finding);
    }

    /// Offers what would reach a goal where the policy is done.
    pub(crate) fn offer_at_end(&mut self, goal: Condition, end: End, finding: &Diagnostic) {
        let (End::Before(id) | End::After(id)) = end;
        let Some(span) = self.program.step(id).map(|step| step.span) else { return };
        if self.offers.len() >= MAX_OFFERS || self.is_inlined(id) {
            return;
        }
        let need = NeedDef { condition: goal, each: None, when: None, span };
        let plans = self.plans(&[need], Frame::default());
        let mends = plans.into_iter().map(|calls| match end {
            End::Before(_) => Mend::Before(id, self.named(calls, span)),
            End::After(_) => Mend::After(id, self.named(calls, Span { start: span.end, ..span })),
        });
        let mends = mends.collect();
        self.offer(finding, mends);
    }

    /// Offers to leave out the step that is being proved.
    pub(crate) fn offer_leaving_out(&mut self, finding: &Diagnostic) {
        let own = self.here.filter(|id| !self.is_inlined(*id));
        self.offer(finding, own.map(Mend::Drop).into_iter().collect());
    }

    fn offer(&mut self, finding: &Diagnostic, mends: Vec<Mend>) {
        if self.offers.len() < MAX_OFFERS {
            let Diagnostic { code, span, message, .. } = finding;
            self.offers.push(Offer { code: *code, span: *span, message: message.clone(), mends });
        }
    }

    /// Offers to perceive again what is stale.
    pub(crate) fn offer_again(&mut self, id: StepId, bound: Span, finding: &Diagnostic) {
        let found = self.program.steps.iter().position(|step| {
            let StepKind::Call(call) = &step.kind else { return false };
            let binding = call.binds.and_then(|id| self.program.bindings.get(id.index()));
            binding.is_some_and(|binding| binding.span == bound)
        });
        let Some(found) = found.and_then(|index| u32::try_from(index).ok()) else { return };
        if !self.is_inlined(id) {
            self.offer(finding, vec![Mend::Again { found: StepId(found), before: id, used: finding.span }]);
        }
    }

    /// Whether a step belongs to a sub-policy, where the names of its caller mean nothing.
    fn is_inlined(&self, id: StepId) -> bool {
        self.program.around(id).any(|(_, step)| matches!(step.kind, StepKind::Inline { .. }))
    }

    /// Whether all that a step makes is so already.
    fn is_done(&self, def: &PrimitiveDef, frame: Frame<'_>) -> bool {
        let mut plain =
            def.makes.iter().filter(|effect| effect.each.is_none() && effect.when.is_none()).peekable();
        plain.peek().is_some()
            && plain.all(|effect| {
                let fact = Condition::Fact(effect.fact.clone());
                let value = self.evaluate(&fact, frame);
                if effect.value { value.is_true() } else { value.is_false() }
            })
    }

    /// Entities by the bindings through which the document speaks of them, where there is one before `place`.
    fn named(&self, mut calls: Vec<Proposed>, place: Span) -> Vec<Proposed> {
        for term in calls.iter_mut().flat_map(|call| &mut call.args) {
            let Term::Entity(entity) = term else { continue };
            let bound = self.program.bindings.iter().enumerate().rev().find(|(index, binding)| {
                let is_before = binding.span.file == place.file && binding.span.start < place.start;
                is_before && binding.name != "_" && self.symbols.of_binding(*index) == Some(*entity)
            });
            if let Some(id) = bound.and_then(|(index, _)| u32::try_from(index).ok()) {
                *term = Term::Binding(BindingId(id));
            }
        }
        calls
    }
}
