//! Printer of policies in the JSON syntax: syntax tree to wire types, and those to text.
//!
//! A name that a `let`, an `each` or a parameter binds is written `"$name"`, any other as it is. A quantity
//! in an SI unit is written as a number, any other as a string with its unit. The compiler names arguments
//! before it prints. A condition with an argument that still has no name is written as a string in the text
//! syntax; in a step such an argument is written under `arg1`, `arg2`, … by its position.
//!
//! A value in a place without an expected type tells its own: a quantity has its unit, and a text is an
//! object.

use rustc_hash::FxHashSet;
use serde_json::Value;
use smol_str::{SmolStr, format_smolstr};

use super::expr::{braces, template};
use crate::ast::{
    Block, Call, Catch, CatchOn, CompareOp, Do, End, EndKind, Expr, ExprKind, Keep, KeepKind, Manner, Name,
    Policy, Reaction, Step, StepKind, TypeExpr, When,
};
use crate::json::term::{self, Args, Awaited, Condition, Count, Duration, Field, Form, Get, Is, Term};
use crate::json::{Fallible, Spanned, wire};
use crate::render::escaped_json;
use crate::unit::{Dimension, Unit};
use crate::words::spelled;

/// A policy in the JSON syntax, indented by two, short values on one line. It ends with a line break.
#[must_use]
pub fn policy_json(policy: &Policy) -> String {
    // The wire types are maps, lists, strings and finite numbers: all of them have a JSON syntax.
    let value = serde_json::to_value(policy_wire(policy)).unwrap_or_default();
    pretty(&value)
}

/// A call as a step, on one line.
pub(super) fn call(step: &Do) -> String {
    let mut translation = WireTranslation { scope: FxHashSet::default() };
    one_line(&serde_json::to_value(translation.call_step(step)).unwrap_or_default())
}

/// Steps in the JSON syntax, on one line, without brackets around them.
pub(crate) fn json_steps(block: &Block) -> String {
    let mut translation = WireTranslation { scope: FxHashSet::default() };
    let steps =
        block.steps.iter().map(|step| serde_json::to_value(translation.step(step)).unwrap_or_default());
    let steps: Vec<String> = steps.map(|step| one_line(&step)).collect();
    steps.join(", ")
}

/// A policy as the wire types of the JSON syntax. Spans are left empty.
#[must_use]
fn policy_wire(policy: &Policy) -> wire::Document {
    let mut translation =
        WireTranslation { scope: policy.params.iter().map(|param| param.name.text.clone()).collect() };
    wire::Document {
        motet: 1.into(),
        policy: name(&policy.name),
        result: policy.result.as_ref().map(|ty| type_text(ty).into()),
        robot: policy.robot.as_ref().map(name),
        achieves: policy.achieves.as_ref().map(|goal| translation.condition(goal)),
        keep: (!policy.keeps.is_empty()).then(|| translation.keeps(&policy.keeps)),
        steps: translation.block(&policy.body),
        finally: policy.cleanup.as_ref().map(|cleanup| Box::new(translation.block(cleanup))),
    }
}

/// A type, with its name as it is.
fn type_text(ty: &TypeExpr) -> SmolStr {
    match ty {
        TypeExpr::Named(name) => name.text.clone(),
        TypeExpr::List(element, _) => format_smolstr!("List<{}>", type_text(element)),
    }
}

fn name(name: &Name) -> Spanned<SmolStr> {
    name.text.clone().into()
}

/// Translation to the wire types, with the names bound so far. A name stays one when its block ends: it may
/// be bound behind the block too.
struct WireTranslation {
    scope: FxHashSet<SmolStr>,
}

impl WireTranslation {
    fn block(&mut self, block: &Block) -> wire::Steps {
        let steps: Vec<_> =
            block.steps.iter().map(|step| Fallible::from(Spanned::from(self.step(step)))).collect();
        steps.into()
    }

    fn step(&mut self, step: &Step) -> wire::Step {
        match &step.kind {
            StepKind::Do(step) => wire::Step::Do(self.call_step(step)),
            StepKind::Let { name: bound, value } => {
                let be = self.untyped(value).into();
                self.scope.insert(bound.text.clone());
                wire::Step::Let(Box::new(wire::Let { r#let: name(bound), be }))
            }
            StepKind::Sequence { name: group, body } => {
                let steps = self.block(body);
                wire::Step::Sequence(wire::Sequence { sequence: name(group), steps, finally: None })
            }
            StepKind::If { condition, then, otherwise } => wire::Step::If(Box::new(wire::If {
                r#if: self.condition(condition),
                then: self.block(then),
                r#else: otherwise.as_ref().map(|block| self.block(block)),
                finally: None,
            })),
            StepKind::Wait { condition, within } => wire::Step::Wait(wire::Wait {
                wait: Awaited(self.condition(condition).0),
                within: within.as_ref().map(|within| Box::new(self.duration(within))),
            }),
            StepKind::Delay { time } => {
                wire::Step::Wait(wire::Wait { wait: Awaited(self.duration(time).0), within: None })
            }
            StepKind::Monitor { whens, body } => {
                let whens: Vec<_> =
                    whens.iter().map(|when| Fallible::from(Spanned::from(self.when(when)))).collect();
                let during = self.block(body);
                wire::Step::Monitor(wire::Monitor { monitor: whens.into(), during, finally: None })
            }
            StepKind::Try { body, catches } => {
                let r#try = self.block(body);
                let catch: Vec<_> =
                    catches.iter().map(|catch| Fallible::from(Spanned::from(self.catch(catch)))).collect();
                let catch = if catch.is_empty() { None } else { Some(catch.into()) };
                wire::Step::Try(wire::Try { r#try, catch, finally: None })
            }
            StepKind::Repeat { times, body, until } => wire::Step::Repeat(Box::new(wire::Repeat {
                repeat: self.count(times),
                steps: self.block(body),
                until: until.as_ref().map(|until| self.condition(until)),
                finally: None,
            })),
            StepKind::Each { item, list, at_most, body } => {
                let (r#in, at_most) = (self.untyped(list).into(), self.count(at_most));
                self.scope.insert(item.text.clone());
                let steps = self.block(body);
                let each = name(item);
                wire::Step::Each(Box::new(wire::Each { each, r#in, at_most, steps, finally: None }))
            }
            StepKind::Parallel { branches } => {
                let branches: Vec<_> = branches.iter().map(|branch| self.block(branch)).collect();
                wire::Step::Parallel(wire::Parallel { parallel: branches.into(), finally: None })
            }
            StepKind::Within { time, body } => {
                let (within, steps) = (self.duration(time), self.block(body));
                wire::Step::Within(wire::Within { within, steps, finally: None })
            }
            StepKind::Keep { keeps, body } => {
                let (keep, steps) = (self.keeps(keeps), self.block(body));
                wire::Step::Keep(wire::Keep { keep, steps, finally: None })
            }
            StepKind::Finally { step, cleanup } => {
                let mut step = self.step(step);
                step.set_finally(self.block(cleanup));
                step
            }
            StepKind::End(end) => wire::Step::End(self.end(end)),
        }
    }

    fn call_step(&mut self, step: &Do) -> term::Do {
        let translated = term::Do {
            r#do: name(&step.call.name),
            args: self.args(&step.call),
            manner: step.manner.as_ref().map(|manner| Box::new(self.manner(manner))),
            within: step.within.as_ref().map(|within| Box::new(self.duration(within))),
            retry: step.retry.as_ref().map(|retry| Box::new(self.count(retry))),
            r#as: step.bind.as_ref().map(|bind| Box::new(name(bind))),
        };
        self.scope.extend(step.bind.as_ref().map(|bind| bind.text.clone()));
        translated
    }

    fn manner(&mut self, manner: &Manner) -> term::Manner {
        term::Manner(match manner {
            Manner::Slowly(_) => Term::Text("slowly".into()).into(),
            Manner::Gently(_) => Term::Text("gently".into()).into(),
            Manner::At(ratio, _) => self.term(ratio).into(),
        })
    }

    fn keeps(&mut self, keeps: &[Keep]) -> wire::Keeps {
        let one = |keep: &Keep| match &keep.kind {
            KeepKind::OutOf(zone) => wire::KeepRule::OutOf(wire::OutOf { out_of: self.term(zone).into() }),
            KeepKind::Distance { to, at_least } => wire::KeepRule::Distance(wire::KeptDistance {
                distance: self.term(to).into(),
                at_least: self.term(at_least).into(),
            }),
        };
        let keeps: Vec<_> = keeps.iter().map(one).map(|kept| Fallible::from(Spanned::from(kept))).collect();
        keeps.into()
    }

    fn when(&mut self, when: &When) -> wire::When {
        wire::When {
            when: self.condition(&when.condition),
            r#for: when.hold.as_ref().map(|hold| self.duration(hold)),
            then: self.reaction(&when.reaction).into(),
        }
    }

    fn reaction(&mut self, reaction: &Reaction) -> wire::Reaction {
        let react = |kind: wire::ReactKind| wire::React {
            react: kind.into(),
            within: None,
            at_most: None,
            steps: None,
        };
        wire::Reaction::React(match reaction {
            Reaction::Pause { within, .. } => {
                let within = within.as_ref().map(|within| self.duration(within));
                wire::React { within, ..react(wire::ReactKind::Pause) }
            }
            Reaction::Restart { at_most, .. } => {
                wire::React { at_most: Some(self.count(at_most)), ..react(wire::ReactKind::Restart) }
            }
            Reaction::Resume { at_most, body, .. } => wire::React {
                at_most: Some(self.count(at_most)),
                steps: Some(self.block(body)),
                ..react(wire::ReactKind::Resume)
            },
            Reaction::End(end) => return wire::Reaction::End(self.end(end)),
        })
    }

    fn catch(&mut self, catch: &Catch) -> wire::Catch {
        let on: Vec<Spanned<SmolStr>> = match &catch.on {
            CatchOn::Any(_) => vec![SmolStr::new("any").into()],
            CatchOn::Kinds(kinds) => kinds.iter().map(name).collect(),
        };
        let r#as = catch.bind.as_ref().map(name);
        self.scope.extend(catch.bind.as_ref().map(|bind| bind.text.clone()));
        wire::Catch { on: on.into(), r#as, steps: self.block(&catch.body) }
    }

    fn end(&mut self, end: &End) -> wire::End {
        let kind = match end.kind {
            EndKind::Done => wire::EndKind::Done,
            EndKind::Fail => wire::EndKind::Fail,
            EndKind::Cannot => wire::EndKind::Cannot,
            EndKind::Replan => wire::EndKind::Replan,
        };
        wire::End {
            end: kind.into(),
            result: end.result.as_ref().map(|result| self.term(result).into()),
            why: end.why.as_ref().map(|why| self.term(why).into()),
        }
    }

    /// A condition. What has no form of its own is written as a string in the text syntax.
    fn condition(&mut self, expr: &Expr) -> Condition {
        let term = match &expr.kind {
            _ if has_unnamed(expr) => Term::Text(super::expression(expr).into()),
            ExprKind::Bool(value) => Term::Bool(*value),
            ExprKind::Binding(bound) => lone_binding(bound),
            ExprKind::Name(bound) if self.scope.contains(bound) => lone_binding(bound),
            ExprKind::Call(_)
            | ExprKind::Field(..)
            | ExprKind::Not(_)
            | ExprKind::All(_)
            | ExprKind::AnyOf(_)
            | ExprKind::Compare(..)
            | ExprKind::Arith(..) => self.form(expr, ExprPosition::Condition),
            _ => Term::Text(super::expression(expr).into()),
        };
        Condition(term.into())
    }

    /// A duration: in seconds as a number, in any other unit as a string.
    fn duration(&mut self, expr: &Expr) -> Duration {
        Duration(self.term(expr).into())
    }

    fn count(&mut self, expr: &Expr) -> Count {
        Count(self.term(expr).into())
    }

    /// A term of a known type, which decides how a bare number or a plain string is read.
    fn term(&mut self, expr: &Expr) -> Term {
        self.value(expr, Expectation::Type)
    }

    /// A term that shows its own type.
    fn untyped(&mut self, expr: &Expr) -> Term {
        self.value(expr, Expectation::Nothing)
    }

    fn value(&mut self, expr: &Expr, expected: Expectation) -> Term {
        match &expr.kind {
            ExprKind::Bool(value) => Term::Bool(*value),
            ExprKind::Number(value) => Term::Number(*value),
            ExprKind::Quantity(value, unit) => {
                let is_si = unit.dimension() != Dimension::NONE && Unit::si(unit.dimension()) == Some(*unit);
                if is_si && expected == Expectation::Type {
                    Term::Number(*value)
                } else {
                    Term::Text(super::expression(expr).into())
                }
            }
            ExprKind::Text(text) if expected == Expectation::Nothing => {
                Term::Form(Box::new(Form::Literal(SmolStr::new(braces(text)).into())))
            }
            ExprKind::Text(text) | ExprKind::Plain(text) => Term::Text(escaped(&braces(text))),
            ExprKind::Template(parts) => Term::Text(escaped(&template(parts))),
            ExprKind::Wrong(text) => Term::Text(escaped(text)),
            ExprKind::Name(bound) if self.scope.contains(bound) => binding(bound),
            ExprKind::Name(plain) => Term::Text(SmolStr::new(braces(plain))),
            ExprKind::Binding(bound) => binding(bound),
            ExprKind::Any => Term::Text("any".into()),
            ExprKind::List(members) => {
                Term::List(members.iter().map(|member| self.value(member, expected).into()).collect())
            }
            ExprKind::Call(_)
            | ExprKind::Field(..)
            | ExprKind::Not(_)
            | ExprKind::All(_)
            | ExprKind::AnyOf(_)
            | ExprKind::Compare(..)
            | ExprKind::Arith(..) => self.form(expr, ExprPosition::Term),
        }
    }

    /// An expression that is an object in JSON; a literal is [`Self::term`]'s.
    fn form(&mut self, expr: &Expr, kind: ExprPosition) -> Term {
        let form = match &expr.kind {
            ExprKind::Call(call) if call.is_pose() => {
                Form::Pose(call.args.iter().map(|arg| self.term(&arg.value).into()).collect())
            }
            ExprKind::Call(call) => {
                let is_of_list = matches!(call.name.text.as_str(), "count" | "first" | "is_empty");
                let expected = if is_of_list { Expectation::Nothing } else { Expectation::Type };
                let (head, args) = (name(&call.name), self.args_with(call, expected));
                match kind {
                    ExprPosition::Condition => Form::Is(Is { is: head, args }),
                    ExprPosition::Term => Form::Get(Get { get: head, args, is: None, than: None }),
                }
            }
            ExprKind::Field(of, field) => {
                let (field, of) = (name(field), self.untyped(of).into());
                Form::Field(Field { field, of, is: None, than: None })
            }
            ExprKind::Not(inner) => Form::Not(self.condition(inner)),
            ExprKind::All(members) => Form::All(self.conditions(members)),
            ExprKind::AnyOf(members) => Form::Any(self.conditions(members)),
            ExprKind::Compare(op, left, right) => {
                let is_plain = matches!(&left.kind, ExprKind::Name(name) if !self.scope.contains(name));
                let right =
                    if left.shows_no_type() || is_plain { self.untyped(right) } else { self.term(right) };
                let pair = [self.term(left).into(), right.into()];
                match op {
                    CompareOp::Equal => Form::Equal(pair),
                    CompareOp::Unequal => Form::Unequal(pair),
                    CompareOp::Less => Form::Less(pair),
                    CompareOp::AtMost => Form::AtMost(pair),
                    CompareOp::More => Form::More(pair),
                    CompareOp::AtLeast => Form::AtLeast(pair),
                }
            }
            ExprKind::Arith(op, left, right) => {
                let pair = [self.untyped(left).into(), self.untyped(right).into()];
                match op {
                    crate::ast::ArithOp::Add => Form::Add(pair),
                    crate::ast::ArithOp::Subtract => Form::Subtract(pair),
                    crate::ast::ArithOp::Multiply => Form::Multiply(pair),
                    crate::ast::ArithOp::Divide => Form::Divide(pair),
                }
            }
            _ => return self.term(expr),
        };
        Term::Form(Box::new(form))
    }

    fn conditions(&mut self, members: &[Expr]) -> Vec<Condition> {
        members.iter().map(|member| self.condition(member)).collect()
    }

    fn args(&mut self, call: &Call) -> Args {
        self.args_with(call, Expectation::Type)
    }

    fn args_with(&mut self, call: &Call, expected: Expectation) -> Args {
        let args = call.args.iter().enumerate().map(|(index, arg)| {
            let key =
                arg.name.as_ref().map_or_else(|| format_smolstr!("arg{}", index + 1), |key| key.text.clone());
            (Spanned::from(key), Spanned::from(self.value(&arg.value, expected)))
        });
        Args(args.collect())
    }
}

/// Expectation at the place of a term.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Expectation {
    /// A type, by the parameter or by the other side of a comparison.
    Type,
    Nothing,
}

/// Checks if a call in an expression has an argument without a name.
fn has_unnamed(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Call(call) if call.is_pose() => call.args.iter().any(|arg| has_unnamed(&arg.value)),
        ExprKind::Call(call) => call.args.iter().any(|arg| arg.name.is_none() || has_unnamed(&arg.value)),
        ExprKind::Not(inner) | ExprKind::Field(inner, _) => has_unnamed(inner),
        ExprKind::All(members) | ExprKind::AnyOf(members) | ExprKind::List(members) => {
            members.iter().any(has_unnamed)
        }
        ExprKind::Compare(_, left, right) | ExprKind::Arith(_, left, right) => {
            has_unnamed(left) || has_unnamed(right)
        }
        _ => false,
    }
}

/// Position of an expression: a call is a fluent in a condition and a measure in a term.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ExprPosition {
    Condition,
    Term,
}

/// A bound name as a whole condition: a string in the text syntax, with back-quotes where it needs them.
fn lone_binding(bound: &str) -> Term {
    Term::Text(format_smolstr!("${}", spelled(bound)))
}

fn binding(bound: &SmolStr) -> Term {
    Term::Text(format_smolstr!("${bound}"))
}

/// A text that begins with `$` is written with two.
fn escaped(text: &str) -> SmolStr {
    if text.starts_with('$') { format_smolstr!("${text}") } else { SmolStr::new(text) }
}

/// Values that end before this column stay on their line.
const WIDTH: usize = 100;

/// A value and a line break. Keys keep their order.
fn pretty(value: &Value) -> String {
    let mut text = String::new();
    broken(&mut text, value, 0, 0);
    text.push('\n');
    text
}

/// A value on one line, without a line break.
fn one_line(value: &Value) -> String {
    let mut text = String::new();
    flat(&mut text, value, usize::MAX);
    text
}

/// Appends a value; `used` columns of the line are taken, and `after` are needed behind it. The outermost is
/// always broken.
fn fitting(text: &mut String, value: &Value, indent: usize, used: usize, after: usize) {
    let before = text.len();
    let room = WIDTH.saturating_sub(used + after);
    if !flat(text, value, before + 4 * room)
        || text.get(before..).is_some_and(|line| line.chars().count() > room)
    {
        text.truncate(before);
        broken(text, value, indent, after);
    }
}

/// Appends a value on one line; `false`, and a useless text, where it is longer than `limit` bytes of text.
fn flat(text: &mut String, value: &Value, limit: usize) -> bool {
    match value {
        Value::Null | Value::Bool(_) | Value::Number(_) | Value::String(_) => {
            text.push_str(&escaped_json(&value.to_string()))
        }
        Value::Array(members) => {
            text.push('[');
            for (index, member) in members.iter().enumerate() {
                text.push_str(if index > 0 { ", " } else { "" });
                if !flat(text, member, limit) {
                    return false;
                }
            }
            text.push(']');
        }
        Value::Object(members) => {
            text.push('{');
            for (index, (key, member)) in members.iter().enumerate() {
                text.push_str(if index > 0 { ", " } else { "" });
                push_key(text, key);
                if !flat(text, member, limit) {
                    return false;
                }
            }
            text.push('}');
        }
    }
    text.len() <= limit
}

/// Appends a container with a member a line; a scalar, or an empty container, as it is.
fn broken(text: &mut String, value: &Value, indent: usize, after: usize) {
    let inner = indent + 2;
    match value {
        Value::Array(members) if !members.is_empty() => {
            text.push('[');
            for (index, member) in members.iter().enumerate() {
                new_line(text, index > 0, inner);
                let is_last = index + 1 == members.len();
                fitting(text, member, inner, inner, usize::from(!is_last));
            }
            text.push('\n');
            spaces(text, indent);
            text.push(']');
        }
        Value::Object(members) if !members.is_empty() => {
            text.push('{');
            for (index, (key, member)) in members.iter().enumerate() {
                new_line(text, index > 0, inner);
                push_key(text, key);
                let is_last = index + 1 == members.len();
                fitting(text, member, inner, inner + key.chars().count() + 4, usize::from(!is_last));
            }
            text.push('\n');
            spaces(text, indent);
            text.push('}');
        }
        Value::Array(_)
        | Value::Object(_)
        | Value::Null
        | Value::Bool(_)
        | Value::Number(_)
        | Value::String(_) => {
            let limit = text.len() + after;
            flat(text, value, limit);
        }
    }
}

fn push_key(text: &mut String, key: &str) {
    text.push_str(&escaped_json(&Value::from(key).to_string()));
    text.push_str(": ");
}

fn new_line(text: &mut String, has_comma: bool, indent: usize) {
    text.push_str(if has_comma { ",\n" } else { "\n" });
    spaces(text, indent);
}

fn spaces(text: &mut String, count: usize) {
    for _ in 0..count {
        text.push(' ');
    }
}
