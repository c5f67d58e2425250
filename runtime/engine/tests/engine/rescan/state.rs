//! What the interpreter keeps.

use motet_graph::{Condition, FactArg, Graph, NodeId, NodeKind, RegionId, Term, Value};
use motet_runtime::RunEnd;
use std::collections::{BTreeMap, BTreeSet};

/// How a region or a step ended; a failure with its kind and where it arose.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Flow {
    Ok,
    Fail(String, NodeId),
    Interrupted,
}

#[derive(Clone, Copy, PartialEq, PartialOrd, Debug)]
pub(super) enum Wish {
    None,
    Hold,
    Suspend,
    Stop,
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Phase {
    Starting,
    Running,
    Held,
    Cancelling,
}

/// Where a step stands.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum At {
    Enter,
    Parked,
    Acquire,
    Queued,
    Suspended,
    Goal(usize, Phase, Wish),
    Waiting,
    Inside,
    Ended(Flow),
}

#[derive(Clone, PartialEq, Debug)]
pub(super) enum After {
    Nothing,
    Exit(Flow),
    Restart,
}

/// An active region.
#[derive(Clone, Debug, Default)]
pub(super) struct Region {
    pub(super) current: Option<NodeId>,
    pub(super) stopping: bool,
    pub(super) suspended: u32,
    pub(super) ended: Option<Flow>,
}

/// A step that was entered.
#[derive(Clone, Debug)]
pub(super) struct Live {
    pub(super) at: At,
    pub(super) count: u32,
    pub(super) after: After,
    /// By watch: how often it fired, and whether it pauses.
    pub(super) watches: Vec<(u32, bool)>,
    /// The watch whose block interrupts the body.
    pub(super) resuming: Option<usize>,
    pub(super) clearing: bool,
    pub(super) body_ended: Option<Flow>,
}

pub(super) struct Naive {
    pub(super) graph: Graph,
    pub(super) held: BTreeSet<String>,
    pub(super) regions: BTreeMap<RegionId, Region>,
    pub(super) nodes: BTreeMap<NodeId, Live>,
    pub(super) goals: BTreeMap<usize, NodeId>,
    pub(super) started: usize,
    pub(super) ending: Option<RunEnd>,
    pub(super) out: Vec<String>,
    pub(super) over: bool,
}

impl Naive {
    pub(super) fn new(graph: Graph) -> Self {
        Self {
            graph,
            held: BTreeSet::new(),
            regions: BTreeMap::new(),
            nodes: BTreeMap::new(),
            goals: BTreeMap::new(),
            started: 0,
            ending: None,
            out: Vec::new(),
            over: false,
        }
    }

    pub(super) fn kind(&self, node: NodeId) -> NodeKind {
        self.graph.nodes[node.index()].kind.clone()
    }

    pub(super) fn live(&mut self, node: NodeId) -> &mut Live {
        self.nodes.get_mut(&node).unwrap()
    }

    pub(super) fn region_of(&self, node: NodeId) -> RegionId {
        self.graph.nodes[node.index()].region
    }

    pub(super) fn owned(&self, node: NodeId) -> Vec<RegionId> {
        let owner = |region: &motet_graph::Region| region.owner == Some(node);
        let all = self.graph.regions.iter().enumerate().filter(|(_, region)| owner(region));
        all.map(|(index, _)| RegionId(index as u32)).collect()
    }

    pub(super) fn is_stopping(&self, region: RegionId) -> bool {
        self.regions.get(&region).is_some_and(|region| region.stopping)
    }

    pub(super) fn is_suspended(&self, region: RegionId) -> bool {
        self.regions.get(&region).is_some_and(|region| region.suspended > 0)
    }

    pub(super) fn is_down(&self, node: NodeId) -> bool {
        self.owned(node).iter().all(|region| !self.regions.contains_key(region))
    }

    pub(super) fn holds(&self, condition: &Condition) -> bool {
        match condition {
            Condition::Literal(value) => *value,
            Condition::Not(inner) => !self.holds(inner),
            Condition::All(parts) => parts.iter().all(|part| self.holds(part)),
            Condition::AnyOf(parts) => parts.iter().any(|part| self.holds(part)),
            Condition::Fact(fact) => match &fact.args[0] {
                FactArg::Term(Term::Literal(Value::Entity(id))) => self.held.contains(id.as_str()),
                other => panic!("{other:?}"),
            },
            Condition::Compare(..) => panic!("no comparisons"),
        }
    }

    pub(super) fn uses(&self, node: NodeId) -> Vec<String> {
        let NodeKind::Call(call) = self.kind(node) else { return Vec::new() };
        let uses = &self.graph.primitives[call.primitive.index()].uses;
        uses.iter().map(|id| self.graph.resources[id.index()].name.to_string()).collect()
    }

    pub(super) fn is_free(&self, node: NodeId) -> bool {
        let wanted = self.uses(node);
        self.goals.values().all(|other| self.uses(*other).iter().all(|used| !wanted.contains(used)))
    }
}
