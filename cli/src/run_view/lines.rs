//! View of a run line by line, for pipes, files and continuous integration.

use std::sync::Arc;

use motet_graph::{Graph, NodeId, NodeKind};
use motet_runtime::{Effect, Event, NodeEnding, RunEnd, Time, TraceEvent, TraceEventKind, Verification};

use super::tree::{Row, Tree};
use super::{Clock, View, duration, mark, paint, summary};
use crate::output::Output;

/// View that prints a line when a step starts or ends.
pub(super) struct Lines {
    graph: Arc<Graph>,
    tree: Tree,
    out: Output,
    is_colored: bool,
    clock: Clock,
}

impl Lines {
    pub(super) fn new(graph: Arc<Graph>, is_colored: bool, clock: Clock) -> Self {
        Self { tree: Tree::new(Arc::clone(&graph)), graph, out: Output::default(), is_colored, clock }
    }

    fn record(&mut self, record: &TraceEvent) {
        let Some(node) = self.tree.take(record) else { return };
        let is_shown = match &record.what {
            // The line of a call appears when its goal starts, after its guards.
            TraceEventKind::Entered { node } => !self.is_call(*node),
            TraceEventKind::Started { .. } | TraceEventKind::Fired { .. } | TraceEventKind::WentOn { .. } => {
                true
            }
            TraceEventKind::GoalEnded { .. } | TraceEventKind::Tested { .. } => true,
            TraceEventKind::Kept { .. } | TraceEventKind::Updated { .. } => true,
            TraceEventKind::Ended { ending, .. } => self.is_leaf(node) || *ending != NodeEnding::Success,
            TraceEventKind::Guard { truth, .. } => *truth != motet_runtime::Truth::True,
            TraceEventKind::Verified { verdict, .. } => matches!(**verdict, Verification::Infeasible { .. }),
            TraceEventKind::Swapped { .. } | TraceEventKind::Bound { .. } => false,
        };
        if let (true, Some(row)) = (is_shown, self.tree.row(node)) {
            let line = self.line(row, record.at);
            self.out.line(&line);
        }
    }

    fn line(&self, row: &Row, at: Time) -> String {
        let indent = "  ".repeat(row.depth.min(20));
        let mark = paint(mark(row.status), row.status, self.is_colored);
        let note = if row.note.is_empty() { String::new() } else { format!("  {}", row.note) };
        let took = row
            .took
            .filter(|took| *took > Time::ZERO)
            .map_or_else(String::new, |took| format!("  ({})", duration(took)));
        format!("{:>9}  {indent}{mark} {}{note}{took}", duration(at), row.label)
    }

    fn kind(&self, node: NodeId) -> Option<&NodeKind> {
        self.graph.nodes.get(node.index()).map(|node| &node.kind)
    }

    fn is_call(&self, node: NodeId) -> bool {
        matches!(self.kind(node), Some(NodeKind::Call(_)))
    }

    fn is_leaf(&self, node: NodeId) -> bool {
        self.is_call(node) || matches!(self.kind(node), Some(NodeKind::Wait { .. }))
    }
}

impl View for Lines {
    fn event(&mut self, event: &Event) {
        self.tree.event(event);
    }

    fn effect(&mut self, _now: Time, effect: &Effect) {
        if let Effect::Report(record) = effect {
            self.record(record);
        }
    }

    fn past(&mut self, _now: Time, effect: &Effect) {
        if let Effect::Report(record) = effect {
            let _ = self.tree.take(record);
        }
    }

    fn reached(&mut self, _now: Time) {}

    fn is_closed(&self) -> bool {
        self.out.is_closed()
    }

    fn finish(&mut self, now: Time, end: &RunEnd) {
        let text = summary(&self.graph, &self.tree, (now, self.clock), end, self.is_colored);
        self.out.line(&format!("\n{text}"));
    }
}
