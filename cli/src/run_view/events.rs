//! View of a run as JSON events, one object per line, for tools.

use std::sync::Arc;

use motet_graph::draw::Names;
use motet_graph::{Graph, NodeId, Value};
use motet_runtime::{
    Command, Effect, EndCause, Event, GoalId, NodeEnding, RunEnd, Time, TraceEvent, TraceEventKind, Truth,
};
use motet_syntax::{Diagnostic, Sources, render};
use serde_json::{Map, json};

use super::View;
use super::tree::{self, FailureNames};
use crate::output::Output;

/// End of a run as JSON.
pub(crate) fn outcome(end: &RunEnd) -> serde_json::Value {
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

/// View that prints each event as JSON.
pub(super) struct Events {
    graph: Arc<Graph>,
    out: Output,
    failures: FailureNames,
}

impl Events {
    pub(super) fn new(graph: Arc<Graph>) -> Self {
        Self { graph, out: Output::default(), failures: FailureNames::default() }
    }

    fn write(&mut self, now: Time, event: &str, node: Option<NodeId>, more: serde_json::Value) {
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
        self.out.line(&serde_json::Value::Object(line).to_string());
    }

    fn ended(&mut self, ending: NodeEnding, cause: EndCause) -> serde_json::Value {
        let failure = match ending {
            NodeEnding::Failure(kind) => Some(self.failures.name(&self.graph, kind)),
            NodeEnding::Success | NodeEnding::Interrupted => None,
        };
        ended(failure, ending, cause)
    }

    fn record(&mut self, record: &TraceEvent) {
        let at = record.at;
        let graph = Arc::clone(&self.graph);
        match &record.what {
            TraceEventKind::Entered { node } => self.write(at, "entered", Some(*node), json!({})),
            TraceEventKind::Ended { node, ending, cause } => {
                let more = self.ended(*ending, *cause);
                self.write(at, "ended", Some(*node), more);
            }
            TraceEventKind::Started { node, goal, attempt } => {
                let more = json!({"goal": goal.to_string(), "attempt": attempt});
                self.write(at, "started", Some(*node), more);
            }
            TraceEventKind::GoalEnded { node, goal, ending, cause } => {
                let mut more = self.ended(*ending, *cause);
                if let serde_json::Value::Object(more) = &mut more {
                    more.insert("goal".to_owned(), json!(goal.to_string()));
                }
                self.write(at, "goal_ended", Some(*node), more);
            }
            TraceEventKind::Guard { node, need, truth } => {
                self.write(at, "guard", Some(*node), json!({"need": need, "truth": word(*truth)}));
            }
            TraceEventKind::Verified { node, verdict } => {
                self.write(at, "verified", Some(*node), json!({"verdict": verdict.to_string()}));
            }
            TraceEventKind::Tested { node, truth } => {
                self.write(at, "tested", Some(*node), json!({"truth": word(*truth)}));
            }
            TraceEventKind::Fired { node, watch, truth } => {
                let when = tree::watched(&graph, *node, *watch);
                self.write(
                    at,
                    "fired",
                    Some(*node),
                    json!({"watch": watch, "when": when, "truth": word(*truth)}),
                );
            }
            TraceEventKind::GoalObserved { truth } => {
                self.write(at, "goal_observed", None, json!({"truth": word(*truth)}));
            }
            TraceEventKind::CleanupSkipped { node } => {
                self.write(at, "cleanup_skipped", Some(*node), json!({}));
            }
            TraceEventKind::CleanupFailed { node, failure } => {
                let failure = self.failures.name(&graph, *failure);
                self.write(at, "cleanup_failed", Some(*node), json!({"failure": failure}));
            }
            TraceEventKind::WentOn { node, watch } => {
                self.write(at, "went_on", Some(*node), json!({"watch": watch}));
            }
            TraceEventKind::Swapped { policy } => {
                self.write(at, "swapped", None, json!({"policy": &**policy}));
            }
            TraceEventKind::Kept { node, goal } => {
                self.write(at, "kept", Some(*node), json!({"goal": goal.to_string()}));
            }
            TraceEventKind::Updated { node, goal } => {
                self.write(at, "updated", Some(*node), json!({"goal": goal.to_string()}));
            }
            TraceEventKind::Bound { binding, value: bound } => {
                let name = graph.bindings.get(binding.index()).map_or("_", |binding| binding.name.as_str());
                self.write(at, "bound", None, json!({"binding": name, "value": value(bound)}));
            }
        }
    }
}

impl View for Events {
    fn event(&mut self, event: &Event) {
        self.failures.event(event);
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        match effect {
            Effect::Start { goal, node, command, deadline } => {
                self.write(now, "command", Some(*node), commanded(*goal, command, *deadline));
            }
            Effect::Update { goal, node, command, deadline } => {
                self.write(now, "update", Some(*node), commanded(*goal, command, *deadline));
            }
            Effect::Report(record) => self.record(record),
            Effect::Cancel { goal } => self.write(now, "cancel", None, json!({"goal": goal.to_string()})),
            Effect::Hold { goal } => self.write(now, "hold", None, json!({"goal": goal.to_string()})),
            Effect::Proceed { goal } => self.write(now, "proceed", None, json!({"goal": goal.to_string()})),
            Effect::SafeStop { goal } => {
                self.write(now, "safe_stop", None, json!({"goal": goal.to_string()}))
            }
            Effect::Verify { check, node, motion } => {
                let asked = json!({"check": check.to_string(), "motion": motion.to_string()});
                self.write(now, "verify", Some(*node), asked);
            }
            Effect::Observe { .. } | Effect::Watch { .. } | Effect::Unwatch { .. } | Effect::Finished(_) => {}
        }
    }

    fn past(&mut self, _now: Time, _effect: &Effect) {}

    fn reached(&mut self, _now: Time) {}

    fn is_closed(&self) -> bool {
        self.out.is_closed()
    }

    fn finish(&mut self, now: Time, end: &RunEnd) {
        let node = match end {
            RunEnd::Failed { node, .. } => Some(*node),
            _ => None,
        };
        let all = outcome(end);
        self.write(now, "finished", node, all);
    }
}

/// Prints the diagnostics of the check as events before the run.
pub(crate) fn diagnostics(diagnostics: &[Diagnostic], sources: &Sources, out: &mut Output) {
    for found in diagnostics {
        let mut line = Map::new();
        line.insert("event".to_owned(), json!("diagnostic"));
        if let Ok(serde_json::Value::Object(record)) = serde_json::to_value(render::record(found, sources)) {
            line.extend(record);
        }
        out.line(&serde_json::Value::Object(line).to_string());
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
