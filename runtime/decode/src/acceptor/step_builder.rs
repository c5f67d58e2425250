//! Builds syntax trees from the events of a machine, also of steps that are not whole.
//!
//! Open parts are closed in the way that refutes least: every open block ends with `fail`, so no path leads
//! out of it. A cleanup cannot fail: there an open block ends where it is.

use motet_compiler::incremental::{CHOICE, PROGRAM_POINT};
use motet_compiler::signature::Type;
use motet_syntax::Span;
use motet_syntax::ast::{
    Block, Call, Catch, CatchOn, Do, End, EndKind, Expr, ExprKind, Keep, KeepKind, Manner, Name, Reaction,
    Step, StepKind, When,
};
use smol_str::SmolStr;

use super::event_log::{Arenas, Event};
use super::syntax_node::{argument, end, expr, fail, named, number, of_list, pose, step, written};
use crate::automaton::{Automaton, Meaning, Op};
use crate::grammar::{Constant, LetValue, NodeKind, Relation};
use crate::subset::{Decimal, Modifiers};

/// A reader of events.
pub(crate) struct Builder<'a> {
    pub(crate) automaton: &'a Automaton,
    pub(crate) arenas: &'a Arenas,
    /// The bytes of the policy, which text and name events refer to.
    pub(crate) bytes: &'a [u8],
    pub(crate) events: &'a [Event],
    /// The steps of which any may stand in the hole; if empty, it stays a hole.
    pub(crate) choice: &'a [Step],
    /// The steps of a cleanup are being read.
    pub(crate) in_cleanup: bool,
}

impl Builder<'_> {
    pub(crate) fn next(&mut self) -> Option<Event> {
        let (first, rest) = self.events.split_first()?;
        self.events = rest;
        Some(*first)
    }

    fn peek(&self) -> Option<Event> {
        self.events.first().copied()
    }

    /// Skips the end of a node, if it is there.
    fn close(&mut self) {
        if self.peek() == Some(Event::Close) {
            self.next();
        }
    }

    /// Reads a step.
    pub(crate) fn step(&mut self) -> Option<Step> {
        let kind = match self.next()? {
            Event::Hole if self.choice.is_empty() => {
                return Some(Step { kind: fail().kind, span: PROGRAM_POINT });
            }
            Event::Hole => {
                let body = Block::new(self.choice.to_vec(), Span::default());
                let kind = StepKind::Sequence { name: named(SmolStr::new_static("_")), body };
                return Some(Step { kind, span: CHOICE });
            }
            Event::Open(NodeKind::Finally) => self.whole(),
            Event::Open(kind) => {
                let kind = self.of_kind(kind);
                self.close();
                self.cleaned(step(kind))
            }
            _ => return None,
        };
        Some(step(kind))
    }

    /// Reads the cleanup of a step, if one follows.
    fn cleaned(&mut self, step: Step) -> StepKind {
        if self.peek() != Some(Event::Open(NodeKind::Finally)) {
            return step.kind;
        }
        self.next();
        let outside = std::mem::replace(&mut self.in_cleanup, true);
        let cleanup = self.rest_of_block();
        self.in_cleanup = outside;
        StepKind::Finally { step: Box::new(step), cleanup }
    }

    /// Reads the body of the policy with its cleanup, behind which the policy is done.
    fn whole(&mut self) -> StepKind {
        let mut steps = Vec::new();
        loop {
            match self.peek() {
                // The end of a step of the body.
                Some(Event::Close) => {
                    self.next();
                }
                None | Some(Event::Open(NodeKind::Finally)) => break,
                Some(_) => match self.step() {
                    Some(step) => steps.push(step),
                    None => break,
                },
            }
        }
        let group = |steps| StepKind::Sequence {
            name: named(SmolStr::new_static("_")),
            body: Block::new(steps, Span::default()),
        };
        let body = self.cleaned(step(group(steps)));
        group(vec![step(body), step(StepKind::End(end(EndKind::Done)))])
    }

    fn of_kind(&mut self, kind: NodeKind) -> StepKind {
        match kind {
            NodeKind::Do(index) => StepKind::Do(self.call(index)),
            NodeKind::Sequence => StepKind::Sequence { name: self.name(), body: self.block() },
            NodeKind::If => {
                let condition = self.condition();
                let (then, otherwise) = (self.block(), Some(self.block()));
                StepKind::If { condition, then, otherwise }
            }
            NodeKind::Delay => StepKind::Delay { time: self.number().unwrap_or_else(|| number(0.0)) },
            NodeKind::Within => {
                let time = self.number().unwrap_or_else(|| number(1.0));
                StepKind::Within { time, body: self.block() }
            }
            NodeKind::Keep => StepKind::Keep { keeps: self.keeps(), body: self.block() },
            NodeKind::Let(value) => {
                let value = self.named_value(value);
                StepKind::Let { name: self.name(), value }
            }
            NodeKind::Wait => {
                let condition = self.condition();
                StepKind::Wait { condition, within: self.modifier() }
            }
            NodeKind::Monitor => {
                let mut whens = Vec::new();
                while self.peek() == Some(Event::Open(NodeKind::When)) {
                    self.next();
                    whens.push(self.when());
                    self.close();
                }
                StepKind::Monitor { whens, body: self.block() }
            }
            NodeKind::Try => {
                let body = self.block();
                let mut catches = Vec::new();
                while self.peek() == Some(Event::Open(NodeKind::Catch)) {
                    self.next();
                    catches.push(self.catch());
                    self.close();
                }
                if catches.is_empty() {
                    let body = self.closed(Vec::new());
                    let on = CatchOn::Any(Span::default());
                    catches.push(Catch { on, bind: None, body, span: Span::default() });
                }
                StepKind::Try { body, catches }
            }
            NodeKind::Repeat => {
                let times = self.number().unwrap_or_else(|| number(1.0));
                let body = self.block();
                let until = match self.peek() {
                    Some(Event::Open(_)) => Some(self.condition()),
                    Some(Event::Constant(_)) => {
                        self.next();
                        None
                    }
                    _ => None,
                };
                StepKind::Repeat { times, body, until }
            }
            NodeKind::Each => {
                let item = self.name();
                let list = self.value().unwrap_or_else(|| expr(ExprKind::List(Vec::new())));
                let at_most = self.number().unwrap_or_else(|| number(1.0));
                StepKind::Each { item, list, at_most, body: self.block() }
            }
            NodeKind::Parallel => {
                let mut branches = Vec::new();
                while self.peek() == Some(Event::Open(NodeKind::Block)) {
                    branches.push(self.block());
                }
                while branches.len() < 2 {
                    branches.push(self.closed(Vec::new()));
                }
                StepKind::Parallel { branches }
            }
            NodeKind::Done => StepKind::End(self.end(EndKind::Done)),
            NodeKind::Fail => StepKind::End(self.end(EndKind::Fail)),
            NodeKind::Cannot => StepKind::End(self.end(EndKind::Cannot)),
            NodeKind::Replan => StepKind::End(self.end(EndKind::Replan)),
            // Not steps.
            _ => fail().kind,
        }
    }

    /// Reads a block; one that is open or missing is closed.
    fn block(&mut self) -> Block {
        if self.peek() != Some(Event::Open(NodeKind::Block)) {
            return self.closed(Vec::new());
        }
        self.next();
        self.rest_of_block()
    }

    fn rest_of_block(&mut self) -> Block {
        let mut steps = Vec::new();
        loop {
            match self.peek() {
                Some(Event::Close) => {
                    self.next();
                    return Block::new(steps, Span::default());
                }
                None => return self.closed(steps),
                Some(_) => match self.step() {
                    Some(step) => steps.push(step),
                    None => return self.closed(steps),
                },
            }
        }
    }

    /// A block that no path leaves: it ends with `fail`, unless it is one of a cleanup.
    fn closed(&self, mut steps: Vec<Step>) -> Block {
        steps.extend((!self.in_cleanup).then(fail));
        Block::new(steps, Span::default())
    }

    /// Reads the rules of a `keep`.
    pub(crate) fn keeps(&mut self) -> Vec<Keep> {
        let mut keeps = Vec::new();
        while let Some(Event::Open(kind @ (NodeKind::OutOf | NodeKind::Distance))) = self.peek() {
            self.next();
            let to = self.value().unwrap_or_else(|| expr(ExprKind::Any));
            let kind = match kind {
                NodeKind::OutOf => KeepKind::OutOf(to),
                _ => KeepKind::Distance { to, at_least: self.number().unwrap_or_else(|| number(0.0)) },
            };
            self.close();
            keeps.push(Keep { kind, span: Span::default() });
        }
        keeps
    }

    /// Reads the value of a `let`.
    fn named_value(&mut self, value: LetValue) -> Expr {
        match value {
            LetValue::Count => self.of_list("count"),
            LetValue::First => self.of_list("first"),
            LetValue::Get(index) => {
                let measure = self.automaton.signatures.measures.get(usize::from(index));
                let measure = measure.map(|measure| (&measure.name, measure.params.as_slice()));
                expr(ExprKind::Call(self.applied(measure)))
            }
            LetValue::Field(index) => expr(self.field(index)),
            LetValue::CaughtText => expr(self.field_named(SmolStr::new_static("text"))),
        }
    }

    /// Reads a list and applies a term to it.
    fn of_list(&mut self, term: &'static str) -> Expr {
        let list = self.value().unwrap_or_else(|| expr(ExprKind::Any));
        expr(ExprKind::Call(of_list(term, list)))
    }

    fn field(&mut self, index: u16) -> ExprKind {
        let field = self.automaton.signatures.fields.get(usize::from(index));
        self.field_named(field.map(|field| field.name.clone()).unwrap_or_default())
    }

    fn field_named(&mut self, name: SmolStr) -> ExprKind {
        let of = self.value().unwrap_or_else(|| expr(ExprKind::Any));
        ExprKind::Field(Box::new(of), named(name))
    }

    fn call(&mut self, index: u16) -> Do {
        let callable = self.automaton.signatures.callables.get(usize::from(index));
        let mut args = Vec::new();
        for param in callable.map(|callable| callable.params.as_slice()).unwrap_or_default() {
            let Some(value) = self.value() else { break };
            args.push(argument(&param.name, value));
        }
        let is_policy = callable.is_some_and(|callable| callable.is_policy);
        let manner = if callable.is_some_and(|callable| callable.moves) { self.manner() } else { None };
        let (within, retry) = if is_policy { (None, None) } else { (self.modifier(), self.modifier()) };
        let bind = matches!(self.peek(), Some(Event::Name(..))).then(|| self.name());
        let name = callable.map(|callable| callable.name.clone()).unwrap_or_default();
        Do { call: Call { name: named(name), args, span: Span::default() }, bind, manner, within, retry }
    }

    /// Reads a manner, if the subset has them.
    fn manner(&mut self) -> Option<Manner> {
        let manner = match self.peek() {
            Some(Event::Constant(Constant::Slowly)) => Some(Manner::Slowly(Span::default())),
            Some(Event::Constant(Constant::Gently)) => Some(Manner::Gently(Span::default())),
            Some(Event::Number(units, decimals)) if self.automaton.subset.modifiers == Modifiers::Written => {
                Some(Manner::At(number(Decimal { units, decimals }.value()), Span::default()))
            }
            _ => None,
        };
        let is_written = self.automaton.subset.modifiers == Modifiers::Written;
        if manner.is_some() || is_written && self.peek() == Some(Event::Constant(Constant::Null)) {
            self.next();
        }
        manner
    }

    /// Reads a deadline or retries, if the subset has them.
    fn modifier(&mut self) -> Option<Expr> {
        if self.automaton.subset.modifiers == Modifiers::Default {
            return None;
        }
        match self.peek() {
            Some(Event::Constant(Constant::Null)) => {
                self.next();
                None
            }
            _ => self.number(),
        }
    }

    fn number(&mut self) -> Option<Expr> {
        let Some(Event::Number(units, decimals)) = self.peek() else { return None };
        self.next();
        Some(expr(ExprKind::Number(Decimal { units, decimals }.value())))
    }

    fn name(&mut self) -> Name {
        let Some(Event::Name(start, len)) = self.peek() else { return named(SmolStr::new_static("_")) };
        self.next();
        named(self.text(start, len))
    }

    fn text(&self, start: u32, len: u32) -> SmolStr {
        let bytes = self.bytes.get(start as usize..).and_then(|rest| rest.get(..len as usize));
        SmolStr::new(String::from_utf8_lossy(bytes.unwrap_or_default()))
    }

    /// Reads a value, if one is there.
    fn value(&mut self) -> Option<Expr> {
        let kind = match self.peek()? {
            Event::Word(op, index) => {
                let Op::Word(words) = self.automaton.op(op) else { return None };
                let entry = words.table.get(index)?;
                match entry.meaning {
                    Meaning::Any => ExprKind::Any,
                    meaning => ExprKind::Plain(
                        meaning.name(&self.automaton.signatures).unwrap_or_else(|| entry.name.clone()),
                    ),
                }
            }
            Event::Bound(id) => {
                let name = self.arenas.name(id)?;
                ExprKind::Binding(self.text(name.start, name.len))
            }
            Event::First(id) => {
                let name = self.arenas.name(id)?;
                let list = expr(ExprKind::Binding(self.text(name.start, name.len)));
                ExprKind::Call(of_list("first", list))
            }
            Event::Text(start, len) => written(self.text(start, len)),
            Event::AnyText => ExprKind::Plain(SmolStr::new_static("~")),
            Event::Number(units, decimals) => ExprKind::Number(Decimal { units, decimals }.value()),
            Event::Constant(Constant::True) => ExprKind::Bool(true),
            Event::Constant(Constant::False) => ExprKind::Bool(false),
            Event::Open(NodeKind::Pose) => {
                self.next();
                let numbers = [(); 4].map(|()| self.number().unwrap_or_else(|| number(0.0)));
                self.close();
                return Some(expr(ExprKind::Call(pose(numbers))));
            }
            Event::Open(NodeKind::List) => {
                self.next();
                let mut items = Vec::new();
                while let Some(item) = self.value() {
                    items.push(item);
                }
                self.close();
                return Some(expr(ExprKind::List(items)));
            }
            Event::Constant(Constant::Null | Constant::Slowly | Constant::Gently)
            | Event::Open(_)
            | Event::Close
            | Event::Name(..)
            | Event::Joined(_)
            | Event::Hole => return None,
        };
        self.next();
        Some(expr(kind))
    }

    /// Reads a condition; a missing one is `true`.
    pub(crate) fn condition(&mut self) -> Expr {
        let first = self.primary();
        let Some(Event::Joined(kind)) = self.peek() else { return first };
        let mut parts = vec![first];
        while let Some(Event::Joined(_)) = self.peek() {
            self.next();
            parts.push(self.primary());
        }
        expr(if kind == NodeKind::Any { ExprKind::AnyOf(parts) } else { ExprKind::All(parts) })
    }

    /// Reads a condition without those joined to it.
    fn primary(&mut self) -> Expr {
        let Some(Event::Open(kind)) = self.peek() else { return expr(ExprKind::Bool(true)) };
        let kind = match kind {
            NodeKind::Is(index) => {
                self.next();
                let fluent = self.automaton.signatures.fluents.get(usize::from(index));
                let fluent = fluent.map(|fluent| (&fluent.name, fluent.params.as_slice()));
                ExprKind::Call(self.applied(fluent))
            }
            NodeKind::Not => {
                self.next();
                ExprKind::Not(Box::new(self.condition()))
            }
            NodeKind::All => {
                self.next();
                ExprKind::All(self.conditions())
            }
            NodeKind::Any => {
                self.next();
                ExprKind::AnyOf(self.conditions())
            }
            NodeKind::Get(index) => {
                self.next();
                let measure = self.automaton.signatures.measures.get(usize::from(index));
                let measure = measure.map(|measure| (&measure.name, measure.params.as_slice()));
                let call = self.applied(measure);
                self.comparison(ExprKind::Call(call))
            }
            NodeKind::Field(index) => {
                self.next();
                let field = self.field(index);
                self.comparison(field)
            }
            NodeKind::Caught => {
                self.next();
                let kind = self.field_named(SmolStr::new_static("kind"));
                self.comparison(kind)
            }
            NodeKind::Count => {
                self.next();
                let count = self.of_list("count");
                self.comparison(count.kind)
            }
            NodeKind::IsEmpty => {
                self.next();
                self.of_list("is_empty").kind
            }
            NodeKind::Group => {
                self.next();
                let inner = self.condition();
                self.close();
                return inner;
            }
            _ => return expr(ExprKind::Bool(true)),
        };
        self.close();
        expr(kind)
    }

    fn conditions(&mut self) -> Vec<Expr> {
        let mut parts = Vec::new();
        while matches!(self.peek(), Some(Event::Open(_))) {
            parts.push(self.condition());
        }
        parts
    }

    /// Reads the arguments of a fluent or a measure.
    fn applied(&mut self, signature: Option<(&SmolStr, &[(SmolStr, Type)])>) -> Call {
        let mut args = Vec::new();
        for (param, _) in signature.map(|(_, params)| params).unwrap_or_default() {
            let Some(value) = self.value() else { break };
            args.push(argument(param, value));
        }
        let name = signature.map(|(name, _)| name.clone()).unwrap_or_default();
        Call { name: named(name), args, span: Span::default() }
    }

    fn comparison(&mut self, subject: ExprKind) -> ExprKind {
        let relation = match self.peek() {
            Some(Event::Word(op, index)) => {
                self.next();
                match self.automaton.op(op) {
                    Op::Word(words) => words.table.get(index).map(|entry| entry.meaning),
                    _ => None,
                }
            }
            _ => None,
        };
        let place = if let Some(Meaning::Named(place)) = relation { usize::from(place) } else { 0 };
        let op = Relation::ALL.get(place).map_or(motet_syntax::ast::CompareOp::Equal, |relation| relation.0);
        let than = self.value().unwrap_or_else(|| number(0.0));
        ExprKind::Compare(op, Box::new(expr(subject)), Box::new(than))
    }

    fn when(&mut self) -> When {
        let condition = self.condition();
        let hold = match self.peek() {
            Some(Event::Constant(Constant::Null)) => {
                self.next();
                None
            }
            _ => self.number(),
        };
        let span = Span::default();
        let Some(Event::Open(kind)) = self.peek() else {
            return When { condition, hold, reaction: Reaction::End(end(EndKind::Fail)), span };
        };
        self.next();
        let count = |count: Option<Expr>| count.unwrap_or_else(|| number(1.0));
        let reaction = match kind {
            NodeKind::Pause => Reaction::Pause { within: self.modifier(), span },
            NodeKind::Restart => Reaction::Restart { at_most: count(self.number()), span },
            NodeKind::Resume => {
                let at_most = count(self.number());
                Reaction::Resume { at_most, body: self.block(), span }
            }
            NodeKind::Done => Reaction::End(self.end(EndKind::Done)),
            NodeKind::Cannot => Reaction::End(self.end(EndKind::Cannot)),
            NodeKind::Replan => Reaction::End(self.end(EndKind::Replan)),
            _ => Reaction::End(self.end(EndKind::Fail)),
        };
        self.close();
        When { condition, hold, reaction, span }
    }

    fn catch(&mut self) -> Catch {
        let mut on = CatchOn::Kinds(Vec::new());
        if self.peek() == Some(Event::Open(NodeKind::List)) {
            self.next();
            while let Some(value) = self.value() {
                match (value.kind, &mut on) {
                    (ExprKind::Plain(name), CatchOn::Kinds(kinds)) => kinds.push(named(name)),
                    _ => on = CatchOn::Any(Span::default()),
                }
            }
            self.close();
        }
        if matches!(&on, CatchOn::Kinds(kinds) if kinds.is_empty()) {
            on = CatchOn::Any(Span::default());
        }
        let bind = matches!(self.peek(), Some(Event::Name(..))).then(|| self.name());
        Catch { on, bind, body: self.block(), span: Span::default() }
    }

    fn end(&mut self, kind: EndKind) -> End {
        match kind {
            EndKind::Done => End { result: self.value(), ..end(kind) },
            EndKind::Fail | EndKind::Cannot | EndKind::Replan => {
                End { why: self.value().or(end(kind).why), ..end(kind) }
            }
        }
    }
}
