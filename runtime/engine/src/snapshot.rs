//! The state of a run as plain data: what a compiler proves a new policy from, and what a trace shows.

use crate::belief::{Beliefs, Facts, PerceivedFact, truth_of};
use crate::cleanup::PendingCleanup;
use crate::effect::Command;
use crate::ids::GoalId;
use crate::json;
use crate::prepared_graph::PreparedGraph;
use crate::query::{Answer, Pattern, Query, Reading, Truth};
use crate::start::StartState;
use crate::state::{Phase, Run};
use crate::time::Time;
use motet_graph::{Graph, NodeId, NodeKind, Value};
use motet_stdlib::lang::is_bare_name;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smol_str::SmolStr;
use std::fmt::Write as _;
use std::sync::Arc;

/// A state between two events.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Snapshot {
    pub at: Time,
    /// The number of the graph that runs.
    pub revision: u32,
    /// The policy that runs.
    pub policy: SmolStr,
    /// The robot that it is for.
    pub robot: SmolStr,
    /// Believed facts in order: a later one overrides an earlier one, and one with `any` holds for every
    /// entity. Facts that are not listed are unknown.
    #[serde(with = "json::facts")]
    #[schemars(with = "Vec<json::FactRow>")]
    pub facts: Vec<(Query, Truth)>,
    /// Facts with `any` that hold of some entity, where it is not known of which.
    pub some: Vec<Query>,
    /// Of these facts, those that last only so long.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lasting: Vec<PerceivedFact>,
    /// The last readings of measures and fields, with their times, by query.
    pub readings: Vec<Reading>,
    /// Entities that the engine has heard of, with the name of their kind where it is known.
    #[serde(with = "json::entities")]
    #[schemars(with = "Vec<json::EntityRow>")]
    pub entities: Vec<(SmolStr, SmolStr)>,
    /// Names that are bound, in the order of the graph.
    #[serde(with = "json::bindings")]
    #[schemars(with = "Vec<json::BindingRow>")]
    pub bindings: Vec<(SmolStr, Value)>,
    /// Live goals in the order of their starts.
    pub goals: Vec<LiveGoal>,
    /// Cleanups that have not run to their end and would still be due: first those of earlier policies, then
    /// those of the policy that runs, in the order of the document.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub pending: Vec<PendingCleanup>,
}

/// A goal that has not ended.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LiveGoal {
    pub goal: GoalId,
    pub command: Arc<Command>,
    /// The path of the step that started it, in the graph of its time.
    pub path: SmolStr,
}

impl Snapshot {
    /// The same as a start for another engine.
    #[must_use]
    pub fn start_state(&self) -> StartState {
        StartState {
            facts: self.facts.clone(),
            some: self.some.clone(),
            lasting: self.lasting.clone(),
            entities: self.entities.clone(),
            bindings: self.bindings.clone(),
            pending: self.pending.clone(),
        }
    }

    /// The facts in the text form, as a state file has them: what holds is true, what does not is false, what
    /// is unknown though something before it says otherwise is none. Only facts about entities and cases can
    /// be said.
    #[must_use]
    pub fn state(&self) -> Vec<(String, Option<bool>)> {
        let said = self.facts.iter().filter_map(|(query, truth)| Some((fact_text(query)?, known(*truth))));
        said.collect()
    }

    pub(crate) fn of(plan: &PreparedGraph, run: &Run) -> Self {
        let graph = &plan.graph;
        let mut fluents: Vec<(&SmolStr, &Facts)> = run.beliefs.fluents.iter().collect();
        fluents.sort_by_key(|(name, _)| *name);
        let mut facts = Vec::new();
        for (name, own) in &fluents {
            let wide = own.wides.iter().map(|wide| {
                let query = Query::Fact { fluent: (*name).clone(), args: wide.args.clone() };
                (query, truth_of(&wide.answer))
            });
            facts.extend(wide);
            facts.extend(singles(&run.beliefs, name, own));
        }
        let some =
            fluents.iter().flat_map(|(_, own)| own.patterns.iter()).filter_map(|id| run.beliefs.cell(*id));
        let some = some.filter(|cell| cell.answer == Answer::Truth(true)).map(|cell| (*cell.query).clone());
        let mut readings: Vec<_> = run.beliefs.readings().collect();
        readings.sort_by_cached_key(|reading| reading.query.to_string());
        let bindings = graph.bindings.iter().zip(&run.bindings);
        let mut goals: Vec<LiveGoal> = Vec::new();
        for (goal, node) in run.goals.live() {
            if let Some(command) = run.command(plan, node) {
                goals.push(LiveGoal { goal, command, path: plan.node(node).path.clone() });
            }
        }
        let orphans = run.orphans.iter().map(|orphan| LiveGoal {
            goal: orphan.goal,
            command: orphan.command.clone(),
            path: orphan.plan.node(orphan.node).path.clone(),
        });
        goals.extend(orphans);
        goals.sort_by_key(|live| live.goal);
        Self {
            at: run.now,
            revision: run.revision,
            policy: graph.policy.clone(),
            robot: graph.robot.clone(),
            facts,
            some: some.collect(),
            lasting: run.beliefs.lasting.clone(),
            readings,
            entities: run.beliefs.entities.named().collect(),
            bindings: bindings
                .filter_map(|(binding, value)| Some((binding.name.clone(), value.clone()?)))
                .collect(),
            goals,
            pending: run.left.iter().cloned().chain(due(plan, run)).collect(),
        }
    }
}

/// Steps whose cleanup is due: control is in them, or left them without it.
pub(crate) fn pending(plan: &PreparedGraph, run: &Run) -> impl Iterator<Item = NodeId> {
    let steps = plan.graph.nodes.iter().enumerate().map(|(index, step)| (NodeId(index as u32), step));
    let with_cleanup = steps.filter(|(_, step)| matches!(step.kind, NodeKind::Finally { .. }));
    let is_due =
        |node: &NodeId| run.nodes.at(node.index()).phase == Phase::Inside || run.uncleaned.contains(node);
    with_cleanup.map(|(node, _)| node).filter(is_due)
}

/// Cleanups of the policy that runs which would still be due, with the values of the names in them.
pub(crate) fn due(plan: &PreparedGraph, run: &Run) -> Vec<PendingCleanup> {
    let mut steps = pending(plan, run).peekable();
    if steps.peek().is_none() {
        return Vec::new();
    }
    let mut graph = Graph::clone(&plan.graph);
    for (binding, value) in graph.bindings.iter_mut().zip(&run.bindings) {
        if let Some(value) = value {
            binding.name = value.to_string().into();
        }
    }
    steps.filter_map(|node| PendingCleanup::of(&graph, node)).collect()
}

/// Single facts of which something else is believed than of all that the same patterns cover.
fn singles(beliefs: &Beliefs, fluent: &SmolStr, own: &Facts) -> Vec<(Query, Truth)> {
    let mut singles = Vec::new();
    for cell in own.cells.iter().filter_map(|id| beliefs.cell(*id)) {
        if let Query::Fact { args, .. } = &*cell.query {
            let (wide, _) = beliefs.wide_answer(fluent, args);
            if truth_of(&wide) != truth_of(&cell.answer) {
                singles.push(((*cell.query).clone(), truth_of(&cell.answer)));
            }
        }
    }
    singles.sort_by_cached_key(|(query, _)| query.to_string());
    singles
}

const fn known(truth: Truth) -> Option<bool> {
    match truth {
        Truth::True => Some(true),
        Truth::False => Some(false),
        Truth::Unknown => None,
    }
}

/// A fact as it is written in a policy; none where an argument is no name.
fn fact_text(query: &Query) -> Option<String> {
    let Query::Fact { fluent, args } = query else { return None };
    let mut text = String::new();
    name(&mut text, fluent);
    text.push('(');
    for (index, arg) in args.iter().enumerate() {
        if index > 0 {
            text.push_str(", ");
        }
        match arg {
            Pattern::Any => text.push_str("any"),
            Pattern::Is(Value::Entity(id) | Value::Case(id)) => name(&mut text, id),
            Pattern::Is(Value::Bool(value)) => write!(text, "{value}").ok()?,
            Pattern::Is(Value::Int(value)) => write!(text, "{value}").ok()?,
            Pattern::Is(Value::Number(_) | Value::Text(_) | Value::Pose(_) | Value::List(_)) => return None,
        }
    }
    text.push(')');
    Some(text)
}

/// A name, in back-quotes where it would not be read as one without.
fn name(text: &mut String, id: &str) {
    if is_bare_name(id) {
        text.push_str(id);
    } else {
        text.push('`');
        text.push_str(id);
        text.push('`');
    }
}
