//! Fallbacks: handlers of failures.

use motet_syntax::ast::{Block, Catch, CatchOn, Name, Step, StepKind};
use roxmltree::Node;

use super::{Context, Importer, elements, id};
use crate::names::{ENDED, FAILURE};

impl<'a, 't> Importer<'_, 'a, 't> {
    pub(super) fn fallback(&mut self, node: Node<'a, 't>, context: Context) -> Vec<Step> {
        let children: Vec<_> = elements(node).collect();
        if children.is_empty() {
            self.wrong(node, format!("`<{}>` has no children", node.tag_name().name()));
        }
        // The end of the whole tree, as the export writes it.
        let done = format!("{ENDED} == 'done'");
        if let [body, last] = children.as_slice()
            && id(*last) == "ScriptCondition"
            && last.attribute("code") == Some(&done)
        {
            return self.node(*body, context);
        }
        self.tried(node, &children, context)
    }

    /// The first child, and where it fails the others.
    fn tried(&mut self, node: Node<'a, 't>, children: &[Node<'a, 't>], context: Context) -> Vec<Step> {
        let Some((first, rest)) = children.split_first() else { return Vec::new() };
        if rest.is_empty() {
            return self.node(*first, context);
        }
        // A condition at the beginning: without it the others run.
        let mut conditions = Vec::new();
        let mut body: Vec<Node<'a, 't>> = Vec::new();
        if self.is_condition(*first) {
            conditions.push(*first);
        } else if id(*first) == "Sequence" && first.attribute("name").is_none() {
            let parts: Vec<_> = elements(*first).collect();
            let count = parts.iter().take_while(|part| self.is_condition(**part)).count();
            if count > 0 {
                let (tests, steps) = parts.split_at(count);
                (conditions, body) = (tests.to_vec(), steps.to_vec());
            }
        }
        if conditions.is_empty() {
            let steps = self.node(*first, context.handled());
            let body = self.block(*first, steps);
            let catches = self.handlers(node, rest, context);
            return self.made(node, context, StepKind::Try { body, catches }).into_iter().collect();
        }
        let tests: Option<Vec<_>> = conditions.iter().map(|test| self.condition(*test)).collect();
        let Some(tests) = tests else { return Vec::new() };
        let condition = joined(tests);
        let then = if body.is_empty() {
            Vec::new()
        } else {
            let steps = body.iter().flat_map(|child| self.node(*child, context.inside().handled())).collect();
            let body = self.block(*first, steps);
            let catches = self.handlers(node, rest, context.inside());
            self.made(node, context.inside(), StepKind::Try { body, catches }).into_iter().collect()
        };
        let Some(condition) = condition else { return Vec::new() };
        let otherwise = self.tried(node, rest, context.inside());
        let then = self.block(*first, then);
        let otherwise = Some(self.block(node, otherwise)).filter(|block| !block.steps.is_empty());
        self.made(node, context, StepKind::If { condition, then, otherwise }).into_iter().collect()
    }

    /// Handlers of a failure: those of the export by their kinds, or else one for all.
    fn handlers(&mut self, node: Node<'a, 't>, rest: &[Node<'a, 't>], context: Context) -> Vec<Catch> {
        let mut rest = rest;
        let guarded: Vec<_>;
        if let [only] = rest
            && id(*only) == "Sequence"
        {
            let parts: Vec<_> = elements(*only).collect();
            let goes_on = format!("{ENDED} == ''");
            if let [guard, handling] = parts.as_slice()
                && id(*guard) == "ScriptCondition"
                && guard.attribute("code") == Some(&goes_on)
            {
                guarded = vec![*handling];
                rest = &guarded;
            }
        }
        let mut catches = Vec::new();
        let only = rest.first().copied().filter(|only| rest.len() == 1 && id(*only) == "IfThenElse");
        let parts: Vec<_> = only.map(|only| elements(only).collect()).unwrap_or_default();
        if let [test, handler, uncaught] = parts.as_slice()
            && let Some(kinds) = kinds(*test)
        {
            let kinds = kinds.into_iter().map(|kind| Name { text: kind.into(), span: self.spans.tag(*test) });
            let on = CatchOn::Kinds(kinds.collect());
            let steps = self.node(*handler, context.inside());
            catches.push(Catch {
                on,
                bind: None,
                body: self.block(*handler, steps),
                span: self.span(*test).to(self.span(*handler)),
            });
            if kinds_follow(*uncaught) {
                catches.extend(self.handlers(node, &[*uncaught], context));
            } else if id(*uncaught) != "AlwaysFailure" || uncaught.has_attribute("name") {
                let steps = self.node(*uncaught, context.inside());
                catches.push(self.catch_all(*uncaught, steps));
            }
            return catches;
        }
        let steps = self.tried(node, rest, context.inside());
        let at = rest.first().copied().unwrap_or(node);
        catches.push(self.catch_all(at, steps));
        catches
    }

    fn catch_all(&self, node: Node<'a, 't>, steps: Vec<Step>) -> Catch {
        let span = self.span(node);
        Catch { on: CatchOn::Any(span), bind: None, body: Block::new(steps, span), span }
    }
}

/// All of them; `None` for none.
fn joined(mut tests: Vec<motet_syntax::ast::Expr>) -> Option<motet_syntax::ast::Expr> {
    use motet_syntax::ast::{Expr, ExprKind};
    let last = tests.pop()?;
    let Some(first) = tests.first() else { return Some(last) };
    let span = first.span.to(last.span);
    tests.push(last);
    Some(Expr { kind: ExprKind::All(tests), span })
}

/// Kinds of failure for which a test of the export asks.
fn kinds<'a>(test: Node<'a, '_>) -> Option<Vec<&'a str>> {
    let code = test.attribute("code").filter(|_| id(test) == "ScriptCondition")?;
    let kind = |part: &'a str| {
        let quoted = part.trim().strip_prefix(FAILURE)?.trim_start().strip_prefix("==")?.trim();
        quoted.strip_prefix('\'')?.strip_suffix('\'')
    };
    code.split("||").map(kind).collect()
}

/// Checks if a node asks for the kind of a failure.
fn kinds_follow(node: Node<'_, '_>) -> bool {
    id(node) == "IfThenElse" && elements(node).next().is_some_and(|test| kinds(test).is_some())
}
