//! Decorators that repeat, retry and limit, and nodes that run at once.

use motet_syntax::Span;
use motet_syntax::ast::{Name, Step, StepKind};
use roxmltree::Node;

use super::document::{elements, kind};
use super::scope::pointer;
use super::step::{attempt, branch, catch_any, step};
use super::value::number;
use super::{Around, Context, Reader};
use crate::leaves::PortType;
use crate::names::{COUNT, IS, OF, THAN};

impl<'a, 't> Reader<'_, 'a, 't> {
    pub(super) fn timeout(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &["msec"]);
        let (Some(time), Some(only)) = (self.milliseconds(node, "msec"), self.only(node)) else {
            return Vec::new();
        };
        if self.is_action(only) {
            return self.call(only, context, Around { within: Some(time), retry: None });
        }
        let body = branch(self.node(only, context), span);
        vec![step(StepKind::Within { time, body }, span)]
    }

    pub(super) fn retry(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &["num_attempts"]);
        let (Some(attempts), Some(only)) = (self.times(node, "num_attempts"), self.only(node)) else {
            return Vec::new();
        };
        let is_once = Context { is_caught: context.is_caught || attempts > 1, ..context.clone() };
        let mut steps = self.node(only, &is_once);
        if let [Step { kind: StepKind::Do(call), .. }] = steps.as_mut_slice()
            && call.call.name.text != super::NODE_FAILED
            && call.retry.is_none()
        {
            call.retry = (attempts > 1).then(|| number(f64::from(attempts - 1), span));
            return steps;
        }
        // Another attempt is a handler with a copy of the steps.
        let (size, depth) = size(&steps);
        let copies = size.saturating_mul(attempts.saturating_sub(1) as usize);
        if !self.count(copies, span) {
            return Vec::new();
        }
        if context.depth + depth + attempts as usize > super::MAX_DEPTH {
            self.refuse(span, format!("{attempts} attempts of more than an action nest too deep"), None);
            return Vec::new();
        }
        let once = steps.clone();
        for _ in 1..attempts {
            steps = vec![attempt(once.clone(), vec![catch_any(steps, span)], span)];
        }
        steps
    }

    pub(super) fn repeat(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &["num_cycles"]);
        let (Some(times), Some(only)) = (self.times(node, "num_cycles"), self.only(node)) else {
            return Vec::new();
        };
        let body = branch(self.node(only, &context.not_last()), span);
        vec![step(StepKind::Repeat { times: number(f64::from(times), span), body, until: None }, span)]
    }

    fn times(&mut self, node: Node<'a, 't>, port: &str) -> Option<u32> {
        let (text, span) = self.required(node, port)?;
        match text.trim().parse::<i64>() {
            Ok(times @ 1..=1_000_000) => u32::try_from(times).ok(),
            Ok(-1) => {
                let help = "give a number of times".to_owned();
                self.refuse(span, format!("`{}` has no bound", kind(node)), Some(help));
                None
            }
            _ => {
                self.wrong(span, format!("`{text}` is no number from 1 to 1000000"), None);
                None
            }
        }
    }

    /// Checks if nodes are a loop with a test, as the export writes it.
    pub(super) fn is_until(&self, nodes: &[Node<'a, 't>]) -> bool {
        let [set, rounds, test] = nodes else { return false };
        kind(*set) == "SetBlackboard" && kind(*test) == crate::names::VALUE && round(*rounds).is_some()
    }

    pub(super) fn until(&mut self, nodes: &[Node<'a, 't>], context: &Context) -> Vec<Step> {
        let Some((retry, body, test)) = nodes.get(1).and_then(|rounds| round(*rounds)) else {
            return Vec::new();
        };
        let span = self.places.tag(retry);
        let times = self.times(retry, "num_attempts");
        let body = branch(self.node(body, &context.not_last()), span);
        let until = self.condition(test, context);
        let times = times.map(|times| number(f64::from(times), span));
        let kind =
            times.zip(until).map(|(times, until)| StepKind::Repeat { times, body, until: Some(until) });
        kind.map(|kind| step(kind, span)).into_iter().collect()
    }

    /// Bound of a loop over a list that a node tests before it.
    pub(super) fn bound(&self, node: Node<'a, 't>, next: Node<'a, 't>) -> Option<&'a str> {
        let test = match kind(node) {
            "Fallback" => elements(node).first().copied()?,
            _ => node,
        };
        let is_bound = kind(test) == COUNT && test.attribute(IS) == Some("at_most");
        let is_loop = kind(next).starts_with("Loop") && next.attribute("queue") == test.attribute(OF);
        test.attribute(THAN).filter(|_| is_bound && is_loop)
    }

    pub(super) fn each(&mut self, node: Node<'a, 't>, bound: Option<&str>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &["queue", "value"]);
        let (Some(queue), Some(value), Some(only)) =
            (self.required(node, "queue"), self.required(node, "value"), self.only(node))
        else {
            return Vec::new();
        };
        let is_constant = pointer("queue", queue.0).is_none();
        let items = queue.0.split(';').count() as f64;
        let at_most = match bound.map(|bound| bound.trim().parse::<u32>()) {
            Some(Ok(bound)) => f64::from(bound),
            None if is_constant => items,
            _ => {
                let help = format!("put `{COUNT}` with `is=\"at_most\"` before it");
                self.refuse(span, "a loop over an entry has no bound".to_owned(), Some(help));
                return Vec::new();
            }
        };
        let ty = match kind(node) {
            "LoopBool" => PortType::Bool,
            "LoopInt" | "LoopDouble" => PortType::Number,
            _ => self.used_as(only, value.0),
        };
        let list = self.value("queue", queue, &PortType::List(Box::new(ty)), &context.scope);
        let item = self.output("value", value, context);
        let body = branch(self.node(only, &context.not_last()), span);
        let kind = list.zip(item).map(|(list, item)| StepKind::Each {
            item: Name { text: item.text, span: item.span },
            list,
            at_most: number(at_most, span),
            body,
        });
        kind.map(|kind| step(kind, span)).into_iter().collect()
    }

    /// Type of the first port that reads an entry.
    fn used_as(&self, node: Node<'a, 't>, entry: &str) -> PortType {
        let uses = node.descendants().filter(Node::is_element).find_map(|leaf| {
            let action = self.leaves.action(kind(leaf))?;
            let reads = |(port, ty): &(smol_str::SmolStr, PortType)| {
                (leaf.attribute(port.as_str()) == Some(entry)).then(|| ty.clone())
            };
            action.ports.iter().find_map(reads)
        });
        uses.unwrap_or(PortType::Name)
    }

    pub(super) fn parallel(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &["success_count", "failure_count"]);
        let children = elements(node);
        let is_one_of = |port: &str, allowed: &[String]| {
            node.attribute(port).is_none_or(|count| allowed.iter().any(|allowed| allowed == count.trim()))
        };
        let all = ["-1".to_owned(), children.len().to_string()];
        if !is_one_of("success_count", &all) || !is_one_of("failure_count", &["1".to_owned()]) {
            let what = "`Parallel` that does not need all its children to succeed".to_owned();
            self.refuse(span, what, None);
            return Vec::new();
        }
        let inner = context.not_last();
        let branches = children.into_iter().map(|child| (self.places.tag(child), child));
        let branches: Vec<(Span, Node<'a, 't>)> = branches.collect();
        let branches = branches.into_iter().map(|(at, child)| branch(self.node(child, &inner), at)).collect();
        vec![step(StepKind::Parallel { branches }, span)]
    }
}

/// The decorator, the body and the test of a loop with a test.
fn round<'a, 't>(rounds: Node<'a, 't>) -> Option<(Node<'a, 't>, Node<'a, 't>, Node<'a, 't>)> {
    let retry = if kind(rounds) == "Fallback" { elements(rounds).first().copied()? } else { rounds };
    let inner = elements(retry).first().copied()?;
    let children = elements(inner);
    let [body, test, set] = children.as_slice() else { return None };
    let is_loop = kind(retry) == "RetryUntilSuccessful" && kind(inner) == "IfThenElse";
    (is_loop && kind(*set) == "SetBlackboard").then_some((retry, *body, *test))
}

/// Number of steps with those inside, and the depth of their blocks.
fn size(steps: &[Step]) -> (usize, usize) {
    let inside = |step: &Step| -> Vec<(usize, usize)> {
        match &step.kind {
            StepKind::Sequence { body, .. }
            | StepKind::Monitor { body, .. }
            | StepKind::Repeat { body, .. }
            | StepKind::Each { body, .. }
            | StepKind::Within { body, .. }
            | StepKind::Keep { body, .. } => vec![size(&body.steps)],
            StepKind::If { then, otherwise, .. } => [Some(then), otherwise.as_ref()]
                .into_iter()
                .flatten()
                .map(|block| size(&block.steps))
                .collect(),
            StepKind::Try { body, catches } => {
                let handlers = catches.iter().map(|catch| &catch.body);
                std::iter::once(body).chain(handlers).map(|block| size(&block.steps)).collect()
            }
            StepKind::Parallel { branches } => branches.iter().map(|block| size(&block.steps)).collect(),
            StepKind::Finally { step, cleanup } => {
                vec![size(std::slice::from_ref(step)), size(&cleanup.steps)]
            }
            StepKind::Do(_) | StepKind::Let { .. } | StepKind::Wait { .. } | StepKind::Delay { .. } => {
                Vec::new()
            }
            StepKind::End(_) => Vec::new(),
        }
    };
    let parts = steps.iter().map(|step| {
        let inside = inside(step);
        let depth = inside.iter().map(|(_, depth)| depth + 1).max().unwrap_or(1);
        (1 + inside.iter().map(|(count, _)| count).sum::<usize>(), depth)
    });
    parts.fold((0, 0), |(count, deepest), (more, depth)| (count + more, deepest.max(depth)))
}
