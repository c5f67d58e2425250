//! Resource conflicts: parallel branches must not need the same resource, nor one that contains another's.

use super::{Findings, InvalidReason};
use crate::model::{Graph, NodeKind, RegionId};

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    let mut used = vec![0_u128; graph.regions.len()];
    // What lies in a node stands after it, so going back each region is complete before its owner is looked
    // at.
    for node in graph.nodes.iter().rev() {
        let mut own = 0;
        if let NodeKind::Call(call) = &node.kind {
            let primitive = graph.primitives.get(call.primitive.index());
            own = primitive
                .map_or(0, |primitive| primitive.uses.iter().fold(0, |bits, id| bits | bit(id.index())));
        }
        for region in super::structure::owned(node) {
            own |= bits(&used, region);
        }
        if let Some(bits) = used.get_mut(node.region.index()) {
            *bits |= own;
        }
    }
    for node in &graph.nodes {
        let NodeKind::Parallel { branches } = &node.kind else { continue };
        let mut taken = 0;
        for branch in branches {
            let bits = bits(&used, *branch);
            let clash = taken & bits;
            if clash != 0 {
                let resource = graph.resources.get(clash.trailing_zeros() as usize);
                findings.node(
                    node,
                    InvalidReason::Conflict(
                        resource.map(|resource| resource.name.clone()).unwrap_or_default(),
                    ),
                );
                break;
            }
            taken |= with_conflicts(graph, bits);
        }
    }
}

fn bits(used: &[u128], region: RegionId) -> u128 {
    used.get(region.index()).copied().unwrap_or(0)
}

fn bit(index: usize) -> u128 {
    1_u128.checked_shl(index as u32).unwrap_or(0)
}

/// Resources, all that they contain, and all that contain them.
fn with_conflicts(graph: &Graph, bits: u128) -> u128 {
    let mut all = bits;
    for (index, resource) in graph.resources.iter().enumerate() {
        let inner = resource.contains.iter().fold(0, |bits, id| bits | bit(id.index()));
        if bits & bit(index) != 0 {
            all |= inner;
        }
        if bits & inner != 0 {
            all |= bit(index);
        }
    }
    all
}
