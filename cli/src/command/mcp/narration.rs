//! Lines that say what happens in a run. Firings of monitors are messages of the run.

use std::sync::Arc;

use motet::run::events::watched;
use motet_graph::draw::Names;
use motet_graph::{Graph, NodeId, NodeKind};
use motet_runtime::{Effect, NodeEnding, RunEnd, Time, TraceEvent, TraceEventKind, Truth};

use super::run_table::RunEnding;

/// A line about a run.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) enum Line {
    /// For the list of events.
    Event(String),
    /// Also the message of the run.
    Message(String),
}

/// Describes an effect in a line; `None` for effects that tell a client nothing. `graph` is the graph of the
/// effect's revision.
pub(super) fn narrate(graph: &Graph, now: Time, effect: &Effect) -> Option<Line> {
    let line = match effect {
        Effect::Report(record) => return report(graph, record),
        Effect::SafeStop { .. } => "safe stop".to_owned(),
        Effect::Hold { .. } => "held".to_owned(),
        Effect::Proceed { .. } => "goes on".to_owned(),
        _ => return None,
    };
    Some(Line::Event(at(now, &line)))
}

fn at(time: Time, line: &str) -> String {
    format!("{:.1} s: {line}", time.secs())
}

fn report(graph: &Graph, record: &TraceEvent) -> Option<Line> {
    let step = |node: &NodeId| step(graph, *node);
    let event = |line: String| Some(Line::Event(at(record.at, &line)));
    let message = |line: String| Some(Line::Message(at(record.at, &line)));
    match &record.what {
        TraceEventKind::Started { node, attempt: 1, .. } => event(format!("starts {}", step(node))),
        TraceEventKind::Started { node, attempt, .. } => {
            event(format!("starts {}, attempt {attempt}", step(node)))
        }
        TraceEventKind::Ended { node, ending: NodeEnding::Failure(kind), cause } if is_call(graph, *node) => {
            // A driver may fail in ways that the graph does not name.
            let is_named = kind.index() < graph.failures.len();
            let kind =
                if is_named { format!(" with `{}`", Names(graph).failure(*kind)) } else { String::new() };
            event(format!("{} failed{kind} ({cause})", step(node)))
        }
        TraceEventKind::Ended { node, ending: NodeEnding::Interrupted, cause } if is_call(graph, *node) => {
            event(format!("{} was interrupted ({cause})", step(node)))
        }
        TraceEventKind::Ended { node, ending: NodeEnding::Success, .. } if is_call(graph, *node) => {
            event(format!("{} is done", step(node)))
        }
        TraceEventKind::Guard { node, truth: Truth::False | Truth::Unknown, .. } => {
            event(format!("a need of {} does not hold", step(node)))
        }
        TraceEventKind::Verified { node, verdict } => event(format!("motion of {}: {verdict}", step(node))),
        TraceEventKind::Tested { node, truth } => event(format!("{}: {truth}", step(node))),
        TraceEventKind::GoalObserved { truth } => event(format!("the goal is {truth}")),
        TraceEventKind::CleanupFailed { node, .. } => message(format!("the cleanup {} failed", step(node))),
        TraceEventKind::CleanupSkipped { node } => {
            message(format!("the cleanup {} does not run", step(node)))
        }
        TraceEventKind::Fired { node, watch, truth } => {
            let fired = format!("a monitor fired: {} ({truth})", watched(graph, *node, *watch));
            message(fired)
        }
        TraceEventKind::WentOn { node, watch } => {
            message(format!("goes on after {}", watched(graph, *node, *watch)))
        }
        TraceEventKind::Swapped { policy } => message(format!("the policy `{policy}` takes over")),
        TraceEventKind::Bound { binding, value } => {
            let name = graph.bindings.get(binding.index()).map(|binding| binding.name.as_str());
            event(format!("{} = {value}", name.filter(|name| *name != "_")?))
        }
        _ => None,
    }
}

fn step(graph: &Graph, node: NodeId) -> String {
    graph
        .nodes
        .get(node.index())
        .map_or_else(|| "a step".to_owned(), |node| format!("`{}`", Names(graph).brief(&node.kind)))
}

fn is_call(graph: &Graph, node: NodeId) -> bool {
    graph.nodes.get(node.index()).is_some_and(|node| matches!(node.kind, NodeKind::Call(_)))
}

/// Ending of a run in words.
pub(super) fn ending(graph: &Arc<Graph>, end: &RunEnd, now: Time) -> RunEnding {
    let reason = |why: &Option<String>| why.as_ref().map_or_else(String::new, |why| format!(": {why}"));
    let (outcome, says) = match end {
        RunEnd::Done { why, result: None } => ("done", format!("done{}", reason(why))),
        RunEnd::Done { why, result: Some(result) } => ("done", format!("done, gave {result}{}", reason(why))),
        RunEnd::Failed { kind, why, node } => {
            ("failed", format!("{} failed with `{kind}`{}", step(graph, *node), reason(why)))
        }
        RunEnd::Declined { why } => ("declined", format!("the policy declined{}", reason(why))),
        RunEnd::Replan { why } => ("replan", format!("the policy asks for a new one{}", reason(why))),
        RunEnd::Interrupted => ("interrupted", "stopped before its end".to_owned()),
        RunEnd::Fault(fault) => ("fault", format!("the engine could not go on: {fault}")),
    };
    RunEnding { outcome, says: at(now, &says) }
}
