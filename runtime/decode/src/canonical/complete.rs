//! Completion: from the syntax tree of a policy to the tree of the canonical subset.

use motet_compiler::signature::{Callable, Type};
use motet_stdlib::lang;
use motet_syntax::ast::{self, Block, CatchOn, Do, EndKind, Expr, ExprKind, KeepKind, Policy, StepKind};
use motet_syntax::unit::Dimension;
use motet_syntax::{Span, Syntax};
use rustc_hash::FxHashSet;
use smol_str::{SmolStr, format_smolstr};

use super::OutsideSubset;
use super::print::{Item, Node, Value};
use super::value::{Completer, argument, numbered, outside};
use crate::grammar::{Grammar, LetValue, NodeKind, ValuePlace};
use crate::subset::NumberRange;
use crate::subset::{MAX_CONDITION_DEPTH, MAX_COUNT, MAX_MEMBERS, MAX_RETRIES, MAX_STEPS, Modifiers};

/// Completes a policy to a tree of the canonical subset.
///
/// # Errors
///
/// The first part of the policy that is outside of the subset.
pub(super) fn complete(policy: &Policy, grammar: &Grammar) -> Result<Node, OutsideSubset> {
    let signatures = &*grammar.signatures;
    let is_json = grammar.subset.syntax == Syntax::Json;
    let mut completer = Completer {
        grammar,
        signatures,
        subset: grammar.subset,
        bound: Vec::new(),
        lists: FxHashSet::default(),
        names: FxHashSet::default(),
        fresh: 0,
        in_cleanup: false,
    };
    if !policy.params.is_empty() {
        return Err(outside(policy.name.span, "a policy has no parameters in the canonical subset"));
    }
    names(&policy.body, &mut completer.names);
    policy.cleanup.iter().for_each(|cleanup| names(cleanup, &mut completer.names));
    if let Some(written) = policy.robot.as_ref().filter(|written| Some(&written.text) != grammar.robot()) {
        return Err(outside(written.span, format!("the policy is for `{}`", written.text)));
    }
    let name = completer.new_name(&policy.name.text, policy.name.span)?;
    let result = policy.result.as_ref().map(|ty| completer.result_type(ty)).transpose()?;
    let goal = policy.achieves.as_ref().map(|goal| completer.asked(goal)).transpose()?;
    let keeps = match policy.keeps.as_slice() {
        [] => Item::Nothing,
        keeps => completer.keeps(keeps, policy.name.span)?,
    };
    let steps = completer.block(&policy.body, grammar.subset.depth, 1)?;
    let cleanup = completer.cleanup(policy.cleanup.as_ref(), grammar.subset.depth)?;
    let mut items = vec![result.unwrap_or(Item::Nothing), goal.unwrap_or(Item::Nothing)];
    // Without observed distances there is no place for a rule.
    let has_keeps = grammar.keep_rule(ValuePlace::Operand).is_some();
    items.extend((has_keeps || is_json || keeps != Item::Nothing).then_some(keeps));
    items.extend([steps, cleanup]);
    Ok(Node { kind: NodeKind::Block, span: policy.name.span, name: Some(name), items })
}

impl Completer<'_> {
    /// A block of at least `least` steps; blocks may be nested `depth` levels below it.
    fn block(&mut self, block: &Block, depth: usize, least: usize) -> Result<Item, OutsideSubset> {
        if !(least..=MAX_STEPS).contains(&block.steps.len()) {
            return Err(outside(
                block.span,
                format!("a block has {least} to {MAX_STEPS} steps in the canonical subset"),
            ));
        }
        // A name stays one when its block ends: it may be bound behind the block too.
        let steps = block.steps.iter().map(|step| self.step(step, depth)).collect::<Result<_, _>>();
        steps.map(Item::Block)
    }

    fn inner(&mut self, block: &Block, depth: usize, least: usize) -> Result<Item, OutsideSubset> {
        let Some(depth) = depth.checked_sub(1) else {
            return Err(outside(block.span, "the blocks are nested too deep"));
        };
        self.block(block, depth, least)
    }

    fn asked(&self, condition: &Expr) -> Result<Item, OutsideSubset> {
        self.condition(condition, MAX_CONDITION_DEPTH).map(Item::Node)
    }

    fn step(&mut self, step: &ast::Step, depth: usize) -> Result<Node, OutsideSubset> {
        let mut given = None;
        let (kind, items) = match &step.kind {
            StepKind::Do(call) => return self.call(call),
            StepKind::Let { name, value } => return self.bound_value(name, value),
            StepKind::Sequence { name, body } => {
                given = Some(self.new_name(&name.text, name.span)?);
                (NodeKind::Sequence, vec![self.inner(body, depth, 1)?])
            }
            StepKind::If { condition, then, otherwise } => {
                let (condition, then) = (self.asked(condition)?, self.inner(then, depth, 1)?);
                let otherwise = match otherwise {
                    Some(block) => self.inner(block, depth, 0)?,
                    None => Item::Block(Vec::new()),
                };
                (NodeKind::If, vec![condition, then, otherwise])
            }
            StepKind::Wait { condition, within } => {
                let condition = self.asked(condition)?;
                (NodeKind::Wait, [condition].into_iter().chain(self.within(within.as_ref())?).collect())
            }
            StepKind::Delay { time } => (NodeKind::Delay, vec![self.seconds(time, NumberRange::DURATION)?]),
            StepKind::Finally { step, cleanup } => {
                let mut node = self.step(step, depth)?;
                // It stands behind the parts of the step, where no cleanup is nothing.
                node.items.pop();
                node.items.push(self.cleanup(Some(cleanup), depth)?);
                return Ok(node);
            }
            StepKind::Within { time, body } => (
                NodeKind::Within,
                vec![self.seconds(time, NumberRange::DEADLINE)?, self.inner(body, depth, 1)?],
            ),
            StepKind::Keep { keeps, body } => {
                (NodeKind::Keep, vec![self.keeps(keeps, step.span)?, self.inner(body, depth, 1)?])
            }
            StepKind::Monitor { whens, body } => {
                count(whens.len(), 1, "a monitor", "conditions", step.span)?;
                let whens = whens.iter().map(|when| self.when(when, depth)).collect::<Result<_, _>>()?;
                (NodeKind::Monitor, vec![Item::Members(whens), self.inner(body, depth, 1)?])
            }
            StepKind::Try { body, catches } => {
                count(catches.len(), 1, "a `try`", "handlers", step.span)?;
                let body = self.inner(body, depth, 1)?;
                let catches =
                    catches.iter().map(|catch| self.catch(catch, depth)).collect::<Result<_, _>>()?;
                (NodeKind::Try, vec![body, Item::Members(catches)])
            }
            StepKind::Repeat { times, body, until } => {
                let (times, steps) = (self.count(times, 1, MAX_COUNT)?, self.inner(body, depth, 1)?);
                let until = until.as_ref().map(|until| self.asked(until)).transpose()?;
                (NodeKind::Repeat, vec![times, steps, until.unwrap_or(Item::Nothing)])
            }
            StepKind::Each { item, list, at_most, body } => {
                let (list, at_most) = (self.each_list(list)?, self.count(at_most, 1, MAX_COUNT)?);
                let item = self.new_name(&item.text, item.span)?;
                self.bound.push(item.clone());
                let steps = self.inner(body, depth, 1)?;
                given = Some(item);
                (NodeKind::Each, vec![Item::Value(list), at_most, steps])
            }
            StepKind::Parallel { branches } => {
                count(branches.len(), 2, "a `parallel`", "branches", step.span)?;
                let branch = |branch: &Block| -> Result<Node, OutsideSubset> {
                    let items = vec![self.inner(branch, depth, 1)?];
                    Ok(Node { kind: NodeKind::Block, span: branch.span, name: None, items })
                };
                let branches = branches.iter().map(branch).collect::<Result<_, _>>()?;
                (NodeKind::Parallel, vec![Item::Members(branches)])
            }
            StepKind::End(end) => return self.end(end),
        };
        let mut node = Node { kind, span: step.span, name: given, items };
        node.items.extend(kind.has_blocks().then_some(Item::Nothing));
        self.cleans(&node)?;
        Ok(node)
    }

    /// The cleanup of a step or of the policy.
    fn cleanup(&mut self, cleanup: Option<&Block>, depth: usize) -> Result<Item, OutsideSubset> {
        let Some(cleanup) = cleanup else { return Ok(Item::Nothing) };
        if std::mem::replace(&mut self.in_cleanup, true) {
            return Err(outside(cleanup.span, "a cleanup has no cleanup in the canonical subset"));
        }
        let block = self.inner(cleanup, depth, 1);
        self.in_cleanup = false;
        block
    }

    /// A step may stand where it does: a cleanup has few kinds of them.
    fn cleans(&self, node: &Node) -> Result<(), OutsideSubset> {
        let mut alternatives = self.grammar.steps.iter().filter(|alternative| alternative.opens(node.kind));
        if self.in_cleanup && alternatives.next().is_some_and(|alternative| !alternative.cleans) {
            let why = "a cleanup has calls, waits, `let`, `if`, `sequence` and `try` in the canonical subset";
            return Err(outside(node.span, why));
        }
        Ok(())
    }

    fn keeps(&self, keeps: &[ast::Keep], span: Span) -> Result<Item, OutsideSubset> {
        count(keeps.len(), 1, "a `keep`", "rules", span)?;
        let rule = |keep: &ast::Keep| {
            let entity = |to, kind| self.value(to, &Type::Entity(kind), None).map(Item::Value);
            let (kind, items) = match &keep.kind {
                KeepKind::OutOf(zone) => {
                    let kind = self.signatures.kinds.iter().position(|kind| kind.name == lang::kinds::ZONE);
                    (NodeKind::OutOf, vec![entity(zone, kind.unwrap_or(0))?])
                }
                KeepKind::Distance { to, at_least } => {
                    let least = self.value(at_least, &Type::Quantity(Dimension::LENGTH), None)?;
                    let Value::Number(least, _) = least else {
                        return Err(outside(at_least.span, "a distance is a number in the canonical subset"));
                    };
                    (NodeKind::Distance, vec![entity(to, 0)?, Item::Number(least)])
                }
            };
            Ok(Node { kind, span: keep.span, name: None, items })
        };
        keeps.iter().map(rule).collect::<Result<_, _>>().map(Item::Members)
    }

    /// A name for a value.
    fn bound_value(&mut self, name: &ast::Name, value: &Expr) -> Result<Node, OutsideSubset> {
        let (kind, items) = self.named_value(value)?;
        let given = self.new_name(&name.text, name.span)?;
        self.bound.push(given.clone());
        let node = Node { kind, span: value.span, name: Some(given), items };
        self.cleans(&node)?;
        Ok(node)
    }

    /// The value of a `let`.
    fn named_value(&mut self, value: &Expr) -> Result<(NodeKind, Vec<Item>), OutsideSubset> {
        let signatures = self.signatures;
        Ok(match &value.kind {
            ExprKind::Call(call) if self.is_term(call, "count") || self.is_term(call, "first") => {
                let list = vec![Item::Value(Value::Binding(self.list_name(call)?))];
                let is_count = call.name.text == "count";
                (NodeKind::Let(if is_count { LetValue::Count } else { LetValue::First }), list)
            }
            ExprKind::Call(call) => {
                let (number, measure) = numbered(&signatures.measures, |row| row.name == call.name.text)
                    .ok_or_else(|| {
                        outside(value.span, format!("there is no measure `{}`", call.name.text))
                    })?;
                (NodeKind::Let(LetValue::Get(number)), self.observed(call, &measure.params, false)?)
            }
            ExprKind::Field(of, name)
                if let (Some(caught), "text") = (self.caught_name(of), name.text.as_str()) =>
            {
                (NodeKind::Let(LetValue::CaughtText), vec![Item::Value(Value::Binding(caught))])
            }
            ExprKind::Field(of, name) => {
                let (number, field) = numbered(&signatures.fields, |row| row.name == name.text)
                    .ok_or_else(|| outside(value.span, format!("there is no field `{}`", name.text)))?;
                let of = self.value(of, &Type::Entity(field.kind), None)?;
                (NodeKind::Let(LetValue::Field(number)), vec![Item::Value(of)])
            }
            _ => {
                let why = "a `let` names a result, a measure, a field, or `count` or `first` of a list in \
                           the canonical subset";
                return Err(outside(value.span, why));
            }
        })
    }

    fn call(&mut self, step: &Do) -> Result<Node, OutsideSubset> {
        let call = &step.call;
        let callables = &self.signatures.callables;
        let is_callable = callables.iter().any(|row| row.name == call.name.text);
        // A value that is a lone call reads as a step that binds its result.
        if let Some(name) = step.bind.as_ref().filter(|_| !is_callable) {
            let value = Expr { kind: ExprKind::Call(call.clone()), span: call.span };
            return self.bound_value(name, &value);
        }
        let Some((number, callable)) = numbered(callables, |row| row.name == call.name.text) else {
            return Err(outside(call.name.span, format!("there is no primitive `{}`", call.name.text)));
        };
        let known = |name: &str| callable.params.iter().any(|param| param.name == name);
        let is_unknown = |arg: &&ast::Arg| arg.name.as_ref().is_some_and(|name| !known(&name.text));
        if let Some(arg) = call.args.iter().find(is_unknown) {
            return Err(outside(arg.span, format!("`{}` has no such parameter", callable.name)));
        }
        if call.args.len() > callable.params.len() {
            return Err(outside(call.span, format!("`{}` has too many arguments", callable.name)));
        }
        let mut items = Vec::with_capacity(callable.params.len() + 2);
        for (index, param) in callable.params.iter().enumerate() {
            let given = argument(call, index, &param.name);
            // A default may be an earlier parameter: then it is the argument for that one.
            let earlier = param.default.as_ref().filter(|_| given.is_none() && !callable.is_policy);
            if let Some(ExprKind::Name(name)) = earlier.map(|default| &default.kind)
                && let Some(at) = callable.params.iter().take(index).position(|other| other.name == *name)
                && let Some(item) = items.get(at).cloned()
            {
                items.push(item);
                continue;
            }
            let Some(arg) = given.or(param.default.as_ref()) else {
                return Err(outside(call.span, format!("`{}` lacks `{}`", callable.name, param.name)));
            };
            items.push(Item::Value(self.value(arg, &param.ty, param.range)?));
        }
        items.extend(self.manner(step.manner.as_ref(), callable)?);
        let within = self.within(step.within.as_ref())?;
        let retry = self.modifier(step.retry.as_ref(), |retry| self.count(retry, 0, MAX_RETRIES))?;
        if !callable.is_policy {
            items.extend(within.into_iter().chain(retry));
        } else if step.within.is_some() || step.retry.is_some() {
            return Err(outside(call.span, "a policy has neither a deadline nor retries"));
        }
        let name = match (&callable.result, &step.bind) {
            (Some(_), Some(name)) => Some(self.new_name(&name.text, name.span)?),
            (Some(_), None) => Some(self.fresh_name()),
            (None, None) => None,
            (None, Some(name)) => {
                return Err(outside(name.span, format!("`{}` has no result", callable.name)));
            }
        };
        self.bound.extend(name.clone());
        if matches!(callable.result, Some(Type::List(_))) {
            self.lists.extend(name.iter().cloned().chain(step.bind.as_ref().map(|name| name.text.clone())));
        }
        let node = Node { kind: NodeKind::Do(number), span: call.span, name, items };
        self.cleans(&node)?;
        Ok(node)
    }

    fn fresh_name(&mut self) -> SmolStr {
        loop {
            self.fresh += 1;
            let name = format_smolstr!("_{}", self.fresh);
            if !self.names.contains(&name) {
                return name;
            }
        }
    }

    fn when(&mut self, when: &ast::When, depth: usize) -> Result<Node, OutsideSubset> {
        let condition = self.asked(&when.condition)?;
        let hold = when.hold.as_ref().map(|hold| self.seconds(hold, NumberRange::DURATION)).transpose()?;
        let (kind, items) = match &when.reaction {
            ast::Reaction::Pause { within, .. } => {
                (NodeKind::Pause, self.within(within.as_ref())?.into_iter().collect())
            }
            ast::Reaction::Restart { at_most, .. } => {
                (NodeKind::Restart, vec![self.count(at_most, 1, MAX_COUNT)?])
            }
            ast::Reaction::Resume { at_most, body, .. } => {
                (NodeKind::Resume, vec![self.count(at_most, 1, MAX_COUNT)?, self.inner(body, depth, 1)?])
            }
            ast::Reaction::End(end) => {
                let end = self.end(end)?;
                (end.kind, end.items)
            }
        };
        let span = when.condition.span;
        let reaction = Item::Node(Node { kind, span, name: None, items });
        let items = vec![condition, hold.unwrap_or(Item::Nothing), reaction];
        Ok(Node { kind: NodeKind::When, span, name: None, items })
    }

    fn catch(&mut self, catch: &ast::Catch, depth: usize) -> Result<Node, OutsideSubset> {
        let on = match &catch.on {
            CatchOn::Any(_) => Vec::new(),
            CatchOn::Kinds(kinds) => {
                count(kinds.len(), 1, "a handler", "kinds of failure", catch.span)?;
                let unknown = kinds.iter().find(|kind| !self.signatures.failures.contains(&kind.text));
                if let Some(unknown) = unknown {
                    return Err(outside(unknown.span, format!("there is no failure `{}`", unknown.text)));
                }
                kinds.iter().map(|kind| kind.text.clone()).collect()
            }
        };
        let caught = catch.bind.as_ref().map(|bind| self.new_name(&bind.text, bind.span)).transpose()?;
        self.bound.extend(caught.clone());
        let body = self.inner(&catch.body, depth, 0)?;
        let items = vec![Item::Failures(on), caught.map_or(Item::Nothing, Item::Name), body];
        Ok(Node { kind: NodeKind::Catch, span: catch.span, name: None, items })
    }

    fn end(&mut self, end: &ast::End) -> Result<Node, OutsideSubset> {
        let kind = match end.kind {
            EndKind::Done => NodeKind::Done,
            EndKind::Fail => NodeKind::Fail,
            EndKind::Cannot => NodeKind::Cannot,
            EndKind::Replan => NodeKind::Replan,
        };
        let result = match &end.result {
            None => Item::Nothing,
            // An unknown name is the checker's business, and an entity has none of its own.
            Some(Expr { kind: ExprKind::Name(name) | ExprKind::Binding(name), span }) => {
                Item::Value(Value::Binding(self.new_name(name, *span)?))
            }
            Some(result) => {
                return Err(outside(result.span, "`done` gives a bound name in the canonical subset"));
            }
        };
        let items = match (end.kind, &end.why) {
            (EndKind::Done, _) => vec![result],
            (EndKind::Fail | EndKind::Cannot | EndKind::Replan, Some(why)) => {
                vec![Item::Value(self.value(why, &Type::Text, None)?)]
            }
            (EndKind::Fail | EndKind::Cannot | EndKind::Replan, None) => {
                return Err(outside(end.span, "an ending has a reason in the canonical subset"));
            }
        };
        let node = Node { kind, span: end.span, name: None, items };
        self.cleans(&node)?;
        Ok(node)
    }

    /// The type of the policy's result.
    fn result_type(&self, ty: &ast::TypeExpr) -> Result<Item, OutsideSubset> {
        fn spelled(ty: &ast::TypeExpr) -> SmolStr {
            match ty {
                ast::TypeExpr::Named(name) => name.text.clone(),
                ast::TypeExpr::List(element, _) => format_smolstr!("List<{}>", spelled(element)),
            }
        }
        let name = spelled(ty);
        let is_known = self.grammar.result_types().iter().any(|(_, known)| *known == name);
        let why = format!("nothing in a policy is bound to a `{name}`");
        is_known.then_some(Item::Name(name)).ok_or_else(|| outside(ty.span(), why))
    }

    fn manner(
        &self,
        manner: Option<&ast::Manner>,
        callable: &Callable,
    ) -> Result<Option<Item>, OutsideSubset> {
        let is_written = callable.moves && self.subset.modifiers == Modifiers::Written;
        match manner {
            None => Ok(is_written.then_some(Item::Nothing)),
            Some(manner) if !is_written => {
                let why = "manners are only written in a subset with modifiers, and of steps that move";
                Err(outside(manner.span(), why))
            }
            Some(ast::Manner::Slowly(_)) => Ok(Some(Item::Manner("slowly"))),
            Some(ast::Manner::Gently(_)) => Ok(Some(Item::Manner("gently"))),
            Some(ast::Manner::At(part, span)) => {
                let part = self.value(part, &Type::Quantity(Dimension::NONE), Some(PART))?;
                match part {
                    Value::Number(part, _) => Ok(Some(Item::Part(part))),
                    _ => Err(outside(*span, "a manner is a number in the canonical subset")),
                }
            }
        }
    }

    fn within(&self, within: Option<&Expr>) -> Result<Option<Item>, OutsideSubset> {
        self.modifier(within, |within| self.seconds(within, NumberRange::DEADLINE))
    }

    /// A modifier, for which only a subset with modifiers has a place.
    fn modifier(
        &self,
        written: Option<&Expr>,
        read: impl FnOnce(&Expr) -> Result<Item, OutsideSubset>,
    ) -> Result<Option<Item>, OutsideSubset> {
        match (self.subset.modifiers, written) {
            (Modifiers::Written, Some(expr)) => read(expr).map(Some),
            (Modifiers::Written, None) => Ok(Some(Item::Nothing)),
            (Modifiers::Default, None) => Ok(None),
            (Modifiers::Default, Some(expr)) => {
                Err(outside(expr.span, "deadlines and retries are only written in a subset with modifiers"))
            }
        }
    }
}

/// The least and the greatest part of the robot's speed that a manner asks for.
const PART: (f64, f64) = (0.01, 1.0);

fn count(actual: usize, least: usize, whose: &str, of: &str, span: Span) -> Result<(), OutsideSubset> {
    if (least..=MAX_MEMBERS).contains(&actual) {
        return Ok(());
    }
    Err(outside(span, format!("{whose} has {least} to {MAX_MEMBERS} {of} in the canonical subset")))
}

/// Every name that the steps of a block bind.
fn names(block: &Block, found: &mut FxHashSet<SmolStr>) {
    for step in &block.steps {
        match &step.kind {
            StepKind::Do(call) => found.extend(call.bind.as_ref().map(|name| name.text.clone())),
            StepKind::Each { item, body, .. } => {
                found.insert(item.text.clone());
                names(body, found);
            }
            StepKind::Sequence { body, .. } | StepKind::Repeat { body, .. } => names(body, found),
            StepKind::If { then, otherwise, .. } => {
                names(then, found);
                otherwise.iter().for_each(|block| names(block, found));
            }
            StepKind::Monitor { whens, body } => {
                for when in whens {
                    if let ast::Reaction::Resume { body, .. } = &when.reaction {
                        names(body, found);
                    }
                }
                names(body, found);
            }
            StepKind::Try { body, catches } => {
                names(body, found);
                for catch in catches {
                    found.extend(catch.bind.as_ref().map(|name| name.text.clone()));
                    names(&catch.body, found);
                }
            }
            StepKind::Parallel { branches } => branches.iter().for_each(|block| names(block, found)),
            StepKind::Finally { step, cleanup } => {
                names(&Block::new(vec![(**step).clone()], step.span), found);
                names(cleanup, found);
            }
            StepKind::Within { body, .. } | StepKind::Keep { body, .. } => names(body, found),
            StepKind::Let { name, .. } => {
                found.insert(name.text.clone());
            }
            StepKind::Wait { .. } | StepKind::Delay { .. } | StepKind::End(_) => {}
        }
    }
}
