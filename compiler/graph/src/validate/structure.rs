//! Regions and edges: that they form a tree in document order, each node in its one place.

use super::invalid::MAX_DEPTH;
use super::{Findings, InvalidReason};
use crate::model::{Ending, Graph, Node, NodeId, NodeKind, ROOT, Reaction, RegionId};

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    owners(graph, findings);
    edges(graph, findings);
    if findings.list.is_empty() {
        depth(graph, findings);
        endings(graph, findings);
    }
}

/// The regions that a node names, in document order.
pub(crate) fn owned(node: &Node) -> Vec<RegionId> {
    match &node.kind {
        NodeKind::Call(_)
        | NodeKind::Let { .. }
        | NodeKind::Wait { .. }
        | NodeKind::Delay { .. }
        | NodeKind::End { .. } => Vec::new(),
        NodeKind::Finally { body, cleanup } => vec![*body, *cleanup],
        NodeKind::Sequence { body, .. }
        | NodeKind::Inline { body, .. }
        | NodeKind::Repeat { body, .. }
        | NodeKind::Each { body, .. } => vec![*body],
        NodeKind::If { then, otherwise, .. } => std::iter::once(*then).chain(*otherwise).collect(),
        NodeKind::Monitor { watches, body } => {
            let blocks = watches.iter().filter_map(|watch| match &watch.reaction {
                Reaction::Resume { body, .. } => Some(*body),
                Reaction::Pause { .. } | Reaction::Restart { .. } | Reaction::End { .. } => None,
            });
            std::iter::once(*body).chain(blocks).collect()
        }
        NodeKind::Try { body, handlers } => {
            std::iter::once(*body).chain(handlers.iter().map(|handler| handler.body)).collect()
        }
        NodeKind::Parallel { branches } => branches.clone(),
    }
}

fn owners(graph: &Graph, findings: &mut Findings) {
    let mut named = vec![0_u32; graph.regions.len()];
    for (index, node) in graph.nodes.iter().enumerate() {
        for region in owned(node) {
            match graph.regions.get(region.index()) {
                None => findings.node(node, InvalidReason::NoSuch { what: "region", id: region.0 }),
                Some(own) if own.owner != Some(NodeId(index as u32)) => {
                    findings.node(node, InvalidReason::Ownership(region.0));
                }
                Some(_) => {
                    if let Some(count) = named.get_mut(region.index()) {
                        *count += 1;
                    }
                }
            }
        }
    }
    if graph.regions.is_empty() {
        findings.table("region", 0, InvalidReason::NoSuch { what: "region", id: ROOT.0 });
    }
    for (index, (region, named)) in graph.regions.iter().zip(named).enumerate() {
        let id = index as u32;
        if region.owner.is_some() == (index == ROOT.index()) {
            findings.table("region", index, InvalidReason::Owner(id));
        } else if named != u32::from(index != ROOT.index()) {
            findings.table("region", index, InvalidReason::Ownership(id));
        }
    }
}

fn edges(graph: &Graph, findings: &mut Findings) {
    let mut led_to = vec![0_u32; graph.nodes.len()];
    for (index, region) in graph.regions.iter().enumerate() {
        let Some(entry) = region.entry else { continue };
        match graph.nodes.get(entry.index()) {
            None => findings.table("region", index, InvalidReason::NoSuch { what: "node", id: entry.0 }),
            Some(node) if node.region.index() != index => {
                findings.table("region", index, InvalidReason::EdgeLeavesRegion(entry.0));
            }
            Some(_) => count(&mut led_to, entry),
        }
    }
    for (index, node) in graph.nodes.iter().enumerate() {
        match graph.regions.get(node.region.index()) {
            None => findings.node(node, InvalidReason::NoSuch { what: "region", id: node.region.0 }),
            Some(region) if region.owner.is_some_and(|owner| owner.index() >= index) => {
                findings.node(node, InvalidReason::BeforeOwner);
            }
            Some(_) => {}
        }
        let Some(next) = node.next else { continue };
        match graph.nodes.get(next.index()) {
            None => findings.node(node, InvalidReason::NoSuch { what: "node", id: next.0 }),
            Some(_) if next.index() <= index => findings.node(node, InvalidReason::EdgeLeadsBack(next.0)),
            Some(other) if other.region != node.region => {
                findings.node(node, InvalidReason::EdgeLeavesRegion(next.0))
            }
            Some(_) => count(&mut led_to, next),
        }
    }
    for (node, led_to) in graph.nodes.iter().zip(led_to) {
        match led_to {
            0 => findings.node(node, InvalidReason::Unreachable),
            1 => {}
            _ => findings.node(node, InvalidReason::TwoEdges),
        }
    }
}

fn count(led_to: &mut [u32], id: NodeId) {
    if let Some(count) = led_to.get_mut(id.index()) {
        *count += 1;
    }
}

fn depth(graph: &Graph, findings: &mut Findings) {
    // An owner stands before what lies in it, so its own depth is known by then.
    let mut depths = vec![0_usize; graph.nodes.len()];
    for (index, node) in graph.nodes.iter().enumerate() {
        let owner = graph.regions.get(node.region.index()).and_then(|region| region.owner);
        let depth = owner.and_then(|owner| depths.get(owner.index())).map_or(0, |depth| depth + 1);
        if let Some(own) = depths.get_mut(index) {
            *own = depth;
        }
        if depth > MAX_DEPTH {
            findings.node(
                node,
                InvalidReason::TooMany { what: "levels of steps", count: depth, limit: MAX_DEPTH },
            );
            return;
        }
    }
}

fn endings(graph: &Graph, findings: &mut Findings) {
    for node in &graph.nodes {
        match &node.kind {
            NodeKind::End { how, of, .. } => ending(graph, node, *how, *of, findings),
            NodeKind::Monitor { watches, .. } => {
                for watch in watches {
                    if let Reaction::End { how, of, .. } = &watch.reaction {
                        ending(graph, node, *how, *of, findings);
                    }
                }
            }
            NodeKind::Call(_) | NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => {
            }
            NodeKind::Wait { .. } | NodeKind::Try { .. } | NodeKind::Repeat { .. } => {}
            NodeKind::Each { .. } | NodeKind::Parallel { .. } => {}
            NodeKind::Let { .. } | NodeKind::Delay { .. } | NodeKind::Finally { .. } => {}
        }
    }
}

fn ending(graph: &Graph, node: &Node, how: Ending, of: Option<NodeId>, findings: &mut Findings) {
    if of.is_some() && matches!(how, Ending::Cannot | Ending::Replan) {
        findings.node(node, InvalidReason::ReplanOfPart);
    }
    let mut region = node.region;
    // Owners stand before what lies in them.
    while let Some(here) = graph.regions.get(region.index()).and_then(|region| region.owner) {
        let Some(around) = graph.nodes.get(here.index()) else { break };
        if matches!(&around.kind, NodeKind::Finally { cleanup, .. } if *cleanup == region) {
            findings.node(node, InvalidReason::EndsCleanup);
            return;
        }
        if Some(here) == of && matches!(around.kind, NodeKind::Inline { .. }) {
            return;
        }
        region = around.region;
    }
    if let Some(of) = of {
        findings.node(node, InvalidReason::NotEnclosing(of.0));
    }
}

/// Resource conflicts: parallel branches must not need the same resource, nor one that contains another's.
pub(super) fn check_resources(graph: &Graph, findings: &mut Findings) {
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
        for region in owned(node) {
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
