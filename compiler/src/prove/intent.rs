//! Lints of intent: what is allowed and yet hardly meant. All are warnings; what they rest on is what the prover knows.

use motet_syntax::ast::PrimitiveKind;
use motet_syntax::{Diagnostic, Span};

use super::apply::Change;
use super::assume::mentions;
use super::errors::{
    EndsHolding, HidesUnsafe, HopelessRetry, LeftOpen, ReactionBreaks, Redundant, Unwatched,
};
use super::eval::Frame;
use super::facts::{Key, show};
use super::mend::End;
use super::value::{Cause, Value};
use super::{Mood, Prover, Verdict};
use crate::ir::{Base, Call, Catch, Condition, Entity, Fact, Failure, Fluent, Slot, Step, StepId, Term};
use crate::library::{NeedDef, PrimitiveDef};

impl Prover<'_> {
    /// Whether a step stands in the document itself, and not in a policy that it calls from elsewhere.
    fn is_own(&self, span: Span) -> bool {
        span.file == self.program.span.file
    }

    /// Where the policy is done: what it still holds, and what it opened and did not close.
    pub(crate) fn check_end(&mut self, end: Option<End>, span: Span) {
        if self.mood == Mood::Judge {
            return;
        }
        let known = &self.library.known;
        let ends = |fluent: Option<Fluent>, of_a_step: bool| {
            let fluent = fluent?;
            let meant = self.program.achieves.as_ref().is_some_and(|(goal, _)| mentions(goal, fluent));
            if meant {
                return None;
            }
            let mut found: Option<(Key, Cause)> = None;
            self.facts.entries(fluent, Key::ALL, |key, value| {
                let counts = value.yes.is_some() && (!of_a_step || value.yes.as_step().is_some());
                if counts && found.is_none_or(|(least, _)| key < least) {
                    found = Some((key, value.yes));
                }
            });
            found.map(|(key, cause)| {
                let name = self.argument_name(fluent, 0, key.arg(0));
                ((fluent, key, false), name, self.cause_span(cause))
            })
        };
        let (holding, open) = (ends(known.holding, false), ends(known.open, true));
        if let Some((want, object, since)) = holding {
            let mistake: Diagnostic = EndsHolding { span, object, since }.into();
            self.offer_ended(want, end, &mistake);
            self.warn(mistake);
        }
        if let Some((want, container, since)) = open {
            let mistake: Diagnostic = LeftOpen { span, container, since }.into();
            self.offer_ended(want, end, &mistake);
            self.warn(mistake);
        }
    }

    /// Says something, once.
    fn warn(&mut self, mistake: Diagnostic) {
        if !self.diagnostics.contains(&mistake) {
            self.diagnostics.push(mistake);
        }
    }

    /// A base that moves to a person, with nothing that watches how near it comes.
    pub(crate) fn check_watched(&mut self, def: &PrimitiveDef, frame: Frame<'_>, span: Span) {
        let Some((query, args)) = def.motion.as_ref().filter(|_| self.is_own(span)) else { return };
        let measure = self.library.known.distance.and_then(|id| self.library.measure(id));
        if query != "go_to" || !measure.is_some_and(|def| def.observable) {
            return;
        }
        let target = args.first().and_then(|arg| self.argument(arg, frame)).map(Entity);
        let Some(target) = target.filter(|target| self.is_person(*target)) else { return };
        if !self.watched.iter().any(|watched| watched.near.contains(&target)) {
            let person = self.entity_name(target);
            self.diagnostics.push(Unwatched { span, callee: def.name.clone(), person }.into());
        }
    }

    /// An action all of whose effects hold already. One with a number or a text among its arguments may do more than its
    /// contract says.
    pub(crate) fn check_redundant(
        &mut self,
        def: &PrimitiveDef,
        makes: &[Change],
        frame: Frame<'_>,
        verdicts: &[Verdict],
        span: Span,
    ) {
        let plain = |base: Base| matches!(base, Base::Entity(_) | Base::Enum(_));
        let says_all = def.form == PrimitiveKind::Action
            && def.params.iter().all(|param| plain(param.ty.base))
            && !verdicts.contains(&Verdict::Refuted);
        if !says_all || !self.is_own(span) || self.may_have_changed(frame) {
            return;
        }
        let Some(first) = makes.iter().find(|change| change.truth) else { return };
        if !makes.iter().all(|change| self.holds_already(change, makes)) {
            return;
        }
        let cause = self.facts.get(first.fluent, first.key).yes;
        let Some(known) = self.library.fluent(first.fluent) else { return };
        let name = |index, arg| self.argument_name(first.fluent, index, arg);
        let fact = show(&known.name, first.key, known.params.len(), name);
        let since = self.cause_span(cause);
        let mistake: Diagnostic = Redundant { span, callee: def.name.clone(), fact, since }.into();
        self.offer_leaving_out(&mistake);
        self.diagnostics.push(mistake);
    }

    /// Whether the world may have moved on without the robot: people walk, and a monitor's reaction runs because of it.
    fn may_have_changed(&self, frame: Frame<'_>) -> bool {
        let in_reaction = |step: &Step| matches!(step.place.slot, Slot::Reaction(_));
        let here = self.here.and_then(|id| self.program.step(id));
        let mut around = self.here.into_iter().flat_map(|id| self.program.around(id));
        let mut args = frame.args.iter();
        here.is_some_and(in_reaction)
            || around.any(|(_, step)| in_reaction(step))
            || args.any(|arg| {
                matches!(arg, Term::Entity(_) | Term::Binding(_))
                    && self.argument(arg, frame).is_some_and(|arg| self.is_person(Entity(arg)))
            })
    }

    fn is_person(&self, entity: Entity) -> bool {
        self.library.known.person.is_some_and(|person| self.is_of_kind(entity, person))
    }

    fn holds_already(&self, change: &Change, makes: &[Change]) -> bool {
        let made = |key: Key| {
            makes.iter().any(|other| other.truth && other.fluent == change.fluent && other.key.covers(key))
        };
        let is = |value: Value| if change.truth { value.is_true() } else { value.is_false() };
        let mut holds = change.is_sure()
            && (is(self.facts.get(change.fluent, change.key)) || (!change.truth && made(change.key)));
        if holds && change.key.is_pattern() {
            self.facts.entries(change.fluent, change.key, |key, value| {
                holds &= is(value) || (!change.truth && made(key));
            });
        }
        holds
    }

    /// A retry that cannot go better: what the step needs is gone for good once it was tried.
    pub(crate) fn check_retry(&mut self, id: StepId, call: &Call, def: &PrimitiveDef, frame: Frame<'_>) {
        let span = self.program.step(id).map_or(self.program.span, |step| step.span);
        let stale = call.args.iter().find_map(|arg| match arg {
            Term::Binding(id) if self.is_stale(*id) => self.program.bindings.get(id.index()),
            _ => None,
        });
        if let Some(binding) = stale {
            let why = format!("`{}` is stale by then: it was perceived before the first try", binding.name);
            return self.diagnostics.push(HopelessRetry { span, callee: def.name.clone(), why }.into());
        }
        let lost = def.needs.iter().find(|need| self.is_lost(need, frame));
        if let Some(need) = lost {
            let needs = self.show(&need.condition, true, frame);
            let why = format!("it needs {needs}, which is lost by then and which nothing here can observe");
            self.diagnostics.push(HopelessRetry { span, callee: def.name.clone(), why }.into());
        }
    }

    /// Whether a need cannot be seen to hold: it is false, or rests on what the robot does not observe.
    fn is_lost(&self, need: &NeedDef, frame: Frame<'_>) -> bool {
        if need.each.is_some() || need.when.is_some() {
            return false;
        }
        let value = self.evaluate(&need.condition, frame);
        let unseen = |fact: &Fact| {
            let Some(def) = self.library.fluent(fact.fluent) else { return false };
            !def.observable && !def.derived
        };
        match &need.condition {
            Condition::Fact(fact) => value.is_false() || (!value.yes.is_some() && unseen(fact)),
            _ => value.is_false(),
        }
    }

    /// A `catch any` that takes `unsafe` and goes on.
    pub(crate) fn check_catch(&mut self, catch: &Catch, kinds: &[Failure]) {
        let hidden = self.library.known.harm;
        let hides = catch.on.is_none() && hidden.is_some_and(|kind| kinds.contains(&kind));
        if hides && self.live && self.is_own(catch.span) {
            self.diagnostics.push(HidesUnsafe { span: catch.span }.into());
        }
    }

    /// A need that is unobserved because of what a monitor's reaction does meanwhile.
    pub(crate) fn check_reactions(
        &mut self,
        def: &PrimitiveDef,
        need: &NeedDef,
        value: Value,
        frame: Frame<'_>,
        span: Span,
    ) {
        let spoken = |fluent: Fluent| mentions(&need.condition, fluent);
        let mut rows = self.volatile.iter();
        let Some(row) = rows.find(|row| spoken(row.fluent) && row.value.open == value.open) else { return };
        let needs = self.show(&need.condition, true, frame);
        let (when, maker) = (row.when, self.cause_name(row.value.open));
        self.warn(ReactionBreaks { span: when, callee: def.name.clone(), needs, maker, step: span }.into());
    }
}
