//! A graph made ready to be stepped: what can be worked out once is worked out here.

use crate::effect::Command;
use motet_graph::{
    CallNode, Ending, FailureId, Graph, Node, NodeId, NodeKind, Primitive, ROOT, Reaction, Region, RegionId,
    Term, Value, Watch,
};
use smol_str::SmolStr;
use std::sync::Arc;

/// A graph and its indices. Never changes during a run.
#[derive(Debug)]
pub(crate) struct Plan {
    pub(crate) graph: Arc<Graph>,
    /// All watches: monitors in document order, so an outer one has the smaller number.
    pub(crate) watches: Vec<(NodeId, u32)>,
    /// The failure `exhausted`.
    pub(crate) exhausted: FailureId,
    /// The failure `failed`.
    pub(crate) failed: FailureId,
    /// Names of all failures: the graph's own, then those that the engine knows beside them.
    pub(crate) failures: Vec<SmolStr>,
    /// The first watch of each node.
    first_watch: Vec<u32>,
    /// The regions that each node owns: a range of `owned`.
    ranges: Vec<(u32, u32)>,
    owned: Vec<RegionId>,
    /// The command of each call whose arguments are all literals.
    commands: Vec<Option<Arc<Command>>>,
    masks: Vec<Mask>,
    spare: Node,
    spare_region: Region,
}

/// Resources as bits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Mask {
    /// Those that a primitive holds.
    pub(crate) uses: u128,
    /// Those that nobody else may hold meanwhile.
    pub(crate) conflicts: u128,
}

impl Plan {
    pub(crate) fn new(graph: Arc<Graph>) -> Self {
        let mut failures = graph.failures.clone();
        let mut failure = |name: &str| {
            let known = failures.iter().position(|known| known == name);
            FailureId(known.unwrap_or_else(|| {
                failures.push(SmolStr::new(name));
                failures.len() - 1
            }) as u32)
        };
        let (exhausted, failed) = (failure("exhausted"), failure("failed"));
        let mut plan = Self {
            watches: Vec::new(),
            exhausted,
            failed,
            failures,
            first_watch: Vec::with_capacity(graph.nodes.len()),
            ranges: Vec::with_capacity(graph.nodes.len()),
            owned: Vec::with_capacity(graph.regions.len()),
            commands: Vec::with_capacity(graph.nodes.len()),
            masks: graph.primitives.iter().map(|primitive| mask(&graph, primitive)).collect(),
            spare: Node {
                path: SmolStr::default(),
                region: ROOT,
                next: None,
                duration: motet_graph::Bounds::default(),
                kind: NodeKind::End { how: Ending::Done, of: None, why: None },
            },
            spare_region: Region { owner: None, entry: None },
            graph: graph.clone(),
        };
        for (index, node) in graph.nodes.iter().enumerate() {
            plan.add(&graph, NodeId(index as u32), &node.kind);
        }
        plan
    }

    fn add(&mut self, graph: &Graph, id: NodeId, kind: &NodeKind) {
        let first = self.owned.len() as u32;
        self.first_watch.push(self.watches.len() as u32);
        self.commands.push(None);
        match kind {
            NodeKind::Call(call) => {
                if let Some(command) = self.commands.last_mut() {
                    *command = literal_command(graph, call);
                }
            }
            NodeKind::Sequence { body, .. }
            | NodeKind::Inline { body, .. }
            | NodeKind::Repeat { body, .. }
            | NodeKind::Each { body, .. } => self.owned.push(*body),
            NodeKind::If { then, otherwise, .. } => {
                self.owned.push(*then);
                self.owned.extend(*otherwise);
            }
            NodeKind::Wait { .. } | NodeKind::End { .. } => {}
            NodeKind::Monitor { watches, body } => {
                self.owned.push(*body);
                for (index, watch) in watches.iter().enumerate() {
                    self.watches.push((id, index as u32));
                    if let Reaction::Resume { body, .. } = &watch.reaction {
                        self.owned.push(*body);
                    }
                }
            }
            NodeKind::Try { body, handlers } => {
                self.owned.push(*body);
                self.owned.extend(handlers.iter().map(|handler| handler.body));
            }
            NodeKind::Parallel { branches } => self.owned.extend(branches),
        }
        self.ranges.push((first, self.owned.len() as u32));
    }

    pub(crate) fn node(&self, id: NodeId) -> &Node {
        self.graph.nodes.get(id.index()).unwrap_or(&self.spare)
    }

    pub(crate) fn region(&self, id: RegionId) -> &Region {
        self.graph.regions.get(id.index()).unwrap_or(&self.spare_region)
    }

    /// The regions that a node owns, in document order.
    pub(crate) fn owned(&self, id: NodeId) -> &[RegionId] {
        let (first, end) = self.ranges.get(id.index()).copied().unwrap_or_default();
        self.owned.get(first as usize..end as usize).unwrap_or_default()
    }

    /// The command of a call whose arguments are all literals.
    pub(crate) fn command(&self, id: NodeId) -> Option<&Arc<Command>> {
        self.commands.get(id.index())?.as_ref()
    }

    pub(crate) fn mask(&self, call: &CallNode) -> Mask {
        self.masks.get(call.primitive.index()).copied().unwrap_or_default()
    }

    /// The number of a monitor's watch among all.
    pub(crate) fn watch_number(&self, monitor: NodeId, index: u32) -> u32 {
        self.first_watch.get(monitor.index()).copied().unwrap_or_default() + index
    }

    /// A watch by its number.
    pub(crate) fn watch(&self, number: u32) -> Option<(NodeId, u32, &Watch)> {
        let (monitor, index) = self.watches.get(number as usize).copied()?;
        match &self.node(monitor).kind {
            NodeKind::Monitor { watches, .. } => Some((monitor, index, watches.get(index as usize)?)),
            NodeKind::Call(_) | NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => {
                None
            }
            NodeKind::Wait { .. }
            | NodeKind::Try { .. }
            | NodeKind::Repeat { .. }
            | NodeKind::Each { .. } => None,
            NodeKind::Parallel { .. } | NodeKind::End { .. } => None,
        }
    }

    /// A call; none where the node is something else.
    pub(crate) fn call(&self, id: NodeId) -> Option<&CallNode> {
        if let NodeKind::Call(call) = &self.node(id).kind { Some(call) } else { None }
    }

    /// The key of a node among timers and dependents: watches come first.
    pub(crate) fn node_key(&self, id: NodeId) -> u32 {
        self.watches.len() as u32 + id.0
    }

    /// Whose key it is.
    pub(crate) fn of_key(&self, key: u32) -> Key {
        let watches = self.watches.len() as u32;
        if key < watches { Key::Watch(key) } else { Key::Node(NodeId(key - watches)) }
    }

    /// How many keys there are.
    pub(crate) fn keys(&self) -> usize {
        self.watches.len() + self.graph.nodes.len()
    }
}

/// Who can set a timer or depend on a belief.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Key {
    /// A watch by its number.
    Watch(u32),
    /// A step.
    Node(NodeId),
}

/// The command of a call with these arguments.
pub(crate) fn command(graph: &Graph, call: &CallNode, args: Vec<Value>) -> Option<Command> {
    let primitive = graph.primitives.get(call.primitive.index())?;
    let names = primitive.params.iter().map(|(name, _)| name.clone());
    let uses = primitive.uses.iter().filter_map(|id| graph.resources.get(id.index()));
    Some(Command {
        primitive: primitive.name.clone(),
        args: names.zip(args).collect(),
        uses: uses.map(|resource| resource.name.clone()).collect(),
        deadline_secs: call.deadline_secs,
    })
}

fn literal_command(graph: &Graph, call: &CallNode) -> Option<Arc<Command>> {
    let literals =
        call.args.iter().map(|arg| if let Term::Literal(value) = arg { Some(value.clone()) } else { None });
    command(graph, call, literals.collect::<Option<_>>()?).map(Arc::new)
}

fn mask(graph: &Graph, primitive: &Primitive) -> Mask {
    let bit = |index: usize| 1_u128.checked_shl(index as u32).unwrap_or(0);
    let mut mask = Mask::default();
    for used in &primitive.uses {
        mask.uses |= bit(used.index());
        mask.conflicts |= bit(used.index());
        if let Some(resource) = graph.resources.get(used.index()) {
            mask.conflicts |= resource.contains.iter().fold(0, |bits, inner| bits | bit(inner.index()));
        }
        for (index, other) in graph.resources.iter().enumerate() {
            if other.contains.contains(used) {
                mask.conflicts |= bit(index);
            }
        }
    }
    mask
}
