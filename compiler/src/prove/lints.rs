//! Lints of intent: warnings about policies that are legal but probably not meant. They rest on the facts of
//! the prover. Guarded by `tests/spec/intent.md`.

use motet_syntax::ast::PrimitiveKind;
use motet_syntax::{Diagnostic, Span};

use super::assume::mentions;
use super::diagnostics::{
    EndsHolding, HidesUnsafe, HopelessRetry, LeftOpen, ReactionBreaks, Redundant, Unwatched,
};
use super::effects::FactChange;
use super::evaluation::CallFrame;
use super::{Mode, NeedVerdict, PolicyEnd, Problem, Prover};
use crate::declare::{NeedDef, PrimitiveDef};
use crate::facts::{Cause, FactKey, TruthSet, show};
use crate::ir::{
    Base, Call, Catch, Condition, Entity, Fact, Failure, Fluent, MotionKind, StepId, StepKind, Term,
};

impl Prover<'_> {
    /// Returns whether a step belongs to the document itself, and not to a policy of another file.
    fn is_own(&self, span: Span) -> bool {
        span.file == self.program.span.file
    }

    /// Warns about things in the hand and open containers where the policy is done.
    pub(crate) fn check_end(&mut self, end: Option<PolicyEnd>, span: Span) {
        if self.mode == Mode::Decide {
            return;
        }
        let known = &self.library.lang_items;
        let ends = |fluent: Option<Fluent>, of_a_step: bool| {
            let fluent = fluent?;
            let meant = self.program.achieves.as_ref().is_some_and(|(goal, _)| mentions(goal, fluent));
            if meant {
                return None;
            }
            let mut found: Option<(FactKey, Cause)> = None;
            self.state.facts.entries(fluent, FactKey::ALL, |key, value| {
                let counts = value.yes.is_some() && (!of_a_step || value.yes.as_step().is_some());
                let counts = counts && !self.is_undone_in_error(fluent, key);
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
        if let Some((subgoal, object, since)) = holding {
            let mistake: Diagnostic = EndsHolding { span, object, since }.into();
            self.notify_ending(subgoal, end, &mistake);
            self.tell_once(mistake);
        }
        if let Some((subgoal, container, since)) = open {
            let mistake: Diagnostic = LeftOpen { span, container, since }.into();
            self.notify_ending(subgoal, end, &mistake);
            self.tell_once(mistake);
        }
    }

    /// Returns true if a step that would make a fact false is refused: then that is all there is to say.
    fn is_undone_in_error(&self, fluent: Fluent, key: FactKey) -> bool {
        let mut steps = self.program.steps.iter().zip(&self.proof.needs);
        steps.any(|(step, verdicts)| {
            let StepKind::Call(call) = &step.kind else { return false };
            let Some(def) = self.library.primitive(call.primitive) else { return false };
            let frame = CallFrame { args: &call.args, ..CallFrame::default() };
            verdicts.contains(&NeedVerdict::Refuted)
                && def.makes.iter().any(|effect| {
                    let thing = effect.fact.args.first().and_then(Option::as_ref);
                    effect.fact.fluent == fluent
                        && !effect.value
                        && thing.and_then(|thing| self.argument(thing, frame)) == Some(key.arg(0))
                })
        })
    }

    fn notify_ending(&mut self, fact: (Fluent, FactKey, bool), end: Option<PolicyEnd>, mistake: &Diagnostic) {
        if let Some(end) = end.filter(|_| self.control.live) {
            self.notify(Problem::UnintendedFact { fact, end }, mistake);
        }
    }

    /// Warns about a base that moves to a person while no monitor watches the distance.
    pub(crate) fn check_watched(&mut self, def: &PrimitiveDef, frame: CallFrame<'_>, span: Span) {
        let Some((query, args)) = def.motion.as_ref().filter(|_| self.is_own(span)) else { return };
        let measure = self.library.lang_items.distance.and_then(|id| self.library.measure(id));
        if *query != MotionKind::GoTo || !measure.is_some_and(|def| def.observable) {
            return;
        }
        let target = args.first().and_then(|arg| self.argument(arg, frame)).map(Entity);
        let Some(target) = target.filter(|target| self.is_person(*target)) else { return };
        if !self.state.watched.iter().any(|watched| watched.near.contains(&target)) {
            let person = self.entity_name(target);
            self.diagnostics.push(Unwatched { span, callee: def.name.clone(), person }.into());
        }
    }

    /// Warns about an action whose effects all hold already. An action with a number or a text among its
    /// arguments may do more than its contract says.
    pub(crate) fn check_redundant(
        &mut self,
        def: &PrimitiveDef,
        makes: &[FactChange],
        frame: CallFrame<'_>,
        verdicts: &[NeedVerdict],
        span: Span,
    ) {
        let plain = |base: Base| matches!(base, Base::Entity(_) | Base::Enum(_));
        let says_all = def.form == PrimitiveKind::Action
            && def.params.iter().all(|param| plain(param.ty.base))
            && !verdicts.contains(&NeedVerdict::Refuted);
        if !says_all || !self.is_own(span) || self.may_have_changed(frame) {
            return;
        }
        let Some(first) = makes.iter().find(|change| change.truth) else { return };
        if !makes.iter().all(|change| self.holds_already(change, makes)) {
            return;
        }
        let cause = self.state.facts.get(first.fluent, first.key).yes;
        let Some(known) = self.library.fluent(first.fluent) else { return };
        let name = |index, arg| self.argument_name(first.fluent, index, arg);
        let fact = show(&known.name, first.key, known.params.len(), name);
        let since = self.cause_span(cause);
        let mistake: Diagnostic = Redundant { span, callee: def.name.clone(), fact, since }.into();
        self.notify(Problem::RedundantStep, &mistake);
        self.diagnostics.push(mistake);
    }

    /// Returns whether the world may have changed without the robot: people walk, and reactions have a cause
    /// outside.
    fn may_have_changed(&self, frame: CallFrame<'_>) -> bool {
        let mut args = frame.args.iter();
        self.control.here.is_some_and(|id| self.is_in_reaction(id))
            || args.any(|arg| {
                matches!(arg, Term::Entity(_) | Term::Binding(_))
                    && self.argument(arg, frame).is_some_and(|arg| self.is_person(Entity(arg)))
            })
    }

    fn is_person(&self, entity: Entity) -> bool {
        self.library.lang_items.person.is_some_and(|person| self.is_of_kind(entity, person))
    }

    fn holds_already(&self, change: &FactChange, makes: &[FactChange]) -> bool {
        let made = |key: FactKey| {
            makes.iter().any(|other| other.truth && other.fluent == change.fluent && other.key.covers(key))
        };
        let is = |value: TruthSet| if change.truth { value.is_true() } else { value.is_false() };
        let mut holds = change.is_sure()
            && (is(self.state.facts.get(change.fluent, change.key)) || (!change.truth && made(change.key)));
        if holds && change.key.is_pattern() {
            self.state.facts.entries(change.fluent, change.key, |key, value| {
                holds &= is(value) || (!change.truth && made(key));
            });
        }
        holds
    }

    /// Warns about a retry that cannot succeed, because the first attempt destroys a need for good.
    pub(crate) fn check_retry(&mut self, id: StepId, call: &Call, def: &PrimitiveDef, frame: CallFrame<'_>) {
        let span = self.program.step(id).map_or(self.program.span, |step| step.span);
        let stale = call.args.iter().find_map(|arg| match arg {
            Term::Binding(id) if self.is_stale(*id) => self.program.bindings.get(id.index()),
            _ => None,
        });
        if let Some(binding) = stale {
            let why = format!(
                "`{}` is stale by then, since it was perceived before the first attempt",
                binding.name
            );
            return self.diagnostics.push(HopelessRetry { span, callee: def.name.clone(), why }.into());
        }
        let lost = def.needs.iter().find(|need| self.is_lost(need, frame));
        if let Some(need) = lost {
            let needs = self.show(&need.condition, true, frame);
            let why =
                format!("it needs {needs}, which the first attempt undoes and the robot cannot observe");
            self.diagnostics.push(HopelessRetry { span, callee: def.name.clone(), why }.into());
        }
    }

    /// Returns whether a need cannot be observed to hold: it is false, or depends on a fact that the robot
    /// cannot observe.
    fn is_lost(&self, need: &NeedDef, frame: CallFrame<'_>) -> bool {
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

    /// Warns about a `catch any` that catches `unsafe` and continues.
    pub(crate) fn check_catch(&mut self, catch: &Catch, kinds: &[Failure]) {
        let hidden = self.library.lang_items.harm;
        let hides = catch.on.is_none() && hidden.is_some_and(|kind| kinds.contains(&kind));
        if hides && self.control.live && self.is_own(catch.span) {
            self.diagnostics.push(HidesUnsafe { span: catch.span }.into());
        }
    }

    /// Warns about a need that a monitor's reaction may destroy.
    pub(crate) fn check_reactions(
        &mut self,
        def: &PrimitiveDef,
        need: &NeedDef,
        value: TruthSet,
        frame: CallFrame<'_>,
        span: Span,
    ) {
        let spoken = |fluent: Fluent| mentions(&need.condition, fluent);
        let mut rows = self.state.volatile.iter();
        let Some((row, when)) = rows.find_map(|row| {
            let is_it = spoken(row.fluent) && row.value.open == value.open;
            Some((row, row.when.filter(|_| is_it)?))
        }) else {
            return;
        };
        let needs = self.show(&need.condition, true, frame);
        let maker = self.cause_name(row.value.open);
        self.tell_once(
            ReactionBreaks { span: when, callee: def.name.clone(), needs, maker, step: span }.into(),
        );
    }
}
