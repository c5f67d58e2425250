//! Steps of a policy as rows of a tree, each with its status. The trace of the engine updates them; views
//! draw them.

use std::sync::Arc;

use crate::run::events::{FailureNames, needed, watched};
use motet_graph::draw::Names;
use motet_graph::{Graph, NodeId, NodeKind, ROOT, Reaction, RegionId, Term};
use motet_runtime::{Command, Event, NodeEnding, Time, TraceEvent, TraceEventKind, Verification};

use crate::printable::escape;

/// Status of a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum StepStatus {
    Pending,
    Running,
    Done,
    Failed,
    Interrupted,
}

/// Row of the tree: a step, or the heading of a branch.
#[derive(Clone, Debug)]
pub struct StepRow {
    /// Step of the row; `None` for a heading.
    pub node: Option<NodeId>,
    /// Indentation, in levels.
    pub depth: usize,
    /// Step in one line.
    pub label: String,
    pub status: StepStatus,
    /// Remark behind the label, such as a failure.
    pub note: String,
    /// Time of the last entry.
    pub since: Time,
    /// Duration of the last execution.
    pub took: Option<Time>,
}

/// All rows in order; a parent precedes its children.
#[derive(Debug)]
pub struct StepTree {
    graph: Arc<Graph>,
    pub rows: Vec<StepRow>,
    /// Row of each node.
    row_of: Vec<Option<usize>>,
    /// Number of calls that succeeded and failed, with every iteration of a loop.
    pub done: usize,
    pub failed: usize,
    failures: FailureNames,
}

impl StepTree {
    /// Tree of a graph, in O(nodes). Iterative, since sub-policies may nest deeply.
    pub fn new(graph: Arc<Graph>) -> Self {
        let row_of = vec![None; graph.nodes.len()];
        let mut tree = Self {
            graph: Arc::clone(&graph),
            rows: Vec::new(),
            row_of,
            done: 0,
            failed: 0,
            failures: FailureNames::default(),
        };
        let mut open = vec![Open::Region(ROOT, 0)];
        while let Some(next) = open.pop() {
            match next {
                Open::Heading(text, depth) => tree.push(None, depth, &text),
                Open::Region(region, depth) => {
                    let entry = graph.regions.get(region.index()).and_then(|region| region.entry);
                    open.extend(entry.map(|entry| Open::Node(entry, depth)));
                }
                Open::Node(id, depth) => {
                    let Some(node) = graph.nodes.get(id.index()) else { continue };
                    if tree.row_of.get(id.index()).is_none_or(|place| place.is_some()) {
                        continue;
                    }
                    tree.push(Some(id), depth, &label(&graph, &node.kind));
                    open.extend(node.next.map(|next| Open::Node(next, depth)));
                    let mut parts = Vec::new();
                    branches(&graph, &node.kind, depth, &mut parts);
                    open.extend(parts.into_iter().rev());
                }
            }
        }
        tree
    }

    fn push(&mut self, node: Option<NodeId>, depth: usize, label: &str) {
        if let Some(place) = node.and_then(|node| self.row_of.get_mut(node.index())) {
            *place = Some(self.rows.len());
        }
        let (status, note, label) = (StepStatus::Pending, String::new(), escape(label));
        self.rows.push(StepRow { node, depth, label, status, note, since: Time::ZERO, took: None });
    }

    /// Row of a node.
    pub fn row(&self, node: NodeId) -> Option<&StepRow> {
        self.place(node).and_then(|place| self.rows.get(place))
    }

    /// Reason in words for which a step failed, or did not begin.
    #[must_use]
    pub fn reason(&self, node: NodeId) -> Option<&str> {
        self.failures.reason(node)
    }

    fn place(&self, node: NodeId) -> Option<usize> {
        self.row_of.get(node.index()).copied().flatten()
    }

    /// Updates the tree by a trace event. Returns the node of the event.
    pub fn take(&mut self, record: &TraceEvent) -> Option<NodeId> {
        let graph = Arc::clone(&self.graph);
        self.failures.trace(&graph, record);
        let (node, note) = match &record.what {
            TraceEventKind::Entered { node } => {
                self.enter(*node, record.at);
                (*node, Some(String::new()))
            }
            TraceEventKind::Started { node, attempt, .. } => {
                (*node, (*attempt > 1).then(|| format!("attempt {attempt}{}", of_all(&graph, *node))))
            }
            TraceEventKind::Ended { node, ending, .. } => {
                self.end(*node, *ending, record.at);
                (*node, self.why(*ending))
            }
            TraceEventKind::GoalEnded { node, ending, .. } => (*node, self.why(*ending)),
            TraceEventKind::Guard { node, need, truth } => {
                let need = needed(&graph, *node, *need);
                (
                    *node,
                    (*truth != motet_runtime::Truth::True).then(|| format!("needs {need}, which is {truth}")),
                )
            }
            TraceEventKind::Verified { node, verdict } => {
                (*node, matches!(**verdict, Verification::Infeasible { .. }).then(|| verdict.to_string()))
            }
            TraceEventKind::Tested { node, truth } => (*node, Some(truth.to_string())),
            TraceEventKind::Fired { node, watch, .. } => {
                (*node, Some(format!("fired: {}", watched(&graph, *node, *watch))))
            }
            TraceEventKind::CleanupSkipped { node } => (*node, Some("not cleaned up".to_owned())),
            TraceEventKind::CleanupFailed { node, failure } => {
                (*node, Some(format!("the cleanup failed: {}", self.failures.name(&graph, *failure))))
            }
            TraceEventKind::WentOn { node, .. } => (*node, Some("went on".to_owned())),
            TraceEventKind::Swapped { .. } | TraceEventKind::GoalObserved { .. } => return None,
            TraceEventKind::Kept { node, .. } => (*node, Some("goes on".to_owned())),
            TraceEventKind::Updated { node, .. } => (*node, Some("updated".to_owned())),
            TraceEventKind::Bound { binding, value } => {
                let binds = |kind: &NodeKind| match kind {
                    NodeKind::Call(call) => call.binds == Some(*binding),
                    NodeKind::Each { item, .. } => item == binding,
                    NodeKind::Let { binding: own, .. } => own == binding,
                    _ => false,
                };
                let node = graph.nodes.iter().position(|node| binds(&node.kind))?;
                (NodeId(u32::try_from(node).ok()?), Some(format!("= {value}")))
            }
        };
        if let (Some(place), Some(note)) = (self.place(node), note)
            && let Some(row) = self.rows.get_mut(place)
        {
            row.note = escape(&note);
        }
        Some(node)
    }

    /// Takes an event before the engine handles it.
    pub fn event(&mut self, event: &Event) {
        self.failures.event(event);
    }

    /// Puts the texts of a command that have values, as they go to the driver, into the label of its step.
    /// Returns true if there are any.
    pub fn start(&mut self, node: NodeId, command: &Command) -> bool {
        let Some(NodeKind::Call(call)) = self.graph.nodes.get(node.index()).map(|node| &node.kind) else {
            return false;
        };
        let mut call = call.clone();
        let mut is_filled = false;
        for (arg, (_, value)) in call.args.iter_mut().zip(&command.args) {
            if matches!(arg, Term::Template(_)) {
                *arg = Term::Literal(value.clone());
                is_filled = true;
            }
        }
        let filled = label(&self.graph, &NodeKind::Call(call));
        if let Some(row) = self.place(node).and_then(|place| self.rows.get_mut(place)).filter(|_| is_filled) {
            row.label = escape(&filled);
        }
        is_filled
    }

    fn why(&mut self, ending: NodeEnding) -> Option<String> {
        match ending {
            NodeEnding::Success => None,
            NodeEnding::Failure(kind) => Some(self.failures.name(&self.graph, kind)),
            NodeEnding::Interrupted => Some("interrupted".to_owned()),
        }
    }

    /// Marks a step as running, and resets all steps inside it. The steps behind it in its block are reset
    /// too: if one has run, that was in an earlier round of a loop.
    fn enter(&mut self, node: NodeId, at: Time) {
        let Some(place) = self.place(node) else { return };
        let Some(depth) = self.rows.get(place).map(|row| row.depth) else { return };
        for (offset, row) in self.rows.iter_mut().skip(place).enumerate() {
            if offset > 0 && row.depth < depth {
                break;
            }
            row.status = if offset == 0 { StepStatus::Running } else { StepStatus::Pending };
            row.took = None;
            row.since = at;
            row.note.clear();
        }
    }

    fn end(&mut self, node: NodeId, ending: NodeEnding, at: Time) {
        let is_call =
            self.graph.nodes.get(node.index()).is_some_and(|node| matches!(node.kind, NodeKind::Call(_)));
        let Some(row) = self.place(node).and_then(|place| self.rows.get_mut(place)) else { return };
        row.took = Some(at.since(row.since));
        row.status = match ending {
            NodeEnding::Success => StepStatus::Done,
            NodeEnding::Failure(_) => StepStatus::Failed,
            NodeEnding::Interrupted => StepStatus::Interrupted,
        };
        self.done += usize::from(is_call && row.status == StepStatus::Done);
        self.failed += usize::from(is_call && row.status == StepStatus::Failed);
    }
}

/// Step in one line, with its retries or the conditions that it monitors.
fn label(graph: &Graph, kind: &NodeKind) -> String {
    let names = Names(graph);
    if let NodeKind::Monitor { watches, .. } = kind {
        let watched = watches.iter().map(|watch| {
            let hold = watch.hold_secs;
            let hold = if hold > 0.0 { format!(" for {hold} s") } else { String::new() };
            format!("{}{hold}", names.condition(&watch.condition))
        });
        return format!("monitor {}", watched.collect::<Vec<_>>().join("; "));
    }
    let brief = names.brief(kind);
    if let NodeKind::Call(call) = kind
        && call.retries > 0
    {
        return format!("{brief} retry {}", call.retries);
    }
    brief
}

/// Suffix of an attempt, such as ` of 3`.
fn of_all(graph: &Graph, node: NodeId) -> String {
    match graph.nodes.get(node.index()).map(|node| &node.kind) {
        Some(NodeKind::Call(call)) => format!(" of {}", u64::from(call.retries) + 1),
        Some(_) | None => String::new(),
    }
}

/// Item of the stack from which the tree is built.
enum Open {
    Node(NodeId, usize),
    Region(RegionId, usize),
    Heading(String, usize),
}

/// Pushes the regions of a node with their headings, in the order of the document.
fn branches(graph: &Graph, kind: &NodeKind, depth: usize, open: &mut Vec<Open>) {
    let inner = depth + 1;
    match kind {
        NodeKind::Call(_)
        | NodeKind::Let { .. }
        | NodeKind::Wait { .. }
        | NodeKind::Delay { .. }
        | NodeKind::End { .. } => {}
        NodeKind::Finally { body, cleanup } => {
            open.push(Open::Region(*body, inner));
            open.push(Open::Heading("finally".to_owned(), depth));
            open.push(Open::Region(*cleanup, inner));
        }
        NodeKind::Sequence { body, .. }
        | NodeKind::Inline { body, .. }
        | NodeKind::Repeat { body, .. }
        | NodeKind::Each { body, .. } => open.push(Open::Region(*body, inner)),
        NodeKind::If { then, otherwise, .. } => {
            open.push(Open::Region(*then, inner));
            if let Some(otherwise) = otherwise {
                open.push(Open::Heading("else".to_owned(), depth));
                open.push(Open::Region(*otherwise, inner));
            }
        }
        NodeKind::Monitor { watches, body } => {
            open.push(Open::Region(*body, inner));
            for watch in watches {
                if let Reaction::Resume { body, .. } = &watch.reaction {
                    let test = Names(graph).condition(&watch.condition);
                    open.push(Open::Heading(format!("when {test}"), depth));
                    open.push(Open::Region(*body, inner));
                }
            }
        }
        NodeKind::Try { body, handlers } => {
            open.push(Open::Region(*body, inner));
            for handler in handlers {
                let names = handler.on.as_ref().map_or_else(
                    || "any".to_owned(),
                    |on| on.iter().map(|id| Names(graph).failure(*id)).collect::<Vec<_>>().join(", "),
                );
                open.push(Open::Heading(format!("catch {names}"), depth));
                open.push(Open::Region(handler.body, inner));
            }
        }
        NodeKind::Parallel { branches } => {
            for (index, branch) in branches.iter().enumerate() {
                open.push(Open::Heading(format!("branch {}", index + 1), inner));
                open.push(Open::Region(*branch, inner + 1));
            }
        }
    }
}
