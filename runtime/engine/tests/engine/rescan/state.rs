//! What the interpreter keeps.

use motet_graph::{Condition, FactArg, Graph, Manner, NodeId, NodeKind, PrimitiveId, RegionId, Term, Value};
use motet_runtime::RunEnd;
use std::collections::{BTreeMap, BTreeSet};

/// An instant, or a time, in ns.
pub(super) type Nanos = u64;

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
    Lose,
    Suspend,
    Expire,
    Stop,
}

#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) enum Phase {
    Starting,
    Running,
    Held,
    Cancelling,
    SafeStopping,
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

/// A condition that is watched.
#[derive(Clone, Debug, Default)]
pub(super) struct Watched {
    pub(super) fired: u32,
    /// Since when it holds without a break.
    pub(super) holds_since: Option<Nanos>,
    pub(super) paused_at: Option<Nanos>,
    /// When its pause will have taken too long.
    pub(super) until: Option<Nanos>,
    /// How long it has paused before.
    pub(super) spent: Nanos,
}

/// A goal whose policy was replaced.
#[derive(Clone, Debug)]
pub(super) struct Orphan {
    pub(super) number: usize,
    pub(super) call: Call,
    pub(super) phase: Phase,
    pub(super) wish: Wish,
    pub(super) due: Nanos,
    pub(super) revision: u32,
    pub(super) node: NodeId,
}

/// What a goal does.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Call {
    pub(super) primitive: PrimitiveId,
    pub(super) args: Vec<Term>,
    pub(super) manner: Option<Manner>,
    pub(super) uses: Vec<String>,
}

/// A step that was entered.
#[derive(Clone, Debug)]
pub(super) struct Live {
    pub(super) at: At,
    /// When it will have taken too long.
    pub(super) timer: Option<Nanos>,
    /// What was left of that when it was held.
    pub(super) left: Nanos,
    pub(super) count: u32,
    pub(super) after: After,
    pub(super) watches: Vec<Watched>,
    /// The watch whose block interrupts the body.
    pub(super) resuming: Option<usize>,
    pub(super) clearing: bool,
    pub(super) body_ended: Option<Flow>,
}

pub(super) struct Naive {
    pub(super) now: Nanos,
    pub(super) graph: Graph,
    pub(super) revision: u32,
    pub(super) held: BTreeSet<String>,
    pub(super) regions: BTreeMap<RegionId, Region>,
    pub(super) nodes: BTreeMap<NodeId, Live>,
    pub(super) goals: BTreeMap<usize, NodeId>,
    pub(super) orphans: Vec<Orphan>,
    pub(super) started: usize,
    pub(super) ending: Option<RunEnd>,
    /// Whether a person has stopped the run.
    pub(super) halted: bool,
    /// Calls whose last goal the driver lost.
    pub(super) lost: BTreeSet<NodeId>,
    /// How the run ends once no orphan is left.
    pub(super) closing: Option<RunEnd>,
    pub(super) out: Vec<String>,
    pub(super) over: bool,
}

impl Naive {
    pub(super) fn new(graph: Graph) -> Self {
        Self {
            now: 0,
            graph,
            revision: 0,
            held: BTreeSet::new(),
            regions: BTreeMap::new(),
            nodes: BTreeMap::new(),
            goals: BTreeMap::new(),
            orphans: Vec::new(),
            started: 0,
            ending: None,
            halted: false,
            lost: BTreeSet::new(),
            closing: None,
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

    pub(super) fn call(&self, node: NodeId) -> Call {
        let NodeKind::Call(call) = self.kind(node) else { panic!("no call") };
        let uses = &self.graph.primitives[call.primitive.index()].uses;
        let uses = uses.iter().map(|id| self.graph.resources[id.index()].name.to_string());
        let (args, manner, uses) = (call.args.clone(), call.manner, uses.collect());
        Call { primitive: call.primitive, args, manner, uses }
    }

    /// Whether nobody holds what a step needs, but for the orphan of a number.
    pub(super) fn is_free(&self, node: NodeId, but: Option<usize>) -> bool {
        let wanted = self.call(node).uses;
        let orphans = self.orphans.iter().filter(|orphan| Some(orphan.number) != but);
        let held = self.goals.values().map(|other| self.call(*other).uses);
        held.chain(orphans.map(|orphan| orphan.call.uses.clone()))
            .all(|held| held.iter().all(|used| !wanted.contains(used)))
    }
}
