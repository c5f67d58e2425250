//! Nodes that are steps or contain steps.

use motet_syntax::ast::{
    Block, Call, Catch, CatchOn, Do, End, EndKind, Expr, ExprKind, Name, Step, StepKind,
};
use motet_syntax::ast::{Reaction, When};
use motet_syntax::unit::Unit;
use roxmltree::Node;

use super::condition::negated;
use super::{Context, Importer, elements, id};
use crate::names::{ENDED, FAILURE, NEEDS, POLL_MSEC, is_added};

impl<'a, 't> Importer<'_, 'a, 't> {
    /// Steps of a node.
    pub(super) fn node(&mut self, node: Node<'a, 't>, context: Context) -> Vec<Step> {
        if !self.conditions_of_node(node) {
            return Vec::new();
        }
        let steps = match id(node) {
            "Sequence" | "AsyncSequence" => return self.sequence(node, context),
            "Fallback" | "AsyncFallback" => return self.fallback(node, context),
            "ReactiveSequence" => self.reactive(node, context),
            "Parallel" => self.parallel(node, context),
            "IfThenElse" => self.branch(node, context),
            "Repeat" => self.repeat(node, context),
            "RetryUntilSuccessful" => return self.retry(node, context),
            "Timeout" => return self.timeout(node, context),
            "ForceSuccess" => self.forced(node, context),
            "Sleep" => self.sleep(node, "msec", context),
            "Delay" => {
                let mut steps: Vec<_> = self.sleep(node, "delay_msec", context).into_iter().collect();
                if let Some(child) = self.only_child(node) {
                    steps.extend(self.node(child, context));
                }
                return steps;
            }
            "AlwaysSuccess" => None,
            "AlwaysFailure" => self.failure(node, node, EndKind::Fail, context),
            "SubTree" => self.subtree(node, context),
            "SetBlackboard" => self.assignment(node, context),
            "Script" | "ScriptCondition" => {
                self.refuse(node, "a policy has no scripts");
                None
            }
            "Inverter" if self.is_condition(node) => self.requirement(node, context),
            name if crate::names::BUILT_IN.contains(&name) => {
                self.refuse(node, "no step of a policy has its meaning");
                None
            }
            _ if self.is_condition(node) => self.requirement(node, context),
            _ => self.call(node, context),
        };
        steps.into_iter().collect()
    }

    /// Refuses the preconditions and scripts of a node, but for those that the export writes.
    fn conditions_of_node(&mut self, node: Node<'a, 't>) -> bool {
        let known = [
            "_failureIf",
            "_successIf",
            "_skipIf",
            "_while",
            "_onSuccess",
            "_onFailure",
            "_onHalted",
            "_post",
        ];
        let is_own = |value: &str| {
            let target = value.split(":=").next().unwrap_or_default().trim();
            is_added(target) && value.contains(":=")
        };
        let wrong = node.attributes().find(|attribute| {
            known.contains(&attribute.name())
                && !(attribute.name() == "_onFailure" && is_own(attribute.value()))
        });
        if let Some(attribute) = wrong {
            let reason = format!("a policy has no scripts, and this node has `{}`", attribute.name());
            self.refuse(node, reason);
        }
        wrong.is_none()
    }

    pub(super) fn only_child(&mut self, node: Node<'a, 't>) -> Option<Node<'a, 't>> {
        let children: Vec<_> = elements(node).collect();
        if let [only] = children.as_slice() {
            return Some(*only);
        }
        self.wrong(node, format!("`<{}>` has one child, not {}", node.tag_name().name(), children.len()));
        None
    }

    fn sequence(&mut self, node: Node<'a, 't>, context: Context) -> Vec<Step> {
        let children: Vec<_> = elements(node).collect();
        if children.is_empty() {
            self.wrong(node, format!("`<{}>` has no children", node.tag_name().name()));
        }
        if let [script, failing] = children.as_slice()
            && let Some(kind) = ending(*script)
            && id(*failing) == "AlwaysFailure"
        {
            return self.failure(node, *failing, kind, context).into_iter().collect();
        }
        if let Some(step) = self.loop_with_test(node, &children, context) {
            return step.into_iter().collect();
        }
        let mut rest = children.as_slice();
        if node.attribute("name") == Some(NEEDS)
            && let Some((call, guards)) = rest.split_last()
            && guards.iter().all(|guard| self.is_need(*guard) || is_start(*guard))
        {
            // The compiler finds the guards by the contract of the action.
            return self.node(*call, context);
        }
        while let Some((_, more)) = rest.split_first().filter(|(first, _)| is_start(**first)) {
            rest = more;
        }
        let name = self.spans.attribute(node, "name").filter(|(name, _)| !name.is_empty());
        let inner = if name.is_some() { context.inside() } else { context };
        let steps: Vec<_> = rest.iter().flat_map(|child| self.node(*child, inner)).collect();
        match name {
            None => steps,
            Some((name, span)) => {
                let name = Name { text: name.into(), span };
                let kind = StepKind::Sequence { name, body: self.block(node, steps) };
                self.made(node, context, kind).into_iter().collect()
            }
        }
    }

    /// A condition in the place of a step: where it does not hold, the tree fails.
    fn requirement(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        if !context.fails_tree {
            self.refuse(node, "another node handles its failure, and a policy has no failing step for that");
            return None;
        }
        let condition = self.condition(node)?;
        let shown =
            node.attribute("name").map_or_else(|| format!("{} does not hold", id(node)), str::to_owned);
        let end = self.end(node, EndKind::Fail, Some(&shown));
        let fails = self.made(node, context.inside(), StepKind::End(end))?;
        let otherwise = Some(self.block(node, vec![fails]));
        let kind = StepKind::If { condition, then: self.block(node, Vec::new()), otherwise };
        self.made(node, context, kind)
    }

    pub(super) fn end(&self, node: Node<'a, 't>, kind: EndKind, why: Option<&str>) -> End {
        let span = self.span(node);
        let why = why.map(|why| Expr { kind: ExprKind::Text(why.into()), span });
        End { kind, result: None, why, span }
    }

    /// An ending of the policy, which in a tree is a failure that nothing handles.
    fn failure(
        &mut self,
        node: Node<'a, 't>,
        failing: Node<'a, 't>,
        kind: EndKind,
        context: Context,
    ) -> Option<Step> {
        // The export guards handlers against endings; a plain failure is handled.
        if !context.fails_tree && id(node) == "AlwaysFailure" {
            self.refuse(node, "another node handles its failure, and a policy has no failing step for that");
            return None;
        }
        let why = failing.attribute("name").filter(|_| kind != EndKind::Done);
        let end = self.end(node, kind, why);
        self.made(node, context, StepKind::End(end))
    }

    fn reactive(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let children: Vec<_> = elements(node).collect();
        let Some((body, guards)) = children.split_last().filter(|(_, guards)| !guards.is_empty()) else {
            self.refuse(node, "it has no condition before its last child");
            return None;
        };
        let mut whens = Vec::new();
        for guard in guards {
            let parts: Vec<_> = elements(*guard).collect();
            let (condition, kind, why) = match parts.as_slice() {
                [condition, sequence] if id(*guard) == "Fallback" && self.is_condition(*condition) => {
                    let steps: Vec<_> = elements(*sequence).collect();
                    let ending = steps.first().and_then(|script| ending(*script));
                    let why = steps.get(1).and_then(|failing| failing.attribute("name"));
                    (*condition, ending, why)
                }
                _ => (*guard, context.fails_tree.then_some(EndKind::Fail), guard.attribute("name")),
            };
            let Some(kind) = kind.filter(|_| self.is_condition(condition)) else {
                let reason =
                    "each child before the last is a condition, and a failure of the node fails the tree";
                self.refuse(*guard, reason);
                return None;
            };
            let holds = self.condition(condition)?;
            let reaction = Reaction::End(self.end(*guard, kind, why.filter(|_| kind != EndKind::Done)));
            whens.push(When { condition: negated(holds), hold: None, reaction, span: self.span(*guard) });
        }
        let steps = self.node(*body, context.inside());
        let kind = StepKind::Monitor { whens, body: self.block(*body, steps) };
        self.made(node, context, kind)
    }

    fn parallel(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let children: Vec<_> = elements(node).collect();
        let count =
            |key: &str, default: &'static str| node.attribute(key).unwrap_or(default).trim().to_owned();
        let all = children.len().to_string();
        let success = count("success_count", "-1");
        if (success != "-1" && success != all) || count("failure_count", "1") != "1" || children.is_empty() {
            self.refuse(node, "`parallel` succeeds when all branches have, and fails when one has");
            return None;
        }
        let inner = Context { fails_tree: context.fails_tree, ..context.inside() };
        let branches = children.iter().map(|child| {
            let steps = self.node(*child, inner);
            self.block(*child, steps)
        });
        let branches: Vec<Block> = branches.collect();
        self.made(node, context, StepKind::Parallel { branches })
    }

    fn branch(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let children: Vec<_> = elements(node).collect();
        let (test, then, otherwise) = match children.as_slice() {
            [test, then] => (*test, *then, None),
            [test, then, otherwise] => (*test, *then, Some(*otherwise)),
            _ => {
                self.wrong(node, format!("`<IfThenElse>` has two or three children, not {}", children.len()));
                return None;
            }
        };
        if !self.is_condition(test) {
            self.refuse(test, "the first child of `<IfThenElse>` has to be a condition");
            return None;
        }
        let condition = self.condition(test)?;
        let steps = self.node(then, context.inside());
        let then = self.block(then, steps);
        let otherwise = match otherwise {
            Some(otherwise) if id(otherwise) == "AlwaysSuccess" => None,
            Some(otherwise) => {
                let steps = self.node(otherwise, context.inside());
                Some(self.block(otherwise, steps))
            }
            None if context.fails_tree => {
                let end = self.end(test, EndKind::Fail, Some("the condition does not hold"));
                let step = self.made(test, context.inside(), StepKind::End(end))?;
                Some(self.block(test, vec![step]))
            }
            None => {
                let reason = "it fails where its condition does not hold, and another node handles that";
                self.refuse(node, reason);
                return None;
            }
        };
        self.made(node, context, StepKind::If { condition, then, otherwise })
    }

    /// A whole number of an attribute, at least one.
    fn count(&mut self, node: Node<'a, 't>, key: &'static str) -> Option<Expr> {
        let (text, span) = self.spans.required(node, key, &mut self.found)?;
        match text.trim().parse::<u32>() {
            Ok(count @ 1..) => Some(Expr { kind: ExprKind::Number(f64::from(count)), span }),
            Ok(0) | Err(_) => {
                self.refuse(node, format!("`{key}` has to be a whole number above zero: every loop ends"));
                None
            }
        }
    }

    fn repeat(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let (times, child) = (self.count(node, "num_cycles")?, self.only_child(node)?);
        let steps = self.node(child, context.inside());
        self.made(node, context, StepKind::Repeat { times, body: self.block(child, steps), until: None })
    }

    /// The loop with a test, as the export writes it. `None` for another sequence.
    fn loop_with_test(
        &mut self,
        node: Node<'a, 't>,
        children: &[Node<'a, 't>],
        context: Context,
    ) -> Option<Option<Step>> {
        let [start, cycles, end] = children else { return None };
        let is_met = |node: &Node<'a, 't>| {
            id(*node) == "ScriptCondition"
                && node
                    .attribute("code")
                    .is_some_and(|code| code.starts_with("met_") && code.ends_with(" == true"))
        };
        if id(*start) != "Script" || id(*cycles) != "Repeat" || !is_met(end) {
            return None;
        }
        let round = elements(*cycles).next().filter(|round| id(*round) == "IfThenElse")?;
        let parts: Vec<_> = elements(round).collect();
        let [met, nothing, round] = parts.as_slice() else { return None };
        let parts: Vec<_> = elements(*round).collect();
        let [body, test] = parts.as_slice() else { return None };
        if !is_met(met) || id(*nothing) != "AlwaysSuccess" || id(*test) != "IfThenElse" {
            return None;
        }
        let test = elements(*test).next()?;
        Some(self.count(*cycles, "num_cycles").and_then(|times| {
            let until = Some(self.condition(test)?);
            let steps = self.node(*body, context.inside());
            self.made(node, context, StepKind::Repeat { times, body: self.block(*body, steps), until })
        }))
    }

    fn retry(&mut self, node: Node<'a, 't>, context: Context) -> Vec<Step> {
        let Some(attempts) = self.count(node, "num_attempts") else { return Vec::new() };
        let Some(child) = self.only_child(node) else { return Vec::new() };
        let mut steps = self.node(child, Context { fails_tree: false, ..context });
        if let [Step { kind: StepKind::Do(call), .. }] = steps.as_mut_slice()
            && call.retry.is_none()
            && self.vocabulary.actions.contains_key(&call.call.name.text)
        {
            if let ExprKind::Number(count) = attempts.kind {
                let kind = ExprKind::Number(count - 1.0);
                call.retry = (count > 1.0).then_some(Expr { kind, ..attempts });
            }
            return steps;
        }
        self.refuse(node, "a policy repeats one action after a failure, not several steps");
        Vec::new()
    }

    fn timeout(&mut self, node: Node<'a, 't>, context: Context) -> Vec<Step> {
        let Some(time) = self.msec(node, "msec") else { return Vec::new() };
        let Some(child) = self.only_child(node) else { return Vec::new() };
        if let Some(step) = self.wait(node, child, &time, context) {
            return step.into_iter().collect();
        }
        let steps = self.node(child, context.inside());
        if let [Step { kind: StepKind::Do(call), .. }] = steps.as_slice()
            && call.within.is_none()
            && call.retry.is_none()
            && self.vocabulary.actions.contains_key(&call.call.name.text)
        {
            let call = Do { within: Some(time), ..call.clone() };
            return vec![Step { kind: StepKind::Do(call), span: self.span(node) }];
        }
        let kind = StepKind::Within { time, body: self.block(child, steps) };
        self.made(node, context, kind).into_iter().collect()
    }

    /// A condition that is looked at until it holds. `None` for another node.
    fn wait(
        &mut self,
        node: Node<'a, 't>,
        child: Node<'a, 't>,
        time: &Expr,
        context: Context,
    ) -> Option<Option<Step>> {
        if id(child) != "RetryUntilSuccessful" || child.attribute("num_attempts")?.trim() != "-1" {
            return None;
        }
        let look = elements(child).next()?;
        let parts: Vec<_> = elements(look).collect();
        let condition = match parts.as_slice() {
            _ if self.is_condition(look) => look,
            [condition, again] if id(look) == "Fallback" && self.is_condition(*condition) => {
                let again: Vec<_> = elements(*again).collect();
                let is_poll = matches!(again.as_slice(), [sleep, failing] if id(*sleep) == "Sleep"
                    && sleep.attribute("msec") == Some(POLL_MSEC) && id(*failing) == "AlwaysFailure");
                if !is_poll {
                    return None;
                }
                *condition
            }
            _ => return None,
        };
        let condition = self.condition(condition);
        Some(condition.and_then(|condition| {
            self.made(node, context, StepKind::Wait { condition, within: Some(time.clone()) })
        }))
    }

    fn forced(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let child = self.only_child(node)?;
        let steps = self.node(child, context.handled());
        let span = self.span(node);
        let catch = Catch { on: CatchOn::Any(span), bind: None, body: self.block(node, Vec::new()), span };
        self.made(node, context, StepKind::Try { body: self.block(child, steps), catches: vec![catch] })
    }

    /// A time in milliseconds, in seconds.
    fn msec(&mut self, node: Node<'a, 't>, key: &'static str) -> Option<Expr> {
        let (text, span) = self.spans.required(node, key, &mut self.found)?;
        match text.trim().parse::<u32>() {
            Ok(msec @ 1..) => {
                Some(Expr { kind: ExprKind::Quantity(f64::from(msec) / 1e3, Unit::Second), span })
            }
            Ok(0) | Err(_) => {
                self.refuse(node, format!("`{key}` has to be a number of milliseconds above zero"));
                None
            }
        }
    }

    fn sleep(&mut self, node: Node<'a, 't>, key: &'static str, context: Context) -> Option<Step> {
        let time = self.msec(node, key)?;
        self.made(node, context, StepKind::Delay { time })
    }

    fn subtree(&mut self, node: Node<'a, 't>, context: Context) -> Option<Step> {
        let (tree, span) = self.spans.required(node, "ID", &mut self.found)?;
        let ports = node.attributes().find(|attribute| !matches!(attribute.name(), "ID" | "name"));
        if let Some(port) = ports {
            let reason = format!(
                "a policy shares no entries with the one that calls it, and this has `{}`",
                port.name()
            );
            self.refuse(node, reason);
            return None;
        }
        let Some((id, _)) = self.trees.get_key_value(tree) else {
            self.wrong(node, format!("there is no tree `{}` in the file", tree.escape_debug()));
            return None;
        };
        let id = *id;
        if !self.wanted.contains(&id) {
            self.wanted.push(id);
        }
        let name = Name { text: tree.into(), span };
        let call = Call { name, args: Vec::new(), span: self.span(node) };
        let call = Do { call, bind: None, manner: None, within: None, retry: None };
        self.made(node, context, StepKind::Do(call))
    }
}

/// Ending of a policy that a script of the export sets.
pub(super) fn ending(script: Node<'_, '_>) -> Option<EndKind> {
    let code = script.attribute("code").filter(|_| id(script) == "Script")?;
    let word = code.strip_prefix(ENDED)?.trim().strip_prefix(":=")?.trim();
    match word {
        "'done'" => Some(EndKind::Done),
        "'fail'" => Some(EndKind::Fail),
        "'cannot'" => Some(EndKind::Cannot),
        "'replan'" => Some(EndKind::Replan),
        _ => None,
    }
}

/// Checks if a node is a script of the export that sets entries before the steps.
fn is_start(node: Node<'_, '_>) -> bool {
    let is_set = |part: &str| {
        let (target, value) = part.split_once(":=").unwrap_or_default();
        is_added(target.trim()) && matches!(value.trim(), "''" | "'timeout'")
    };
    id(node) == "Script" && node.attribute("code").is_some_and(|code| code.split(';').all(is_set))
        || node.attribute("code").is_some_and(|code| code.trim() == format!("{FAILURE} := ''"))
}
