//! A graph as a Graphviz digraph, each region a cluster.

use super::names::Names;
use super::{DEEPEST, chain, parts};
use crate::model::{Graph, NodeKind, ROOT, RegionId};
use std::fmt::Write;

/// A graph as a Graphviz digraph.
#[must_use]
pub fn dot(graph: &Graph) -> String {
    let mut out = format!("digraph \"{}\" {{\n", escape(&graph.policy));
    out.push_str("  compound=true;\n  node [shape=box, fontname=\"sans-serif\"];\n");
    // Writing to a string fails never.
    let _ = writeln!(out, "  start [shape=oval, label=\"{}\"];", escape(&graph.policy));
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
    let _ = writeln!(out, "{pad}  label=\"{}\";", escape(label));
    for id in &chain {
        let Some(node) = graph.nodes.get(id.index()) else { continue };
        let mut lines = vec![names.step(&node.kind)];
        if let NodeKind::Monitor { watches, .. } = &node.kind {
            lines.extend(watches.iter().map(|watch| names.watch(watch)));
        }
        let lines: Vec<String> = lines.iter().map(|line| escape(line)).collect();
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
        let _ = writeln!(out, "{pad}{owner} -> n{} [style=dotted, label=\"{}\"];", first.0, escape(label));
    }
    for (before, after) in chain.iter().zip(chain.iter().skip(1)) {
        let _ = writeln!(out, "{pad}n{} -> n{};", before.0, after.0);
    }
}

fn escape(text: &str) -> String {
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
