//! The story of a refutation: which fact, made false by which step, and what would make it true.

use motet_syntax::ast::{ArithOp, CompareOp};
use motet_syntax::{Diagnostic, Span};
use smol_str::{SmolStr, format_smolstr};

use super::Prover;
use super::errors::GoalRefuted;
use super::eval::Frame;
use super::facts::show;
use super::value::Cause;
use crate::ir::{Base, Condition, Entity, Fact, Fluent, StepKind, Term};

/// Why a condition can be false.
#[derive(Clone, Debug)]
pub(crate) struct Blame {
    /// What was asked for: "`free(hand)`", "`not open(drawer_1)`".
    pub(crate) wanted: String,
    /// What made it otherwise.
    pub(crate) cause: Cause,
    /// The fluent and the value that it should have.
    pub(crate) fact: Option<(Fluent, bool)>,
    /// The name of the fluent, measure or field that it turns on, and the value that it should have.
    pub(crate) subject: Option<(SmolStr, bool)>,
    /// What is told instead of a cause: "`kettle` has 2.1 kg".
    numbers: Option<String>,
    maker: Option<SmolStr>,
}

impl Blame {
    /// The rest of the sentence "… needs X, ".
    pub(crate) fn story(&self) -> String {
        if let Some(numbers) = &self.numbers {
            return numbers.clone();
        }
        match (&self.maker, self.cause) {
            (Some(maker), _) => format!("which `{maker}` made false"),
            (None, Cause::NOTHING) => "which nothing ever made true".to_owned(),
            (None, _) => "which does not hold at the start".to_owned(),
        }
    }
}

/// Whether the end of the policy is a place where steps could be added.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum AtEnd {
    /// It is: the last step has run.
    Offer,
    /// A `done` in the middle.
    Tell,
}

impl Prover<'_> {
    /// Why `condition` can fail to be `truth`.
    pub(crate) fn blame(&self, condition: &Condition, truth: bool, frame: Frame<'_>) -> Blame {
        let fails = |part: &&Condition| {
            let value = self.evaluate(part, frame);
            if truth { value.no.is_some() } else { value.yes.is_some() }
        };
        match condition {
            Condition::Not(inner) => return self.blame(inner, !truth, frame),
            Condition::All(parts) | Condition::AnyOf(parts) => {
                let joined = matches!(condition, Condition::AnyOf(_)) == truth && parts.len() > 1;
                if let Some(part) = parts.iter().find(fails) {
                    let mut blame = self.blame(part, truth, frame);
                    if joined {
                        blame.wanted = self.show(condition, truth, frame);
                    }
                    return blame;
                }
            }
            Condition::Fact(fact) => {
                let value = self.evaluate(condition, frame);
                let cause = if truth { value.no } else { value.yes };
                let maker = cause.as_step().map(|_| self.cause_name(cause));
                let wanted = self.show(condition, truth, frame);
                let subject = self.library.fluent(fact.fluent).map(|def| (def.name.clone(), truth));
                return Blame {
                    wanted,
                    cause,
                    fact: Some((fact.fluent, truth)),
                    subject,
                    numbers: None,
                    maker,
                };
            }
            Condition::Compare(_, left, right) => {
                let numbers = self.numbers(left, right, frame);
                let wanted = self.show(condition, truth, frame);
                return Blame {
                    wanted,
                    cause: Cause::START,
                    fact: None,
                    subject: self.measured(left).or_else(|| self.measured(right)).map(|name| (name, truth)),
                    numbers: Some(numbers),
                    maker: None,
                };
            }
            Condition::MonitoredMeasure(_) | Condition::MonitoredFluent(_) => {
                let wanted = self.show(condition, truth, frame);
                let numbers = Some("and no `monitor` around it does".to_owned());
                let subject = Some((SmolStr::new_static("monitored"), truth));
                return Blame { wanted, cause: Cause::NOTHING, fact: None, subject, numbers, maker: None };
            }
            Condition::Literal(_) | Condition::Unknown => {}
        }
        let wanted = self.show(condition, truth, frame);
        Blame { wanted, cause: Cause::NOTHING, fact: None, subject: None, numbers: None, maker: None }
    }

    /// The field or measure behind a number.
    fn measured(&self, term: &Term) -> Option<SmolStr> {
        match term {
            Term::Field(_, name) => Some(name.clone()),
            Term::Measure(id, _) => self.library.measure(*id).map(|def| def.name.clone()),
            Term::Arith(_, left, right) => self.measured(left).or_else(|| self.measured(right)),
            _ => None,
        }
    }

    /// Which primitives make the fact that is missing.
    pub(crate) fn remedy(&self, blame: &Blame) -> Option<String> {
        let (fluent, truth) = blame.fact?;
        let makers = self.library.primitives.iter().filter(|def| def.provided);
        let makers = makers.filter(|def| {
            def.makes.iter().any(|effect| effect.fact.fluent == fluent && effect.value == truth)
                && !def.needs.iter().any(|need| asks_for(&need.condition, fluent, truth))
        });
        let names: Vec<_> = makers.map(|def| format!("`{}`", def.name)).take(4).collect();
        match names.split_last() {
            None => None,
            Some((only, [])) => Some(format!("{only} makes it so: call it before")),
            Some((last, rest)) => Some(format!("{} or {last} makes it so: call it before", rest.join(", "))),
        }
    }

    /// Where the policy is done, its goal must not be refuted.
    pub(crate) fn check_goal(&mut self, end: AtEnd) {
        let program = self.program;
        let Some((goal, span)) = &program.achieves else { return };
        let frame = Frame::default();
        if !self.evaluate(goal, frame).no.is_some() {
            return;
        }
        let blame = self.blame(goal, true, frame);
        let mistake = GoalRefuted {
            span: *span,
            wanted: blame.wanted.clone(),
            story: blame.story(),
            culprit: self.cause_span(blame.cause),
            remedy: self.remedy(&blame),
            subject: blame.subject,
        };
        let mistake: Diagnostic = mistake.into();
        if let (AtEnd::Offer, true) = (end, self.live) {
            self.offer_goal(goal, *span, (mistake.code, mistake.message.clone()));
        }
        if !self.diagnostics.contains(&mistake) {
            self.diagnostics.push(mistake);
        }
    }

    /// The place of the step behind a cause.
    pub(crate) fn cause_span(&self, cause: Cause) -> Option<Span> {
        Some(self.program.steps.get(cause.as_step()?.index())?.span)
    }

    /// The step behind a cause, in a word.
    pub(crate) fn cause_name(&self, cause: Cause) -> SmolStr {
        let step = cause.as_step().and_then(|id| self.program.steps.get(id.index()));
        match step.map(|step| &step.kind) {
            Some(StepKind::Call(call)) => {
                let name = self.library.primitive(call.primitive).map_or("a step", |def| def.name.as_str());
                let args = call.args.iter().filter_map(|arg| match arg {
                    Term::Entity(_) | Term::Binding(_) => Some(self.term_text(arg, Frame::default())),
                    _ => None,
                });
                format_smolstr!("{name}({})", args.collect::<Vec<_>>().join(", "))
            }
            Some(StepKind::If { .. }) => "if".into(),
            Some(StepKind::Wait { .. }) => "wait".into(),
            Some(StepKind::Monitor { .. }) => "monitor".into(),
            Some(StepKind::Repeat { .. }) => "repeat".into(),
            Some(StepKind::Each { .. }) => "each".into(),
            Some(StepKind::Parallel { .. }) => "parallel".into(),
            Some(
                StepKind::Sequence { .. }
                | StepKind::Inline { .. }
                | StepKind::Try { .. }
                | StepKind::End { .. }
                | StepKind::Unknown,
            )
            | None => "a step".into(),
        }
    }

    /// An argument of a fact by its name.
    pub(crate) fn argument_name(&self, fluent: Fluent, index: usize, arg: u16) -> SmolStr {
        let ty = self.library.fluent(fluent).and_then(|def| def.params.get(index)).map(|(_, ty)| *ty);
        if let Some(Base::Enum(id)) = ty.map(|ty| ty.base) {
            return self.library.case_name(id, arg).into();
        }
        self.entity_name(Entity(arg))
    }

    fn entity_name(&self, entity: Entity) -> SmolStr {
        let bound = self.symbols.binding_of(entity).and_then(|index| self.program.bindings.get(index));
        bound.map_or_else(|| self.world.name(entity), |binding| binding.name.clone())
    }

    fn numbers(&self, left: &Term, right: &Term, frame: Frame<'_>) -> String {
        let side = |term: &Term| self.number(term, frame).map(|value| format!("{}", round(value)));
        match (side(left), side(right)) {
            (Some(a), Some(b)) => format!("and {} is {a}, not within {b}", self.term_text(left, frame)),
            _ => "which does not hold".to_owned(),
        }
    }

    /// A condition as the language writes it, in back-quotes.
    pub(crate) fn show(&self, condition: &Condition, truth: bool, frame: Frame<'_>) -> String {
        let text = self.text(condition, frame);
        let inner = text.trim_matches('`');
        if truth { format!("`{inner}`") } else { format!("`not {inner}`") }
    }

    fn text(&self, condition: &Condition, frame: Frame<'_>) -> String {
        let join = |parts: &[Condition], word: &str| {
            let parts: Vec<_> = parts.iter().map(|part| self.text(part, frame)).collect();
            parts.join(word)
        };
        match condition {
            Condition::Literal(value) => value.to_string(),
            Condition::Fact(fact) => self.fact_text(fact, frame),
            Condition::Compare(op, left, right) => {
                format!("{} {} {}", self.term_text(left, frame), symbol(*op), self.term_text(right, frame))
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

    fn fact_text(&self, fact: &Fact, frame: Frame<'_>) -> String {
        let Some(def) = self.library.fluent(fact.fluent) else { return "…".to_owned() };
        match self.key(fact, frame) {
            Some(key) => {
                let name = |index, arg| self.argument_name(fact.fluent, index, arg);
                show(&def.name, key, def.params.len(), name).trim_matches('`').to_owned()
            }
            None => def.name.to_string(),
        }
    }

    fn term_text(&self, term: &Term, frame: Frame<'_>) -> String {
        match term {
            Term::Bool(value) => value.to_string(),
            Term::Int(value) => value.to_string(),
            Term::Number(value) => round(*value).to_string(),
            Term::Text(text) => format!("\"{text}\""),
            Term::Case(id, case) => self.library.case_name(*id, *case).to_owned(),
            Term::Entity(entity) => self.world.name(*entity).to_string(),
            Term::List(items) => {
                let items: Vec<_> = items.iter().map(|item| self.term_text(item, frame)).collect();
                format!("[{}]", items.join(", "))
            }
            Term::Binding(id) => self
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
                let op = match op {
                    ArithOp::Add => "+",
                    ArithOp::Subtract => "-",
                    ArithOp::Multiply => "*",
                    ArithOp::Divide => "/",
                };
                format!("{} {op} {}", self.term_text(left, frame), self.term_text(right, frame))
            }
            Term::Unknown => "?".to_owned(),
        }
    }
}

/// Whether a condition asks for a fluent to have a truth: what needs a fact is no way to make it.
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

fn symbol(op: CompareOp) -> &'static str {
    match op {
        CompareOp::Equal => "==",
        CompareOp::Unequal => "!=",
        CompareOp::Less => "<",
        CompareOp::AtMost => "<=",
        CompareOp::More => ">",
        CompareOp::AtLeast => ">=",
    }
}

/// A number short enough to read.
fn round(value: f64) -> f64 {
    (value * 1000.0).round() / 1000.0
}
