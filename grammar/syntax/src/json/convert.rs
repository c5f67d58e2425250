//! The wire types of a policy to the AST, step by step. What the types cannot say is checked here: names,
//! nesting, the number of steps, which keys a reaction has. Conditions and terms are in
//! [`super::convert_term`].

use super::term::{Condition, Duration, Form, Term};
use super::wire::{self, ReactKind};
use super::{Fallible, Spanned};
use crate::ast::{
    Block, Catch, CatchOn, Do, End, EndKind, Expr, ExprKind, Keep, KeepKind, MAX_MISTAKES, MAX_NESTING,
    MAX_STEPS, Name, Policy, Reaction, Step, StepKind, TypeExpr, When,
};
use crate::diagnostic::Diagnostic;
use crate::diagnostics::{BadName, BadValue, MissingKey, ReservedKey, TooDeep, TooManySteps, UnknownKey};
use crate::source::{FileId, Span};
use crate::unit::{Unit, parse_quantity};
use crate::words;

/// The policy of a document, and what is wrong with it.
pub(super) fn policy(document: Spanned<wire::Document>, file: FileId) -> (Policy, Vec<Diagnostic>) {
    let mut converter = Converter { file, found: Vec::new(), steps: 0 };
    let Spanned { value: document, span } = document;
    if *document.motet != 1 {
        let message = format!("version {} of the format is not known", *document.motet);
        converter.bad_value(document.motet.span, message, &["1"]);
    }
    let policy = Policy {
        doc: smol_str::SmolStr::default(),
        name: converter.name(document.policy),
        params: Vec::new(),
        result: document.result.and_then(|ty| converter.type_expr(ty)),
        robot: document.robot.map(|robot| converter.name(robot)),
        achieves: document.achieves.map(|goal| converter.condition(goal, 1)),
        keeps: document.keep.map(|keeps| converter.keeps(keeps, 0)).unwrap_or_default(),
        body: converter.block(document.steps, 1),
        cleanup: document.finally.map(|steps| converter.block(*steps, 1)),
        span,
    };
    (policy, converter.found)
}

pub(super) struct Converter {
    pub(super) file: FileId,
    pub(super) found: Vec<Diagnostic>,
    steps: usize,
}

impl Converter {
    /// A block; `depth` counts the braces that the text syntax has around its steps.
    fn block(&mut self, steps: wire::Steps, depth: usize) -> Block {
        let span = steps.span;
        if depth > MAX_NESTING {
            self.found.push(TooDeep { span, limit: MAX_NESTING }.into());
            return Block::new(Vec::new(), span);
        }
        let (mut block, mut gaps) = (Vec::with_capacity(steps.value.len()), Vec::new());
        for (index, Fallible(step)) in (0_u32..).zip(steps.value) {
            if self.found.len().max(gaps.len()) > MAX_MISTAKES {
                break;
            }
            let Some(step) = step else {
                gaps.push(index);
                continue;
            };
            self.steps += 1;
            if self.steps > MAX_STEPS {
                if self.steps == MAX_STEPS + 1 {
                    self.found.push(TooManySteps { span: step.span }.into());
                }
                break;
            }
            let span = step.span;
            block.push(Step { kind: self.step(step.value, span, depth), span });
        }
        Block { steps: block, gaps, span }
    }

    fn step(&mut self, step: wire::Step, span: Span, depth: usize) -> StepKind {
        let (kind, cleanup) = match step {
            wire::Step::Do(step) => (StepKind::Do(self.call_step(step, span, depth)), None),
            wire::Step::Let(step) => {
                (StepKind::Let { name: self.name(step.r#let), value: self.term(step.be, depth + 1) }, None)
            }
            wire::Step::Sequence(step) => {
                let (name, body) = (self.name(step.sequence), self.block(step.steps, depth + 1));
                (StepKind::Sequence { name, body }, step.finally)
            }
            wire::Step::If(step) => {
                let condition = self.condition(step.r#if, depth);
                let then = self.block(step.then, depth + 1);
                let otherwise = step.r#else.map(|steps| self.block(steps, depth + 1));
                (StepKind::If { condition, then, otherwise }, step.finally)
            }
            wire::Step::Wait(step) => (self.wait(step, depth), None),
            wire::Step::Monitor(step) => {
                self.at_least_one(step.monitor.value.is_empty(), step.monitor.span, "monitor", "condition");
                let whens = step.monitor.value.into_iter().filter_map(|Fallible(when)| when);
                let whens = whens.filter_map(|when| self.when(when, depth)).collect();
                (StepKind::Monitor { whens, body: self.block(step.during, depth + 1) }, step.finally)
            }
            wire::Step::Try(step) => {
                let place = Span { end: step.r#try.span.start + 1, ..step.r#try.span };
                let is_bare = step.catch.is_none();
                if is_bare && step.finally.is_none() {
                    self.found.push(MissingKey { key: "catch".into(), span: place }.into());
                }
                let Spanned { value: catch, span } = step.catch.unwrap_or_else(|| Vec::new().into());
                self.at_least_one(catch.is_empty() && !is_bare, span, "try", "handler");
                let body = self.block(step.r#try, depth + 1);
                let catches = catch.into_iter().filter_map(|Fallible(catch)| catch);
                let catches = catches.map(|catch| self.catch(catch, depth)).collect();
                (StepKind::Try { body, catches }, step.finally)
            }
            wire::Step::Repeat(step) => {
                let (times, body) = (self.count(step.repeat, depth), self.block(step.steps, depth + 1));
                let until = step.until.map(|until| self.condition(until, depth));
                (StepKind::Repeat { times, body, until }, step.finally)
            }
            wire::Step::Each(step) => {
                let (item, list) = (self.name(step.each), self.term(step.r#in, depth + 1));
                let (at_most, body) = (self.count(step.at_most, depth), self.block(step.steps, depth + 1));
                (StepKind::Each { item, list, at_most, body }, step.finally)
            }
            wire::Step::Parallel(step) => {
                self.at_least_one(step.parallel.value.is_empty(), step.parallel.span, "parallel", "branch");
                let branches = step.parallel.value.into_iter();
                let branches = branches.map(|steps| self.block(steps, depth + 2)).collect();
                (StepKind::Parallel { branches }, step.finally)
            }
            wire::Step::Within(step) => {
                let (time, body) = (self.duration(step.within, depth), self.block(step.steps, depth + 1));
                (StepKind::Within { time, body }, step.finally)
            }
            wire::Step::Keep(step) => {
                self.at_least_one(step.keep.value.is_empty(), step.keep.span, "keep", "rule");
                let (keeps, body) = (self.keeps(step.keep, depth), self.block(step.steps, depth + 1));
                (StepKind::Keep { keeps, body }, step.finally)
            }
            wire::Step::End(end) => (StepKind::End(self.end(end, span, depth)), None),
        };
        let Some(cleanup) = cleanup else { return kind };
        StepKind::Finally { step: Box::new(Step { kind, span }), cleanup: self.block(*cleanup, depth + 1) }
    }

    fn keeps(&mut self, keeps: wire::Keeps, depth: usize) -> Vec<Keep> {
        let keeps = keeps.value.into_iter().filter_map(|Fallible(kept)| kept);
        let one = |Spanned { value, span }: Spanned<wire::KeepRule>| {
            let kind = match value {
                wire::KeepRule::OutOf(kept) => KeepKind::OutOf(self.term(kept.out_of, depth + 1)),
                wire::KeepRule::Distance(kept) => KeepKind::Distance {
                    to: self.term(kept.distance, depth + 1),
                    at_least: self.length(kept.at_least, depth),
                },
            };
            Keep { kind, span }
        };
        keeps.map(one).collect()
    }

    /// A length: a bare number is metres.
    fn length(&mut self, length: Spanned<Term>, depth: usize) -> Expr {
        let kind = match &length.value {
            Term::Number(metres) => ExprKind::Quantity(*metres, Unit::Metre),
            Term::Text(text) => match parse_quantity(text) {
                Some((value, unit)) => ExprKind::Quantity(value, unit),
                None => return self.term(length, depth + 1),
            },
            Term::Bool(_) | Term::List(_) | Term::Form(_) => return self.term(length, depth + 1),
        };
        Expr { kind, span: length.span }
    }

    /// A number or a quantity is a time, anything else a condition.
    fn wait(&mut self, step: wire::Wait, depth: usize) -> StepKind {
        let is_time = match &step.wait.0.value {
            Term::Number(_) => true,
            Term::Text(text) => parse_quantity(text).is_some(),
            Term::Form(form) => {
                matches!(**form, Form::Add(_) | Form::Subtract(_) | Form::Multiply(_) | Form::Divide(_))
            }
            Term::Bool(_) | Term::List(_) => false,
        };
        if !is_time {
            return StepKind::Wait {
                condition: self.condition(Condition(step.wait.0), depth),
                within: step.within.map(|within| self.duration(*within, depth)),
            };
        }
        if let Some(within) = &step.within {
            self.bad_value(within.0.span, "a wait for a time has no deadline".into(), &[]);
        }
        StepKind::Delay { time: self.duration(Duration(step.wait.0), depth) }
    }

    fn call_step(&mut self, mut step: super::term::Do, span: Span, depth: usize) -> Do {
        // A key of another step is no argument, not even one that does not exist.
        step.args.0.retain(|(key, _)| {
            // One may be another name of a parameter.
            let is_reserved = words::json_key_owner(&key.value).is_some() && key.value != "in";
            if is_reserved {
                self.found.push(ReservedKey { span: key.span, key: key.value.clone() }.into());
            }
            !is_reserved
        });
        Do {
            call: self.call(step.r#do, step.args, span, depth + 1, false),
            bind: step.r#as.map(|bind| self.name(*bind)),
            manner: step.manner.and_then(|manner| self.manner(*manner, depth)),
            within: step.within.map(|within| self.duration(*within, depth)),
            retry: step.retry.map(|retry| self.count(*retry, depth)),
        }
    }

    fn when(&mut self, when: Spanned<wire::When>, depth: usize) -> Option<When> {
        let Spanned { value: when, span } = when;
        let condition = self.condition(when.when, depth);
        let hold = when.r#for.map(|hold| self.duration(hold, depth));
        let Spanned { value: reaction, span: place } = when.then;
        let reaction = match reaction {
            wire::Reaction::End(end) => Reaction::End(self.end(end, place, depth)),
            wire::Reaction::React(react) => self.react(react, place, depth)?,
        };
        Some(When { condition, hold, reaction, span })
    }

    /// A reaction; `None` where a key is missing.
    fn react(&mut self, react: wire::React, span: Span, depth: usize) -> Option<Reaction> {
        let kind = react.react.value;
        let place = react.react.span;
        let mut surplus = |key: &'static str, at: Option<Span>, expected: &'static [&'static str]| {
            self.found.extend(at.map(|span| {
                Diagnostic::from(UnknownKey { key: key.into(), span, expected: smol(expected) })
            }));
        };
        if kind != ReactKind::Pause {
            surplus(
                "within",
                react.within.as_ref().map(|within| within.0.span),
                &["react", "at_most", "steps"],
            );
        }
        if kind == ReactKind::Pause {
            surplus("at_most", react.at_most.as_ref().map(|count| count.0.span), &["react", "within"]);
        }
        if kind != ReactKind::Resume {
            surplus("steps", react.steps.as_ref().map(|steps| steps.span), &["react", "within", "at_most"]);
        }
        if kind == ReactKind::Pause {
            return Some(Reaction::Pause {
                within: react.within.map(|within| self.duration(within, depth)),
                span,
            });
        }
        let Some(at_most) = react.at_most else {
            self.found.push(MissingKey { key: "at_most".into(), span: place }.into());
            return None;
        };
        let at_most = self.count(at_most, depth);
        if kind == ReactKind::Restart {
            return Some(Reaction::Restart { at_most, span });
        }
        let Some(steps) = react.steps else {
            self.found.push(MissingKey { key: "steps".into(), span: place }.into());
            return None;
        };
        Some(Reaction::Resume { at_most, body: self.block(steps, depth + 2), span })
    }

    fn catch(&mut self, catch: Spanned<wire::Catch>, depth: usize) -> Catch {
        let Spanned { value: catch, span } = catch;
        let Spanned { value: on, span: place } = catch.on;
        self.at_least_one(on.is_empty(), place, "catch", "kind of failure");
        // Every kind, whatever stands beside it.
        let on = match on.iter().find(|kind| kind.value == "any") {
            Some(any) => CatchOn::Any(any.span),
            None => CatchOn::Kinds(on.into_iter().map(|kind| self.name(kind)).collect()),
        };
        let bind = catch.r#as.map(|bind| self.name(bind));
        Catch { on, bind, body: self.block(catch.steps, depth + 1), span }
    }

    fn end(&mut self, end: wire::End, span: Span, depth: usize) -> End {
        let kind = match end.end.value {
            wire::EndKind::Done => EndKind::Done,
            wire::EndKind::Fail => EndKind::Fail,
            wire::EndKind::Cannot => EndKind::Cannot,
            wire::EndKind::Replan => EndKind::Replan,
        };
        let (mut result, mut why) = (end.result, end.why);
        let (surplus, what) = match kind {
            EndKind::Done => (why.take(), "`done` has no reason"),
            EndKind::Fail | EndKind::Cannot | EndKind::Replan => (result.take(), "only `done` has a result"),
        };
        if let Some(surplus) = surplus {
            self.bad_value(surplus.span, what.into(), &[]);
        }
        let result = result.map(|result| self.term(result, depth + 1));
        End { kind, result, why: why.map(|why| self.term(why, depth + 1)), span }
    }

    /// The type of a result, which is written as in the text syntax.
    fn type_expr(&mut self, ty: Spanned<smol_str::SmolStr>) -> Option<TypeExpr> {
        let Spanned { value: text, span } = ty;
        let (mut inner, mut lists) = (text.trim(), 0_usize);
        while let Some(element) = inner.strip_prefix("List<").and_then(|rest| rest.strip_suffix('>')) {
            (inner, lists) = (element.trim(), lists + 1);
        }
        if lists > MAX_NESTING || !words::is_name(inner) {
            let message = format!("`{text}` is not a type");
            self.bad_value(span, message, &["Object", "Text", "List<Object>"]);
            return None;
        }
        let named = TypeExpr::Named(Name { text: inner.into(), span });
        Some((0..lists).fold(named, |inner, _| TypeExpr::List(Box::new(inner), span)))
    }

    #[inline]
    pub(super) fn name(&mut self, name: Spanned<smol_str::SmolStr>) -> Name {
        if !words::is_name(&name.value) {
            self.bad_name(&name);
        }
        Name { text: name.value, span: name.span }
    }

    #[cold]
    fn bad_name(&mut self, name: &Spanned<smol_str::SmolStr>) {
        self.found.push(BadName { span: name.span, name: name.value.clone() }.into());
    }

    fn at_least_one(&mut self, is_empty: bool, span: Span, key: &str, what: &str) {
        if is_empty {
            self.bad_value(span, format!("`{key}` needs at least one {what}"), &[]);
        }
    }

    pub(super) fn bad_value(&mut self, span: Span, message: String, expected: &'static [&'static str]) {
        self.found.push(BadValue { expected: smol(expected), ..BadValue::new(span, message) }.into());
    }
}

fn smol(words: &[&'static str]) -> Vec<smol_str::SmolStr> {
    words.iter().copied().map(smol_str::SmolStr::new_static).collect()
}
