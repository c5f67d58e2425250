//! Lays sketched steps out as a graph.

use super::vocabulary::{self as v, DETECT, SAY};
use super::{CallSketch, ReactionSketch, StepSketch, WatchSketch};
use motet_graph::{
    Binding, BindingId, CallNode, Condition, DurationBounds, Ending, Fact, FactArg, Graph, Handler, Node,
    NodeId, NodeKind, ROOT, Reaction, Region, RegionId, ResourceId, Term, TextPart, Type, Watch,
};
use smol_str::SmolStr;

/// The graph of a policy with these steps. Always valid: a call in a branch that would need what an earlier
/// branch needs becomes a `say`.
#[must_use]
pub fn graph(steps: &[StepSketch]) -> Graph {
    let mut layout = Layout {
        graph: v::declarations(),
        objects: Vec::new(),
        share: None,
        taken: Vec::new(),
        inline: None,
        is_cleanup: false,
    };
    layout.graph.regions.push(Region { owner: None, entry: None });
    layout.fill(ROOT, steps, "/steps");
    layout.graph
}

struct Layout {
    graph: Graph,
    /// Objects that are bound here, the latest last.
    objects: Vec<BindingId>,
    /// Binding that the first `detect` of the next region binds, as those of the other paths do.
    share: Option<BindingId>,
    /// Resources that branches at the same time need.
    taken: Vec<ResourceId>,
    /// The sub-policy around here; inside a cleanup only one that is also inside it.
    inline: Option<NodeId>,
    is_cleanup: bool,
}

impl Layout {
    fn region(&mut self, owner: NodeId, steps: &[StepSketch], path: &str) -> RegionId {
        let id = RegionId(self.graph.regions.len() as u32);
        self.graph.regions.push(Region { owner: Some(owner), entry: None });
        self.fill(id, steps, path);
        id
    }

    /// A region behind which its objects are not bound.
    fn closed_region(&mut self, owner: NodeId, steps: &[StepSketch], path: &str) -> RegionId {
        let bound = self.objects.len();
        let region = self.region(owner, steps, path);
        self.objects.truncate(bound);
        region
    }

    /// Regions of which one is taken. If each has a `detect`, the first of each binds one object.
    fn paths(&mut self, owner: NodeId, paths: &[(&[StepSketch], String)]) -> Vec<RegionId> {
        let detects = |step: &StepSketch| matches!(step, StepSketch::Call(call) if call.primitive == DETECT);
        let shares = paths.len() > 1 && paths.iter().all(|(steps, _)| steps.iter().any(detects));
        let shared = shares.then(|| self.binding("it", Type::Entity(v::OBJECT)));
        let first = self.graph.nodes.len();
        let mut regions = Vec::with_capacity(paths.len());
        for (steps, path) in paths {
            self.share = shared;
            regions.push(self.closed_region(owner, steps, path));
            self.share = None;
        }
        // In a branch whose resources are taken a `detect` becomes a `say`.
        let calls = self.graph.nodes.iter().skip(first).filter_map(|node| match &node.kind {
            NodeKind::Call(call) => call.binds,
            _ => None,
        });
        let count = calls.filter(|binds| Some(*binds) == shared).count();
        self.objects.extend(shared.filter(|_| count == paths.len()));
        regions
    }

    fn fill(&mut self, region: RegionId, steps: &[StepSketch], path: &str) {
        let mut share = self.share.take();
        let mut before: Option<NodeId> = None;
        for (index, step) in steps.iter().enumerate() {
            let id = NodeId(self.graph.nodes.len() as u32);
            let path = format!("{path}/{index}");
            let kind = NodeKind::Parallel { branches: Vec::new() };
            let duration = DurationBounds { least_secs: 0.0, greatest_secs: 10.0 };
            self.graph.nodes.push(Node { path: SmolStr::new(&path), region, next: None, duration, kind });
            if matches!(step, StepSketch::Call(call) if call.primitive == DETECT) {
                self.share = share.take();
            }
            let kind = self.kind(id, step, &path);
            self.share = None;
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
    }

    fn kind(&mut self, id: NodeId, step: &StepSketch, path: &str) -> NodeKind {
        match step {
            StepSketch::Call(call) => NodeKind::Call(self.call(call)),
            StepSketch::Let(value) => {
                let value = self.term(value);
                let binding = self.binding("object", Type::Entity(v::OBJECT));
                self.objects.push(binding);
                NodeKind::Let { binding, value }
            }
            StepSketch::Sequence(steps) => {
                NodeKind::Sequence { name: SmolStr::new_static("group"), body: self.region(id, steps, path) }
            }
            StepSketch::Inline(steps) => {
                let outer = self.inline.replace(id);
                let body = self.closed_region(id, steps, &format!("{path}:/steps"));
                self.inline = outer;
                NodeKind::Inline { policy: SmolStr::new_static("part"), body }
            }
            StepSketch::If(condition, then, otherwise) => {
                let condition = self.condition(condition);
                let mut paths = vec![(then.as_slice(), format!("{path}/then"))];
                paths.extend(otherwise.iter().map(|steps| (steps.as_slice(), format!("{path}/else"))));
                let regions = self.paths(id, &paths);
                let region = |index: usize| regions.get(index).copied();
                NodeKind::If { condition, then: region(0).unwrap_or(ROOT), otherwise: region(1) }
            }
            StepSketch::Wait(condition, within_secs) => {
                NodeKind::Wait { condition: self.condition(condition), within_secs: *within_secs }
            }
            StepSketch::Delay(secs) => NodeKind::Delay { secs: *secs },
            StepSketch::Finally(body, cleanup) => {
                let bound = self.objects.len();
                let body = self.region(id, body, path);
                // What the body binds, the cleanup does not see.
                let of_body = self.objects.split_off(bound);
                let outer = (self.inline.take(), std::mem::replace(&mut self.is_cleanup, true));
                let cleanup = self.closed_region(id, cleanup, &format!("{path}/finally"));
                (self.inline, self.is_cleanup) = outer;
                self.objects.extend(of_body);
                NodeKind::Finally { body, cleanup }
            }
            StepSketch::Monitor(whens, steps) => self.monitor(id, whens, steps, path),
            StepSketch::Try(body, handlers) => {
                let mut paths = vec![(body.as_slice(), format!("{path}/try"))];
                let numbered = handlers.iter().enumerate();
                paths
                    .extend(numbered.map(|(index, (_, steps))| {
                        (steps.as_slice(), format!("{path}/catch/{index}/steps"))
                    }));
                let mut regions = self.paths(id, &paths).into_iter();
                let body = regions.next().unwrap_or(ROOT);
                let handlers = handlers.iter().zip(regions);
                let handlers = handlers.map(|((on, _), body)| Handler { on: on.clone(), binds: None, body });
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
                let body = self.closed_region(id, steps, &format!("{path}/steps"));
                self.objects.pop();
                NodeKind::Each { item, list, at_most: *at_most, body }
            }
            StepSketch::Parallel(branches) => self.parallel(id, branches, path),
            StepSketch::End(how) => match self.ending(*how) {
                Some(of) => NodeKind::End { how: *how, of, why: None },
                None => {
                    let body = self.region(id, &[], path);
                    NodeKind::Sequence { name: SmolStr::new_static("nothing"), body }
                }
            },
        }
    }

    /// The sub-policy that an ending ends, or none for the whole policy; `None` where it would leave a
    /// cleanup.
    fn ending(&self, how: Ending) -> Option<Option<NodeId>> {
        let of = self.inline.filter(|_| matches!(how, Ending::Done | Ending::Fail));
        (of.is_some() || !self.is_cleanup).then_some(of)
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
            let shared = self.share.take().filter(|_| object);
            let binding = shared.unwrap_or_else(|| self.binding("it", ty));
            if object {
                self.objects.push(binding);
            }
            binding
        });
        CallNode {
            primitive,
            args,
            binds,
            manner: call.manner,
            deadline_secs: call.deadline_secs,
            retries: call.retries,
            needs: contract.needs,
            motion: None,
            effects: contract.effects,
            unsettles: contract.unsettles,
            lasts: None,
        }
    }

    fn monitor(&mut self, id: NodeId, whens: &[WatchSketch], steps: &[StepSketch], path: &str) -> NodeKind {
        let conditions: Vec<Condition> = whens.iter().map(|when| self.condition(&when.condition)).collect();
        // Regions in the order in which a monitor names them: the body, then the blocks.
        let bound = self.objects.len();
        let body = self.region(id, steps, &format!("{path}/during"));
        // The reactions do not see what the body binds.
        let of_body = self.objects.split_off(bound);
        let watches = whens.iter().zip(conditions).enumerate().map(|(index, (when, condition))| {
            let reaction = match &when.react {
                ReactionSketch::Pause(within_secs) => Reaction::Pause { within_secs: *within_secs },
                ReactionSketch::Restart(at_most) => Reaction::Restart { at_most: *at_most },
                ReactionSketch::Resume(at_most, steps) => {
                    let path = format!("{path}/monitor/{index}/then/steps");
                    Reaction::Resume { at_most: *at_most, body: self.closed_region(id, steps, &path) }
                }
                ReactionSketch::End(how) => match self.ending(*how) {
                    Some(of) => Reaction::End { how: *how, of, why: None },
                    None => Reaction::Restart { at_most: 1 },
                },
            };
            Watch { condition, hold_secs: when.hold_secs, reaction }
        });
        let watches = watches.collect();
        self.objects.extend(of_body);
        NodeKind::Monitor { watches, body }
    }

    fn parallel(&mut self, id: NodeId, branches: &[Vec<StepSketch>], path: &str) -> NodeKind {
        let (outer, bound) = (self.taken.len(), self.objects.len());
        let (mut regions, mut of_branches) = (Vec::new(), Vec::new());
        for (index, steps) in branches.iter().enumerate() {
            let first = self.graph.nodes.len();
            regions.push(self.region(id, steps, &format!("{path}/parallel/{index}")));
            of_branches.extend(self.objects.split_off(bound));
            let used = self.graph.nodes.iter().skip(first).filter_map(|node| match &node.kind {
                NodeKind::Call(call) => self.graph.primitives.get(call.primitive.index()),
                NodeKind::Let { .. }
                | NodeKind::Sequence { .. }
                | NodeKind::Inline { .. }
                | NodeKind::If { .. } => None,
                NodeKind::Wait { .. } | NodeKind::Monitor { .. } | NodeKind::Try { .. } => None,
                NodeKind::Repeat { .. } | NodeKind::Each { .. } | NodeKind::Parallel { .. } => None,
                NodeKind::Delay { .. } | NodeKind::Finally { .. } | NodeKind::End { .. } => None,
            });
            let used: Vec<ResourceId> = used.flat_map(|primitive| primitive.uses.clone()).collect();
            self.taken.extend(used);
        }
        self.taken.truncate(outer);
        self.objects.extend(of_branches);
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
            among: Vec::new(),
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
            Term::Count(list) => Term::Count(Box::new(self.term(list))),
            Term::First(list) => Term::First(Box::new(self.term(list))),
            Term::Template(parts) => {
                let part = |part: &TextPart| match part {
                    TextPart::Literal(text) => TextPart::Literal(text.clone()),
                    TextPart::Value(value, ty) => TextPart::Value(self.term(value), ty.clone()),
                };
                Term::Template(parts.iter().map(part).collect())
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
