//! A graph made ready to be stepped: what can be worked out once is worked out here.

use crate::effect::{Command, PlannedMotion};
use crate::ids::GoalId;
use crate::time::Time;
use motet_graph::{
    CallNode, Ending, FailureId, Graph, Motion, Node, NodeId, NodeKind, Primitive, ROOT, Reaction, Region,
    RegionId, Term, Value, Verdict, Watch,
};
use motet_stdlib::lang::failures;
use smol_str::SmolStr;
use std::sync::Arc;

/// A graph and its indices. Never changes during a run.
#[derive(Debug)]
pub(crate) struct PreparedGraph {
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
    /// Prepared data of every node.
    steps: Vec<PreparedNode>,
    /// Of each primitive.
    means: Vec<PrimitiveResources>,
    spare_step: PreparedNode,
    spare: Node,
    spare_region: Region,
}

/// Data of a node that each run looks up, stored compactly apart from the graph.
#[derive(Clone, Debug)]
pub(crate) struct PreparedNode {
    pub(crate) region: RegionId,
    pub(crate) next: Option<NodeId>,
    /// Call: the deadline of an attempt.
    pub(crate) deadline: Time,
    /// Call: its resources.
    pub(crate) mask: ResourceMask,
    /// Call: its command where its arguments are all literals.
    pub(crate) command: Option<Arc<Command>>,
    pub(crate) is_call: bool,
    /// True if it owns regions.
    pub(crate) is_composite: bool,
    /// Call: whether nothing is to be checked or unsettled before it starts.
    pub(crate) is_ready: bool,
    /// Call: whether its success changes nothing that the engine knows.
    pub(crate) is_silent: bool,
}

/// Resources of a primitive.
#[derive(Debug)]
struct PrimitiveResources {
    mask: ResourceMask,
    /// The names of its resources.
    uses: Arc<[SmolStr]>,
}

/// Resources as bits.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ResourceMask {
    /// Those that a primitive holds.
    pub(crate) uses: u128,
    /// Those that nobody else may hold meanwhile.
    pub(crate) conflicts: u128,
}

impl PreparedGraph {
    pub(crate) fn new(graph: Arc<Graph>) -> Self {
        let mut failures = graph.failures.clone();
        let mut failure = |name: &str| {
            let known = failures.iter().position(|known| known == name);
            FailureId(known.unwrap_or_else(|| {
                failures.push(SmolStr::new(name));
                failures.len() - 1
            }) as u32)
        };
        let (exhausted, failed) = (failure(failures::EXHAUSTED), failure(failures::FAILED));
        let mut plan = Self {
            watches: Vec::new(),
            exhausted,
            failed,
            failures,
            first_watch: Vec::with_capacity(graph.nodes.len()),
            ranges: Vec::with_capacity(graph.nodes.len()),
            owned: Vec::with_capacity(graph.regions.len()),
            steps: Vec::with_capacity(graph.nodes.len()),
            means: graph.primitives.iter().map(|primitive| means(&graph, primitive)).collect(),
            spare_step: PreparedNode::of_kind(ROOT, None),
            spare: Node {
                path: SmolStr::default(),
                region: ROOT,
                next: None,
                duration: motet_graph::DurationBounds::default(),
                kind: NodeKind::End { how: Ending::Done, of: None, why: None },
            },
            spare_region: Region { owner: None, entry: None },
            graph: graph.clone(),
        };
        for (index, node) in graph.nodes.iter().enumerate() {
            plan.add(NodeId(index as u32), &node.kind);
            let step = plan.ready(node, plan.owned(NodeId(index as u32)).is_empty());
            plan.steps.push(step);
        }
        plan
    }

    fn add(&mut self, id: NodeId, kind: &NodeKind) {
        let first = self.owned.len() as u32;
        self.first_watch.push(self.watches.len() as u32);
        match kind {
            NodeKind::Sequence { body, .. }
            | NodeKind::Inline { body, .. }
            | NodeKind::Repeat { body, .. }
            | NodeKind::Each { body, .. } => self.owned.push(*body),
            NodeKind::If { then, otherwise, .. } => {
                self.owned.push(*then);
                self.owned.extend(*otherwise);
            }
            NodeKind::Call(_)
            | NodeKind::Let { .. }
            | NodeKind::Wait { .. }
            | NodeKind::Delay { .. }
            | NodeKind::End { .. } => {}
            NodeKind::Finally { body, cleanup } => self.owned.extend([*body, *cleanup]),
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

    fn ready(&self, node: &Node, is_leaf: bool) -> PreparedNode {
        let mut step =
            PreparedNode { is_composite: !is_leaf, ..PreparedNode::of_kind(node.region, node.next) };
        if let NodeKind::Call(call) = &node.kind {
            let deferred = |verdict| verdict == Verdict::Deferred;
            let checks = call.needs.iter().any(|need| deferred(need.verdict))
                || call.motion.as_ref().is_some_and(|motion| deferred(motion.verdict));
            let literals = call.args.iter().map(literal);
            step.is_call = true;
            step.deadline = Time::from_secs(call.deadline_secs);
            step.mask = self.means.get(call.primitive.index()).map(|means| means.mask).unwrap_or_default();
            step.command = self.command(call, literals).map(|command| {
                let planned = call.motion.as_ref().and_then(|motion| Some((literal_motion(motion)?, motion)));
                Arc::new(match planned {
                    Some((planned, motion)) => command.with_motion(planned, motion.leaves.as_deref()),
                    None => command,
                })
            });
            step.is_ready = !checks && call.unsettles.is_empty();
            step.is_silent = call.effects.is_empty() && call.binds.is_none();
        }
        step
    }

    /// The command of a call with these arguments; none where one of them is not known.
    pub(crate) fn command(
        &self,
        call: &CallNode,
        args: impl Iterator<Item = Option<Value>>,
    ) -> Option<Command> {
        let primitive = self.graph.primitives.get(call.primitive.index())?;
        let mut named = Vec::with_capacity(primitive.params.len());
        for (param, arg) in primitive.params.iter().zip(args) {
            named.push((param.name.clone(), arg?));
        }
        Some(Command {
            primitive: primitive.name.clone(),
            args: named,
            uses: self.means.get(call.primitive.index())?.uses.clone(),
            manner: call.manner,
            deadline_secs: call.deadline_secs,
            motions: Vec::new(),
            leaves: None,
        })
    }

    /// The regions that a node owns, in document order.
    pub(crate) fn owned(&self, id: NodeId) -> &[RegionId] {
        let (first, end) = self.ranges.get(id.index()).copied().unwrap_or_default();
        self.owned.get(first as usize..end as usize).unwrap_or_default()
    }

    /// Prepared data of a node.
    #[inline]
    pub(crate) fn step(&self, id: NodeId) -> &PreparedNode {
        self.steps.get(id.index()).unwrap_or(&self.spare_step)
    }

    /// Returns whether a node stands in the block of a monitor's reaction.
    pub(crate) fn is_in_reaction(&self, id: NodeId) -> bool {
        let mut region = self.step(id).region;
        while let Some(owner) = self.region(region).owner {
            if let NodeKind::Monitor { body, .. } = &self.node(owner).kind
                && *body != region
            {
                return true;
            }
            region = self.step(owner).region;
        }
        false
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
            NodeKind::Let { .. }
            | NodeKind::Wait { .. }
            | NodeKind::Try { .. }
            | NodeKind::Repeat { .. }
            | NodeKind::Each { .. } => None,
            NodeKind::Delay { .. } | NodeKind::Finally { .. } => None,
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

    /// Node that stands for the goal of the policy: it is observed as a test is.
    pub(crate) fn goal(&self) -> NodeId {
        NodeId(self.graph.nodes.len() as u32)
    }

    /// Owner of a key.
    pub(crate) fn of_key(&self, key: u32) -> Dependent {
        let watches = self.watches.len() as u32;
        if key < watches { Dependent::Watch(key) } else { Dependent::Node(NodeId(key - watches)) }
    }

    /// Number of keys.
    pub(crate) fn keys(&self) -> usize {
        self.watches.len() + self.graph.nodes.len() + 1
    }
}

/// A part of the run that can set a timer or depend on a belief.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Dependent {
    /// A watch by its number.
    Watch(u32),
    Node(NodeId),
    /// A goal of a replaced policy.
    Orphan(GoalId),
}

impl PreparedNode {
    /// A step that is no call.
    fn of_kind(region: RegionId, next: Option<NodeId>) -> Self {
        Self {
            region,
            next,
            deadline: Time::ZERO,
            mask: ResourceMask::default(),
            command: None,
            is_call: false,
            is_composite: false,
            is_ready: false,
            is_silent: false,
        }
    }
}

/// The value of a term that is a literal.
fn literal(term: &Term) -> Option<Value> {
    if let Term::Literal(value) = term { Some(value.clone()) } else { None }
}

/// The compiler's motion, if all its arguments are literals.
fn literal_motion(motion: &Motion) -> Option<PlannedMotion> {
    let args = motion.args.iter().map(literal).collect::<Option<_>>()?;
    Some(PlannedMotion::compiled(motion, args))
}

fn means(graph: &Graph, primitive: &Primitive) -> PrimitiveResources {
    let uses = primitive.uses.iter().filter_map(|id| graph.resources.get(id.index()));
    PrimitiveResources {
        mask: mask(graph, primitive),
        uses: uses.map(|resource| resource.name.clone()).collect(),
    }
}

fn mask(graph: &Graph, primitive: &Primitive) -> ResourceMask {
    let bit = |index: usize| 1_u128.checked_shl(index as u32).unwrap_or(0);
    let mut mask = ResourceMask::default();
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

/// Rows by index.
#[derive(Clone, Debug)]
pub(crate) struct Table<T> {
    rows: Vec<T>,
    spare: T,
}

impl<T: Clone> Table<T> {
    /// So many equal rows.
    pub(crate) fn new(len: usize, row: T) -> Self {
        Self { rows: vec![row.clone(); len], spare: row }
    }
}

impl<T> Table<T> {
    #[inline]
    pub(crate) fn at(&self, index: usize) -> &T {
        self.rows.get(index).unwrap_or(&self.spare)
    }

    #[inline]
    pub(crate) fn at_mut(&mut self, index: usize) -> &mut T {
        self.rows.get_mut(index).unwrap_or(&mut self.spare)
    }
}
