//! Graphs for people: an indented tree, a Mermaid flowchart, a Graphviz digraph. The same graph gives the
//! same text.
//!
//! Any graph can be drawn, a valid one or not; what an id does not name is shown as `?`. How deep a drawing
//! goes is bounded.

mod diagram;
mod names;

pub use diagram::{dot, mermaid};
pub use names::Names;

use crate::model::{CallNode, Graph, Node, NodeId, NodeKind, ROOT, Reaction, RegionId, Verdict};

/// The deepest level that is drawn: below it an invalid graph could go round in circles.
const DEEPEST: usize = crate::validate::MAX_DEPTH + 1;

/// The regions of a node with what each is for.
fn parts(graph: &Graph, kind: &NodeKind) -> Vec<(String, RegionId)> {
    let names = Names(graph);
    match kind {
        NodeKind::Call(_)
        | NodeKind::Let { .. }
        | NodeKind::Wait { .. }
        | NodeKind::Delay { .. }
        | NodeKind::End { .. } => Vec::new(),
        NodeKind::Finally { body, cleanup } => {
            vec![(String::new(), *body), ("finally".to_owned(), *cleanup)]
        }
        NodeKind::Sequence { body, .. }
        | NodeKind::Inline { body, .. }
        | NodeKind::Repeat { body, .. }
        | NodeKind::Each { body, .. } => vec![(String::new(), *body)],
        NodeKind::If { then, otherwise, .. } => {
            let otherwise = otherwise.map(|region| ("else".to_owned(), region));
            std::iter::once(("then".to_owned(), *then)).chain(otherwise).collect()
        }
        NodeKind::Monitor { body, .. } if kind.deadline_secs().is_some() => vec![(String::new(), *body)],
        NodeKind::Monitor { watches, body } => {
            let blocks = watches.iter().filter_map(|watch| match &watch.reaction {
                Reaction::Resume { body, .. } => Some((names.watch(watch), *body)),
                Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End { .. } => None,
            });
            std::iter::once(("during".to_owned(), *body)).chain(blocks).collect()
        }
        NodeKind::Try { body, handlers } => {
            let handlers = handlers.iter().map(|handler| (names.handler(handler), handler.body));
            std::iter::once(("try".to_owned(), *body)).chain(handlers).collect()
        }
        NodeKind::Parallel { branches } => {
            let branches = branches.iter().enumerate();
            branches.map(|(index, region)| (format!("branch {}", index + 1), *region)).collect()
        }
    }
}

/// The nodes of a region in order.
fn chain(graph: &Graph, region: RegionId) -> Vec<NodeId> {
    let mut chain = Vec::new();
    let mut at = graph.regions.get(region.index()).and_then(|region| region.entry);
    while let Some(id) = at {
        chain.push(id);
        let next = graph.nodes.get(id.index()).and_then(|node| node.next);
        // Only forward, so that a chain ends in any graph.
        at = next.filter(|next| *next > id);
    }
    chain
}

/// A graph as an indented tree: a line for each step with its duration, and below a call what it needs and
/// changes. A need that is `deferred` is a guard, checked before each start.
///
/// ```
/// let graph = motet_graph::Graph::empty("tidy_up", "hsr");
/// assert!(motet_graph::draw::text(&graph).starts_with("policy tidy_up for hsr"));
/// ```
#[must_use]
pub fn text(graph: &Graph) -> String {
    let robot = if graph.robot.is_empty() { String::new() } else { format!(" for {}", graph.robot) };
    let (least, greatest) = (graph.duration.least_secs, graph.duration.greatest_secs);
    let mut out = format!("policy {}{robot}  ({least} s .. {greatest} s)\n", graph.policy);
    region(graph, ROOT, 1, &mut out);
    out
}

fn region(graph: &Graph, id: RegionId, level: usize, out: &mut String) {
    if level > DEEPEST {
        line(out, level, "…");
        return;
    }
    for node in chain(graph, id).into_iter().filter_map(|id| graph.nodes.get(id.index())) {
        step(graph, node, level, out);
    }
}

fn step(graph: &Graph, node: &Node, level: usize, out: &mut String) {
    let names = Names(graph);
    let (least, greatest) = (node.duration.least_secs, node.duration.greatest_secs);
    line(out, level, &format!("{}  ({least} s .. {greatest} s)", names.step(&node.kind)));
    if let NodeKind::Call(of) = &node.kind {
        call(&names, of, level + 1, out);
    }
    if let NodeKind::Monitor { watches, .. } = &node.kind {
        for watch in watches {
            line(out, level + 1, &names.watch(watch));
        }
    }
    for (label, body) in parts(graph, &node.kind) {
        if label.is_empty() {
            region(graph, body, level + 1, out);
        } else {
            line(out, level + 1, &format!("{label}:"));
            region(graph, body, level + 2, out);
        }
    }
}

fn call(names: &Names<'_>, call: &CallNode, level: usize, out: &mut String) {
    for need in &call.needs {
        line(out, level, &format!("needs {} — {}", names.need(need), verdict(need.verdict)));
    }
    if let Some(motion) = &call.motion {
        let told = match (&motion.witness, &motion.why) {
            (Some(witness), _) => format!(", {:.3} m clear", witness.clearance),
            (None, Some(why)) => format!(": {why}"),
            (None, None) => String::new(),
        };
        line(out, level, &format!("motion {} — {}{told}", names.motion(motion), verdict(motion.verdict)));
    }
    for effect in &call.effects {
        line(out, level, &format!("makes {}", names.effect(effect)));
    }
    for unsettled in &call.unsettles {
        line(out, level, &format!("unsettles {}", names.unsettled(unsettled)));
    }
    if let Some(lifetime) = &call.lasts {
        line(out, level, &format!("lasts until {}", names.lifetime(lifetime)));
    }
}

fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proven => "proven",
        Verdict::Deferred => "deferred",
    }
}

fn line(out: &mut String, level: usize, text: &str) {
    out.extend(std::iter::repeat_n("  ", level));
    // A text in a policy may hold line breaks; a step is one line.
    out.extend(text.chars().map(|char| if char.is_control() { ' ' } else { char }));
    out.push('\n');
}
