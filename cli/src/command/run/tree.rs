//! The plan as rows of a tree, each with what has become of it. Fed with the engine's records; it draws nothing.

use std::sync::Arc;

use motet_graph::draw::Names;
use motet_graph::{Graph, NodeId, NodeKind, ROOT};
use motet_runtime::{Event, NodeEnding, Time, TraceEvent, TraceEventKind, Verification};

use super::branch::{Open, branches};
use super::made_up::MadeUp;
use crate::out::plain;

/// What has become of a step.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Status {
    /// Nothing yet.
    Pending,
    /// It runs.
    Running,
    /// It did what it was for.
    Done,
    /// It failed.
    Failed,
    /// It was interrupted.
    Interrupted,
}

/// A row: a step, or the heading of a branch.
#[derive(Clone, Debug)]
pub(super) struct Row {
    /// The step; none for a heading.
    pub(super) node: Option<NodeId>,
    /// How far it is indented.
    pub(super) depth: usize,
    /// The step in one line.
    pub(super) label: String,
    /// What has become of it.
    pub(super) status: Status,
    /// What there is to say about it.
    pub(super) note: String,
    /// When it was entered last.
    pub(super) since: Time,
    /// How long it took.
    pub(super) took: Option<Time>,
}

/// All rows, a parent before its children.
#[derive(Debug)]
pub(super) struct Tree {
    graph: Arc<Graph>,
    pub(super) rows: Vec<Row>,
    /// The row of each node.
    places: Vec<Option<usize>>,
    /// Calls that succeeded and failed, every run of a loop counted.
    pub(super) done: usize,
    pub(super) failed: usize,
    made_up: MadeUp,
}

impl Tree {
    /// The plan of a graph. O(nodes); no recursion, since sub-policies may nest deep.
    pub(super) fn new(graph: Arc<Graph>) -> Self {
        let places = vec![None; graph.nodes.len()];
        let mut tree = Self {
            graph: Arc::clone(&graph),
            rows: Vec::new(),
            places,
            done: 0,
            failed: 0,
            made_up: MadeUp::default(),
        };
        let mut open = vec![Open::Region(ROOT, 0)];
        while let Some(next) = open.pop() {
            match next {
                Open::Heading(text, depth) => tree.push(None, depth, text),
                Open::Region(region, depth) => {
                    let entry = graph.regions.get(region.index()).and_then(|region| region.entry);
                    open.extend(entry.map(|entry| Open::Node(entry, depth)));
                }
                Open::Node(id, depth) => {
                    let Some(node) = graph.nodes.get(id.index()) else { continue };
                    if tree.places.get(id.index()).is_none_or(|place| place.is_some()) {
                        continue;
                    }
                    tree.push(Some(id), depth, plain(&label(&graph, &node.kind)));
                    open.extend(node.next.map(|next| Open::Node(next, depth)));
                    let mut parts = Vec::new();
                    branches(&graph, &node.kind, depth, &mut parts);
                    open.extend(parts.into_iter().rev());
                }
            }
        }
        tree
    }

    fn push(&mut self, node: Option<NodeId>, depth: usize, label: String) {
        if let Some(place) = node.and_then(|node| self.places.get_mut(node.index())) {
            *place = Some(self.rows.len());
        }
        let (status, note) = (Status::Pending, String::new());
        self.rows.push(Row { node, depth, label, status, note, since: Time::ZERO, took: None });
    }

    /// The row of a node.
    pub(super) fn row(&self, node: NodeId) -> Option<&Row> {
        self.place(node).and_then(|place| self.rows.get(place))
    }

    fn place(&self, node: NodeId) -> Option<usize> {
        self.places.get(node.index()).copied().flatten()
    }

    /// Takes a record in. Returns the node that it is about.
    pub(super) fn take(&mut self, record: &TraceEvent) -> Option<NodeId> {
        let graph = Arc::clone(&self.graph);
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
            TraceEventKind::WentOn { node, .. } => (*node, Some("went on".to_owned())),
            TraceEventKind::Swapped { .. } => return None,
            TraceEventKind::Kept { node, .. } => (*node, Some("goes on".to_owned())),
            TraceEventKind::Updated { node, .. } => (*node, Some("updated".to_owned())),
            TraceEventKind::Bound { binding, value } => {
                let binds = |kind: &NodeKind| match kind {
                    NodeKind::Call(call) => call.binds == Some(*binding),
                    NodeKind::Each { item, .. } => item == binding,
                    NodeKind::Sequence { .. }
                    | NodeKind::Inline { .. }
                    | NodeKind::If { .. }
                    | NodeKind::Wait { .. }
                    | NodeKind::Monitor { .. }
                    | NodeKind::Try { .. }
                    | NodeKind::Repeat { .. }
                    | NodeKind::Parallel { .. }
                    | NodeKind::End { .. } => false,
                };
                let node = graph.nodes.iter().position(|node| binds(&node.kind))?;
                (NodeId(u32::try_from(node).ok()?), Some(format!("= {value}")))
            }
        };
        if let (Some(place), Some(note)) = (self.place(node), note)
            && let Some(row) = self.rows.get_mut(place)
        {
            row.note = plain(&note);
        }
        Some(node)
    }

    /// Hears an event before the engine handles it.
    pub(super) fn hear(&mut self, event: &Event) {
        self.made_up.hear(event);
    }

    fn why(&mut self, ending: NodeEnding) -> Option<String> {
        match ending {
            NodeEnding::Success => None,
            NodeEnding::Failure(kind) => Some(self.made_up.name(&self.graph, kind)),
            NodeEnding::Interrupted => Some("interrupted".to_owned()),
        }
    }

    /// A step begins, and so what is within it is all to be done (again).
    fn enter(&mut self, node: NodeId, at: Time) {
        let Some(place) = self.place(node) else { return };
        let Some(depth) = self.rows.get(place).map(|row| row.depth) else { return };
        for (offset, row) in self.rows.iter_mut().skip(place).enumerate() {
            if offset > 0 && row.depth <= depth {
                break;
            }
            row.status = if offset == 0 { Status::Running } else { Status::Pending };
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
            NodeEnding::Success => Status::Done,
            NodeEnding::Failure(_) => Status::Failed,
            NodeEnding::Interrupted => Status::Interrupted,
        };
        self.done += usize::from(is_call && row.status == Status::Done);
        self.failed += usize::from(is_call && row.status == Status::Failed);
    }
}

/// A step in one line, with how often it is tried again and how long what it watches must hold.
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

/// ` of 3`, as often as a call is tried in all.
fn of_all(graph: &Graph, node: NodeId) -> String {
    match graph.nodes.get(node.index()).map(|node| &node.kind) {
        Some(NodeKind::Call(call)) => format!(" of {}", u64::from(call.retries) + 1),
        Some(_) | None => String::new(),
    }
}

/// What a guard asks.
fn needed(graph: &Graph, node: NodeId, need: u32) -> String {
    match graph.nodes.get(node.index()).map(|node| &node.kind) {
        Some(NodeKind::Call(call)) => call
            .needs
            .get(need as usize)
            .map_or_else(|| "?".to_owned(), |need| Names(graph).condition(&need.condition)),
        Some(_) | None => "?".to_owned(),
    }
}

/// What a monitor watches.
pub(super) fn watched(graph: &Graph, node: NodeId, watch: u32) -> String {
    match graph.nodes.get(node.index()).map(|node| &node.kind) {
        Some(NodeKind::Monitor { watches, .. }) => watches
            .get(watch as usize)
            .map_or_else(|| "?".to_owned(), |watch| Names(graph).condition(&watch.condition)),
        Some(_) | None => "?".to_owned(),
    }
}
