//! A graph as a Graphviz digraph, each region a cluster, and as a Mermaid flowchart.

use std::fmt::Write;

use super::names::Names;
use super::{DEEPEST, chain, parts};
use crate::model::{Graph, NodeKind, ROOT, RegionId};

/// A graph as a Graphviz digraph.
///
/// ```
/// let graph = motet_graph::Graph::empty("tidy_up", "hsr");
/// assert!(motet_graph::draw::dot(&graph).starts_with("digraph"));
/// ```
#[must_use]
pub fn dot(graph: &Graph) -> String {
    let mut out = format!("digraph \"{}\" {{\n", escape_dot(&graph.policy));
    out.push_str("  compound=true;\n  node [shape=box, fontname=\"sans-serif\"];\n");
    // Writing to a string fails never.
    let _ = writeln!(out, "  start [shape=oval, label=\"{}\"];", escape_dot(&graph.policy));
    cluster(graph, ROOT, "start", "", 1, &mut out);
    out.push_str("}\n");
    out
}

fn cluster(graph: &Graph, region: RegionId, owner: &str, label: &str, level: usize, out: &mut String) {
    if level > DEEPEST {
        return;
    }
    let names = Names(graph);
    let chain = chain(graph, region);
    let pad = "  ".repeat(level);
    let _ = writeln!(out, "{pad}subgraph cluster_{} {{", region.0);
    let _ = writeln!(out, "{pad}  label=\"{}\";", escape_dot(label));
    for id in &chain {
        let Some(node) = graph.nodes.get(id.index()) else { continue };
        let mut lines = vec![names.step(&node.kind)];
        if let NodeKind::Monitor { watches, .. } = &node.kind {
            lines.extend(watches.iter().map(|watch| names.watch(watch)));
        }
        let lines: Vec<String> = lines.iter().map(|line| escape_dot(line)).collect();
        let shape = if matches!(node.kind, NodeKind::If { .. } | NodeKind::Wait { .. }) {
            ", shape=diamond"
        } else {
            ""
        };
        let _ = writeln!(out, "{pad}  n{} [label=\"{}\"{shape}];", id.0, lines.join("\\l"));
        for (label, body) in parts(graph, &node.kind) {
            cluster(graph, body, &format!("n{}", id.0), &label, level + 1, out);
        }
    }
    let _ = writeln!(out, "{pad}}}");
    if let Some(first) = chain.first() {
        let _ =
            writeln!(out, "{pad}{owner} -> n{} [style=dotted, label=\"{}\"];", first.0, escape_dot(label));
    }
    for (before, after) in chain.iter().zip(chain.iter().skip(1)) {
        let _ = writeln!(out, "{pad}n{} -> n{};", before.0, after.0);
    }
}

fn escape_dot(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for char in text.chars() {
        match char {
            '"' => out.push_str("\\\""),
            '\\' => out.push_str("\\\\"),
            char if char.is_control() => out.push(' '),
            char => out.push(char),
        }
    }
    out
}

/// A graph as a Mermaid flowchart.
///
/// ```
/// let graph = motet_graph::Graph::empty("tidy_up", "hsr");
/// assert!(motet_graph::draw::mermaid(&graph).starts_with("flowchart"));
/// ```
#[must_use]
pub fn mermaid(graph: &Graph) -> String {
    let names = Names(graph);
    let mut out = String::from("flowchart TD\n");
    // Writing to a string fails never.
    let _ = writeln!(out, "    start([\"{}\"])", escape_mermaid(&graph.policy));
    for (index, node) in graph.nodes.iter().enumerate() {
        let (open, close) = brackets(&node.kind);
        let _ = writeln!(out, "    n{index}{open}\"{}\"{close}", escape_mermaid(&names.step(&node.kind)));
    }
    edges(graph, "start", "", ROOT, &mut out);
    for (index, node) in graph.nodes.iter().enumerate() {
        for (label, region) in parts(graph, &node.kind) {
            edges(graph, &format!("n{index}"), &label, region, &mut out);
        }
        if let NodeKind::Monitor { watches, .. } = &node.kind {
            for (place, watch) in watches.iter().enumerate() {
                let _ = writeln!(out, "    w{index}_{place}[/\"{}\"/]", escape_mermaid(&names.watch(watch)));
                let _ = writeln!(out, "    n{index} -.- w{index}_{place}");
            }
        }
    }
    out
}

fn edges(graph: &Graph, from: &str, label: &str, region: RegionId, out: &mut String) {
    let chain = chain(graph, region);
    if let Some(first) = chain.first() {
        let label = if label.is_empty() { String::new() } else { format!("|\"{}\"|", escape_mermaid(label)) };
        let _ = writeln!(out, "    {from} -.->{label} n{}", first.0);
    }
    for (before, after) in chain.iter().zip(chain.iter().skip(1)) {
        let _ = writeln!(out, "    n{} --> n{}", before.0, after.0);
    }
}

fn brackets(kind: &NodeKind) -> (&'static str, &'static str) {
    match kind {
        NodeKind::If { .. } | NodeKind::Wait { .. } => ("{", "}"),
        NodeKind::End { .. } => ("([", "])"),
        NodeKind::Monitor { .. } => ("{{", "}}"),
        NodeKind::Parallel { .. } => ("[[", "]]"),
        NodeKind::Call(_) | NodeKind::Let { .. } | NodeKind::Sequence { .. } | NodeKind::Inline { .. } => {
            ("[", "]")
        }
        NodeKind::Try { .. } | NodeKind::Repeat { .. } | NodeKind::Each { .. } => ("[", "]"),
        NodeKind::Delay { .. } | NodeKind::Finally { .. } => ("[", "]"),
    }
}

/// Mermaid takes entity codes in quoted labels.
fn escape_mermaid(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for char in text.chars() {
        match char {
            '"' => out.push_str("#quot;"),
            '#' => out.push_str("#35;"),
            '<' => out.push_str("#lt;"),
            '>' => out.push_str("#gt;"),
            '&' => out.push_str("#amp;"),
            '`' => out.push_str("#96;"),
            '\\' => out.push_str("#92;"),
            char if char.is_control() => out.push(' '),
            char => out.push(char),
        }
    }
    out
}
