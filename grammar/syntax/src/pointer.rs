//! JSON Pointers into a policy, whichever syntax it was read from: a diagnostic of any stage names its node
//! in the JSON syntax it belongs.

use smol_str::SmolStr;

use crate::ast::{
    Arg, Block, Call, End, Expr, ExprKind, Keep, KeepKind, Manner, Policy, Reaction, Step, StepKind,
    TypeExpr, When,
};
use crate::located::push_token;
use crate::source::Span;

/// The pointer of the innermost step, argument or condition that contains the span, such as
/// `/steps/2/try/0/object`; empty where none does. `parameter` names the parameter of a primitive or policy
/// at a position, from 0, for arguments without a name; such an argument has the pointer of its call where
/// there is none. O(nodes on the way).
///
/// ```
/// use motet_syntax::{FileId, Source, Span, pointer, read};
///
/// let text = "policy p { go(table) done }";
/// let policy = read(&Source::new("p.motet", text), FileId(0)).file.policies().next().cloned().unwrap();
/// let table = Span::new(FileId(0), 14, 19);
/// let parameter = |_: &str, _: usize| Some("to".into());
/// assert_eq!(pointer::pointer_to(&policy, table, &parameter), "/steps/0/to");
/// ```
#[must_use]
pub fn pointer_to(policy: &Policy, span: Span, parameter: &dyn Fn(&str, usize) -> Option<SmolStr>) -> String {
    let mut walk = PointerWalk { span, parameter, pointer: String::new() };
    if let Some(goal) = &policy.achieves {
        walk.expr("achieves", goal);
    }
    let _ = walk.name("result", policy.result.as_ref().map(TypeExpr::span));
    let _ = walk.keeps(&policy.keeps)
        || walk.block("steps", &policy.body)
        || policy.cleanup.as_ref().is_some_and(|cleanup| walk.block("finally", cleanup));
    walk.pointer
}

struct PointerWalk<'a> {
    span: Span,
    parameter: &'a dyn Fn(&str, usize) -> Option<SmolStr>,
    pointer: String,
}

/// Each method appends its key and goes on inside, if its node contains the span, and returns true if it did.
impl PointerWalk<'_> {
    fn key(&mut self, key: &str) {
        push_token(&mut self.pointer, key);
    }

    fn index(&mut self, index: usize) {
        push_token(&mut self.pointer, &index.to_string());
    }

    fn block(&mut self, key: &str, block: &Block) -> bool {
        let steps = &block.steps;
        // Steps stand in the order of the text, so the first that does not end before the span is the only
        // candidate.
        let index = steps.partition_point(|step| step.span.end < self.span.end);
        let Some(step) = steps.get(index).filter(|step| step.span.contains(self.span)) else { return false };
        self.key(key);
        self.index(written_index(block, index));
        self.step(step);
        true
    }

    fn step(&mut self, step: &Step) {
        match &step.kind {
            StepKind::Do(step) => {
                let _ = self.args(&step.call)
                    || self.positional(&step.call)
                    || self.name("manner", step.manner.as_ref().map(Manner::span))
                    || self.optional("within", step.within.as_ref())
                    || self.optional("retry", step.retry.as_ref())
                    || self.name("as", step.bind.as_ref().map(|name| name.span))
                    || self.name("do", Some(step.call.name.span));
            }
            StepKind::Let { name, value } => {
                let _ = self.expr("be", value) || self.name("let", Some(name.span));
            }
            StepKind::Sequence { name, body } => {
                let _ = self.block("steps", body) || self.name("sequence", Some(name.span));
            }
            StepKind::If { condition, then, otherwise } => {
                let _ = self.expr("if", condition)
                    || self.block("then", then)
                    || otherwise.as_ref().is_some_and(|block| self.block("else", block));
            }
            StepKind::Wait { condition, within } => {
                let _ = self.expr("wait", condition) || self.optional("within", within.as_ref());
            }
            StepKind::Delay { time } => {
                let _ = self.expr("wait", time);
            }
            StepKind::Within { time, body } => {
                let _ = self.expr("within", time) || self.block("steps", body);
            }
            StepKind::Finally { step, cleanup } => {
                if !self.block("finally", cleanup) {
                    self.step(step);
                }
            }
            StepKind::Monitor { whens, body } => {
                let _ = self.whens(whens) || self.block("during", body);
            }
            StepKind::Try { body, catches } => {
                if self.block("try", body) {
                    return;
                }
                if let Some(index) = catches.iter().position(|catch| catch.span.contains(self.span)) {
                    self.key("catch");
                    self.index(index);
                    let _ = catches.get(index).is_some_and(|catch| {
                        self.block("steps", &catch.body)
                            || self.name("as", catch.bind.as_ref().map(|name| name.span))
                    });
                }
            }
            StepKind::Repeat { times, body, until } => {
                let _ = self.expr("repeat", times)
                    || self.block("steps", body)
                    || self.optional("until", until.as_ref());
            }
            StepKind::Each { item, list, at_most, body } => {
                let _ = self.name("each", Some(item.span))
                    || self.expr("in", list)
                    || self.expr("at_most", at_most)
                    || self.block("steps", body);
            }
            StepKind::Keep { keeps, body } => {
                let _ = self.keeps(keeps) || self.block("steps", body);
            }
            StepKind::Parallel { branches } => self.group("parallel", |walk| {
                let _ =
                    branches.iter().enumerate().any(|(index, branch)| walk.block(&index.to_string(), branch));
            }),
            StepKind::End(end) => self.end(end),
        }
    }

    fn keeps(&mut self, keeps: &[Keep]) -> bool {
        let Some(index) = keeps.iter().position(|keep| keep.span.contains(self.span)) else { return false };
        self.key("keep");
        self.index(index);
        let _ = keeps.get(index).is_some_and(|keep| match &keep.kind {
            KeepKind::OutOf(zone) => self.expr("out_of", zone),
            KeepKind::Distance { to, at_least } => {
                self.expr("distance", to) || self.expr("at_least", at_least)
            }
        });
        true
    }

    fn whens(&mut self, whens: &[When]) -> bool {
        let Some(index) = whens.iter().position(|when| when.span.contains(self.span)) else { return false };
        let Some(when) = whens.get(index) else { return false };
        self.key("monitor");
        self.index(index);
        let _ = self.expr("when", &when.condition) || self.optional("for", when.hold.as_ref()) || {
            let span = reaction_span(&when.reaction);
            span.contains(self.span) && {
                self.key("then");
                self.reaction(&when.reaction);
                true
            }
        };
        true
    }

    fn reaction(&mut self, reaction: &Reaction) {
        match reaction {
            Reaction::Pause { within, .. } => {
                self.optional("within", within.as_ref());
            }
            Reaction::Restart { at_most, .. } => {
                self.expr("at_most", at_most);
            }
            Reaction::Resume { at_most, body, .. } => {
                let _ = self.expr("at_most", at_most) || self.block("steps", body);
            }
            Reaction::End(end) => self.end(end),
        }
    }

    fn end(&mut self, end: &End) {
        let _ = self.optional("result", end.result.as_ref()) || self.optional("why", end.why.as_ref());
    }

    fn name(&mut self, key: &str, span: Option<Span>) -> bool {
        let is_there = span.is_some_and(|span| span.contains(self.span));
        if is_there {
            self.key(key);
        }
        is_there
    }

    fn optional(&mut self, key: &str, expr: Option<&Expr>) -> bool {
        expr.is_some_and(|expr| self.expr(key, expr))
    }

    fn args(&mut self, call: &Call) -> bool {
        for arg in &call.args {
            let Some(name) = arg.name.as_ref().filter(|_| arg.span.contains(self.span)) else { continue };
            if !self.expr(&name.text, &arg.value) {
                self.key(&name.text);
            }
            return true;
        }
        false
    }

    /// An argument without a name.
    fn positional(&mut self, call: &Call) -> bool {
        let contains = |arg: &Arg| arg.name.is_none() && arg.span.contains(self.span);
        let Some(position) = call.args.iter().position(contains) else { return false };
        let (Some(arg), Some(name)) = (call.args.get(position), (self.parameter)(&call.name.text, position))
        else {
            return false;
        };
        self.expr(&name, &arg.value)
    }

    fn expr(&mut self, key: &str, expr: &Expr) -> bool {
        if !expr.span.contains(self.span) {
            return false;
        }
        self.key(key);
        match &expr.kind {
            ExprKind::Bool(_)
            | ExprKind::Number(_)
            | ExprKind::Quantity(..)
            | ExprKind::Text(_)
            | ExprKind::Template(_)
            | ExprKind::Name(_)
            | ExprKind::Binding(_)
            | ExprKind::Plain(_)
            | ExprKind::Wrong(_)
            | ExprKind::Any => {}
            ExprKind::List(members) => self.members(members),
            ExprKind::Call(call) => {
                self.args(call);
            }
            ExprKind::Field(inner, _) => {
                self.expr("of", inner);
            }
            ExprKind::Not(inner) => {
                self.expr("not", inner);
            }
            ExprKind::All(members) => {
                self.group("all", |walk| walk.members(members));
            }
            ExprKind::AnyOf(members) => {
                self.group("any", |walk| walk.members(members));
            }
            // Written in one object, the value has the object's place.
            ExprKind::Compare(_, left, right) if left.span == expr.span => {
                if !self.expr("than", right) {
                    match &left.kind {
                        ExprKind::Call(call) => {
                            self.args(call);
                        }
                        ExprKind::Field(of, _) => {
                            self.expr("of", of);
                        }
                        _ => {}
                    }
                }
            }
            ExprKind::Compare(op, left, right) => {
                self.group(op.key(), |walk| {
                    let _ = walk.expr("0", left) || walk.expr("1", right);
                });
            }
            ExprKind::Arith(op, left, right) => {
                self.group(op.key(), |walk| {
                    let _ = walk.expr("0", left) || walk.expr("1", right);
                });
            }
        }
        true
    }

    fn members(&mut self, members: &[Expr]) {
        // They stand in order, as the steps of a block do.
        let index = members.partition_point(|member| member.span.end < self.span.end);
        let _ = members.get(index).is_some_and(|member| self.expr(&index.to_string(), member));
    }

    /// A key whose value is only pointed into: without a member that contains the span it is left out again.
    fn group(&mut self, key: &str, inside: impl FnOnce(&mut Self)) {
        let before = self.pointer.len();
        self.key(key);
        let with_key = self.pointer.len();
        inside(self);
        if self.pointer.len() == with_key {
            self.pointer.truncate(before);
        }
    }
}

/// Position of a step in its list as it is written, with what could not be read before it.
fn written_index(block: &Block, mut index: usize) -> usize {
    for gap in &block.gaps {
        index += usize::from(usize::try_from(*gap).is_ok_and(|gap| gap <= index));
    }
    index
}

fn reaction_span(reaction: &Reaction) -> Span {
    match reaction {
        Reaction::Pause { span, .. } | Reaction::Restart { span, .. } | Reaction::Resume { span, .. } => {
            *span
        }
        Reaction::End(end) => end.span,
    }
}
