//! Nodes as steps that succeed and fail as the nodes do.

use motet_syntax::Span;
use motet_syntax::ast::{
    Block, Catch, CatchOn, End, EndKind, Expr, ExprKind, Reaction, Step, StepKind, When,
};
use motet_syntax::suggest::closest;
use roxmltree::Node;

use super::condition::negated;
use super::document::{elements, kind};
use super::value::expr;
use super::{Around, Context, MAX_DEPTH, Reader};
use crate::names::{ENDINGS, FAILURE, FAILURE_IS, NEEDS};

pub(super) fn step(kind: StepKind, span: Span) -> Step {
    Step { kind, span }
}

pub(super) fn block(steps: Vec<Step>, span: Span) -> Block {
    Block::new(steps, span)
}

pub(super) fn end(end: End) -> Step {
    let span = end.span;
    step(StepKind::End(end), span)
}

/// A `fail` with a reason.
pub(super) fn fail(why: &str, span: Span) -> Step {
    let why = Some(expr(ExprKind::Text(why.into()), span));
    end(End { kind: EndKind::Fail, result: None, why, span })
}

/// A `done`, which ends the policy.
pub(super) fn done(span: Span) -> Step {
    end(End { kind: EndKind::Done, result: None, why: None, span })
}

/// Step that does nothing and takes no time, for a block that must have one: an `else` alone would need a
/// condition whose opposite is known.
fn nothing(span: Span) -> Step {
    step(StepKind::Wait { condition: expr(ExprKind::Bool(true), span), within: None }, span)
}

/// True for a step that does nothing.
fn is_nothing(step: &Step) -> bool {
    matches!(&step.kind, StepKind::Wait { condition, within: None } if condition.kind == ExprKind::Bool(true))
}

/// Block of a branch, with a step in any case.
pub(super) fn branch(mut steps: Vec<Step>, span: Span) -> Block {
    if steps.is_empty() {
        steps.push(nothing(span));
    }
    block(steps, span)
}

/// Block of a handler or an `else`, which may be empty.
fn reaction(mut steps: Vec<Step>, span: Span) -> Block {
    if let [only] = steps.as_slice()
        && is_nothing(only)
    {
        steps.clear();
    }
    block(steps, span)
}

impl<'a, 't> Reader<'_, 'a, 't> {
    /// Steps of a node.
    pub(super) fn node(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        if context.depth > MAX_DEPTH {
            self.refuse(span, format!("nodes are nested more than {MAX_DEPTH} deep"), None);
            return Vec::new();
        }
        if !self.count(1, span) {
            return Vec::new();
        }
        if self.is_condition(node) {
            let condition = self.condition(node, context);
            return condition.map(|condition| self.assertion(condition, span)).unwrap_or_default();
        }
        let inner = context.inner();
        match kind(node) {
            "Sequence" | "AsyncSequence" => {
                self.ports(node, &[]);
                let children = elements(node);
                match self.places.attribute(node, "name") {
                    Some(("until", _)) if self.is_until(&children) => self.until(&children, &inner),
                    Some((name, at)) => {
                        let steps = self.sequence(&children, &inner);
                        let name = motet_syntax::ast::Name { text: name.into(), span: at };
                        vec![step(StepKind::Sequence { name, body: branch(steps, span) }, span)]
                    }
                    None => self.sequence(&children, &inner),
                }
            }
            "Fallback" | "AsyncFallback" => {
                self.ports(node, &[]);
                self.fallback(&elements(node), &inner, span)
            }
            "IfThenElse" => self.branch(node, &inner),
            "ReactiveSequence" | "ReactiveFallback" => self.reactive(node, &inner),
            "Parallel" => self.parallel(node, &inner),
            "Timeout" => self.timeout(node, &inner),
            "RetryUntilSuccessful" => self.retry(node, &inner),
            "Repeat" => self.repeat(node, &inner),
            "LoopString" | "LoopDouble" | "LoopInt" | "LoopBool" => self.each(node, None, &inner),
            "Sleep" => {
                self.ports(node, &["msec"]);
                let time = self.milliseconds(node, "msec");
                time.map(|time| step(StepKind::Delay { time }, span)).into_iter().collect()
            }
            "Delay" => {
                self.ports(node, &["delay_msec"]);
                let time = self.milliseconds(node, "delay_msec");
                let mut steps: Vec<Step> =
                    time.map(|time| step(StepKind::Delay { time }, span)).into_iter().collect();
                if let Some(only) = self.only(node) {
                    steps.extend(self.node(only, &inner));
                }
                steps
            }
            "ForceSuccess" | "ForceFailure" => {
                self.ports(node, &[]);
                let Some(only) = self.only(node) else { return Vec::new() };
                let mut steps = self.forced(only, &inner, span);
                if kind(node) == "ForceFailure" {
                    steps.extend(self.failing(span));
                }
                steps
            }
            "AlwaysSuccess" => Vec::new(),
            "AlwaysFailure" => self.failing(span),
            "SetBlackboard" => self.set(node, context),
            "SubTree" => self.subtree(node, context),
            id if ENDINGS.contains(&id) => self.ending(node, context),
            _ if self.is_action(node) => self.call(node, context, Around::default()),
            id => {
                self.unknown(id, span);
                Vec::new()
            }
        }
    }

    fn unknown(&mut self, id: &str, span: Span) {
        if self.leaves.action(id.strip_prefix(NEEDS).unwrap_or_default()).is_some() {
            let what = format!("`{id}` does not stand before its action with the same ports");
            return self.refuse(span, what, None);
        }
        let reason = match id {
            "Inverter" => "inverts an action: a step cannot succeed because another fails",
            "KeepRunningUntilFailure" => "has no bound",
            "Script" | "ScriptCondition" | "Precondition" => "is a script, which no step has",
            "SequenceWithMemory" => "goes on where it failed, and a step begins anew",
            "ParallelAll" => "does not stop the others when one fails",
            "WhileDoElse" => "changes between running steps",
            "RunOnce" | "TryCatch" | "UnsetBlackboard" | "WasEntryUpdated" | "SkipUnlessUpdated"
            | "WaitValueUpdate" | "Switch2" | "Switch3" | "Switch4" | "Switch5" | "Switch6" => {
                "has no equal among the steps"
            }
            _ => {
                let names = self.leaves.names();
                let near = closest(id, names.iter().map(String::as_str));
                let help = near.map(|near| format!("did you mean `{near}`?"));
                return self.wrong(span, format!("there is no leaf `{id}` in the library"), help);
            }
        };
        self.refuse(span, format!("`{id}` {reason}"), None);
    }

    /// Steps that do not fail, whatever a node does.
    fn forced(&mut self, node: Node<'a, 't>, context: &Context, span: Span) -> Vec<Step> {
        let caught = Context { is_caught: true, is_last: false, ..context.clone() };
        let steps = self.node(node, &caught);
        match steps.is_empty() || kind(node) == "SetBlackboard" {
            true => steps,
            false => vec![attempt(steps, vec![catch_any(Vec::new(), span)], span)],
        }
    }

    /// A step that fails unless a condition is known to hold.
    fn assertion(&mut self, condition: Expr, span: Span) -> Vec<Step> {
        if condition.kind == ExprKind::Bool(true) {
            return vec![nothing(span)];
        }
        let otherwise = Some(block(self.failing(span), span));
        vec![step(StepKind::If { condition, then: branch(Vec::new(), span), otherwise }, span)]
    }

    /// Steps of nodes that run one after the other.
    pub(super) fn sequence(&mut self, nodes: &[Node<'a, 't>], context: &Context) -> Vec<Step> {
        let mut steps = Vec::new();
        let mut rest = nodes;
        while let [node, after @ ..] = rest {
            let inner = if after.is_empty() { context.clone() } else { context.not_last() };
            rest = after;
            let next = after.first().copied();
            if let Some(next) = next
                && self.guards(*node, next)
            {
                continue;
            }
            if let Some((looped, bound)) = next.and_then(|next| Some((next, self.bound(*node, next)?))) {
                let inner = if after.len() == 1 { context.clone() } else { context.not_last() };
                steps.extend(self.each(looped, Some(bound), &inner.inner()));
                rest = after.get(1..).unwrap_or_default();
                continue;
            }
            steps.extend(self.node(*node, &inner));
        }
        steps
    }

    /// Checks if a node tests the needs of the action behind it, as its contract does.
    fn guards(&self, node: Node<'a, 't>, next: Node<'a, 't>) -> bool {
        let Some(name) = kind(node).strip_prefix(NEEDS) else { return false };
        let action = match kind(next) {
            "Timeout" => elements(next).first().copied(),
            _ => Some(next),
        };
        let Some(action) = action.filter(|action| kind(*action) == name && self.is_action(*action)) else {
            return false;
        };
        node.attributes().all(|attribute| {
            let is_own = ["ID", "name", FAILURE].contains(&attribute.name());
            is_own || action.attribute(attribute.name()) == Some(attribute.value())
        })
    }

    fn fallback(&mut self, nodes: &[Node<'a, 't>], context: &Context, span: Span) -> Vec<Step> {
        let [first, rest @ ..] = nodes else { return self.failing(span) };
        let [next, ..] = rest else { return self.node(*first, context) };
        if self.names_failure(*next) {
            // The kind of the failure is set; nothing else is done about it.
            return self.node(*first, context);
        }
        let deeper = context.inner();
        if self.is_condition(*first) {
            let Some(condition) = self.condition(*first, context) else { return Vec::new() };
            let otherwise = self.fallback(rest, &deeper, span);
            let then = branch(Vec::new(), span);
            return vec![step(
                StepKind::If { condition, then, otherwise: Some(block(otherwise, span)) },
                span,
            )];
        }
        let caught = Context { is_caught: true, ..deeper.clone() };
        let body = self.node(*first, &caught);
        let catches = match rest {
            [only] if kind(*only) == "IfThenElse" => self.catches(*only, &deeper),
            _ => None,
        };
        let catches = catches.unwrap_or_else(|| vec![catch_any(self.fallback(rest, &deeper, span), span)]);
        vec![attempt(body, catches, span)]
    }

    /// Checks if a node sets the kind of a failure and fails.
    fn names_failure(&self, node: Node<'a, 't>) -> bool {
        let inside = elements(node);
        kind(node) == "ForceFailure" && inside.first().is_some_and(|set| is_register(*set))
    }

    /// Handlers that ask for the kind of a failure, one in the other.
    fn catches(&mut self, node: Node<'a, 't>, context: &Context) -> Option<Vec<Catch>> {
        let mut catches = Vec::new();
        let mut at = node;
        loop {
            let span = self.places.tag(at);
            let children = elements(at);
            let [test, then, otherwise] = children.as_slice() else { return None };
            if kind(at) != "IfThenElse" || kind(*test) != FAILURE_IS {
                return None;
            }
            let body = reaction(self.node(*then, context), span);
            if let Some(on) = self.kinds(*test) {
                catches.push(Catch { on, bind: None, body, span });
            }
            let leads_on = elements(*otherwise).first().is_some_and(|test| kind(*test) == FAILURE_IS);
            match kind(*otherwise) {
                "AlwaysFailure" => return Some(catches),
                "IfThenElse" if leads_on => at = *otherwise,
                _ => {
                    let steps = self.node(*otherwise, context);
                    catches.push(catch_any(steps, span));
                    return Some(catches);
                }
            }
        }
    }

    fn branch(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &[]);
        let children = elements(node);
        let (test, then, otherwise) = match children.as_slice() {
            [test, then] => (*test, *then, None),
            [test, then, otherwise] => (*test, *then, Some(*otherwise)),
            _ => {
                self.refuse(span, "`IfThenElse` takes two or three children".to_owned(), None);
                return Vec::new();
            }
        };
        if !self.is_test(test) {
            let at = self.places.tag(test);
            self.refuse(at, "the condition of `IfThenElse` is no condition".to_owned(), None);
            return Vec::new();
        }
        let condition = self.condition(test, context);
        let then = self.node(then, context);
        let otherwise = match otherwise {
            Some(otherwise) => reaction(self.node(otherwise, context), span).steps,
            None => self.failing(span),
        };
        let otherwise = (!otherwise.is_empty()).then(|| block(otherwise, span));
        let condition =
            condition.map(|condition| StepKind::If { condition, then: branch(then, span), otherwise });
        condition.map(|kind| step(kind, span)).into_iter().collect()
    }

    fn reactive(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &[]);
        let children = elements(node);
        let is_sequence = kind(node) == "ReactiveSequence";
        let Some((body, checks)) = children.split_last() else { return Vec::new() };
        if !is_sequence
            && let [check] = checks
            && kind(*body) == "ForceFailure"
            && let Some(sleep) = elements(*body).first().filter(|sleep| kind(**sleep) == "Sleep")
        {
            let within = self.milliseconds(*sleep, "msec");
            let condition = self.condition(*check, context);
            let wait = condition.map(|condition| StepKind::Wait { condition, within });
            return wait.map(|kind| step(kind, span)).into_iter().collect();
        }
        let mut whens = Vec::new();
        for check in checks {
            let at = self.places.tag(*check);
            let parts = elements(*check);
            let (test, last) = match parts.as_slice() {
                [test, last] if is_sequence && kind(*check) == "Fallback" && self.is_ending(*last) => {
                    (*test, Some(*last))
                }
                _ => (*check, None),
            };
            if !self.is_test(test) {
                self.refuse(at, format!("a child of `{}` before its last is no condition", kind(node)), None);
                continue;
            }
            let Some(condition) = self.condition(test, context) else { continue };
            let ending = match (is_sequence, last) {
                (true, Some(last)) => self.node(last, context).pop(),
                (true, None) if context.is_caught => {
                    let what = "a condition of `ReactiveSequence` in a fallback: a monitor ends the policy";
                    self.refuse(at, what.to_owned(), None);
                    None
                }
                (true, None) => Some(fail("a condition of the tree no longer holds", at)),
                (false, _) if context.is_last => {
                    Some(end(End { kind: EndKind::Done, result: None, why: None, span: at }))
                }
                (false, _) => {
                    let what = "`ReactiveFallback` before the last node: a monitor ends the policy";
                    self.refuse(at, what.to_owned(), None);
                    None
                }
            };
            let condition = if is_sequence { negated(condition) } else { condition };
            if let Some(Step { kind: StepKind::End(ending), .. }) = ending {
                whens.push(When { condition, hold: None, reaction: Reaction::End(ending), span: at });
            }
        }
        let steps = self.node(*body, context);
        if whens.is_empty() {
            return steps;
        }
        vec![step(StepKind::Monitor { whens, body: branch(steps, span) }, span)]
    }

    /// Checks if a node ends the policy.
    fn is_ending(&self, node: Node<'a, 't>) -> bool {
        match (kind(node), elements(node).as_slice()) {
            ("Sequence", [set, ending]) => is_register(*set) && self.is_ending(*ending),
            (id, _) => ENDINGS.contains(&id),
        }
    }

    /// Constants of an entry have no type, and an entry that is read has the type of what wrote it.
    fn set(&mut self, node: Node<'a, 't>, context: &Context) -> Vec<Step> {
        let span = self.places.tag(node);
        self.ports(node, &["value", "output_key"]);
        if is_register(node) {
            return Vec::new();
        }
        let (Some((value, at)), Some((key, to))) =
            (self.required(node, "value"), self.required(node, "output_key"))
        else {
            return Vec::new();
        };
        let Some(from) = super::scope::pointer("value", value) else {
            let help = "give the constant to the port that reads the entry".to_owned();
            self.refuse(at, "a constant on the blackboard has no type".to_owned(), Some(help));
            return Vec::new();
        };
        let key = key.trim_matches(['{', '}']);
        match (context.scope.entry(from), context.scope.entry(key)) {
            (super::scope::Entry::Binding(from), super::scope::Entry::Binding(text)) => {
                let name = motet_syntax::ast::Name { text, span: to };
                let value = expr(ExprKind::Binding(from), at);
                vec![step(StepKind::Let { name, value }, span)]
            }
            _ => {
                self.refuse(span, "a port of a tree that is a constant is written".to_owned(), None);
                Vec::new()
            }
        }
    }
}

/// Checks if a node sets the kind of the failure on its way, which the engine does itself.
fn is_register(node: Node<'_, '_>) -> bool {
    let key = node.attribute("output_key").unwrap_or_default();
    let rest = key.strip_prefix(FAILURE);
    let is_ours = rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('_'));
    kind(node) == "SetBlackboard" && is_ours
}

pub(super) fn attempt(body: Vec<Step>, catches: Vec<Catch>, span: Span) -> Step {
    step(StepKind::Try { body: branch(body, span), catches }, span)
}

pub(super) fn catch_any(steps: Vec<Step>, span: Span) -> Catch {
    Catch { on: CatchOn::Any(span), bind: None, body: reaction(steps, span), span }
}
