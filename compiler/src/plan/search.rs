//! Weighted best-first search (Pohl 1970) over calls. A state consists of the facts after the calls that lead
//! to it; it is recomputed from them when needed, since plans are short and facts are cheap to write and to
//! roll back. A state is estimated when its turn comes (deferred evaluation, Richter and Helmert 2009). A
//! plan estimates all states that may be the nearest, a repair first the one that its estimate expects to be.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::hash::{Hash, Hasher};

use motet_syntax::ast::PrimitiveKind;
use rustc_hash::{FxHashSet, FxHasher};

use super::estimate::{Estimate, Purpose, Ready, Target};
use crate::declare::PerceptionLifetime;
use crate::facts::Cause;
use crate::ir::StepId;
use crate::plan::achievers::CandidateCall;
use crate::prove::Prover;
use crate::prove::effects::FactChange;
use crate::prove::evaluation::CallFrame;

/// Weight of the heuristic against the cost so far: above 1 the search is greedier.
const WEIGHT: u64 = 2;

/// Bounds of a search; what it uses is taken from the first two.
#[derive(Clone, Copy)]
pub(crate) struct Bounds {
    /// Number of states to expand.
    pub(crate) states: usize,
    /// Number of calls to estimate.
    pub(crate) estimates: usize,
    /// Number of calls of a plan.
    pub(crate) calls: usize,
    /// Number of plans.
    pub(crate) plans: usize,
}

/// Node of the search tree.
struct Node {
    parent: Option<usize>,
    call: Option<CandidateCall>,
    /// Calls to try here, once the state is estimated.
    ready: Option<Vec<Ready>>,
    spent: u64,
    depth: usize,
}

/// Searches plans that meet a target from the present state, the best first; none is the beginning of
/// another. Fails if no call leads to the target, with a need that none can meet if one is known.
pub(crate) fn search(
    prover: &mut Prover<'_>,
    target: Target<'_>,
    bounds: &mut Bounds,
) -> Result<Vec<Vec<CandidateCall>>, Option<String>> {
    let (root, lasting) = (prover.state.facts.mark(), prover.state.lasting.clone());
    let mut nodes = vec![Node { parent: None, call: None, ready: None, spent: 0, depth: 0 }];
    // What is nearest first; of equals the one that was found first.
    let mut open = BinaryHeap::from([Reverse((0, 0))]);
    let (mut found, mut seen, mut blocker) = (Vec::new(), FxHashSet::default(), None);
    while let Some(Reverse((_, index))) = open.pop().filter(|_| found.len() < bounds.plans) {
        let Some(left) = bounds.states.checked_sub(1) else { break };
        let path = path(&nodes, index);
        let Some(node) = nodes.get_mut(index) else { break };
        if node.ready.is_none() {
            path.iter().for_each(|call| apply(prover, call));
            let is_new = seen.insert(fingerprint(prover, root));
            if is_new && target.is_met(prover) {
                bounds.states = left;
                found.push(path);
            } else if is_new {
                match Estimate::new(prover, target, &mut bounds.estimates).lacking() {
                    Ok((missing, mut ready)) => {
                        let order = match target.purpose {
                            Purpose::Plan => node.spent + WEIGHT * u64::from(missing),
                            // A short search has to be greedy: it goes on here.
                            Purpose::Repair => 0,
                        };
                        // Of calls that come to the same the cheapest is kept.
                        ready.sort_by_key(|ready| ready.cost);
                        open.push(Reverse((order, index)));
                        node.ready = Some(ready);
                    }
                    Err(dead) => blocker = blocker.or(dead.filter(|_| index == 0)),
                }
            }
            prover.back_to(root);
            prover.state.lasting.clone_from(&lasting);
            continue;
        }
        bounds.states = left;
        let (spent, depth) = (node.spent, node.depth + 1);
        let ready = node.ready.take().into_iter().flatten().filter(|_| depth <= bounds.calls);
        for Ready { call, cost, missing, .. } in ready {
            let spent = spent + u64::from(cost);
            let order = match target.purpose {
                // At most its order, so that it is estimated before a state behind it is expanded.
                Purpose::Plan => spent,
                Purpose::Repair => spent + WEIGHT * u64::from(missing),
            };
            open.push(Reverse((order, nodes.len())));
            nodes.push(Node { parent: Some(index), call: Some(call), ready: None, spent, depth });
        }
    }
    let is_exhausted = bounds.states == 0 || bounds.estimates == 0;
    if found.is_empty() && !is_exhausted { Err(blocker) } else { Ok(found) }
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

/// Applies a call that succeeds.
pub(super) fn apply(prover: &mut Prover<'_>, call: &CandidateCall) {
    let library = prover.library;
    let Some(def) = library.primitive(call.primitive) else { return };
    // A number behind the steps of the policy. The trail grows with every call.
    let id = prover.program.steps.len() + prover.state.facts.mark();
    let id = StepId(u32::try_from(id).unwrap_or(u32::MAX));
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

/// Hash of the facts that differ from those at a position in the trail.
fn fingerprint(prover: &Prover<'_>, root: usize) -> u64 {
    let (mut hasher, mut at_root) = (FxHasher::default(), BTreeMap::new());
    for (fluent, key, before) in prover.state.facts.writes(root) {
        at_root.entry((fluent, key)).or_insert(before);
    }
    for ((fluent, key), before) in at_root {
        let now = prover.state.facts.get(fluent, key);
        if !now.same_set(before) {
            (fluent, key, now.yes.is_some(), now.no.is_some(), now.open.is_some()).hash(&mut hasher);
        }
    }
    hasher.finish()
}
