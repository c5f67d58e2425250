//! Lays sketched steps out as a graph.

use super::vocabulary::{self as v, SAY};
use super::{CallSketch, ReactionSketch, StepSketch, WatchSketch};
use crate::model::{
    Binding, BindingId, CallNode, Condition, DurationBounds, Ending, Fact, FactArg, Graph, Handler, Node,
    NodeId, NodeKind, ROOT, Reaction, Region, RegionId, ResourceId, Term, Type, Watch,
};
use smol_str::SmolStr;

/// The graph of a policy with these steps. Always valid: a call in a branch that would need what an earlier
/// branch needs becomes a `say`.
#[must_use]
pub fn graph(steps: &[StepSketch]) -> Graph {
    let mut layout =
        Layout { graph: v::declarations(), objects: Vec::new(), taken: Vec::new(), inline: None };
    layout.graph.regions.push(Region { owner: None, entry: None });
    layout.fill(ROOT, steps, "/steps");
    layout.graph
}

struct Layout {
    graph: Graph,
    /// Objects that are bound here, the latest last.
    objects: Vec<BindingId>,
    /// Resources that branches at the same time need.
    taken: Vec<ResourceId>,
    /// The sub-policy around here.
    inline: Option<NodeId>,
}

impl Layout {
    fn region(&mut self, owner: NodeId, steps: &[StepSketch], path: &str) -> RegionId {
        let id = RegionId(self.graph.regions.len() as u32);
        self.graph.regions.push(Region { owner: Some(owner), entry: None });
        self.fill(id, steps, path);
        id
    }

    fn fill(&mut self, region: RegionId, steps: &[StepSketch], path: &str) {
        let bound = self.objects.len();
        let mut before: Option<NodeId> = None;
        for (index, step) in steps.iter().enumerate() {
            let id = NodeId(self.graph.nodes.len() as u32);
            let path = format!("{path}/{index}");
            let kind = NodeKind::Parallel { branches: Vec::new() };
            let duration = DurationBounds { least_secs: 0.0, greatest_secs: 10.0 };
            self.graph.nodes.push(Node { path: SmolStr::new(&path), region, next: None, duration, kind });
            let kind = self.kind(id, step, &path);
            if let Some(node) = self.graph.nodes.get_mut(id.index()) {
                node.kind = kind;
            }
            match before.and_then(|before| self.graph.nodes.get_mut(before.index())) {
                Some(before) => before.next = Some(id),
                None => {
                    if let Some(region) = self.graph.regions.get_mut(region.index()) {
                        region.entry = Some(id);
                    }
                }
            }
            before = Some(id);
        }
        self.objects.truncate(bound);
    }

    fn kind(&mut self, id: NodeId, step: &StepSketch, path: &str) -> NodeKind {
        match step {
            StepSketch::Call(call) => NodeKind::Call(self.call(call)),
            StepSketch::Sequence(steps) => {
                NodeKind::Sequence { name: SmolStr::new_static("group"), body: self.region(id, steps, path) }
            }
            StepSketch::Inline(steps) => {
                let outer = self.inline.replace(id);
                let body = self.region(id, steps, &format!("{path}:/steps"));
                self.inline = outer;
                NodeKind::Inline { policy: SmolStr::new_static("part"), body }
            }
            StepSketch::If(condition, then, otherwise) => NodeKind::If {
                condition: self.condition(condition),
                then: self.region(id, then, &format!("{path}/then")),
                otherwise: otherwise.as_ref().map(|steps| self.region(id, steps, &format!("{path}/else"))),
            },
            StepSketch::Wait(condition, within_secs) => {
                NodeKind::Wait { condition: self.condition(condition), within_secs: *within_secs }
            }
            StepSketch::Monitor(whens, steps) => self.monitor(id, whens, steps, path),
            StepSketch::Try(body, handlers) => {
                let body = self.region(id, body, &format!("{path}/try"));
                let handlers = handlers.iter().enumerate().map(|(index, (on, steps))| Handler {
                    on: on.clone(),
                    body: self.region(id, steps, &format!("{path}/catch/{index}/steps")),
                });
                NodeKind::Try { body, handlers: handlers.collect() }
            }
            StepSketch::Repeat(times, steps, until) => {
                let body = self.region(id, steps, &format!("{path}/steps"));
                NodeKind::Repeat {
                    times: *times,
                    body,
                    until: until.as_ref().map(|until| self.condition(until)),
                }
            }
            StepSketch::Each(list, at_most, steps) => {
                let list = self.term(list);
                let item = self.binding("item", Type::Entity(v::OBJECT));
                self.objects.push(item);
                let body = self.region(id, steps, &format!("{path}/steps"));
                self.objects.pop();
                NodeKind::Each { item, list, at_most: *at_most, body }
            }
            StepSketch::Parallel(branches) => self.parallel(id, branches, path),
            StepSketch::End(how) => {
                NodeKind::End { how: *how, of: self.inline.filter(|_| *how != Ending::Replan), why: None }
            }
        }
    }

    fn call(&mut self, call: &CallSketch) -> CallNode {
        let declared = self.graph.primitives.get(call.primitive.index());
        let clashes = |id: &ResourceId| self.taken.iter().any(|taken| self.conflict(*taken, *id));
        let free = declared.is_some_and(|primitive| !primitive.uses.iter().any(clashes));
        let (primitive, args) =
            if free { (call.primitive, call.args.clone()) } else { (SAY, vec![v::text("busy")]) };
        let args: Vec<Term> = args.iter().map(|arg| self.term(arg)).collect();
        let contract = v::contract(primitive, &args, call.verdict);
        let result =
            self.graph.primitives.get(primitive.index()).and_then(|primitive| primitive.result.clone());
        let binds = result.map(|ty| {
            let object = matches!(ty, Type::Entity(_));
            let binding = self.binding("it", ty);
            if object {
                self.objects.push(binding);
            }
            binding
        });
        CallNode {
            primitive,
            args,
            binds,
            deadline_secs: call.deadline_secs,
            retries: call.retries,
            needs: contract.needs,
            motion: None,
            effects: contract.effects,
            unsettles: contract.unsettles,
        }
    }

    fn monitor(&mut self, id: NodeId, whens: &[WatchSketch], steps: &[StepSketch], path: &str) -> NodeKind {
        let conditions: Vec<Condition> = whens.iter().map(|when| self.condition(&when.condition)).collect();
        // Regions in the order in which a monitor names them: the body, then the blocks.
        let body = self.region(id, steps, &format!("{path}/during"));
        let watches = whens.iter().zip(conditions).enumerate().map(|(index, (when, condition))| {
            let reaction = match &when.react {
                ReactionSketch::Pause(within_secs) => Reaction::Pause { within_secs: *within_secs },
                ReactionSketch::Restart(at_most) => Reaction::Restart { at_most: *at_most },
                ReactionSketch::Resume(at_most, steps) => {
                    let path = format!("{path}/monitor/{index}/then/steps");
                    Reaction::Resume { at_most: *at_most, body: self.region(id, steps, &path) }
                }
                ReactionSketch::End(how) => {
                    Reaction::End { how: *how, of: self.inline.filter(|_| *how != Ending::Replan), why: None }
                }
            };
            Watch { condition, hold_secs: when.hold_secs, reaction }
        });
        NodeKind::Monitor { watches: watches.collect(), body }
    }

    fn parallel(&mut self, id: NodeId, branches: &[Vec<StepSketch>], path: &str) -> NodeKind {
        let outer = self.taken.len();
        let mut regions = Vec::new();
        for (index, steps) in branches.iter().enumerate() {
            let first = self.graph.nodes.len();
            regions.push(self.region(id, steps, &format!("{path}/parallel/{index}")));
            let used = self.graph.nodes.iter().skip(first).filter_map(|node| match &node.kind {
                NodeKind::Call(call) => self.graph.primitives.get(call.primitive.index()),
                NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => None,
                NodeKind::Wait { .. } | NodeKind::Monitor { .. } | NodeKind::Try { .. } => None,
                NodeKind::Repeat { .. } | NodeKind::Each { .. } | NodeKind::Parallel { .. } => None,
                NodeKind::End { .. } => None,
            });
            let used: Vec<ResourceId> = used.flat_map(|primitive| primitive.uses.clone()).collect();
            self.taken.extend(used);
        }
        self.taken.truncate(outer);
        NodeKind::Parallel { branches: regions }
    }

    fn conflict(&self, a: ResourceId, b: ResourceId) -> bool {
        let contains = |outer: ResourceId, inner: ResourceId| {
            self.graph.resources.get(outer.index()).is_some_and(|resource| resource.contains.contains(&inner))
        };
        a == b || contains(a, b) || contains(b, a)
    }

    fn binding(&mut self, name: &str, ty: Type) -> BindingId {
        let id = BindingId(self.graph.bindings.len() as u32);
        self.graph.bindings.push(Binding {
            name: SmolStr::from(format!("{name}'{}", id.0)),
            ty,
            given: false,
        });
        id
    }

    fn term(&self, term: &Term) -> Term {
        match term {
            term if *term == CallSketch::NEAREST => {
                self.objects.last().map_or_else(|| v::entity("mug"), |binding| Term::Binding(*binding))
            }
            Term::Literal(_) | Term::Binding(_) | Term::Each => term.clone(),
            Term::Field(of, field) => Term::Field(Box::new(self.term(of)), field.clone()),
            Term::Measure(id, args) => Term::Measure(*id, args.iter().map(|arg| self.term(arg)).collect()),
            Term::List(items) => Term::List(items.iter().map(|item| self.term(item)).collect()),
            Term::Arith(operation, left, right) => {
                Term::Arith(*operation, Box::new(self.term(left)), Box::new(self.term(right)))
            }
        }
    }

    fn condition(&self, condition: &Condition) -> Condition {
        let all = |parts: &[Condition]| parts.iter().map(|part| self.condition(part)).collect();
        match condition {
            Condition::Literal(value) => Condition::Literal(*value),
            Condition::Fact(Fact { fluent, args }) => {
                let args = args.iter().map(|arg| match arg {
                    FactArg::Term(term) => FactArg::Term(self.term(term)),
                    FactArg::Any => FactArg::Any,
                });
                Condition::Fact(Fact { fluent: *fluent, args: args.collect() })
            }
            Condition::Compare(comparison, left, right) => {
                Condition::Compare(*comparison, self.term(left), self.term(right))
            }
            Condition::Not(inner) => Condition::Not(Box::new(self.condition(inner))),
            Condition::All(parts) => Condition::All(all(parts)),
            Condition::AnyOf(parts) => Condition::AnyOf(all(parts)),
        }
    }
}
