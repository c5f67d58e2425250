//! Transfer function of a call: its needs, its effects, and the facts after a failure.

use motet_syntax::{Diagnostic, Mistake, Severity, Span};
use smallvec::SmallVec;

use super::assume::Outcome;
use super::candidates::Candidates;
use super::diagnostics::{Refuted, Stale};
use super::effects::{Certainty, FactChange, weaken};
use super::evaluation::{CallFrame, MAX_ALIASES};
use super::{CertainFact, Mode, NeedVerdict, NeedVerdicts, Problem, Prover};
use crate::analysis::{Domain, Enclosing};
use crate::declare::{EffectDef, LastsDef, NeedDef, PerceptionLifetime, PrimitiveDef, ResourceSet};
use crate::environment::base_pose_facts;
use crate::facts::{ANY, Cause, FactKey, TruthSet, effort};
use crate::ir::{
    Base, BindingId, Call, Condition, Entity, Fluent, MotionKind, StepId, StepKind, Term, Ty, When,
};

impl<'a> Prover<'a> {
    pub(crate) fn call(&mut self, id: StepId, call: &Call, span: Span) {
        let library = self.library;
        let Some(def) = library.primitive(call.primitive) else { return };
        let result = call.binds.and_then(|binding| self.symbols.of_binding(binding.index()));
        let frame = CallFrame { args: &call.args, result, each: None };
        let cause = Cause::step(id);
        self.control.here = Some(id);
        self.erode();

        self.check_fresh(id, call, def);
        // Of an earlier visit.
        for index in 0..def.needs.len() {
            self.proof.retried.remove(&(id, index));
            self.proof.unknown_of.remove(&(id, index));
        }
        let mut verdicts = self.needs(id, def, def.needs.len(), frame, span);
        if self.mode == Mode::Explain {
            self.note_certain(id, def);
        }
        let (mut makes, mut unsettles) = std::mem::take(&mut self.buffers);
        self.changes(&def.makes, frame, &mut makes);
        self.changes(&def.unsettles, frame, &mut unsettles);
        if self.mode == Mode::Explain {
            self.check_watched(def, frame, span);
            self.check_redundant(def, &makes, frame, &verdicts, span);
        }
        if def.motion.is_some() {
            // A motion that is refused changes nothing.
            self.throw_all(&def.fails);
        }
        let lasting = self.lasting(id);
        self.make_stale(id, def, frame);
        self.unsettle(&unsettles, cause);
        if call.retries > 0 || self.may_begin_again() {
            self.effects_of_retries(id, def, frame, (&mut makes, &mut unsettles));
        }
        self.check_lasting(&lasting);
        self.fail(id, call, def, frame, &makes, &mut verdicts);
        self.forget(result.filter(|entity| self.symbols.get(*entity).is_some()));
        call.binds.into_iter().for_each(|binding| self.forget_tests(binding));
        let armed = self.armed(id);
        self.make(&makes, if def.lasts.is_some() { Cause::seen_by(id) } else { cause });
        self.stand(def, frame, cause);
        self.check_fired(&armed, id);
        self.buffers = (makes, unsettles);
        self.bind(id, call, def, frame);
        self.erode();
        self.see_states();
        // It fails for certain, and only its handler goes on.
        self.control.live &= !verdicts.contains(&NeedVerdict::Caught);
        if let Some(slot) = self.proof.needs.get_mut(id.index()) {
            *slot = verdicts;
        }
    }

    /// Records what the robot serves and is near after a drive to a pose that is written out, in the scene.
    fn stand(&mut self, def: &PrimitiveDef, frame: CallFrame<'_>, cause: Cause) {
        let Some((MotionKind::StandAt, args)) = &def.motion else { return };
        let Some(Term::Param(index)) = args.first() else { return };
        let Some(Term::Pose { xyz: [x, y, _], .. }) = frame.args.get(usize::from(*index)) else { return };
        let facts = base_pose_facts::from_base(self.library, self.environment, [*x, *y]);
        let change = |(fluent, key, truth)| FactChange::new(fluent, key, truth, Certainty::Always);
        let changes: Vec<FactChange> = facts.into_iter().map(change).collect();
        self.make(&changes, cause);
    }

    /// Records the certain facts about open containers and the hand before a motion, which rule out possible
    /// worlds.
    fn note_certain(&mut self, id: StepId, def: &PrimitiveDef) {
        if def.motion.is_none() || !self.environment.has_scene() {
            return;
        }
        let mut certain = Vec::new();
        let known = &self.library.lang_items;
        for fluent in [known.open, known.holding].into_iter().flatten() {
            self.state.facts.written(fluent, |key, value| {
                if value.is_true() || value.is_false() {
                    let (entity, value) = (Entity(key.arg(0)), value.is_true());
                    certain.push(CertainFact { fluent, entity, value });
                }
            });
        }
        if certain.is_empty() {
            self.proof.certain.remove(&id);
        } else {
            self.proof.certain.insert(id, certain);
        }
    }

    /// Weakens the effects of a step that is tried again: those with a condition are then decided by what an
    /// attempt that failed has left behind.
    fn effects_of_retries(
        &mut self,
        id: StepId,
        def: &PrimitiveDef,
        frame: CallFrame<'_>,
        (makes, unsettles): (&mut Vec<FactChange>, &mut Vec<FactChange>),
    ) {
        let is_conditional = |effect: &EffectDef| effect.when.is_some();
        if !def.makes.iter().chain(&def.unsettles).any(is_conditional) {
            return;
        }
        let mark = self.state.facts.mark();
        self.unsettle(makes, Cause::step(id));
        self.erode();
        let (mut made, mut unsettled) = (Vec::new(), Vec::new());
        self.changes(&def.makes, frame, &mut made);
        self.changes(&def.unsettles, frame, &mut unsettled);
        self.back_to(mark);
        weaken(makes, &made);
        weaken(unsettles, &unsettled);
        self.unsettle(unsettles, Cause::step(id));
        // What the last attempt need not make, an earlier one has left unknown.
        let doubtful: Vec<FactChange> = makes
            .iter()
            .filter(|change| !change.is_sure())
            .map(|change| FactChange { sure: Certainty::Sometimes, ..*change })
            .collect();
        self.unsettle(&doubtful, Cause::step(id));
    }

    /// Propagates the facts after a failure of the step, and rechecks its needs for a retry.
    fn fail(
        &mut self,
        id: StepId,
        call: &Call,
        def: &PrimitiveDef,
        frame: CallFrame<'_>,
        makes: &[FactChange],
        verdicts: &mut [NeedVerdict],
    ) {
        let (retried, may_begin_again) = (call.retries > 0, self.may_begin_again());
        if self.control.enclosing.is_empty() && !retried && !may_begin_again {
            return;
        }
        let mark = self.state.facts.mark();
        self.unsettle(makes, Cause::step(id));
        self.erode();
        self.see_states();
        self.throw_all(&def.fails);
        if retried && self.mode == Mode::Explain && !verdicts.contains(&NeedVerdict::Refuted) {
            self.check_retry(id, call, def, frame);
        }
        if retried || may_begin_again {
            for (index, (need, verdict)) in def.needs.iter().zip(verdicts).enumerate() {
                if *verdict != NeedVerdict::Proven {
                    continue;
                }
                let (value, culprit) = self.need(need, frame);
                if value.is_true() {
                    continue;
                }
                // What begins again after an interruption is asked again by the run, whatever the verdict.
                if retried {
                    *verdict = NeedVerdict::Deferred;
                    self.proof.retried.insert((id, index));
                    culprit.map(|entity| self.proof.unknown_of.insert((id, index), entity));
                }
                self.throw(self.library.lang_items.need_failure(&need.condition, &def.fails), usize::MAX);
            }
        }
        self.back_to(mark);
    }

    /// Returns whether a monitor around the step may interrupt it and let it begin again.
    fn may_begin_again(&self) -> bool {
        let goes_on = |when: &When| when.reaction.goes_on();
        self.state.watched.iter().any(|watched| {
            let kind = self.program.step(watched.by).map(|step| &step.kind);
            matches!(kind, Some(StepKind::Monitor { whens, .. }) if whens.iter().any(goes_on))
        })
    }

    /// Reports the use of a pose that was perceived before something moved.
    fn check_fresh(&mut self, id: StepId, call: &Call, def: &PrimitiveDef) {
        for (arg, span) in call.args.iter().zip(&call.spans) {
            let Term::Binding(binding) = arg else { continue };
            let Some(bound) = self.program.bindings.get(binding.index()) else { continue };
            if bound.ty != Ty::plain(Base::Pose) {
                continue;
            }
            let fresh = self.freshness(*binding);
            if fresh.no.is_some() && self.mode == Mode::Decide {
                self.count(Stale::CODE);
            } else if fresh.no.is_some() {
                let mistake = Stale {
                    span: *span,
                    name: bound.name.clone(),
                    callee: def.name.clone(),
                    found: bound.span,
                    moved: self.cause_span(fresh.no),
                    mover: self.cause_name(fresh.no),
                };
                let (bound, mistake) = (bound.span, Diagnostic::from(mistake));
                self.notify(Problem::StaleBinding { step: id, bound }, &mistake);
                self.diagnostics.push(mistake);
            }
        }
    }

    /// Freshness of a pose: stale if it is, by whichever path it was bound.
    fn freshness(&self, binding: BindingId) -> TruthSet {
        let found = self.poses(binding).into_iter();
        found.fold(TruthSet::default(), |fresh, key| fresh.join(self.state.facts.get(self.fresh, key)))
    }

    /// Keys of a pose, one for each step that may have bound it, in the order of the steps.
    fn poses(&self, binding: BindingId) -> SmallVec<[FactKey; 2]> {
        let mut found = SmallVec::new();
        let any_step = pose_key(binding, StepId(0)).with(2, ANY).with(3, ANY);
        self.state.facts.entries(self.fresh, any_step, |key, _| found.push(key));
        found.sort_unstable();
        found
    }

    /// Returns whether a binding is a stale pose.
    pub(crate) fn is_stale(&self, id: BindingId) -> bool {
        let binding = self.program.bindings.get(id.index());
        binding.is_some_and(|binding| binding.ty == Ty::plain(Base::Pose)) && self.freshness(id).no.is_some()
    }

    /// Verdicts on the first `count` needs.
    pub(crate) fn needs(
        &mut self,
        id: StepId,
        def: &PrimitiveDef,
        count: usize,
        frame: CallFrame<'_>,
        span: Span,
    ) -> NeedVerdicts {
        let mut verdicts = NeedVerdicts::new();
        // What it needs of a thing that it cannot be given at all is beside the point.
        let mut is_misgiven = false;
        for need in def.needs.iter().take(count).take_while(|_| !effort::is_used_up()) {
            let (value, culprit) = match (&need.each, &need.when) {
                (None, None) => (self.evaluate_on_paths(&need.condition, frame), None),
                _ => self.need(need, frame),
            };
            let verdict = if value.no.is_some() {
                let frame = CallFrame { each: culprit, ..frame };
                let is_caught = self.is_caught(def, need);
                if !is_misgiven {
                    self.refuted(id, def, need, frame, span);
                }
                is_misgiven |= self.is_misgiven(&need.condition, frame);
                if is_caught { NeedVerdict::Caught } else { NeedVerdict::Refuted }
            } else if value.open.is_some() {
                if let Some(entity) = culprit {
                    self.proof.unknown_of.insert((id, verdicts.len()), entity);
                }
                NeedVerdict::Deferred
            } else {
                NeedVerdict::Proven
            };
            verdicts.push(verdict);
            if verdict == NeedVerdict::Deferred
                && !self.state.volatile.is_empty()
                && self.mode == Mode::Explain
            {
                self.check_reactions(def, need, value, frame, span);
            }
            if matches!(verdict, NeedVerdict::Deferred | NeedVerdict::Caught) {
                // A guard that refuses changes nothing, and the need did not hold.
                self.throw(self.library.lang_items.need_failure(&need.condition, &def.fails), usize::MAX);
            }
            if verdict != NeedVerdict::Proven {
                self.grant(id, need, frame);
            }
        }
        verdicts
    }

    fn refuted(&mut self, id: StepId, def: &PrimitiveDef, need: &NeedDef, frame: CallFrame<'_>, span: Span) {
        let is_caught = self.is_caught(def, need);
        if self.mode == Mode::Decide {
            if !is_caught {
                if need.each.is_none() && self.is_entered(&need.condition, frame) {
                    self.control.settled.get_or_insert(self.diagnostics.len());
                }
                self.count(Refuted::CODE);
            }
            return;
        }
        let in_cleanup = self.explain_in_cleanup(id, need, frame);
        let explanation = in_cleanup.unwrap_or_else(|| self.explain(&need.condition, true, frame));
        let mistake = Refuted {
            span,
            callee: def.name.clone(),
            needs: explanation.wanted.clone(),
            story: explanation.story(),
            culprit: self.cause_span(explanation.cause),
            declared: need.span,
            remedy: self.remedy(&explanation),
            subject: explanation.subject,
        };
        let mut mistake = Diagnostic::from(mistake);
        if is_caught {
            mistake.severity = Severity::Warning;
            mistake.help = Some("the step fails, and the `catch` around it runs".to_owned());
            return self.diagnostics.push(mistake);
        }
        let frame = CallFrame { each: None, ..frame };
        self.notify(Problem::RefutedNeed { step: id, def, frame }, &mistake);
        self.diagnostics.push(mistake);
    }

    /// Returns whether each fact in a condition keeps its value at a join. One about a name that no step has
    /// written is unknown there.
    fn is_entered(&self, condition: &Condition, frame: CallFrame<'_>) -> bool {
        let is_lost = |part: &Condition| {
            let Condition::Fact(fact) = part else { return false };
            let is_bare =
                |key| self.has_symbol(fact.fluent, key) && self.state.facts.entry(fact.fluent, key).is_none();
            self.key(fact, frame).is_none_or(is_bare)
        };
        !condition.any(&is_lost)
    }

    /// Returns true if a need compares a number of the thing itself, which no step can change, and a handler
    /// around the step catches the failure of that need.
    fn is_caught(&self, def: &PrimitiveDef, need: &NeedDef) -> bool {
        let Condition::Compare(_, Term::Field(..), _) = &need.condition else { return false };
        let Some(failure) = self.library.lang_items.need_failure(&need.condition, &def.fails) else {
            return false;
        };
        let around = self.control.enclosing.iter().rev();
        let mut inside = around.take_while(|around| !matches!(around, Enclosing::Cleanup(_)));
        inside.any(|around| around.handles(failure))
    }

    /// Possible values of a need, and the entity for which it can be false, or else is unknown.
    pub(crate) fn need(&self, need: &NeedDef, frame: CallFrame<'_>) -> (TruthSet, Option<Entity>) {
        let Some(kind) = need.each else {
            let asked = self.evaluate(&need.condition, frame);
            let value = match &need.when {
                None => asked,
                Some(when) => self.evaluate(when, frame).not().or(asked),
            };
            return (value, None);
        };
        let Candidates { known, doubtful, rest } = self.asked(need, kind, frame);
        let (mut all, mut culprit, mut unknown) = (TruthSet::yes(Cause::NOTHING), None, None);
        let known = known.into_iter().map(|entity| (entity, false));
        for (candidate, is_doubtful) in known.chain(doubtful.into_iter().map(|entity| (entity, true))) {
            let frame = CallFrame { each: Some(candidate), ..frame };
            let when =
                need.when.as_ref().map_or(TruthSet::yes(Cause::NOTHING), |when| self.evaluate(when, frame));
            let mut value = when.not().or(self.evaluate(&need.condition, frame));
            if is_doubtful && !value.is_true() {
                // It may be of another kind, and then it does not count.
                value = TruthSet::NOTHING_KNOWN;
            }
            if value.no.is_some() && culprit.is_none() {
                culprit = Some(candidate);
            }
            if value.open.is_some() && unknown.is_none() {
                unknown = Some(candidate);
            }
            all = all.and(value);
        }
        if rest.is_some() {
            all = all.and(TruthSet::NOTHING_KNOWN.or(TruthSet::NOTHING_KNOWN));
        }
        (all, culprit.or(unknown))
    }

    /// Assumes a need: its guard has observed it, or its refutation was reported once.
    pub(crate) fn grant(&mut self, id: StepId, need: &NeedDef, frame: CallFrame<'_>) {
        let cause = Cause::step(id);
        if need.each.is_none() && need.when.is_none() {
            self.assume(&need.condition, Outcome::True, cause, frame);
        }
    }

    /// Binds a new result: a fresh pose, and facts with the lifetime of the contract.
    fn bind(&mut self, id: StepId, call: &Call, def: &PrimitiveDef, frame: CallFrame<'_>) {
        let Some(lasts) = &def.lasts else { return };
        let mut lifetime = self.lifetime(lasts, frame);
        if let (Some(binding), Some(_)) = (call.binds, frame.result) {
            self.outlive(binding, id, frame, &mut lifetime);
        }
        self.state.lasting.insert(id, lifetime);
        if let Some(binding) = call.binds.filter(|_| def.result == Some(Ty::plain(Base::Pose))) {
            // What another step bound to the name is gone.
            for other in self.poses(binding) {
                self.state.facts.forget(self.fresh, other);
            }
            self.state.facts.set(self.fresh, pose_key(binding, id), TruthSet::yes(Cause::step(id)));
        }
    }

    fn lifetime(&self, lasts: &LastsDef, frame: CallFrame<'_>) -> PerceptionLifetime {
        let entities = lasts.entities.iter().filter_map(|term| self.argument(term, frame));
        PerceptionLifetime { resources: lasts.resources, entities: entities.map(Entity).collect() }
    }

    /// Shortens the lifetime of the facts of a name to that of all steps that bind it: where their paths have
    /// met, it may be what any of them found.
    fn outlive(
        &self,
        binding: BindingId,
        id: StepId,
        frame: CallFrame<'_>,
        lifetime: &mut PerceptionLifetime,
    ) {
        let Some(binding) = self.program.bindings.get(binding.index()) else { return };
        if binding.binders.len() > MAX_ALIASES {
            lifetime.resources = ResourceSet::MAX;
            return;
        }
        for step in binding.binders.iter().filter(|step| **step != id) {
            let Some(StepKind::Call(call)) = self.program.step(*step).map(|step| &step.kind) else {
                continue;
            };
            let def = self.library.primitive(call.primitive);
            let Some(lasts) = def.and_then(|def| def.lasts.as_ref()) else { continue };
            let other = self.lifetime(lasts, CallFrame { args: &call.args, ..frame });
            lifetime.resources |= other.resources;
            lifetime.entities.extend(other.entities);
        }
    }

    /// Forgets the facts of a symbol whose name is bound anew.
    pub(crate) fn forget(&mut self, symbol: Option<Entity>) {
        let Some(symbol) = symbol else { return };
        let mut stale: SmallVec<[_; 8]> = SmallVec::new();
        for (index, def) in self.library.fluents.iter().enumerate() {
            let fluent = Fluent(u16::try_from(index).unwrap_or(u16::MAX));
            self.state.facts.written_parts(fluent, |key| {
                let mut params = def.params.iter().enumerate();
                if params.any(|(at, (_, ty))| ty.kind().is_some() && key.arg(at) == symbol.0) {
                    stale.push((fluent, key));
                }
            });
        }
        stale.sort_unstable();
        for (fluent, key) in stale {
            self.state.facts.forget(fluent, key);
        }
    }
}

/// Key of a pose in the table of fresh values: the binding, and the step that bound it. Bindings and steps
/// beyond 2^30 do not occur.
fn pose_key(binding: BindingId, step: StepId) -> FactKey {
    FactKey::new([low(binding.0), high(binding.0), low(step.0), high(step.0)].into_iter())
}

/// Step in the key of a pose.
pub(super) fn pose_step(key: FactKey) -> StepId {
    StepId(u32::from(key.arg(2)) | (u32::from(key.arg(3)) << 15))
}

/// Lower half of a number; below the pattern value, as the upper one.
fn low(number: u32) -> u16 {
    (number & 0x7fff) as u16
}

fn high(number: u32) -> u16 {
    ((number >> 15) & 0x7fff) as u16
}
