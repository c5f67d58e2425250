//! Explanations of refutations: the fact, the step that made it false, and calls that would make it true.

use motet_syntax::ast::CompareOp;
use motet_syntax::{Diagnostic, Mistake, Span};
use smol_str::{SmolStr, format_smolstr};

use super::diagnostics::GoalRefuted;
use super::evaluation::CallFrame;
use super::{GoalVerdict, Mode, PolicyEnd, Problem, Prover};
use crate::declare::NeedDef;
use crate::facts::{Cause, show};
use crate::ir::{Base, BlockSlot, Condition, Entity, Fact, Fluent, StepId, StepKind, Term};

/// Explanation of a condition that can be false.
#[derive(Clone, Debug, Default)]
pub(crate) struct Explanation {
    /// The condition: "`free(hand)`", "`not open(drawer_1)`".
    pub(crate) wanted: String,
    /// Cause of the opposite.
    pub(crate) cause: Cause,
    /// Fluent with the value that it should have.
    pub(crate) fact: Option<(Fluent, bool)>,
    /// Name of the fluent, measure or field in question, with the value that it should have.
    pub(crate) subject: Option<(SmolStr, bool)>,
    /// Text in place of a cause: "`kettle` has 2.1 kg".
    numbers: Option<String>,
    /// Phrase for the cause: "`place(mug, table)` made".
    maker: Option<String>,
    /// Path from the cause: " where `open(drawer)` holds".
    path: String,
    /// Advice, if no earlier step could help.
    advice: Option<SmolStr>,
}

impl Explanation {
    /// End of the sentence "… needs X, ".
    pub(crate) fn story(&self) -> String {
        if let Some(numbers) = &self.numbers {
            return numbers.clone();
        }
        match (&self.maker, self.cause) {
            (Some(maker), _) => format!("which {maker} false{}", self.path),
            (None, Cause::NONE | Cause::NOTHING) => "which no step makes true".to_owned(),
            (None, _) if !self.path.is_empty() => format!("which does not hold{}", self.path),
            (None, _) => "which does not hold at the start".to_owned(),
        }
    }
}

impl Prover<'_> {
    /// Explains why `condition` can fail to be `truth`.
    pub(crate) fn explain(&self, condition: &Condition, truth: bool, frame: CallFrame<'_>) -> Explanation {
        let fails = |part: &&Condition| {
            let value = self.evaluate(part, frame);
            if truth { value.no.is_some() } else { value.yes.is_some() }
        };
        match condition {
            Condition::Not(inner) => return self.explain(inner, !truth, frame),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                let joined = matches!(condition, Condition::AnyOf(_)) == truth && parts.len() > 1;
                if let Some(part) = parts.iter().find(fails) {
                    let mut explanation = self.explain(part, truth, frame);
                    if joined {
                        explanation.wanted = self.show(condition, truth, frame);
                    }
                    return explanation;
                }
            }
            Condition::Fact(fact) => {
                let value = self.evaluate(condition, frame);
                let cause = if truth { value.no } else { value.yes };
                let maker = cause.as_step().map(|_| self.maker(cause));
                let wanted = self.show(condition, truth, frame);
                let subject = self.library.fluent(fact.fluent).map(|def| (def.name.clone(), truth));
                let path = self.cleanup_path(cause, fact.fluent, truth).unwrap_or_else(|| self.path(cause));
                let fact = Some((fact.fluent, truth));
                return Explanation { wanted, cause, fact, subject, maker, path, ..Explanation::default() };
            }
            Condition::Compare(CompareOp::Unequal, left, _)
                if truth && self.is_misgiven(condition, frame) =>
            {
                let wanted = format!("something other than `{}`", self.term_text(left, frame));
                let numbers = Some("but it is given exactly that".to_owned());
                let advice = Some(SmolStr::new_static("name another entity, or remove this step"));
                return Explanation {
                    wanted,
                    cause: Cause::START,
                    numbers,
                    advice,
                    ..Explanation::default()
                };
            }
            Condition::Compare(_, left, right) => {
                let numbers = self.numbers(left, right, frame);
                let wanted = self.show(condition, truth, frame);
                let subject = self.measured(left).or_else(|| self.measured(right)).map(|name| (name, truth));
                let numbers = Some(numbers);
                return Explanation {
                    wanted,
                    cause: Cause::START,
                    subject,
                    numbers,
                    ..Explanation::default()
                };
            }
            Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) => {
                let wanted = self.show(condition, truth, frame);
                let numbers = Some("but no `monitor` around it does".to_owned());
                let subject = Some((SmolStr::new_static("monitored"), truth));
                return Explanation { wanted, subject, numbers, ..Explanation::default() };
            }
            Condition::Literal(_) | Condition::Unknown => {}
        }
        let wanted = self.show(condition, truth, frame);
        Explanation { wanted, ..Explanation::default() }
    }

    /// Returns whether a condition excludes the very argument that it is given: no earlier step could help.
    pub(crate) fn is_misgiven(&self, condition: &Condition, frame: CallFrame<'_>) -> bool {
        let Condition::Compare(CompareOp::Unequal, left, right) = condition else { return false };
        let entity = |term| self.argument(term, frame);
        entity(left).is_some_and(|one| entity(right) == Some(one))
    }

    /// Name of the field or measure behind a number.
    fn measured(&self, term: &Term) -> Option<SmolStr> {
        match term {
            Term::Field(_, name) => Some(name.clone()),
            Term::Measure(id, _) => self.library.measure(*id).map(|def| def.name.clone()),
            Term::Arith(_, left, right) => self.measured(left).or_else(|| self.measured(right)),
            _ => None,
        }
    }

    /// Phrase for a cause: an action made the fact false, or a test found it so.
    fn maker(&self, cause: Cause) -> String {
        let step = cause.as_step().and_then(|id| self.program.step(id));
        match step.map(|step| &step.kind) {
            Some(StepKind::If { condition, .. }) => {
                format!("`if {}` found", self.text(condition, CallFrame::default()))
            }
            Some(StepKind::Wait { .. } | StepKind::Repeat { until: Some(_), .. }) => {
                format!("`{}` found", self.cause_name(cause))
            }
            _ => format!("`{}` made", self.cause_name(cause)),
        }
    }

    /// Describes the path from a cause to the present step, if there are others.
    fn path(&self, cause: Cause) -> String {
        let Some(maker) = cause.as_step() else { return String::new() };
        if self.control.here.is_some_and(|here| maker >= here) {
            return " in an earlier round".to_owned();
        }
        let around = |id: StepId| self.program.around(id).map(|(id, _)| id);
        let shared: Vec<StepId> = self.control.here.into_iter().flat_map(around).collect();
        let mut slot = self.program.step(maker).map(|step| step.position.slot);
        for (outer, fork) in self.program.around(maker) {
            // A step beside the one being proved, in another block of the same fork, is on another path too.
            let apart = !shared.contains(&outer);
            match (&fork.kind, slot) {
                (StepKind::If { condition, .. }, Some(BlockSlot::Then)) if apart => {
                    return format!(" where {} holds", self.show(condition, true, CallFrame::default()));
                }
                (StepKind::If { condition, .. }, Some(BlockSlot::Else)) if apart => {
                    return format!(
                        " where {} does not hold",
                        self.show(condition, true, CallFrame::default())
                    );
                }
                (_, Some(BlockSlot::Catch(_))) if apart => return " after a failure".to_owned(),
                (_, Some(BlockSlot::Reaction(_))) => return " when its monitor fires".to_owned(),
                _ => slot = Some(fork.position.slot),
            }
        }
        String::new()
    }

    /// Describes the path on which the cleanup around a cause, which would undo it, fails; `None` without
    /// such a cleanup.
    fn cleanup_path(&self, cause: Cause, fluent: Fluent, truth: bool) -> Option<String> {
        let maker = cause.as_step().filter(|maker| self.control.here.is_none_or(|here| *maker < here))?;
        let around = |id: StepId| self.program.around(id).map(|(id, _)| id);
        let shared: Vec<StepId> = self.control.here.into_iter().flat_map(around).collect();
        let mut slot = self.program.step(maker)?.position.slot;
        let (whole, _) = self.program.around(maker).find(|(id, outer)| {
            let inside = std::mem::replace(&mut slot, outer.position.slot);
            matches!(outer.kind, StepKind::Finally { .. })
                && inside != BlockSlot::Finally
                && !shared.contains(id)
        })?;
        let achieves = |id: StepId| match self.program.step(id).map(|step| &step.kind) {
            Some(StepKind::Call(call)) => self.library.primitive(call.primitive).is_some_and(|def| {
                def.makes.iter().any(|effect| effect.fact.fluent == fluent && effect.value == truth)
            }),
            _ => false,
        };
        let is_in_cleanup = |id: StepId| {
            let mut slot = self.program.step(id).map(|step| step.position.slot);
            let mut around = self.program.around(id);
            around.any(|(outer, step)| {
                slot.replace(step.position.slot) == Some(BlockSlot::Finally) && outer == whole
            })
        };
        let steps = (whole.0 + 1..).take(self.program.steps.len()).map(StepId);
        let mut steps = steps.take_while(|id| self.program.step(*id).is_some());
        let undoes = steps.find(|id| achieves(*id) && is_in_cleanup(*id))?;
        let is_sure = self.program.step(undoes)?.position.parent == Some(whole);
        let ending = if is_sure { "fails" } else { "does not run" };
        Some(format!(" where `{}` in the `finally` {ending}", self.cause_name(Cause::step(undoes))))
    }

    /// Explains a need of a step in a cleanup that holds on some of the paths there, and not on the one where
    /// the first step before the cleanup fails. `None` for any other need.
    pub(crate) fn explain_in_cleanup(
        &self,
        id: StepId,
        need: &NeedDef,
        frame: CallFrame<'_>,
    ) -> Option<Explanation> {
        let (value, _) = self.need(need, frame);
        let is_mixed = value.yes.is_some() || value.open.is_some();
        let mut explanation = self.explain(&need.condition, true, frame);
        // Where the robot has to stand it can drive, whatever happened.
        let items = &self.library.lang_items;
        let is_driven = |(fluent, _): (Fluent, bool)| [items.at, items.near].contains(&Some(fluent));
        if !is_mixed || explanation.fact.is_none_or(is_driven) || explanation.cause.as_step().is_some() {
            return None;
        }
        let mut slot = self.program.step(id)?.position.slot;
        let (whole, _) = self
            .program
            .around(id)
            .find(|(_, outer)| std::mem::replace(&mut slot, outer.position.slot) == BlockSlot::Finally)?;
        let steps = self.program.steps.iter().enumerate().skip(whole.index() + 1);
        let mut calls = steps.filter(|(_, step)| matches!(step.kind, StepKind::Call(_)));
        let first = calls.next().and_then(|(index, _)| u32::try_from(index).ok().map(StepId))?;
        if first >= id {
            return None;
        }
        let test = explanation.wanted.trim_matches('`');
        explanation.advice = Some(format_smolstr!("test it first: `if {test} {{ … }}`"));
        explanation.path = format!(" where `{}` fails", self.cause_name(Cause::step(first)));
        Some(explanation)
    }

    /// Advice: primitives that achieve the missing fact.
    pub(crate) fn remedy(&self, explanation: &Explanation) -> Option<String> {
        if let Some(advice) = &explanation.advice {
            return Some(advice.to_string());
        }
        let (fluent, truth) = explanation.fact?;
        let achievers = self.library.primitives.iter().filter(|def| def.provided);
        let achievers = achievers.filter(|def| {
            def.makes.iter().any(|effect| effect.fact.fluent == fluent && effect.value == truth)
                && !def.needs.iter().any(|need| asks_for(&need.condition, fluent, truth))
        });
        let names: Vec<_> = achievers.map(|def| format!("`{}`", def.name)).take(4).collect();
        match names.split_last() {
            None => None,
            Some((only, [])) => Some(format!("call {only} first")),
            Some((last, rest)) => Some(format!("call {} or {last} first", rest.join(", "))),
        }
    }

    /// Checks that the goal is not refuted where the policy is done.
    pub(crate) fn check_goal(&mut self, end: Option<PolicyEnd>) {
        let program = self.program;
        let Some((goal, span)) = &program.achieves else { return };
        let frame = CallFrame::default();
        let value = self.evaluate_on_paths(goal, frame);
        let verdict = self.proof.goal.get_or_insert(GoalVerdict { may_hold: false, is_proven: true });
        verdict.may_hold |= !value.is_false();
        verdict.is_proven &= value.is_true();
        if !value.no.is_some() {
            return;
        }
        if self.mode == Mode::Decide {
            return self.count(GoalRefuted::CODE);
        }
        self.control.here = None;
        let explanation = self.explain(goal, true, frame);
        let mistake = GoalRefuted {
            span: *span,
            wanted: explanation.wanted.clone(),
            story: explanation.story(),
            culprit: self.cause_span(explanation.cause),
            remedy: self.remedy(&explanation),
            subject: explanation.subject,
        };
        let mistake: Diagnostic = mistake.into();
        if let Some(end) = end.filter(|_| self.control.live) {
            self.notify(Problem::RefutedGoal { goal, end }, &mistake);
        }
        self.tell_once(mistake);
    }

    /// Span of the step behind a cause.
    pub(crate) fn cause_span(&self, cause: Cause) -> Option<Span> {
        Some(self.program.step(cause.as_step()?)?.span)
    }

    /// Short name of the step behind a cause.
    pub(crate) fn cause_name(&self, cause: Cause) -> SmolStr {
        let step = cause.as_step().and_then(|id| self.program.step(id));
        match step.map(|step| &step.kind) {
            Some(StepKind::Call(call)) => {
                let def = self.library.primitive(call.primitive);
                let name = def.map_or("a step", |def| def.name.as_str());
                let args =
                    def.into_iter().flat_map(|def| def.asked(&call.args)).filter_map(|arg| match arg {
                        Term::Entity(_) | Term::Binding(_) | Term::First(_) => {
                            Some(self.term_text(arg, CallFrame::default()))
                        }
                        _ => None,
                    });
                let args: Vec<_> = args.collect();
                // Its arguments are left out where they are texts, numbers, or wrong.
                if args.is_empty() && !call.args.is_empty() {
                    return name.into();
                }
                format_smolstr!("{name}({})", args.join(", "))
            }
            Some(StepKind::Let { .. }) => "let".into(),
            Some(StepKind::If { .. }) => "if".into(),
            Some(StepKind::Wait { .. }) => "wait".into(),
            Some(kind @ StepKind::Monitor { .. }) if kind.deadline().is_some() => "within".into(),
            Some(StepKind::Monitor { .. }) => "monitor".into(),
            Some(StepKind::Repeat { .. }) => "repeat".into(),
            Some(StepKind::Each { .. }) => "each".into(),
            Some(StepKind::Parallel { .. }) => "parallel".into(),
            Some(
                StepKind::Sequence { .. }
                | StepKind::Inline { .. }
                | StepKind::Try { .. }
                | StepKind::Delay { .. }
                | StepKind::Finally { .. }
                | StepKind::End { .. }
                | StepKind::Unknown,
            )
            | None => "a step".into(),
        }
    }

    /// Name of an argument of a fact.
    pub(crate) fn argument_name(&self, fluent: Fluent, index: usize, arg: u16) -> SmolStr {
        let ty = self.library.fluent(fluent).and_then(|def| def.params.get(index)).map(|(_, ty)| *ty);
        if let Some(Base::Enum(id)) = ty.map(|ty| ty.base) {
            return self.library.case_name(id, arg).into();
        }
        self.entity_name(Entity(arg))
    }

    pub(crate) fn entity_name(&self, entity: Entity) -> SmolStr {
        let bound = self.symbols.binding_of(entity).and_then(|index| self.program.bindings.get(index));
        bound.map_or_else(|| self.environment.name(entity), |binding| binding.name.clone())
    }

    fn numbers(&self, left: &Term, right: &Term, frame: CallFrame<'_>) -> String {
        let side = |term: &Term| self.number(term, frame).map(|value| format!("{}", round(value)));
        match (side(left), side(right)) {
            (Some(a), Some(b)) => format!("but {} is {a}, not within {b}", self.term_text(left, frame)),
            _ => "which does not hold".to_owned(),
        }
    }
}

/// Returns whether a condition requires a fluent to have a truth value: a call that needs a fact cannot
/// achieve it.
fn asks_for(condition: &Condition, fluent: Fluent, truth: bool) -> bool {
    match condition {
        Condition::Fact(fact) => truth && fact.fluent == fluent,
        Condition::Not(inner) => asks_for(inner, fluent, !truth),
        Condition::All(parts) => parts.iter().any(|part| asks_for(part, fluent, truth)),
        Condition::AnyOf(_)
        | Condition::Literal(_)
        | Condition::Compare(..)
        | Condition::MonitoredMeasure(_)
        | Condition::MonitoredFluent(_)
        | Condition::Unknown => false,
    }
}

impl Prover<'_> {
    /// Spelling of a condition, in back-quotes.
    pub(crate) fn show(&self, condition: &Condition, truth: bool, frame: CallFrame<'_>) -> String {
        let text = self.text(condition, frame);
        let inner = text.trim_matches('`');
        if truth { format!("`{inner}`") } else { format!("`not {inner}`") }
    }

    pub(super) fn text(&self, condition: &Condition, frame: CallFrame<'_>) -> String {
        let join = |parts: &[Condition], word: &str| {
            let parts: Vec<_> = parts.iter().map(|part| self.text(part, frame)).collect();
            parts.join(word)
        };
        match condition {
            Condition::Literal(value) => value.to_string(),
            Condition::Fact(fact) => self.fact_text(fact, frame),
            Condition::Compare(op, left, right) => {
                format!("{} {} {}", self.term_text(left, frame), op.symbol(), self.term_text(right, frame))
            }
            Condition::MonitoredMeasure(id) => {
                format!("monitored({})", self.library.measure(*id).map_or("?", |def| def.name.as_str()))
            }
            Condition::MonitoredFluent(id) => {
                format!("monitored({})", self.library.fluent(*id).map_or("?", |def| def.name.as_str()))
            }
            Condition::Not(inner) => format!("not {}", self.text(inner, frame)),
            Condition::All(parts) => join(parts, " and "),
            Condition::AnyOf(parts) => join(parts, " or "),
            Condition::Unknown => "…".to_owned(),
        }
    }

    fn fact_text(&self, fact: &Fact, frame: CallFrame<'_>) -> String {
        let Some(def) = self.library.fluent(fact.fluent) else { return "…".to_owned() };
        let is_bound = frame.each.is_some() || !fact.args.contains(&Some(Term::Each));
        let Some(key) = self.key(fact, frame).filter(|_| is_bound) else {
            let arg =
                |arg: &Option<Term>| arg.as_ref().map_or("any".into(), |arg| self.term_text(arg, frame));
            return format!("{}({})", def.name, fact.args.iter().map(arg).collect::<Vec<_>>().join(", "));
        };
        let name = |index, arg| self.argument_name(fact.fluent, index, arg);
        show(&def.name, key, def.params.len(), name).trim_matches('`').to_owned()
    }

    /// Spelling of a term.
    pub(crate) fn term_text(&self, term: &Term, frame: CallFrame<'_>) -> String {
        match term {
            Term::Bool(value) => value.to_string(),
            Term::Int(value) => value.to_string(),
            Term::Number(value) => round(*value).to_string(),
            Term::Text(text) => format!("\"{text}\""),
            Term::Pose { xyz: [x, y, z], yaw } => {
                let height = if *z == 0.0 { String::new() } else { format!("{} m, ", round(*z)) };
                format!("pose({} m, {} m, {height}{} rad)", round(*x), round(*y), round(*yaw))
            }
            Term::Case(id, case) => self.library.case_name(*id, *case).to_owned(),
            Term::Entity(entity) => self.environment.name(*entity).to_string(),
            Term::List(items) => {
                let items: Vec<_> = items.iter().map(|item| self.term_text(item, frame)).collect();
                format!("[{}]", items.join(", "))
            }
            Term::Binding(id) | Term::Caught(_, id) => self
                .program
                .bindings
                .get(id.index())
                .map_or_else(|| "?".to_owned(), |binding| binding.name.to_string()),
            Term::Param(index) => match frame.args.get(usize::from(*index)) {
                None | Some(Term::Param(_)) => "?".to_owned(),
                Some(term) => self.term_text(term, frame),
            },
            Term::Result => "result".to_owned(),
            Term::Each => {
                frame.each.map_or_else(|| "each".to_owned(), |entity| self.entity_name(entity).to_string())
            }
            Term::Field(of, name) => format!("{}.{name}", self.term_text(of, frame)),
            Term::Measure(id, args) => {
                let name = self.library.measure(*id).map_or("?", |def| def.name.as_str());
                let args: Vec<_> = args.iter().map(|arg| self.term_text(arg, frame)).collect();
                format!("{name}({})", args.join(", "))
            }
            Term::Arith(op, left, right) => {
                format!("{} {} {}", self.term_text(left, frame), op.symbol(), self.term_text(right, frame))
            }
            Term::Count(of) => format!("count({})", self.term_text(of, frame)),
            Term::First(of) => format!("first({})", self.term_text(of, frame)),
            Term::Template(parts) => {
                let parts = parts.iter().map(|(part, _)| match part {
                    Term::Text(text) => text.to_string(),
                    value => format!("{{{}}}", self.term_text(value, frame)),
                });
                format!("\"{}\"", parts.collect::<String>())
            }
            Term::Unknown => "?".to_owned(),
        }
    }
}

/// Rounds a number for messages.
pub(super) fn round(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
