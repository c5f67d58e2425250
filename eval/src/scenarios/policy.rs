//! A plan as an ordinary policy in JSON, with a map from its paths back to the steps of the plan.
//!
//! A binding of Motet is visible where every way has bound it, one of a plan from then on. So where a branch
//! binds what is used after it, what comes after is written in both branches; after a body that has always
//! run, such as that of a monitor, the entity itself is named.

use std::collections::HashMap;

use indexmap::IndexMap;
use serde_json::{Value, json};

use super::row::{Do, Names, Node, Row, Step};
use super::words::{self, Bound, Conditions};

/// The most steps that writing a continuation twice may lead to.
const MAX_STEPS: usize = 10_000;

/// A place in a plan.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(super) struct Spot {
    pub(super) order: usize,
    pub(super) label: String,
}

/// A plan as a policy.
#[derive(Clone, Debug)]
pub(super) struct Written {
    pub(super) policy: Value,
    /// From a pointer of the policy to the step of the plan.
    spots: HashMap<String, Spot>,
    /// Fluents that the plan's conditions speak of beyond those of the contract, with their number of
    /// parameters.
    pub(super) fluents: IndexMap<String, usize>,
}

impl Written {
    /// The step of the plan that a pointer into the policy leads into; none for the goal and the whole.
    pub(super) fn spot(&self, pointer: &str) -> Option<&Spot> {
        let mut at = pointer;
        loop {
            if let Some(spot) = self.spots.get(at) {
                return Some(spot);
            }
            at = at.rsplit_once('/')?.0;
        }
    }

    /// The parallel step around the place that a pointer leads to.
    pub(super) fn parallel(&self, pointer: &str) -> Option<&Spot> {
        self.spot(pointer.rsplit_once("/parallel/")?.0)
    }
}

/// Writes the plan of a row, with the goal of its scene.
pub(super) fn write(row: &Row, plan: &[Node], names: &Names) -> Result<Written, String> {
    let mut conditions = Conditions::new(names);
    for rule in row.scene.get("rules").and_then(Value::as_array).into_iter().flatten() {
        if let Some(watched) = rule.get("cond").and_then(Value::as_str) {
            conditions.declare(watched);
        }
    }
    let mut writer =
        Writer { names, conditions, scope: Scope::default(), spots: HashMap::new(), bound: 0, written: 0 };
    let mut steps = Vec::with_capacity(plan.len() + 1);
    if row.scene.contains_key("swap_point") {
        writer.push(
            &mut steps,
            "/steps",
            &Spot { order: 0, label: "start".to_owned() },
            json!({"do": "take_over"}),
        );
    }
    writer.block(&plan.iter().collect::<Vec<_>>(), "/steps", &mut steps)?;
    let mut policy = json!({"motet": 1, "policy": "plan", "robot": row.robot});
    let goal = row.scene.get("goal").and_then(Value::as_array).into_iter().flatten();
    let goal: Vec<_> = goal.map(|atom| writer.conditions.atom(atom, &Scope::default())).collect();
    if let Some(keys) = policy.as_object_mut() {
        if !goal.is_empty() {
            keys.insert("achieves".into(), json!({"all": goal}));
        }
        keys.insert("steps".into(), Value::Array(steps));
    }
    Ok(Written { policy, spots: writer.spots, fluents: writer.conditions.into_fluents() })
}

/// Meanings of the references of the plan, the innermost block last.
#[derive(Clone, Debug)]
pub(super) struct Scope(Vec<HashMap<String, Bound>>);

impl Default for Scope {
    fn default() -> Self {
        Self(vec![HashMap::new()])
    }
}

impl Scope {
    pub(super) fn find(&self, reference: &str) -> Option<&Bound> {
        self.0.iter().rev().find_map(|block| block.get(reference))
    }

    fn bind(&mut self, reference: &str, bound: Bound) {
        if let Some(block) = self.0.last_mut() {
            block.insert(reference.to_owned(), bound);
        }
    }
}

struct Writer<'n> {
    names: &'n Names,
    conditions: Conditions<'n>,
    scope: Scope,
    spots: HashMap<String, Spot>,
    bound: usize,
    written: usize,
}

impl Writer<'_> {
    fn push(&mut self, steps: &mut Vec<Value>, at: &str, spot: &Spot, step: Value) -> String {
        let pointer = format!("{at}/{}", steps.len());
        self.spots.insert(pointer.clone(), spot.clone());
        self.written += 1;
        steps.push(step);
        pointer
    }

    fn set(steps: &mut [Value], key: &str, value: Value) {
        if let Some(keys) = steps.last_mut().and_then(Value::as_object_mut) {
            keys.insert(key.to_owned(), value);
        }
    }

    /// Writes steps one after the other, the last of which are what comes after.
    fn block(&mut self, nodes: &[&Node], at: &str, steps: &mut Vec<Value>) -> Result<(), String> {
        if self.written > MAX_STEPS {
            return Err("the plan is too large".to_owned());
        }
        for (index, node) in nodes.iter().enumerate() {
            let after = nodes.get(index + 1..).unwrap_or_default();
            let spot = Spot { order: node.order, label: node.label.clone() };
            match &node.step {
                Step::Do(call) => self.call(call, &spot, at, steps),
                Step::If { condition, then, otherwise } => {
                    let escapes = escapes(then.iter().chain(otherwise), after);
                    let rest = if escapes { after } else { &[] };
                    let condition = self.conditions.value(condition, &self.scope);
                    let here = self.push(steps, at, &spot, json!({"if": condition}));
                    for (key, arm) in [("then", then), ("else", otherwise)] {
                        let arm = self.inner(&joined(arm, rest), &format!("{here}/{key}"))?;
                        Self::set(steps, key, arm);
                    }
                    if escapes {
                        return Ok(());
                    }
                }
                Step::Retry { times, body, on_fail } => {
                    if self.retry(times, body, on_fail, after, &spot, at, steps)? {
                        return Ok(());
                    }
                }
                Step::While { condition, max, body } => {
                    let condition = self.conditions.value(condition, &self.scope);
                    let here = self.push(steps, at, &spot, json!({"repeat": bound(max)}));
                    let inner = format!("{here}/steps/0");
                    self.spots.insert(inner.clone(), spot.clone());
                    let body = self.inner(&joined(body, &[]), &format!("{inner}/then"))?;
                    Self::set(steps, "steps", json!([{"if": condition, "then": body}]));
                }
                Step::Monitor { condition, reaction, body } => {
                    let whens = self.conditions.list(condition, &self.scope);
                    let reaction = words::reaction(reaction);
                    let whens: Vec<_> =
                        whens.iter().map(|when| json!({"when": when, "then": reaction})).collect();
                    let here = self.push(steps, at, &spot, json!({"monitor": whens}));
                    let body = self.surviving(body, &format!("{here}/during"))?;
                    Self::set(steps, "during", body);
                }
                Step::Parallel { branches } => {
                    let here = self.push(steps, at, &spot, json!({}));
                    let mut list = Vec::with_capacity(branches.len());
                    for (index, branch) in branches.iter().enumerate() {
                        list.push(self.surviving(branch, &format!("{here}/parallel/{index}"))?);
                    }
                    Self::set(steps, "parallel", Value::Array(list));
                }
            }
        }
        Ok(())
    }

    /// A block of its own.
    fn inner(&mut self, nodes: &[&Node], at: &str) -> Result<Value, String> {
        self.scope.0.push(HashMap::new());
        let mut steps = Vec::with_capacity(nodes.len());
        let done = self.block(nodes, at, &mut steps);
        self.scope.0.pop();
        done.map(|()| Value::Array(steps))
    }

    /// A block that always runs: what it binds is still known after it, by its id.
    fn surviving(&mut self, nodes: &[Node], at: &str) -> Result<Value, String> {
        self.scope.0.push(HashMap::new());
        let mut steps = Vec::with_capacity(nodes.len());
        let done = self.block(&nodes.iter().collect::<Vec<_>>(), at, &mut steps);
        for (reference, bound) in self.scope.0.pop().unwrap_or_default() {
            if let Some(entity) = bound.entity {
                self.scope.bind(&reference, Bound::entity(entity));
            }
        }
        done.map(|()| Value::Array(steps))
    }

    /// True if the steps after it were written with it. The contract does not say what a failed attempt
    /// leaves behind, so one attempt at several steps stands for all.
    #[expect(clippy::too_many_arguments, reason = "the parts of a step and where it goes")]
    fn retry(
        &mut self,
        times: &Value,
        body: &[Node],
        on_fail: &[Node],
        after: &[&Node],
        spot: &Spot,
        at: &str,
        steps: &mut Vec<Value>,
    ) -> Result<bool, String> {
        let Some(times) = times.as_u64() else {
            let here = self.push(steps, at, spot, json!({"repeat": bound(times)}));
            let body = self.inner(&joined(body, &[]), &format!("{here}/steps"))?;
            Self::set(steps, "steps", body);
            return Ok(false);
        };
        let again = match body {
            [Node { step: Step::Do(_), .. }] if times > 1 => Some(times - 1),
            _ => None,
        };
        let retried = |steps: &mut [Value]| {
            if let Some(again) = again
                && steps.last().is_some_and(|step| step.get("do").is_some())
            {
                Self::set(steps, "retry", json!(again));
            }
        };
        if on_fail.is_empty() {
            self.block(&joined(body, &[]), at, steps)?;
            retried(steps);
            return Ok(false);
        }
        // Where the handler ends the policy, what comes after follows a body that has run.
        let ended = ends(on_fail);
        let escapes = !ended && escapes(body.iter().chain(on_fail), after);
        let rest = if escapes { after } else { &[] };
        let here = self.push(steps, at, spot, json!({}));
        let inside = format!("{here}/try");
        let mut tried =
            if ended { self.surviving(body, &inside)? } else { self.inner(&joined(body, rest), &inside)? };
        if let (Some(tried), false) = (tried.as_array_mut(), escapes) {
            retried(tried);
        }
        Self::set(steps, "try", tried);
        let handler = self.inner(&joined(on_fail, rest), &format!("{here}/catch/0/steps"))?;
        Self::set(steps, "catch", json!([{"on": ["any"], "steps": handler}]));
        Ok(escapes)
    }

    /// A primitive, and what the language needs before it.
    fn call(&mut self, call: &Do, spot: &Spot, at: &str, steps: &mut Vec<Value>) {
        let mut binding = || {
            self.bound += 1;
            self.bound
        };
        let (written, bound) = words::call(call, self.names, &self.scope, &mut binding);
        for step in written {
            self.push(steps, at, spot, step);
        }
        if let (Some(reference), Some(bound)) = (&call.binds, bound) {
            self.scope.bind(reference, bound);
        }
    }
}

/// Bound of a loop. For no bound the language has no word, and says so of this one.
fn bound(times: &Value) -> Value {
    if times.is_null() { json!("forever") } else { times.clone() }
}

/// A block with what comes after it, where it does not end the policy.
fn joined<'n>(block: &'n [Node], after: &[&'n Node]) -> Vec<&'n Node> {
    let after = if ends(block) { &[] } else { after };
    block.iter().chain(after.iter().copied()).collect()
}

/// True if a block ends the policy by its last step.
fn ends(block: &[Node]) -> bool {
    match block.last().map(|node| &node.step) {
        Some(Step::Do(call)) => call.op == "done",
        Some(Step::If { then, otherwise, .. }) => ends(then) && ends(otherwise),
        Some(Step::Retry { .. } | Step::While { .. } | Step::Monitor { .. } | Step::Parallel { .. })
        | None => false,
    }
}

/// True if blocks bind names that are used after them.
fn escapes<'n>(blocks: impl Iterator<Item = &'n Node>, after: &[&Node]) -> bool {
    let mut bound = Vec::new();
    blocks.for_each(|node| {
        visit(node, &mut |step| {
            if let Step::Do(call) = step {
                bound.extend(call.binds.clone());
            }
        })
    });
    let mut used = false;
    for node in after {
        visit(node, &mut |step| {
            let texts: Vec<&str> = match step {
                Step::Do(call) => call.args.iter().filter_map(Value::as_str).collect(),
                Step::If { condition, .. }
                | Step::While { condition, .. }
                | Step::Monitor { condition, .. } => condition.as_str().into_iter().collect(),
                Step::Retry { .. } | Step::Parallel { .. } => Vec::new(),
            };
            used |= bound.iter().any(|name| texts.iter().any(|text| text.contains(&format!("${name}"))));
        });
    }
    used
}

/// A node and all below it.
fn visit(node: &Node, run: &mut dyn FnMut(&Step)) {
    run(&node.step);
    let blocks: Vec<&[Node]> = match &node.step {
        Step::Do(_) => Vec::new(),
        Step::If { then, otherwise, .. } => vec![then, otherwise],
        Step::Retry { body, on_fail, .. } => vec![body, on_fail],
        Step::While { body, .. } | Step::Monitor { body, .. } => vec![body],
        Step::Parallel { branches } => branches.iter().map(Vec::as_slice).collect(),
    };
    for node in blocks.into_iter().flatten() {
        visit(node, run);
    }
}
