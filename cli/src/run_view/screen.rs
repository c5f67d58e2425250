//! View of a run on a terminal: the tree of steps, redrawn in place.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::{Duration, Instant};

use motet_graph::{Graph, NodeId, NodeKind};
use motet_runtime::{
    DriverEvent, Effect, Event, GoalId, NodeEnding, RunEnd, Time, TraceEvent, TraceEventKind, Verification,
};

use super::{Clock, View, duration, mark, paint, summary};
use crate::output::{Output, escape};
use crate::typed_line;
use motet::page::tree::{StepRow, StepStatus, StepTree};

/// Minimum time between two drawings.
const FRAME: Duration = Duration::from_millis(60);

/// View that redraws the tree of steps.
pub(super) struct Screen {
    graph: Arc<Graph>,
    tree: StepTree,
    out: Output,
    is_colored: bool,
    clock: Clock,
    /// Number of lines of the last drawing, above the cursor.
    drawn: usize,
    last: Option<Instant>,
    /// True while a person holds the run.
    is_held: bool,
    /// Goals that a monitor holds.
    held: BTreeSet<GoalId>,
}

impl Screen {
    pub(super) fn new(graph: Arc<Graph>, is_colored: bool, clock: Clock) -> Self {
        let tree = StepTree::new(Arc::clone(&graph));
        let (out, held) = (Output::default(), BTreeSet::new());
        Self { graph, tree, out, is_colored, clock, drawn: 0, last: None, is_held: false, held }
    }

    fn draw(&mut self, now: Time) {
        let (height, width) = console::Term::stdout().size();
        let (height, width) = (usize::from(height).max(6), usize::from(width).max(20));
        let shown = window(&self.tree.rows, height.saturating_sub(4));
        let mut text = String::new();
        if self.drawn > 0 {
            // Moves to the first line of the last drawing, and clears everything below.
            text.push_str(&format!("\u{1b}[{}A\u{1b}[J", self.drawn));
        }
        let mut lines = 0;
        let mut push = |line: &str| {
            text.push_str(&console::truncate_str(line, width, "…"));
            text.push('\n');
            lines += 1;
        };
        let paused = if self.is_held || !self.held.is_empty() { "  paused" } else { "" };
        let (policy, robot) = (escape(&self.graph.policy), escape(robot(&self.graph)));
        push(&format!("{policy} on {robot}  {}{paused}", duration(now)));
        let (before, after) = (shown.start, self.tree.rows.len().saturating_sub(shown.end));
        if before > 0 {
            push(&paint(&format!("  … {before} above"), StepStatus::Pending, self.is_colored));
        }
        for row in self.tree.rows.get(shown).unwrap_or_default() {
            push(&self.line(row, now));
        }
        if after > 0 {
            push(&paint(&format!("  … {after} below"), StepStatus::Pending, self.is_colored));
        }
        if let Some(typed) = typed_line::current() {
            typed_line::set_drawn(true);
            push(&format!("> {typed}"));
        }
        self.drawn = lines;
        self.out.styled(&text);
        self.last = Some(Instant::now());
    }

    fn line(&self, row: &StepRow, now: Time) -> String {
        let indent = "  ".repeat(row.depth);
        let took = match row.status {
            StepStatus::Running => Some(now.since(row.since)),
            StepStatus::Pending | StepStatus::Done | StepStatus::Failed | StepStatus::Interrupted => row.took,
        };
        let took = took.filter(|took| *took > Time::ZERO).map_or_else(String::new, |took| {
            paint(&format!("  {}", duration(took)), StepStatus::Pending, self.is_colored)
        });
        let note = if row.note.is_empty() { String::new() } else { format!("  {}", row.note) };
        let sign = if row.node.is_some() { mark(row.status) } else { " " };
        let head = paint(&format!("{sign} {}", row.label), row.status, self.is_colored);
        format!("{indent}{head}{note}{took}")
    }
}

fn robot(graph: &Graph) -> &str {
    if graph.robot.is_empty() { "no robot" } else { &graph.robot }
}

/// Range of up to `height` rows around the running one.
fn window(rows: &[StepRow], height: usize) -> std::ops::Range<usize> {
    if rows.len() <= height {
        return 0..rows.len();
    }
    let running = rows.iter().rposition(|row| row.status == StepStatus::Running);
    let last = running.or_else(|| rows.iter().rposition(|row| row.status != StepStatus::Pending));
    let start = last.unwrap_or(0).saturating_sub(height / 2).min(rows.len() - height);
    start..start + height
}

impl View for Screen {
    fn event(&mut self, event: &Event) {
        self.tree.event(event);
        match event {
            Event::Hold => self.is_held = true,
            Event::Proceed | Event::Stop => self.is_held = false,
            Event::Driver(DriverEvent::Ended { goal, .. } | DriverEvent::Stopped { goal }) => {
                self.held.remove(goal);
            }
            _ => {}
        }
    }

    fn effect(&mut self, now: Time, effect: &Effect) {
        match effect {
            Effect::Report(record) => {
                self.tree.take(record);
            }
            Effect::Start { node, command, .. } => {
                let _ = self.tree.start(*node, command);
            }
            Effect::Hold { goal } => {
                self.held.insert(*goal);
            }
            Effect::Proceed { goal } | Effect::Cancel { goal } => {
                self.held.remove(goal);
            }
            _ => {}
        }
        self.reached(now);
    }

    fn past(&mut self, _now: Time, effect: &Effect) {
        if let Effect::Report(record) = effect {
            let _ = self.tree.take(record);
        }
    }

    fn go_below(&mut self) {
        self.drawn = 0;
    }

    fn leave(&mut self, now: Time) {
        self.draw(now);
    }

    fn late(&mut self, _now: Time, _effect: &Effect) {
        // The last drawing stays as it is, above the view of the other policy.
    }

    fn reached(&mut self, now: Time) {
        // Frames of a terminal that is paused would only be old.
        if self.last.is_none_or(|last| last.elapsed() >= FRAME) && !self.out.is_behind() {
            self.draw(now);
        }
    }

    fn is_closed(&self) -> bool {
        self.out.is_closed()
    }

    fn finish(&mut self, now: Time, end: &RunEnd) {
        self.draw(now);
        typed_line::set_drawn(false);
        let text = summary(&self.graph, &self.tree, (now, self.clock), end, self.is_colored);
        self.out.styled(&format!("\n{text}\n"));
    }
}

/// View that prints a line when a step starts or ends.
pub(super) struct Lines {
    graph: Arc<Graph>,
    tree: StepTree,
    out: Output,
    is_colored: bool,
    clock: Clock,
}

impl Lines {
    pub(super) fn new(graph: Arc<Graph>, is_colored: bool, clock: Clock) -> Self {
        Self { tree: StepTree::new(Arc::clone(&graph)), graph, out: Output::default(), is_colored, clock }
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
            TraceEventKind::CleanupFailed { .. } | TraceEventKind::CleanupSkipped { .. } => true,
            TraceEventKind::Kept { .. } | TraceEventKind::Updated { .. } => true,
            TraceEventKind::Ended { ending, .. } => self.is_leaf(node) || *ending != NodeEnding::Success,
            TraceEventKind::Guard { truth, .. } => *truth != motet_runtime::Truth::True,
            TraceEventKind::Verified { verdict, .. } => matches!(**verdict, Verification::Infeasible { .. }),
            TraceEventKind::Swapped { .. } | TraceEventKind::Bound { .. } => false,
            TraceEventKind::GoalObserved { .. } => false,
        };
        if let (true, Some(row)) = (is_shown, self.tree.row(node)) {
            let line = self.line(row, record.at);
            self.out.styled(&format!("{line}\n"));
        }
    }

    fn line(&self, row: &StepRow, at: Time) -> String {
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
        self.is_call(node) || matches!(self.kind(node), Some(NodeKind::Wait { .. } | NodeKind::Delay { .. }))
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
        if let Effect::Start { node, command, .. } = effect {
            let _ = self.tree.start(*node, command);
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
        self.out.styled(&format!("\n{text}\n"));
    }
}
