//! From a policy of either form to the tree of the model subset.

use motet_compiler::Signatures;
use motet_compiler::signature::Type;
use motet_syntax::Span;
use motet_syntax::ast::{self, Block, CatchOn, Do, EndKind, Expr, Policy, StepKind};
use rustc_hash::FxHashSet;
use smol_str::{SmolStr, format_smolstr};

use super::Outside;
use super::value::outside;
use crate::subset::{
    self, Call, Catch, Document, End, MAX_CONDITION_DEPTH, MAX_COUNT, MAX_MEMBERS, MAX_RETRIES, MAX_STEPS,
    Modifiers, Reaction, Step, Subset, When,
};

/// A policy as a tree of the model subset.
///
/// # Errors
///
/// The first thing in the policy that the subset cannot say.
pub fn complete(policy: &Policy, signatures: &Signatures, subset: Subset) -> Result<Document, Outside> {
    let mut completer =
        Completer { signatures, subset, bound: Vec::new(), names: FxHashSet::default(), fresh: 0 };
    if !policy.params.is_empty() {
        return Err(Outside {
            span: policy.name.span,
            why: "a policy has no parameters on the model subset".into(),
        });
    }
    names(&policy.body, &mut completer.names);
    let robot = Some(&signatures.robot).filter(|robot| !robot.is_empty()).cloned();
    if let Some(written) = policy.robot.as_ref().filter(|written| Some(&written.text) != robot.as_ref()) {
        return Err(Outside { span: written.span, why: format!("the policy is for `{}`", written.text) });
    }
    let name = completer.new_name(&policy.name.text, policy.name.span)?;
    let goal = policy.achieves.as_ref();
    let achieves = goal.map(|goal| completer.condition(goal, MAX_CONDITION_DEPTH)).transpose()?;
    let steps = completer.block(&policy.body, subset.depth, 1)?;
    Ok(Document { name, robot, achieves, steps })
}

pub(super) struct Completer<'a> {
    pub(super) signatures: &'a Signatures,
    pub(super) subset: Subset,
    /// What is bound here, in the order of binding.
    bound: Vec<SmolStr>,
    /// What is bound anywhere.
    names: FxHashSet<SmolStr>,
    fresh: usize,
}

impl Completer<'_> {
    pub(super) fn is_bound(&self, name: &str) -> bool {
        self.bound.iter().any(|bound| bound == name)
    }

    /// A block of at least so many steps, with so many levels of blocks below it.
    fn block(&mut self, block: &Block, depth: usize, least: usize) -> Result<Vec<Step>, Outside> {
        if !(least..=MAX_STEPS).contains(&block.steps.len()) {
            return Err(Outside {
                span: block.span,
                why: format!("a block has {least} to {MAX_STEPS} steps on the model subset"),
            });
        }
        let outer = self.bound.len();
        let steps = block.steps.iter().map(|step| self.step(step, depth)).collect();
        self.bound.truncate(outer);
        steps
    }

    fn inner(&mut self, block: &Block, depth: usize, least: usize) -> Result<Vec<Step>, Outside> {
        let Some(depth) = depth.checked_sub(1) else {
            return Err(Outside { span: block.span, why: "blocks stand too deep in one another".into() });
        };
        self.block(block, depth, least)
    }

    fn step(&mut self, step: &ast::Step, depth: usize) -> Result<Step, Outside> {
        Ok(match &step.kind {
            StepKind::Do(call) => Step::Do(self.call(call)?),
            StepKind::Sequence { name, body } => {
                Step::Sequence(self.new_name(&name.text, name.span)?, self.inner(body, depth, 1)?)
            }
            StepKind::If { condition, then, otherwise } => {
                let condition = self.condition(condition, MAX_CONDITION_DEPTH)?;
                let then = self.inner(then, depth, 1)?;
                let otherwise = match otherwise {
                    Some(block) => self.inner(block, depth, 0)?,
                    None => Vec::new(),
                };
                Step::If(condition, then, otherwise)
            }
            StepKind::Wait { condition, within } => {
                Step::Wait(self.condition(condition, MAX_CONDITION_DEPTH)?, self.within(within.as_ref())?)
            }
            StepKind::Monitor { whens, body } => {
                count(whens.len(), 1, "a monitor", "conditions", step.span)?;
                let whens = whens.iter().map(|when| self.when(when, depth)).collect::<Result<_, _>>()?;
                Step::Monitor(whens, self.inner(body, depth, 1)?)
            }
            StepKind::Try { body, catches } => {
                count(catches.len(), 1, "a `try`", "handlers", step.span)?;
                let body = self.inner(body, depth, 1)?;
                Step::Try(
                    body,
                    catches.iter().map(|catch| self.catch(catch, depth)).collect::<Result<_, _>>()?,
                )
            }
            StepKind::Repeat { times, body, until } => {
                let times = self.count(times, 1, MAX_COUNT)?;
                let steps = self.inner(body, depth, 1)?;
                let until = until.as_ref().map(|until| self.condition(until, MAX_CONDITION_DEPTH));
                Step::Repeat(times, steps, until.transpose()?)
            }
            StepKind::Each { item, list, at_most, body } => {
                let list = self.each_list(list)?;
                let at_most = self.count(at_most, 1, MAX_COUNT)?;
                let item = self.new_name(&item.text, item.span)?;
                self.bound.push(item.clone());
                let steps = self.inner(body, depth, 1);
                self.bound.pop();
                Step::Each { item, list, at_most, steps: steps? }
            }
            StepKind::Parallel { branches } => {
                count(branches.len(), 2, "a `parallel`", "branches", step.span)?;
                Step::Parallel(
                    branches.iter().map(|branch| self.inner(branch, depth, 1)).collect::<Result<_, _>>()?,
                )
            }
            StepKind::End(end) => Step::End(self.end(end)?),
        })
    }

    fn call(&mut self, step: &Do) -> Result<Call, Outside> {
        let call = &step.call;
        let Some(callable) = self.signatures.callable(&call.name.text) else {
            return Err(Outside {
                span: call.name.span,
                why: format!("there is no primitive `{}`", call.name.text),
            });
        };
        let known = |name: &str| callable.params.iter().any(|param| param.name == name);
        if let Some(arg) =
            call.args.iter().find(|arg| arg.name.as_ref().is_some_and(|name| !known(&name.text)))
        {
            return Err(Outside {
                span: arg.span,
                why: format!("`{}` has no such parameter", callable.name),
            });
        }
        if call.args.len() > callable.params.len() {
            return Err(Outside {
                span: call.span,
                why: format!("`{}` has too many arguments", callable.name),
            });
        }
        let mut args = Vec::with_capacity(callable.params.len());
        for (index, param) in callable.params.iter().enumerate() {
            let Some(arg) = argument(call, index, &param.name).or(param.default.as_ref()) else {
                return Err(Outside {
                    span: call.span,
                    why: format!("`{}` lacks `{}`", callable.name, param.name),
                });
            };
            args.push((param.name.clone(), self.value(arg, &param.ty, param.range)?));
        }
        let within = self.within(step.within.as_ref())?;
        let retry = step.retry.as_ref().map(|retry| {
            self.modifier(retry)?;
            self.count(retry, 0, MAX_RETRIES)
        });
        let retry = retry.transpose()?;
        if callable.is_policy && (within.is_some() || retry.is_some()) {
            return Err(Outside {
                span: call.span,
                why: "a policy has neither a deadline nor retries".into(),
            });
        }
        let bind = match (&callable.result, &step.bind) {
            (Some(_), Some(name)) => Some(self.new_name(&name.text, name.span)?),
            (Some(_), None) => Some(self.fresh_name()),
            (None, None) => None,
            (None, Some(name)) => {
                return Err(Outside { span: name.span, why: format!("`{}` has no result", callable.name) });
            }
        };
        self.bound.extend(bind.clone());
        Ok(Call { name: callable.name.clone(), args, is_policy: callable.is_policy, within, retry, bind })
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

    fn when(&mut self, when: &ast::When, depth: usize) -> Result<When, Outside> {
        let condition = self.condition(&when.condition, MAX_CONDITION_DEPTH)?;
        let hold = when.hold.as_ref().map(|hold| self.seconds(hold)).transpose()?;
        let reaction = match &when.reaction {
            ast::Reaction::Pause { within, .. } => Reaction::Pause(self.within(within.as_ref())?),
            ast::Reaction::Restart { at_most, .. } => Reaction::Restart(self.count(at_most, 1, MAX_COUNT)?),
            ast::Reaction::Resume { at_most, body, .. } => {
                Reaction::Resume(self.count(at_most, 1, MAX_COUNT)?, self.inner(body, depth, 1)?)
            }
            ast::Reaction::End(end) => Reaction::End(self.end(end)?),
        };
        Ok(When { condition, hold, reaction })
    }

    fn catch(&mut self, catch: &ast::Catch, depth: usize) -> Result<Catch, Outside> {
        let on = match &catch.on {
            CatchOn::Any(_) => Vec::new(),
            CatchOn::Kinds(kinds) => {
                count(kinds.len(), 1, "a handler", "kinds of failure", catch.span)?;
                let unknown = kinds.iter().find(|kind| !self.signatures.failures.contains(&kind.text));
                if let Some(unknown) = unknown {
                    return Err(Outside {
                        span: unknown.span,
                        why: format!("there is no failure `{}`", unknown.text),
                    });
                }
                kinds.iter().map(|kind| kind.text.clone()).collect()
            }
        };
        Ok(Catch { on, steps: self.inner(&catch.body, depth, 0)? })
    }

    fn end(&mut self, end: &ast::End) -> Result<End, Outside> {
        let why = match (end.kind, &end.why) {
            (EndKind::Done, _) => None,
            (EndKind::Fail | EndKind::Replan, Some(why)) => Some(self.value(why, &Type::Text, None)?),
            (EndKind::Fail | EndKind::Replan, None) => {
                return Err(Outside {
                    span: end.span,
                    why: "an ending has a reason on the model subset".into(),
                });
            }
        };
        Ok(End { kind: end.kind, why })
    }

    fn within(&self, within: Option<&Expr>) -> Result<Option<subset::Decimal>, Outside> {
        let Some(within) = within else { return Ok(None) };
        self.modifier(within)?;
        self.seconds(within).map(Some)
    }

    /// A place that only a subset with modifiers has.
    fn modifier(&self, expr: &Expr) -> Result<(), Outside> {
        match self.subset.modifiers {
            Modifiers::Written => Ok(()),
            Modifiers::Default => {
                Err(outside(expr, "deadlines and retries are only written on a subset with modifiers".into()))
            }
        }
    }
}

/// The argument for a parameter, by its name or its place.
pub(super) fn argument<'c>(call: &'c ast::Call, index: usize, name: &str) -> Option<&'c Expr> {
    let named = call.args.iter().find(|arg| arg.name.as_ref().is_some_and(|given| given.text == name));
    let arg = named.or_else(|| call.args.get(index).filter(|arg| arg.name.is_none()));
    arg.map(|arg| &arg.value)
}

fn count(actual: usize, least: usize, whose: &str, of: &str, span: Span) -> Result<(), Outside> {
    if (least..=MAX_MEMBERS).contains(&actual) {
        return Ok(());
    }
    Err(Outside { span, why: format!("{whose} has {least} to {MAX_MEMBERS} {of} on the model subset") })
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
                catches.iter().for_each(|catch| names(&catch.body, found));
            }
            StepKind::Parallel { branches } => branches.iter().for_each(|block| names(block, found)),
            StepKind::Wait { .. } | StepKind::End(_) => {}
        }
    }
}
