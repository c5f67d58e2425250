//! Weighted best-first search (Pohl 1970) over calls. A state consists of the facts after the calls that lead
//! to it; it is recomputed from them when needed, since plans are short and facts are cheap to write and to
//! roll back.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::hash::{Hash, Hasher};

use motet_syntax::ast::PrimitiveKind;
use rustc_hash::{FxHashMap, FxHashSet, FxHasher};

use super::estimate::{Estimate, Ready};
use crate::declare::NeedDef;
use crate::facts::Cause;
use crate::ir::StepId;
use crate::plan::achievers::CandidateCall;
use crate::prove::Prover;
use crate::prove::effects::{FactChange, PerceptionLifetime};
use crate::prove::evaluation::CallFrame;

/// Weight of the heuristic against the cost so far: above 1 the search is greedier.
const WEIGHT: u64 = 2;

/// Node of the search tree.
struct Node {
    parent: Option<usize>,
    call: Option<CandidateCall>,
    /// Calls to try from here.
    ready: Vec<Ready>,
    spent: u64,
    depth: usize,
}

/// Needs that a search has to meet.
#[derive(Clone, Copy)]
pub(crate) struct Target<'t> {
    pub(crate) needs: &'t [NeedDef],
    pub(crate) frame: CallFrame<'t>,
    /// Needs that are unknown count as met: a guard asks them.
    pub(crate) leaves_guards: bool,
}

impl Target<'_> {
    fn is_met(&self, prover: &Prover<'_>) -> bool {
        self.needs.iter().all(|need| {
            let value = prover.need(need, self.frame).0;
            if self.leaves_guards { !value.no.is_some() } else { value.is_true() }
        })
    }
}

/// Bounds of a search.
#[derive(Clone, Copy)]
pub(crate) struct Bounds {
    /// Maximal number of expanded states.
    pub(crate) states: usize,
    /// Maximal number of calls of a plan.
    pub(crate) calls: usize,
    /// Maximal depth of needs of needs.
    pub(crate) depth: usize,
    /// Maximal number of plans.
    pub(crate) plans: usize,
}

/// Facts at the start of all plans of a search, to which the prover returns.
pub(crate) struct Root {
    mark: usize,
    lasting: FxHashMap<StepId, PerceptionLifetime>,
}

impl Root {
    /// The present facts.
    pub(crate) fn here(prover: &Prover<'_>) -> Self {
        Self { mark: prover.state.facts.mark(), lasting: prover.state.lasting.clone() }
    }

    /// Rolls everything back and applies calls from the start.
    pub(crate) fn replay(&self, prover: &mut Prover<'_>, calls: &[CandidateCall]) {
        prover.back_to(self.mark);
        prover.state.lasting.clone_from(&self.lasting);
        for (index, call) in calls.iter().enumerate() {
            apply(prover, index, call);
        }
    }
}

/// Result of a search.
#[derive(Default)]
pub(crate) struct Found {
    /// Calls after which the target is met, the best first. No plan is the beginning of another.
    pub(crate) plans: Vec<Vec<CandidateCall>>,
    pub(super) expanded_states: usize,
    /// The bound of states ended the search.
    pub(super) is_exhausted: bool,
    /// A need that no call can meet.
    pub(super) blocker: Option<String>,
}

/// Searches calls that meet a target after the calls `before`. Leaves the facts anywhere: the caller restores
/// them.
pub(crate) fn search(
    prover: &mut Prover<'_>,
    root: &Root,
    before: &[CandidateCall],
    target: Target<'_>,
    bounds: Bounds,
) -> Found {
    let mut found = Found::default();
    root.replay(prover, before);
    let mut seen: FxHashSet<u64> = FxHashSet::default();
    seen.insert(fingerprint(prover, root));
    let mut nodes = Vec::new();
    // What is nearest first; of equals the one that was found first.
    let mut open = BinaryHeap::new();
    let mut estimate = Estimate::new(prover, target.leaves_guards, bounds.depth);
    match estimate.target(target) {
        None => found.blocker = estimate.dead,
        Some(_) => {
            nodes.push(Node { parent: None, call: None, ready: estimate.ready, spent: 0, depth: 0 });
            open.push((Reverse((0, 0)), 0_usize));
        }
    }
    while let Some((_, index)) = open.pop() {
        if found.expanded_states == bounds.states {
            found.is_exhausted = true;
            break;
        }
        found.expanded_states += 1;
        let path = path(&nodes, index);
        root.replay(prover, before);
        for (offset, call) in path.iter().enumerate() {
            apply(prover, before.len() + offset, call);
        }
        if target.is_met(prover) {
            found.plans.push(path);
            if found.plans.len() == bounds.plans {
                break;
            }
            continue;
        }
        let Some(node) = nodes.get_mut(index).filter(|node| node.depth < bounds.calls) else { continue };
        let (spent, depth, mut ready) = (node.spent, node.depth, std::mem::take(&mut node.ready));
        // Of calls that come to the same the cheapest is kept.
        ready.sort_by_key(|ready| ready.cost);
        for Ready { call, cost } in ready {
            let mark = prover.state.facts.mark();
            let lasting = prover.state.lasting.clone();
            apply(prover, before.len() + depth, &call);
            if seen.insert(fingerprint(prover, root)) {
                let mut estimate = Estimate::new(prover, target.leaves_guards, bounds.depth);
                if let Some(missing) = estimate.target(target) {
                    let (spent, ready) = (spent + u64::from(cost), estimate.ready);
                    let order = (spent + WEIGHT * u64::from(missing), nodes.len());
                    open.push((Reverse(order), nodes.len()));
                    nodes.push(Node {
                        parent: Some(index),
                        call: Some(call),
                        ready,
                        spent,
                        depth: depth + 1,
                    });
                }
            }
            prover.back_to(mark);
            prover.state.lasting = lasting;
        }
    }
    found
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
pub(super) fn apply(prover: &mut Prover<'_>, index: usize, call: &CandidateCall) {
    let library = prover.library;
    let Some(def) = library.primitive(call.primitive) else { return };
    // Behind the steps of the policy, which have numbers of their own.
    let id = StepId(u32::try_from(prover.program.steps.len() + index).unwrap_or(u32::MAX));
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
    prover.make(&makes, cause);
    if let Some(lasts) = &def.lasts {
        let entities = lasts.entities.iter().filter_map(|term| prover.argument(term, frame));
        let entities = entities.map(crate::ir::Entity).collect();
        prover.state.lasting.insert(id, PerceptionLifetime { resources: lasts.resources, entities });
    }
}

/// Hash of the facts that differ from the root.
fn fingerprint(prover: &Prover<'_>, root: &Root) -> u64 {
    let mut hasher = FxHasher::default();
    let mut at_root = FxHashMap::default();
    for (fluent, key, before) in prover.state.facts.writes(root.mark) {
        at_root.entry((fluent, key)).or_insert(before);
    }
    for (fluent, key) in prover.state.facts.touched(root.mark) {
        let now = prover.state.facts.get(fluent, key);
        if !at_root.get(&(fluent, key)).is_some_and(|before| now.same_set(*before)) {
            (fluent, key, now.yes.is_some(), now.no.is_some(), now.open.is_some()).hash(&mut hasher);
        }
    }
    hasher.finish()
}
