//! A graph as an indented tree, with durations, verdicts and guards.

use super::names::Names;
use super::{DEEPEST, chain, parts};
use crate::model::{CallNode, Graph, Node, NodeKind, ROOT, RegionId, Verdict};

/// A graph as an indented tree: a line for each step with its duration, and below a call what it needs and
/// changes. A need that is `deferred` is a guard, checked before each start.
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
