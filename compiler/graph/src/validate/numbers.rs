//! Durations, deadlines, bounds and the numbers of witnesses.

use super::{Findings, InvalidReason};
use crate::model::{DurationBounds, Graph, Motion, Node, NodeKind, Reaction, Verdict};
use smol_str::SmolStr;

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
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
                if let Some(why) = call.motion.as_ref().and_then(bad_motion) {
                    findings.node(node, InvalidReason::Witness(why));
                }
            }
            NodeKind::Wait { within_secs, .. } => span(findings, node, "the deadline", *within_secs),
            NodeKind::Repeat { times: 0, .. } => findings.node(node, InvalidReason::NoRuns),
            NodeKind::Monitor { watches, .. } => {
                for watch in watches {
                    span(findings, node, "the time that a condition must hold", watch.hold_secs);
                    if let Reaction::Pause { within_secs } = &watch.reaction {
                        span(findings, node, "the longest pause", *within_secs);
                    }
                }
            }
            NodeKind::Sequence { .. }
            | NodeKind::Inline { .. }
            | NodeKind::If { .. }
            | NodeKind::Try { .. } => {}
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
        (Verdict::Deferred, None) => return None,
        (Verdict::Proven, None) => return Some("is proven and has no witness"),
        (Verdict::Deferred, Some(_)) => return Some("is deferred and has a witness"),
    };
    if witness.path.is_empty() {
        return Some("has a witness without a path");
    }
    if witness.path.iter().any(|at| at.joints.len() != witness.joints.len()) {
        return Some("has a way-point without a position for each joint");
    }
    let path = witness.path.iter().flat_map(|at| at.base.iter().chain(&at.joints));
    let grasp = witness
        .grasp
        .iter()
        .flat_map(|grasp| grasp.xyz.iter().chain(&grasp.quaternion).chain([&grasp.width]));
    let margins = [&witness.clearance].into_iter().chain(&witness.limit).chain(&witness.payload);
    let is_number = path.chain(grasp).chain(margins).all(|value| value.is_finite());
    (!is_number).then_some("has a number that is not finite")
}
