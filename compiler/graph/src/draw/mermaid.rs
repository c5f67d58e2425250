//! A graph as a Mermaid flowchart: success edges are solid, what a node holds hangs on dotted edges.

use super::names::Names;
use super::{chain, parts};
use crate::model::{Graph, NodeKind, ROOT};
use std::fmt::Write;

/// A graph as a Mermaid flowchart.
#[must_use]
pub fn mermaid(graph: &Graph) -> String {
    let names = Names(graph);
    let mut out = String::from("flowchart TD\n");
    // Writing to a string fails never.
    let _ = writeln!(out, "    start([\"{}\"])", escape(&graph.policy));
    for (index, node) in graph.nodes.iter().enumerate() {
        let (open, close) = brackets(&node.kind);
        let _ = writeln!(out, "    n{index}{open}\"{}\"{close}", escape(&names.step(&node.kind)));
    }
    edges(graph, "start", "", ROOT, &mut out);
    for (index, node) in graph.nodes.iter().enumerate() {
        for (label, region) in parts(graph, &node.kind) {
            edges(graph, &format!("n{index}"), &label, region, &mut out);
        }
        if let NodeKind::Monitor { watches, .. } = &node.kind {
            for (place, watch) in watches.iter().enumerate() {
                let _ = writeln!(out, "    w{index}_{place}[/\"{}\"/]", escape(&names.watch(watch)));
                let _ = writeln!(out, "    n{index} -.- w{index}_{place}");
            }
        }
    }
    out
}

fn edges(graph: &Graph, from: &str, label: &str, region: crate::model::RegionId, out: &mut String) {
    let chain = chain(graph, region);
    if let Some(first) = chain.first() {
        let label = if label.is_empty() { String::new() } else { format!("|\"{}\"|", escape(label)) };
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
        NodeKind::Call(_) | NodeKind::Sequence { .. } | NodeKind::Inline { .. } => ("[", "]"),
        NodeKind::Try { .. } | NodeKind::Repeat { .. } | NodeKind::Each { .. } => ("[", "]"),
    }
}

/// Mermaid takes entity codes in quoted labels.
fn escape(text: &str) -> String {
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
