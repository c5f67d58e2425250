//! The tables of declarations; durations, deadlines, bounds and the numbers of witnesses.

use smol_str::SmolStr;

use super::invalid::{MAX_NODES, MAX_RESOURCES, MAX_TERM_DEPTH};
use super::{Findings, InvalidReason};
use crate::model::{
    DurationBounds, FactArg, Graph, InitialFact, Motion, Node, NodeKind, Reaction, Term, Type, Verdict,
};

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    for (what, count, limit) in [
        ("nodes", graph.nodes.len(), MAX_NODES),
        ("regions", graph.regions.len(), MAX_NODES),
        ("bindings", graph.bindings.len(), MAX_NODES),
        ("resources", graph.resources.len(), MAX_RESOURCES),
    ] {
        if count > limit {
            findings.table(what, limit, InvalidReason::TooMany { what, count, limit });
        }
    }
    if graph.failures.first().is_none_or(|first| first != "timeout") {
        findings.table("failure", 0, InvalidReason::NoTimeout);
    }
    for (index, kind) in graph.kinds.iter().enumerate() {
        if kind.parent.is_some_and(|parent| parent.index() >= index) {
            findings.table("kind", index, InvalidReason::KindOrder(kind.name.clone()));
        }
    }
    declarations(graph, findings);
    for (index, resource) in graph.resources.iter().enumerate() {
        for inner in &resource.contains {
            known(findings, "resource", index, "resource", inner.0, graph.resources.len());
        }
    }
    initial(graph, findings);
}

fn declarations(graph: &Graph, findings: &mut Findings) {
    for (index, fluent) in graph.fluents.iter().enumerate() {
        fluent.params.iter().for_each(|ty| type_known(graph, findings, "fluent", index, ty));
    }
    for (index, measure) in graph.measures.iter().enumerate() {
        measure.params.iter().for_each(|ty| type_known(graph, findings, "measure", index, ty));
        type_known(graph, findings, "measure", index, &measure.result);
    }
    for (index, primitive) in graph.primitives.iter().enumerate() {
        primitive.params.iter().for_each(|param| type_known(graph, findings, "primitive", index, &param.ty));
        primitive.result.iter().for_each(|ty| type_known(graph, findings, "primitive", index, ty));
        for resource in &primitive.uses {
            known(findings, "primitive", index, "resource", resource.0, graph.resources.len());
        }
        for failure in &primitive.fails {
            known(findings, "primitive", index, "failure", failure.0, graph.failures.len());
        }
    }
    for (index, binding) in graph.bindings.iter().enumerate() {
        type_known(graph, findings, "binding", index, &binding.ty);
    }
    for (index, declared) in graph.entities.iter().enumerate() {
        known(findings, "entity", index, "kind", declared.kind.0, graph.kinds.len());
    }
    for (index, sentence) in graph.sentences.iter().enumerate() {
        known(findings, "sentence", index, "failure", sentence.failure.0, graph.failures.len());
    }
    if let Some(result) = graph.result {
        known(findings, "result", 0, "binding", result.0, graph.bindings.len());
    }
}

fn initial(graph: &Graph, findings: &mut Findings) {
    for (index, InitialFact { fact, .. }) in graph.initial.iter().enumerate() {
        let Some(fluent) = graph.fluents.get(fact.fluent.index()) else {
            findings.table(
                "initial fact",
                index,
                InvalidReason::NoSuch { what: "fluent", id: fact.fluent.0 },
            );
            continue;
        };
        let (expected, given) = (fluent.params.len(), fact.args.len());
        if expected != given {
            let of = fluent.name.clone();
            findings.table("initial fact", index, InvalidReason::Arity { of, expected, given });
        }
        for (place, (arg, ty)) in fact.args.iter().zip(&fluent.params).enumerate() {
            match arg {
                FactArg::Any => {}
                FactArg::Term(Term::Literal(value)) if value.fits(ty) => {}
                FactArg::Term(Term::Literal(_)) => {
                    let of = fluent.name.clone();
                    findings.table("initial fact", index, InvalidReason::Argument { of, index: place });
                }
                FactArg::Term(_) => findings.table("initial fact", index, InvalidReason::NotGround),
            }
        }
    }
}

fn type_known(graph: &Graph, findings: &mut Findings, table: &str, index: usize, ty: &Type) {
    let mut inner = ty;
    let mut depth = 0;
    while let Type::List(item) = inner {
        inner = item;
        depth += 1;
        if depth > MAX_TERM_DEPTH {
            let reason =
                InvalidReason::TooMany { what: "levels of a type", count: depth, limit: MAX_TERM_DEPTH };
            findings.table(table, index, reason);
            return;
        }
    }
    if let Type::Entity(kind) = inner {
        known(findings, table, index, "kind", kind.0, graph.kinds.len());
    }
}

fn known(findings: &mut Findings, table: &str, index: usize, what: &'static str, id: u32, len: usize) {
    if id as usize >= len {
        findings.table(table, index, InvalidReason::NoSuch { what, id });
    }
}

pub(super) fn check_numbers(graph: &Graph, findings: &mut Findings) {
    let whole = SmolStr::new_static("policy");
    if !is_span(graph.observe_within_secs) {
        let reason =
            InvalidReason::Number { what: "the time for an observation", value: graph.observe_within_secs };
        findings.add(whole.clone(), reason);
    }
    if let Some(reason) = bad_bounds(graph.duration) {
        findings.add(whole, reason);
    }
    for node in &graph.nodes {
        if let Some(reason) = bad_bounds(node.duration) {
            findings.node(node, reason);
        }
        match &node.kind {
            NodeKind::Call(call) => {
                span(findings, node, "the deadline", call.deadline_secs);
                for (what, value) in call.manner.iter().flat_map(|manner| {
                    [
                        ("the part of the speed", manner.speed),
                        ("the part of the acceleration", manner.acceleration),
                    ]
                }) {
                    if !(value > 0.0 && value <= 1.0) {
                        findings.node(node, InvalidReason::Part { what, value });
                    }
                }
                if let Some(why) = call.motion.as_ref().and_then(bad_motion) {
                    findings.node(node, InvalidReason::Witness(why));
                }
            }
            NodeKind::Wait { within_secs, .. } => span(findings, node, "the deadline", *within_secs),
            NodeKind::Delay { secs } => span(findings, node, "the time of a wait", *secs),
            NodeKind::Repeat { times: 0, .. } => findings.node(node, InvalidReason::NoRuns),
            NodeKind::Monitor { watches, .. } => {
                for watch in watches {
                    span(findings, node, "the time that a condition must hold", watch.hold_secs);
                    if let Reaction::Pause { within_secs } = &watch.reaction {
                        span(findings, node, "the longest pause", *within_secs);
                    }
                }
            }
            NodeKind::Let { .. }
            | NodeKind::Sequence { .. }
            | NodeKind::Inline { .. }
            | NodeKind::If { .. }
            | NodeKind::Try { .. }
            | NodeKind::Finally { .. } => {}
            NodeKind::Repeat { .. } | NodeKind::Each { .. } | NodeKind::Parallel { .. } => {}
            NodeKind::End { .. } => {}
        }
    }
}

fn span(findings: &mut Findings, node: &Node, what: &'static str, value: f64) {
    if !is_span(value) {
        findings.node(node, InvalidReason::Number { what, value });
    }
}

fn is_span(secs: f64) -> bool {
    secs.is_finite() && secs >= 0.0
}

fn bad_bounds(bounds: DurationBounds) -> Option<InvalidReason> {
    let DurationBounds { least_secs, greatest_secs } = bounds;
    for (what, value) in [("the least duration", least_secs), ("the greatest duration", greatest_secs)] {
        if !is_span(value) {
            return Some(InvalidReason::Number { what, value });
        }
    }
    (least_secs > greatest_secs)
        .then_some(InvalidReason::Bounds { least: least_secs, greatest: greatest_secs })
}

/// Describes the error of a motion: a proven motion needs a witness, and a witness holds finite numbers.
fn bad_motion(motion: &Motion) -> Option<&'static str> {
    let witness = match (motion.verdict, &motion.witness) {
        (Verdict::Proven, Some(witness)) => witness,
        (Verdict::Deferred, None) if motion.leaves.is_some() => {
            return Some("is deferred and says where it leaves the robot");
        }
        (Verdict::Deferred, None) => return None,
        (Verdict::Proven, None) => return Some("is proven and has no witness"),
        (Verdict::Deferred, Some(_)) => return Some("is deferred and has a witness"),
    };
    if let Some(leaves) = &motion.leaves
        && !leaves.base.iter().chain(leaves.joints.values()).all(|value| value.is_finite())
    {
        return Some("leaves the robot at a number that is not finite");
    }
    if witness.path.is_empty() {
        return Some("has a witness without a path");
    }
    if witness.path.iter().any(|at| at.joints.len() != witness.joints.len()) {
        return Some("has a way-point without a position for each joint");
    }
    if !witness.path.is_sorted_by(|one, next| one.at <= next.at) {
        return Some("has way-points whose times go back");
    }
    let path = witness.path.iter().flat_map(|at| at.base.iter().chain(&at.joints).chain([&at.at, &at.ramp]));
    let grasp = witness
        .grasp
        .iter()
        .flat_map(|grasp| grasp.xyz.iter().chain(&grasp.quaternion).chain([&grasp.width]));
    let object = witness.grasp.iter().filter_map(|grasp| grasp.object.as_ref());
    let object = object.flat_map(|pose| pose.xyz.iter().chain(&pose.quaternion));
    let margins = [&witness.clearance].into_iter().chain(&witness.limit).chain(&witness.payload);
    let margins = margins.chain([&witness.keeps.base, &witness.keeps.arm]);
    let is_number = path.chain(grasp).chain(object).chain(margins).all(|value| value.is_finite());
    (!is_number).then_some("has a number that is not finite")
}
