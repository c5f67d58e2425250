//! Weighted best-first search (Pohl 1970) over calls. A state consists of the facts after the calls that lead
//! to it; it is recomputed from them when needed, since plans are short and facts are cheap to write and to
//! roll back.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hash::{Hash, Hasher};

use motet_syntax::ast::PrimitiveKind;
use rustc_hash::{FxHashSet, FxHasher};

use super::NoPlan;
use super::estimate::{Estimate, Ready};
use crate::declare::PerceptionLifetime;
use crate::facts::Cause;
use crate::ir::{Condition, StepId};
use crate::plan::achievers::CandidateCall;
use crate::prove::Prover;
use crate::prove::effects::FactChange;
use crate::prove::evaluation::CallFrame;

/// Weight of the heuristic against the cost so far: above 1 the search is greedier.
const WEIGHT: u64 = 2;

/// Node of the search tree.
struct Node {
    parent: Option<usize>,
    call: Option<CandidateCall>,
    spent: u64,
    depth: usize,
}

/// Finds calls that reach a goal after the calls `before`. `left` is the remaining budget of states.
pub(super) fn search(
    prover: &mut Prover<'_>,
    before: &[CandidateCall],
    goal: &Condition,
    left: &mut usize,
) -> Result<Vec<CandidateCall>, NoPlan> {
    let shown = |prover: &Prover<'_>| prover.show(goal, true, CallFrame::default());
    replay(prover, before);
    let mut nodes = vec![Node { parent: None, call: None, spent: 0, depth: 0 }];
    let mut seen: FxHashSet<u64> = FxHashSet::default();
    seen.insert(fingerprint(prover));
    // What is nearest first; of equals the one that was found first.
    let mut open = BinaryHeap::from([(Reverse((0, 0)), 0_usize)]);
    let mut blocker = None;
    while let Some((_, index)) = open.pop() {
        let Some(rest) = left.checked_sub(1) else { return Err(NoPlan::Budget { goal: shown(prover) }) };
        *left = rest;
        let path = path(&nodes, index);
        replay(prover, before);
        for (offset, call) in path.iter().enumerate() {
            apply(prover, before.len() + offset, call);
        }
        if prover.evaluate(goal, CallFrame::default()).is_true() {
            return Ok(path);
        }
        let mut estimate = Estimate::new(prover);
        let is_hopeless = estimate.goal(goal).is_none();
        let Estimate { mut ready, dead, .. } = estimate;
        // Of calls that come to the same the cheapest is kept.
        ready.sort_by_key(|ready| ready.cost);
        if is_hopeless {
            if nodes.len() == 1 {
                blocker = dead;
            }
            continue;
        }
        let (spent, depth) = nodes.get(index).map_or((0, 0), |node| (node.spent, node.depth));
        for Ready { call, cost } in ready {
            let mark = prover.state.facts.mark();
            let lasting = prover.state.lasting.clone();
            apply(prover, before.len() + depth, &call);
            if seen.insert(fingerprint(prover)) {
                let missing = Estimate::new(prover).goal(goal);
                if let Some(missing) = missing {
                    let spent = spent + u64::from(cost);
                    let order = (spent + WEIGHT * u64::from(missing), nodes.len());
                    open.push((Reverse(order), nodes.len()));
                    nodes.push(Node { parent: Some(index), call: Some(call), spent, depth: depth + 1 });
                }
            }
            prover.back_to(mark);
            prover.state.lasting = lasting;
        }
    }
    Err(NoPlan::Unreachable { goal: shown(prover), blocker })
}

/// Calls that lead to a node.
fn path(nodes: &[Node], index: usize) -> Vec<CandidateCall> {
    let mut calls = Vec::new();
    let mut at = Some(index);
    while let Some(node) = at.and_then(|at| nodes.get(at)) {
        calls.extend(node.call.clone());
        at = node.parent;
    }
    calls.reverse();
    calls
}

/// Rolls everything back and applies calls from the start.
pub(super) fn replay(prover: &mut Prover<'_>, calls: &[CandidateCall]) {
    prover.back_to(0);
    prover.state.lasting.clear();
    for (index, call) in calls.iter().enumerate() {
        apply(prover, index, call);
    }
}

/// Applies a call that succeeds.
pub(super) fn apply(prover: &mut Prover<'_>, index: usize, call: &CandidateCall) {
    let library = prover.library;
    let Some(def) = library.primitive(call.primitive) else { return };
    let id = StepId(u32::try_from(index).unwrap_or(u32::MAX));
    let cause = Cause::step(id);
    let frame = CallFrame { args: &call.args, result: call.result, each: None };
    let (mut makes, mut unsettles): (Vec<FactChange>, Vec<FactChange>) = Default::default();
    prover.changes(&def.makes, frame, &mut makes);
    prover.changes(&def.unsettles, frame, &mut unsettles);
    // A look changes nothing: what is false stays so, and a plan does not make it unknown to rely on a guard.
    let only_looks = def.form == PrimitiveKind::Perception
        && def.motion.as_ref().is_some_and(|(motion, _)| !motion.moves());
    if only_looks {
        unsettles.retain(|change| !prover.state.facts.get(change.fluent, change.key).is_false());
    }
    prover.make_stale(id, def, frame);
    prover.unsettle(&unsettles, cause);
    prover.make(&makes, if def.lasts.is_some() { Cause::seen_by(id) } else { cause });
    if let Some(lasts) = &def.lasts {
        let entities = lasts.entities.iter().filter_map(|term| prover.argument(term, frame));
        let entities = entities.map(crate::ir::Entity).collect();
        prover.state.lasting.insert(id, PerceptionLifetime { resources: lasts.resources, entities });
    }
}

/// Hash of the facts that differ from the start.
fn fingerprint(prover: &Prover<'_>) -> u64 {
    let mut hasher = FxHasher::default();
    for (fluent, key) in prover.state.facts.touched(0) {
        let now = prover.state.facts.get(fluent, key);
        if !now.same_set(prover.environment.facts.get(fluent, key)) {
            (fluent, key, now.yes.is_some(), now.no.is_some(), now.open.is_some()).hash(&mut hasher);
        }
    }
    hasher.finish()
}
