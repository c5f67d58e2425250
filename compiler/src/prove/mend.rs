//! What would mend a refutation: calls that bring about what a step needs, found by chaining backwards from the needs to
//! primitives that make them, and trying them on the facts as they are before the step.
//!
//! The search is bounded and greedy, after the manner of means-ends analysis (Newell and Simon 1963); what it finds is a
//! proposal, which [`crate::fix`] verifies by checking the document again.

use motet_syntax::ast::CompareOp;
use motet_syntax::{Code, Span};

use super::Prover;
use super::apply::Change;
use super::eval::Frame;
use super::facts::{ANY, Key};
use super::value::Cause;
use crate::ir::{Base, BindingId, Condition, Entity, Fluent, Primitive, StepId, StepKind, Term, Ty};
use crate::library::{EffectDef, NeedDef, PrimitiveDef};

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
}

/// A call that is not there yet.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Proposed {
    pub(crate) primitive: Primitive,
    pub(crate) args: Vec<Term>,
}

/// A fact that is asked for: the fluent, its arguments, its truth.
type Want = (Fluent, Key, bool);

impl Prover<'_> {
    /// Offers what would make the needs of a step hold, where nothing is offered for it yet.
    pub(crate) fn offer_before(
        &mut self,
        id: StepId,
        def: &PrimitiveDef,
        frame: Frame<'_>,
        finding: (Code, String),
    ) {
        let Some(step) = self.program.steps.get(id.index()) else { return };
        let span = step.span;
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
        let plans = self.plans(&def.needs, frame);
        let wants = self.first_refuted(&def.needs, frame);
        let direct: Vec<_> = wants.into_iter().flat_map(|want| self.makers(want)).collect();
        mends.extend(plans.into_iter().map(|calls| Mend::Before(id, self.named(calls, span))));
        // What cannot be done here, since the hand is full, say, may go before an earlier step.
        for earlier in self.siblings_before(id) {
            let place = self.program.steps.get(earlier.index()).map_or(span, |step| step.span);
            for (call, _) in direct.iter().take(MAX_PROPOSALS) {
                mends.push(Mend::Before(earlier, self.named(vec![call.clone()], place)));
            }
        }
        self.offers.push(Offer { code: finding.0, span, message: finding.1, mends });
    }

    /// The steps before one in its block, the nearest first.
    fn siblings_before(&self, id: StepId) -> Vec<StepId> {
        let Some(place) = self.program.steps.get(id.index()).map(|step| step.place) else {
            return Vec::new();
        };
        let before = self.program.steps.iter().enumerate().take(id.index()).rev();
        let siblings =
            before.filter(|(_, step)| step.place.parent == place.parent && step.place.slot == place.slot);
        siblings.filter_map(|(index, _)| u32::try_from(index).ok().map(StepId)).take(MAX_EARLIER).collect()
    }

    /// Offers what would reach the goal behind the last step.
    pub(crate) fn offer_goal(&mut self, goal: &Condition, span: Span, finding: (Code, String)) {
        let Some(last) = self.program.body.last().copied() else { return };
        if !self.live || self.offers.iter().any(|offer| offer.span == span) {
            return;
        }
        let need = NeedDef { condition: goal.clone(), each: None, when: None, span };
        let plans = self.plans(&[need], Frame::default());
        let end = self
            .program
            .steps
            .get(last.index())
            .map_or(span, |step| Span { start: step.span.end, ..step.span });
        let mends = plans.into_iter().map(|calls| Mend::After(last, self.named(calls, end))).collect();
        self.offers.push(Offer { code: finding.0, span, message: finding.1, mends });
    }

    /// Offers to perceive again what is stale.
    pub(crate) fn offer_again(&mut self, id: StepId, bound: Span, used: Span, finding: (Code, String)) {
        let found = self.program.steps.iter().position(|step| {
            let StepKind::Call(call) = &step.kind else { return false };
            let binding = call.binds.and_then(|id| self.program.bindings.get(id.index()));
            binding.is_some_and(|binding| binding.span == bound)
        });
        let Some(found) = found.and_then(|index| u32::try_from(index).ok()) else { return };
        if self.offers.len() < MAX_OFFERS && !self.is_inlined(id) {
            let mends = vec![Mend::Again { found: StepId(found), before: id, used }];
            self.offers.push(Offer { code: finding.0, span: used, message: finding.1, mends });
        }
    }

    /// Whether a step belongs to a sub-policy, where the names of its caller mean nothing.
    fn is_inlined(&self, id: StepId) -> bool {
        let step = |id: &StepId| self.program.steps.get(id.index());
        let parents = std::iter::successors(step(&id), |of| of.place.parent.as_ref().and_then(step));
        parents.skip(1).any(|step| matches!(step.kind, StepKind::Inline { .. }))
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

    /// Runs of calls after which all needs hold, the shortest first.
    fn plans(&mut self, needs: &[NeedDef], frame: Frame<'_>) -> Vec<Vec<Proposed>> {
        let mut plans = Vec::new();
        let mut tries = MAX_TRIES;
        for want in self.first_refuted(needs, frame) {
            for (call, want) in self.makers(want) {
                let mark = self.facts.mark();
                let mut calls = Vec::new();
                let is_found = self.perform(&call, want, MAX_DEPTH, &mut tries, &mut calls)
                    && self.satisfy(needs, frame, MAX_DEPTH, &mut tries, &mut calls);
                self.back_to(mark);
                if is_found && !plans.contains(&calls) {
                    plans.push(calls);
                }
            }
        }
        plans.sort_by_key(Vec::len);
        plans.truncate(MAX_PROPOSALS);
        plans
    }

    /// Extends `calls`, and the facts with them, until no need is refuted.
    fn satisfy(
        &mut self,
        needs: &[NeedDef],
        frame: Frame<'_>,
        depth: usize,
        tries: &mut usize,
        calls: &mut Vec<Proposed>,
    ) -> bool {
        loop {
            let wants = self.first_refuted(needs, frame);
            if wants.is_empty() {
                // Either all is well, or what is refuted is no fact that a step could change.
                return needs.iter().all(|need| !self.need(need, frame).0.no.is_some());
            }
            if depth == 0 || calls.len() >= MAX_CALLS {
                return false;
            }
            let before = calls.len();
            let is_found = wants.into_iter().any(|want| {
                self.makers(want).into_iter().any(|(call, want)| {
                    let mark = self.facts.mark();
                    let is_found = self.perform(&call, want, depth - 1, tries, calls);
                    if !is_found {
                        self.back_to(mark);
                        calls.truncate(before);
                    }
                    is_found
                })
            });
            if !is_found {
                return false;
            }
        }
    }

    /// Brings about what a call needs, and does it. `false`, with facts and calls to be taken back, where that fails.
    fn perform(
        &mut self,
        call: &Proposed,
        want: Want,
        depth: usize,
        tries: &mut usize,
        calls: &mut Vec<Proposed>,
    ) -> bool {
        let library = self.library;
        let Some(def) = library.primitive(call.primitive) else { return false };
        let Some(left) = tries.checked_sub(1) else { return false };
        *tries = left;
        let frame = Frame { args: &call.args, ..Frame::default() };
        if calls.contains(call)
            || !self.satisfy(&def.needs, frame, depth, tries, calls)
            || calls.len() >= MAX_CALLS
        {
            return false;
        }
        let (mut makes, mut unsettles): (Vec<Change>, Vec<Change>) = Default::default();
        self.changes(&def.makes, frame, &mut makes);
        self.changes(&def.unsettles, frame, &mut unsettles);
        self.unsettle(&unsettles, Cause::NOTHING);
        self.make(&makes, Cause::NOTHING);
        calls.push(call.clone());
        let (fluent, key, truth) = want;
        let holds = if key.is_pattern() { None } else { Some(self.read(fluent, key)) };
        holds.is_none_or(|value| if truth { value.is_true() } else { value.is_false() })
    }

    /// The facts each of which would be a first step towards the first need that is refuted.
    fn first_refuted(&self, needs: &[NeedDef], frame: Frame<'_>) -> Vec<Want> {
        let mut wants = Vec::new();
        for need in needs {
            let (value, each) = self.need(need, frame);
            if value.no.is_some() {
                self.wants(&need.condition, true, Frame { each, ..frame }, &mut wants);
                break;
            }
        }
        wants
    }

    fn wants(&self, condition: &Condition, truth: bool, frame: Frame<'_>, wants: &mut Vec<Want>) {
        let value = self.evaluate(condition, frame);
        if !(if truth { value.no } else { value.yes }).is_some() {
            return;
        }
        match condition {
            Condition::Not(inner) => self.wants(inner, !truth, frame, wants),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                // Of a disjunction any part will do, of a conjunction each in its turn.
                let is_choice = matches!(condition, Condition::AnyOf(_)) == truth;
                for part in parts {
                    if is_choice || wants.is_empty() {
                        self.wants(part, truth, frame, wants);
                    }
                }
            }
            Condition::Fact(fact) => {
                let Some(key) = self.key(fact, frame) else { return };
                if truth || !key.is_pattern() {
                    wants.push((fact.fluent, key, truth));
                    return;
                }
                // That none holds: each that may hold has to go.
                let mut held: Vec<_> =
                    self.facts.entries(fact.fluent, key).filter(|(_, value)| value.yes.is_some()).collect();
                held.sort_unstable_by_key(|(key, _)| *key);
                wants.extend(held.into_iter().map(|(key, _)| (fact.fluent, key, false)));
            }
            Condition::Literal(_)
            | Condition::Compare(..)
            | Condition::MonitoredMeasure(_)
            | Condition::MonitoredFluent(_)
            | Condition::Unknown => {}
        }
    }

    /// Calls that make a fact, in the order of the library.
    fn makers(&self, want: Want) -> Vec<(Proposed, Want)> {
        let mut found = Vec::new();
        for (index, def) in self.library.primitives.iter().enumerate() {
            let Some(primitive) = u16::try_from(index).ok().map(Primitive).filter(|_| def.provided) else {
                continue;
            };
            for effect in
                def.makes.iter().filter(|effect| effect.fact.fluent == want.0 && effect.value == want.2)
            {
                let Some(args) = self.unify(def, effect, want.1) else { continue };
                for args in self.fill(def, args) {
                    let call = Proposed { primitive, args };
                    if !found.iter().any(|(other, _)| *other == call) && self.applies(effect, &call, want.1) {
                        found.push((call, want));
                    }
                }
            }
        }
        found
    }

    /// The arguments for which an effect is about a fact; those that it leaves open are none.
    fn unify(&self, def: &PrimitiveDef, effect: &EffectDef, key: Key) -> Option<Vec<Option<Term>>> {
        let mut args: Vec<Option<Term>> = vec![None; def.params.len()];
        let mut each = None;
        for (index, term) in effect.fact.args.iter().enumerate() {
            let value = key.arg(index);
            match term {
                None => {}
                Some(_) if value == ANY => {}
                Some(Term::Param(at)) => self.bind_arg(def, &mut args, *at, value)?,
                Some(Term::Each) => each = Some(value),
                Some(term) if self.argument(term, Frame::default()) == Some(value) => {}
                Some(_) => return None,
            }
        }
        if let (Some(value), Some(Condition::Compare(CompareOp::Equal, left, right))) = (each, &effect.when) {
            match (left, right) {
                (Term::Each, Term::Param(at)) | (Term::Param(at), Term::Each) => {
                    self.bind_arg(def, &mut args, *at, value)?;
                }
                _ => {}
            }
        }
        Some(args)
    }

    fn bind_arg(&self, def: &PrimitiveDef, args: &mut [Option<Term>], at: u16, value: u16) -> Option<()> {
        let term = match def.params.get(usize::from(at))?.ty {
            Ty { base: Base::Enum(id), lists: 0 } => Term::Case(id, value),
            ty => {
                let kind = self.symbols.kind(self.world, Entity(value))?;
                self.library.fits(ty, Ty::plain(Base::Entity(kind))).then_some(Term::Entity(Entity(value)))?
            }
        };
        let slot = args.get_mut(usize::from(at))?;
        match slot {
            Some(other) if *other != term => None,
            _ => {
                *slot = Some(term);
                Some(())
            }
        }
    }

    /// Whether the effect is about the fact at this call, in the state as it is.
    fn applies(&self, effect: &EffectDef, call: &Proposed, key: Key) -> bool {
        let place = effect.fact.args.iter().position(|arg| *arg == Some(Term::Each));
        let each = place.map(|index| Entity(key.arg(index)));
        let is_of_kind = match (effect.each, each) {
            (Some(kind), Some(each)) => {
                self.symbols.kind(self.world, each).is_some_and(|other| self.library.is_kind(other, kind))
            }
            _ => true,
        };
        let frame = Frame { args: &call.args, result: None, each };
        is_of_kind && effect.when.as_ref().is_none_or(|when| self.evaluate(when, frame).is_true())
    }

    /// What the open arguments may be: what the primitive's own needs say of them in the state as it is.
    fn fill(&self, def: &PrimitiveDef, args: Vec<Option<Term>>) -> Vec<Vec<Term>> {
        let mut all = vec![args];
        for (index, param) in def.params.iter().enumerate() {
            let mut next = Vec::new();
            for args in all {
                if args.get(index).is_some_and(Option::is_some) {
                    next.push(args);
                    continue;
                }
                let choices = match (&param.default, param.ty.kind()) {
                    (Some(default), _) => vec![default.clone()],
                    (None, Some(_)) => self.choices(def, index, &args),
                    (None, None) => Vec::new(),
                };
                for choice in choices {
                    let mut args = args.clone();
                    if let Some(slot) = args.get_mut(index) {
                        *slot = Some(choice);
                    }
                    next.push(args);
                }
            }
            all = next;
        }
        all.into_iter().filter_map(|args| args.into_iter().collect()).collect()
    }

    /// Entities that may stand for a parameter: those for which a need of the primitive is known to hold; else any few.
    fn choices(&self, def: &PrimitiveDef, index: usize, args: &[Option<Term>]) -> Vec<Term> {
        let Some(param) = def.params.get(index) else { return Vec::new() };
        let Some(kind) = param.ty.kind() else { return Vec::new() };
        let mut found = Vec::new();
        for need in def.needs.iter().filter(|need| need.each.is_none()) {
            let Condition::Fact(fact) = &need.condition else { continue };
            let is_it =
                |term: &Option<Term>| matches!(term, Some(Term::Param(at)) if usize::from(*at) == index);
            let Some(place) = fact.args.iter().position(is_it) else { continue };
            let pattern = fact.args.iter().enumerate().try_fold(Key(0), |key, (at, term)| {
                let value = match term {
                    _ if at == place => ANY,
                    None => ANY,
                    Some(Term::Param(other)) => match args.get(usize::from(*other)) {
                        Some(Some(term)) => self.argument(term, Frame::default())?,
                        _ => ANY,
                    },
                    Some(term) => self.argument(term, Frame::default())?,
                };
                Some(key.with(at, value))
            });
            let Some(pattern) = pattern else { continue };
            let entries = self.facts.entries(fact.fluent, pattern).filter(|(_, value)| value.is_true());
            found.extend(entries.map(|(key, _)| Entity(key.arg(place))));
        }
        found.sort_unstable();
        found.dedup();
        found.retain(|entity| {
            let other = self.symbols.kind(self.world, *entity);
            other.is_some_and(|other| self.library.is_kind(other, kind))
        });
        if found.is_empty() {
            found = self.of_kind(kind, MAX_PROPOSALS);
        }
        // Furniture is a better place to put something than a thing or a person.
        let rank = |entity: &Entity| {
            let kind = self.symbols.kind(self.world, *entity);
            let is =
                |name| kind.is_some_and(|kind| self.library.is_kind(kind, self.library.kind_named(name)));
            if is("Surface") { 0 } else { 1 + usize::from(!is("Container")) }
        };
        found.sort_by_key(rank);
        found.truncate(MAX_PROPOSALS);
        found.into_iter().map(Term::Entity).collect()
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
