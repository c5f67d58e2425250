//! Outline of a graph for the page: the rows of its tree with what each step needs, watches and moves.

use motet_graph::draw::Names;
use motet_graph::{Comparison, Condition, Graph, NodeId, NodeKind, Reaction, Term, Verdict};
use serde_json::{Map, Value, json};

use super::source::PolicyText;
use super::tree::StepTree;
use super::world::PageWorld;

/// Steps of a graph beyond which its paths are not drawn: they would be many megabytes.
const MOST_PATHS: usize = 300;

/// Outline of a graph: its name, its robot, and a row for each step and each heading.
pub(super) fn outline(
    graph: &Graph,
    tree: &StepTree,
    text: Option<&PolicyText>,
    world: Option<&PageWorld>,
) -> Map<String, Value> {
    let rows: Vec<Value> = tree
        .rows
        .iter()
        .map(|row| {
            let mut item = json!({"d": row.depth, "l": row.label});
            if let (Some(id), Some(item)) = (row.node, item.as_object_mut()) {
                step(graph, id, item, text, world);
            }
            item
        })
        .collect();
    let mut item = Map::new();
    item.insert("policy".to_owned(), json!(graph.policy));
    item.insert("robot".to_owned(), json!(graph.robot));
    item.insert("secs".to_owned(), json!([graph.duration.least_secs, graph.duration.greatest_secs]));
    item.insert("rows".to_owned(), Value::Array(rows));
    if let Some(text) = text {
        item.insert("text".to_owned(), text.item());
    }
    item
}

/// Adds what is known of a step before it runs.
fn step(
    graph: &Graph,
    id: NodeId,
    item: &mut Map<String, Value>,
    text: Option<&PolicyText>,
    world: Option<&PageWorld>,
) {
    let Some(node) = graph.nodes.get(id.index()) else { return };
    let names = Names(graph);
    item.insert("n".to_owned(), json!(id.0));
    item.insert("kind".to_owned(), json!(kind(&node.kind)));
    item.insert("path".to_owned(), json!(node.path));
    item.insert("secs".to_owned(), json!([node.duration.least_secs, node.duration.greatest_secs]));
    if let Some(line) = text.and_then(|text| text.line(&node.path)) {
        item.insert("line".to_owned(), json!(line));
    }
    match &node.kind {
        NodeKind::Call(call) => {
            let needs: Vec<Value> = call
                .needs
                .iter()
                .map(|need| json!({"text": names.need(need), "verdict": verdict(need.verdict)}))
                .collect();
            if !needs.is_empty() {
                item.insert("needs".to_owned(), Value::Array(needs));
            }
            if let Some(motion) = &call.motion {
                let mut told = json!({
                    "text": names.motion(motion), "verdict": verdict(motion.verdict), "why": motion.why,
                });
                if let (Some(witness), Some(told)) = (&motion.witness, told.as_object_mut()) {
                    told.insert("clearance".to_owned(), json!(witness.clearance));
                    let world = world.filter(|_| graph.nodes.len() <= MOST_PATHS);
                    told.insert("path".to_owned(), world.map_or(Value::Null, |world| world.path(witness)));
                }
                item.insert("motion".to_owned(), told);
            }
        }
        NodeKind::Monitor { watches, .. } => {
            let watches: Vec<Value> = watches
                .iter()
                .map(|watch| {
                    let mut reads = Vec::new();
                    readings(&names, &watch.condition, false, &mut reads);
                    json!({"text": names.watch(watch), "reads": reads, "then": reaction(&watch.reaction)})
                })
                .collect();
            item.insert("watches".to_owned(), Value::Array(watches));
        }
        _ => {}
    }
}

/// Word for a kind of step.
const fn kind(kind: &NodeKind) -> &'static str {
    match kind {
        NodeKind::Call(_) => "call",
        NodeKind::Let { .. } => "let",
        NodeKind::Sequence { .. } => "sequence",
        NodeKind::Inline { .. } => "policy",
        NodeKind::If { .. } => "if",
        NodeKind::Wait { .. } => "wait",
        NodeKind::Delay { .. } => "delay",
        NodeKind::Finally { .. } => "finally",
        NodeKind::Monitor { .. } => "monitor",
        NodeKind::Try { .. } => "try",
        NodeKind::Repeat { .. } => "repeat",
        NodeKind::Each { .. } => "each",
        NodeKind::Parallel { .. } => "parallel",
        NodeKind::End { .. } => "end",
    }
}

const fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Proven => "proven",
        Verdict::Deferred => "deferred",
    }
}

const fn reaction(reaction: &Reaction) -> &'static str {
    match reaction {
        Reaction::Pause { .. } => "pause",
        Reaction::Restart { .. } => "restart",
        Reaction::Resume { .. } => "resume",
        Reaction::End { .. } => "end",
    }
}

/// Adds the questions on which a condition depends, each with the bound of a number or the truth that makes
/// the condition true.
fn readings(names: &Names<'_>, condition: &Condition, is_negated: bool, reads: &mut Vec<Value>) {
    match condition {
        Condition::Literal(_) => {}
        Condition::Fact(_) => {
            reads.push(json!({"q": names.condition(condition), "is": !is_negated}));
        }
        Condition::Compare(comparison, left, right) => {
            let (asked, bound, comparison) = match (number(left), number(right)) {
                (None, Some(bound)) => (left, bound, *comparison),
                (Some(bound), None) => (right, bound, mirrored(*comparison)),
                (Some(_), Some(_)) | (None, None) => return,
            };
            if matches!(asked, Term::Measure(..) | Term::Field(..)) {
                let sign = if is_negated { "not" } else { comparison.symbol() };
                reads.push(json!({"q": names.term(asked), "op": sign, "bound": bound}));
            }
        }
        Condition::Not(inner) => readings(names, inner, !is_negated, reads),
        Condition::All(parts) | Condition::AnyOf(parts) => {
            parts.iter().for_each(|part| readings(names, part, is_negated, reads));
        }
    }
}

fn number(term: &Term) -> Option<f64> {
    match term {
        Term::Literal(motet_graph::Value::Number(number)) => Some(*number),
        Term::Literal(motet_graph::Value::Int(number)) => Some(*number as f64),
        _ => None,
    }
}

/// The same comparison with its sides exchanged.
const fn mirrored(comparison: Comparison) -> Comparison {
    match comparison {
        Comparison::Less => Comparison::More,
        Comparison::AtMost => Comparison::AtLeast,
        Comparison::More => Comparison::Less,
        Comparison::AtLeast => Comparison::AtMost,
        same @ (Comparison::Equal | Comparison::Unequal) => same,
    }
}
