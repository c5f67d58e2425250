//! Events of a run as JSON objects, one a line, for tools.

use std::collections::BTreeMap;
use std::sync::Arc;

use motet_graph::draw::Names;
use motet_graph::{FailureId, Graph, NodeId, NodeKind, Value};
use motet_runtime::{
    Command, DriverEvent, Effect, EndCause, Event, FailureReport, GoalId, MissingPrimitive, NodeEnding,
    Outcome, RunEnd, Time, TraceEvent, TraceEventKind, Truth,
};
use motet_syntax::{Diagnostic, Sources, render};
use serde_json::{Map, json};

/// Writer of the events of a run: it takes what the engine handles and gives out, and returns lines.
#[derive(Debug)]
pub struct RunEvents {
    graph: Arc<Graph>,
    failures: FailureNames,
}

impl RunEvents {
    /// Writer for the run of a graph.
    #[must_use]
    pub fn new(graph: Arc<Graph>) -> Self {
        Self { graph, failures: FailureNames::default() }
    }

    fn line(&self, now: Time, event: &str, node: Option<NodeId>, more: serde_json::Value) -> String {
        let mut line = Map::new();
        line.insert("at".to_owned(), json!(now.secs()));
        line.insert("event".to_owned(), json!(event));
        if let Some(id) = node {
            line.insert("node".to_owned(), json!(id.0));
            if let Some(node) = self.graph.nodes.get(id.index()) {
                line.insert("path".to_owned(), json!(node.path.as_str()));
                line.insert("step".to_owned(), json!(Names(&self.graph).brief(&node.kind)));
            }
        }
        if let serde_json::Value::Object(more) = more {
            line.extend(more);
        }
        serde_json::Value::Object(line).to_string()
    }

    fn ended(&mut self, ending: NodeEnding, cause: EndCause) -> serde_json::Value {
        let failure = match ending {
            NodeEnding::Failure(kind) => Some(self.failures.name(&self.graph, kind)),
            NodeEnding::Success | NodeEnding::Interrupted => None,
        };
        ended(failure, ending, cause)
    }

    fn record(&mut self, record: &TraceEvent) -> String {
        let at = record.at;
        let graph = Arc::clone(&self.graph);
        self.failures.trace(&graph, record);
        match &record.what {
            TraceEventKind::Entered { node } => self.line(at, "entered", Some(*node), json!({})),
            TraceEventKind::Ended { node, ending, cause } => {
                let more = self.ended(*ending, *cause);
                self.line(at, "ended", Some(*node), more)
            }
            TraceEventKind::Started { node, goal, attempt } => {
                let more = json!({"goal": goal.to_string(), "attempt": attempt});
                self.line(at, "started", Some(*node), more)
            }
            TraceEventKind::GoalEnded { node, goal, ending, cause } => {
                let mut more = self.ended(*ending, *cause);
                if let serde_json::Value::Object(more) = &mut more {
                    more.insert("goal".to_owned(), json!(goal.to_string()));
                }
                self.line(at, "goal_ended", Some(*node), more)
            }
            TraceEventKind::Guard { node, need, truth } => {
                let needs = needed(&graph, *node, *need);
                let more = json!({"need": need, "needs": needs, "truth": word(*truth)});
                self.line(at, "guard", Some(*node), more)
            }
            TraceEventKind::Verified { node, verdict } => {
                self.line(at, "verified", Some(*node), json!({"verdict": verdict.to_string()}))
            }
            TraceEventKind::Tested { node, truth } => {
                self.line(at, "tested", Some(*node), json!({"truth": word(*truth)}))
            }
            TraceEventKind::Fired { node, watch, truth } => {
                let when = watched(&graph, *node, *watch);
                self.line(
                    at,
                    "fired",
                    Some(*node),
                    json!({"watch": watch, "when": when, "truth": word(*truth)}),
                )
            }
            TraceEventKind::GoalObserved { truth } => {
                self.line(at, "goal_observed", None, json!({"truth": word(*truth)}))
            }
            TraceEventKind::CleanupSkipped { node } => {
                self.line(at, "cleanup_skipped", Some(*node), json!({}))
            }
            TraceEventKind::CleanupFailed { node, failure } => {
                let failure = self.failures.name(&graph, *failure);
                self.line(at, "cleanup_failed", Some(*node), json!({"failure": failure}))
            }
            TraceEventKind::WentOn { node, watch } => {
                self.line(at, "went_on", Some(*node), json!({"watch": watch}))
            }
            TraceEventKind::Swapped { policy } => {
                self.line(at, "swapped", None, json!({"policy": &**policy}))
            }
            TraceEventKind::Kept { node, goal } => {
                self.line(at, "kept", Some(*node), json!({"goal": goal.to_string()}))
            }
            TraceEventKind::Updated { node, goal } => {
                self.line(at, "updated", Some(*node), json!({"goal": goal.to_string()}))
            }
            TraceEventKind::Bound { binding, value: bound } => {
                let name = graph.bindings.get(binding.index()).map_or("_", |binding| binding.name.as_str());
                self.line(at, "bound", None, json!({"binding": name, "value": value(bound)}))
            }
        }
    }
}

impl RunEvents {
    /// Takes an event before the engine handles it.
    pub fn event(&mut self, event: &Event) {
        self.failures.event(event);
    }

    /// Line of an effect; `None` for those that say nothing new.
    pub fn effect(&mut self, now: Time, effect: &Effect) -> Option<String> {
        Some(match effect {
            Effect::Start { goal, node, command, deadline } => {
                self.line(now, "command", Some(*node), commanded(*goal, command, *deadline))
            }
            Effect::Update { goal, node, command, deadline } => {
                self.line(now, "update", Some(*node), commanded(*goal, command, *deadline))
            }
            Effect::Report(record) => self.record(record),
            Effect::Cancel { goal } => self.line(now, "cancel", None, json!({"goal": goal.to_string()})),
            Effect::Hold { goal } => self.line(now, "hold", None, json!({"goal": goal.to_string()})),
            Effect::Proceed { goal } => self.line(now, "proceed", None, json!({"goal": goal.to_string()})),
            Effect::SafeStop { goal } => self.line(now, "safe_stop", None, json!({"goal": goal.to_string()})),
            Effect::Verify { check, node, motion } => {
                let asked = json!({"check": check.to_string(), "motion": motion.to_string()});
                self.line(now, "verify", Some(*node), asked)
            }
            Effect::Observe { .. } | Effect::Watch { .. } | Effect::Unwatch { .. } | Effect::Finished(_) => {
                return None;
            }
        })
    }

    /// Line of the end of the run.
    #[must_use]
    pub fn finish(&self, now: Time, end: &RunEnd) -> String {
        let node = match end {
            RunEnd::Failed { node, .. } => Some(*node),
            _ => None,
        };
        let mut more = outcome(end);
        if let RunEnd::Failed { node, why: None, .. } = end
            && let Some(why) = self.failures.reason(*node)
            && let Some(more) = more.as_object_mut()
        {
            more.insert("why".to_owned(), json!(why));
        }
        self.line(now, "finished", node, more)
    }
}

/// End of a run as a JSON object, without its time.
#[must_use]
pub fn outcome(end: &RunEnd) -> serde_json::Value {
    let (outcome, more) = match end {
        RunEnd::Done { why, result: None } => ("done", json!({"why": why})),
        RunEnd::Done { why, result: Some(result) } => ("done", json!({"why": why, "result": value(result)})),
        RunEnd::Failed { kind, why, .. } => ("failed", json!({"failure": kind.as_str(), "why": why})),
        RunEnd::Declined { why } => ("declined", json!({"why": why})),
        RunEnd::Replan { why } => ("replan", json!({"why": why})),
        RunEnd::Interrupted => ("interrupted", json!({})),
        RunEnd::Fault(fault) => ("fault", json!({"why": fault.to_string()})),
    };
    let mut all = json!({"outcome": outcome});
    if let (serde_json::Value::Object(all), serde_json::Value::Object(more)) = (&mut all, more) {
        all.extend(more);
    }
    all
}

/// Lines of the diagnostics of a check, which come before those of the run.
#[must_use]
pub fn diagnostics(diagnostics: &[Diagnostic], sources: &Sources) -> Vec<String> {
    let line = |found| {
        let mut line = Map::new();
        line.insert("event".to_owned(), json!("diagnostic"));
        if let Ok(serde_json::Value::Object(record)) = serde_json::to_value(render::record(found, sources)) {
            line.extend(record);
        }
        serde_json::Value::Object(line).to_string()
    };
    diagnostics.iter().map(line).collect()
}

/// Line of the refusal of a policy by its driver: the primitives that the driver does not have, each with
/// the first step that calls it. `line` gives the line of the step at a path.
#[must_use]
pub fn refused(missing: &[MissingPrimitive], line: &dyn Fn(&str) -> Option<usize>) -> String {
    let item = |one: &MissingPrimitive| {
        let mut item = Map::new();
        item.insert("primitive".to_owned(), json!(one.name.as_str()));
        item.insert("path".to_owned(), json!(one.path.as_str()));
        item.extend(line(&one.path).map(|line| ("line".to_owned(), json!(line))));
        item
    };
    let items: Vec<_> = missing.iter().map(item).collect();
    json!({"event": "refused", "missing": items}).to_string()
}

/// Need of a call, by its number.
#[must_use]
pub fn needed(graph: &Graph, node: NodeId, need: u32) -> String {
    let Some(NodeKind::Call(call)) = graph.nodes.get(node.index()).map(|node| &node.kind) else {
        return "?".to_owned();
    };
    call.needs.get(need as usize).map_or_else(|| "?".to_owned(), |need| Names(graph).needed(need))
}

/// Condition of a watch.
#[must_use]
pub fn watched(graph: &Graph, node: NodeId, watch: u32) -> String {
    match graph.nodes.get(node.index()).map(|node| &node.kind) {
        Some(NodeKind::Monitor { watches, .. }) => watches
            .get(watch as usize)
            .map_or_else(|| "?".to_owned(), |watch| Names(graph).condition(&watch.condition)),
        Some(_) | None => "?".to_owned(),
    }
}

/// Names of the failure kinds that a driver invented: neither the graph nor the trace has them, but the
/// events of the driver.
#[derive(Debug, Default)]
pub struct FailureNames {
    last: Option<FailureReport>,
    known: BTreeMap<usize, String>,
    /// Step that failed or did not begin last, with the reason in words.
    reason: Option<(NodeId, String)>,
}

impl FailureNames {
    /// Takes an event before the engine handles it.
    pub fn event(&mut self, event: &Event) {
        self.last = match event {
            Event::Driver(
                DriverEvent::Ended { outcome: Outcome::Failure(failure), .. }
                | DriverEvent::Refused { failure, .. },
            ) => Some(failure.clone()),
            _ => None,
        };
    }

    /// Takes a trace event of a graph.
    pub fn trace(&mut self, graph: &Graph, record: &TraceEvent) {
        match &record.what {
            // A step that did not begin has no driver that could say why.
            TraceEventKind::Guard { node, need, truth } => {
                let needs = || needed(graph, *node, *need);
                self.reason =
                    (*truth != Truth::True).then(|| (*node, format!("needs {}, which is {truth}", needs())));
            }
            TraceEventKind::GoalEnded { node, ending: NodeEnding::Failure(_), .. } => {
                let text = self.last.as_ref().and_then(|failure| failure.text.as_ref());
                self.reason = text.map(|text| (*node, text.to_string()));
            }
            _ => {}
        }
    }

    /// Reason in words for which a step failed, or did not begin: the driver's, or the need that it lacked.
    #[must_use]
    pub fn reason(&self, node: NodeId) -> Option<&str> {
        self.reason.as_ref().filter(|(step, _)| *step == node).map(|(_, why)| why.as_str())
    }

    /// Name of a failure kind: that of the graph, or the driver's when its number first appeared.
    pub fn name(&mut self, graph: &Graph, kind: FailureId) -> String {
        if kind.index() < graph.failures.len() {
            return Names(graph).failure(kind).to_owned();
        }
        match &self.last {
            Some(last) => self.known.entry(kind.index()).or_insert_with(|| last.kind.to_string()).clone(),
            None => self.known.get(&kind.index()).map_or_else(|| "?".to_owned(), String::clone),
        }
    }
}

fn commanded(goal: GoalId, command: &Command, deadline: Time) -> serde_json::Value {
    let args: Map<_, _> = command.args.iter().map(|(name, arg)| (name.to_string(), value(arg))).collect();
    let mut line = json!({
        "goal": goal.to_string(),
        "primitive": command.primitive.as_str(),
        "args": args,
        "deadline": deadline.secs(),
    });
    if let (Some(manner), Some(line)) = (command.manner, line.as_object_mut()) {
        line.insert("manner".into(), json!(manner));
    }
    line
}

fn ended(failure: Option<String>, ending: NodeEnding, cause: EndCause) -> serde_json::Value {
    let cause = match cause {
        EndCause::Completed => "completed",
        EndCause::Failed => "failed",
        EndCause::Refused => "refused",
        EndCause::GuardRefuted => "guard_refuted",
        EndCause::Deadline => "deadline",
        EndCause::Exhausted => "exhausted",
        EndCause::BadValue => "bad_value",
        EndCause::Monitor => "monitor",
        EndCause::SiblingFailed => "sibling_failed",
        EndCause::ParentEnded => "parent_ended",
        EndCause::Person => "person",
        EndCause::Driver => "driver",
        EndCause::Swap => "swap",
        EndCause::Lost => "lost",
    };
    match ending {
        NodeEnding::Success => json!({"ending": "success", "cause": cause}),
        NodeEnding::Failure(_) => {
            json!({"ending": "failure", "failure": failure, "cause": cause})
        }
        NodeEnding::Interrupted => json!({"ending": "interrupted", "cause": cause}),
    }
}

fn word(truth: Truth) -> String {
    truth.to_string()
}

/// Value as JSON.
fn value(of: &Value) -> serde_json::Value {
    match of {
        Value::Bool(value) => json!(value),
        Value::Int(value) => json!(value),
        Value::Number(value) => json!(value),
        Value::Text(text) | Value::Entity(text) | Value::Case(text) => json!(text.as_str()),
        Value::Pose(pose) => json!({"xyz": pose.xyz, "quaternion": pose.quaternion}),
        Value::List(items) => items.iter().map(value).collect(),
    }
}
