//! Definite assignment: every name is bound on every path before it is used.
//!
//! A given name is bound everywhere. Any other is bound by a call or a loop, for what follows. Where paths
//! meet, a name is bound if every path that goes on has bound it: the walk in document order takes back what
//! one path binds before it walks the next, and compares them behind the last.

use super::{Findings, InvalidReason};
use crate::model::{
    BindingId, CallNode, Condition, Ending, Fact, FactArg, Graph, Node, NodeId, NodeKind, Reaction, RegionId,
    Term, TextPart,
};

/// Entry of the stack of regions and nodes that are still to be walked.
enum Todo {
    /// A node, then those after it.
    Node(NodeId),
    /// A region; with names that are bound in it, and the loop whose test follows it.
    Open { region: RegionId, names: [Option<BindingId>; 2], until: Option<NodeId> },
    /// The test of a loop.
    Until(NodeId),
    /// The end of a region that may not run, or whose names are its own: only so many names stay bound, and
    /// control goes on if it did before.
    Close { keep: usize, goes_on: bool },
    /// The end of a sub-policy: what its end, if control comes there, and each `done` have bound stays bound.
    Leave { keep: usize, of: NodeId },
    /// The end of a region with a cleanup, which sees only the first names and whether control came so far.
    Cleanup { region: RegionId, keep: usize, goes_on: bool },
    /// The end of a cleanup: names that the region before it bound, and whether control went on behind that.
    Cleaned { keep: usize, names: Vec<BindingId>, goes_on: bool },
    /// The first of the paths through a node.
    Fork,
    /// The end of one path.
    Path,
    /// The place where the paths through a node meet.
    Meet { how: Meeting, goes_on: bool },
}

/// Paths through a node that meet.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Meeting {
    /// One is taken.
    One,
    /// One is taken, or none.
    OneOrNone,
    /// All are taken at once.
    All,
}

/// A path through a node: the names that it binds, and false if control never reaches its end.
type Path = (Vec<BindingId>, bool);

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    let bound = graph.bindings.iter().map(|binding| binding.given).collect();
    let mut walk = Walk {
        graph,
        findings,
        bound,
        log: Vec::new(),
        goes_on: true,
        inlined: vec![Inlined::default(); graph.nodes.len()],
        forks: Vec::new(),
        counts: vec![0; graph.bindings.len()],
        todo: Vec::new(),
        terms: Vec::new(),
    };
    let goal = Node::goal();
    graph.goal.iter().for_each(|part| walk.condition(&goal, part));
    walk.todo.push(Todo::Open { region: crate::model::ROOT, names: [None; 2], until: None });
    while let Some(todo) = walk.todo.pop() {
        walk.step(todo);
    }
}

/// A sub-policy that is being walked, or was.
#[derive(Clone, Default)]
struct Inlined {
    /// Number of names bound before it.
    keep: usize,
    /// Names that each `done` so far has bound in it; `None` without one.
    done: Option<Vec<BindingId>>,
}

struct Walk<'a> {
    graph: &'a Graph,
    findings: &'a mut Findings,
    bound: Vec<bool>,
    /// Bindings in the order in which they were bound.
    log: Vec<BindingId>,
    /// False behind a node that never goes on.
    goes_on: bool,
    /// By node, of sub-policies.
    inlined: Vec<Inlined>,
    /// The open forks, each with the number of names bound before it and its paths so far.
    forks: Vec<(usize, Vec<Path>)>,
    /// By binding, the number of paths that bind it; zero between two forks.
    counts: Vec<usize>,
    todo: Vec<Todo>,
    /// Parts of a term that are still to be looked at; empty between two terms.
    terms: Vec<&'a Term>,
}

impl<'a> Walk<'a> {
    fn step(&mut self, todo: Todo) {
        match todo {
            Todo::Open { region, names, until } => {
                names.into_iter().flatten().for_each(|name| self.bind(name));
                self.todo.extend(until.map(Todo::Until));
                let entry = self.graph.regions.get(region.index()).and_then(|region| region.entry);
                self.todo.extend(entry.map(Todo::Node));
            }
            Todo::Close { keep, goes_on } => {
                self.take_back(keep);
                self.goes_on = goes_on;
            }
            Todo::Leave { keep, of } => self.leave(keep, of),
            Todo::Cleanup { region, keep, goes_on } => {
                let names = self.take_back(keep);
                let goes_on = std::mem::replace(&mut self.goes_on, goes_on);
                self.todo.push(Todo::Cleaned { keep, names, goes_on });
                self.todo.push(Todo::Open { region, names: [None; 2], until: None });
            }
            Todo::Cleaned { keep, names, goes_on } => {
                self.take_back(keep);
                names.into_iter().for_each(|name| self.bind(name));
                self.goes_on = goes_on;
            }
            Todo::Fork => {
                self.forks.push((self.log.len(), Vec::new()));
                self.goes_on = true;
            }
            Todo::Path => {
                let Some((keep, mut paths)) = self.forks.pop() else { return };
                paths.push((self.take_back(keep), std::mem::replace(&mut self.goes_on, true)));
                self.forks.push((keep, paths));
            }
            Todo::Meet { how, goes_on } => self.meet(how, goes_on),
            Todo::Until(id) => {
                if let Some(node) = self.graph.nodes.get(id.index())
                    && let NodeKind::Repeat { until: Some(until), .. } = &node.kind
                {
                    self.condition(node, until);
                }
            }
            Todo::Node(id) => {
                if let Some(node) = self.graph.nodes.get(id.index()) {
                    // A result is bound for what follows, not for what lies in the node: a call owns no
                    // region.
                    self.todo.extend(node.next.map(Todo::Node));
                    self.node(id, node);
                }
            }
        }
    }

    /// Leads behind a sub-policy.
    fn leave(&mut self, keep: usize, of: NodeId) {
        let mut names = self.take_back(keep);
        if let Some(done) = self.inlined.get_mut(of.index()).and_then(|inlined| inlined.done.take()) {
            for name in names.iter().filter(|_| self.goes_on) {
                if let Some(count) = self.counts.get_mut(name.index()) {
                    *count = 1;
                }
            }
            let is_bound = |name: &BindingId| !self.goes_on || self.counts.get(name.index()) == Some(&1);
            let done: Vec<BindingId> = done.into_iter().filter(is_bound).collect();
            for name in names {
                if let Some(count) = self.counts.get_mut(name.index()) {
                    *count = 0;
                }
            }
            (names, self.goes_on) = (done, true);
        }
        names.into_iter().for_each(|name| self.bind(name));
    }

    /// Takes back what was bound since so many names were.
    fn take_back(&mut self, keep: usize) -> Vec<BindingId> {
        let names = self.log.split_off(keep.min(self.log.len()));
        for name in &names {
            if let Some(bound) = self.bound.get_mut(name.index()) {
                *bound = false;
            }
        }
        names
    }

    /// Binds what is bound behind the paths of the innermost fork.
    fn meet(&mut self, how: Meeting, goes_on: bool) {
        let Some((_, mut paths)) = self.forks.pop() else { return };
        if how == Meeting::OneOrNone {
            paths.push((Vec::new(), true));
        }
        let live = paths.iter().filter(|(_, goes_on)| *goes_on).count();
        // Nothing runs behind paths that never go on, nor behind branches of which one does not.
        let wanted = match how {
            Meeting::One | Meeting::OneOrNone if live == 0 => None,
            Meeting::One | Meeting::OneOrNone => Some(live),
            // Of a name that two branches bind at once the value is not known.
            Meeting::All => Some(1),
        };
        self.goes_on = goes_on && if how == Meeting::All { live == paths.len() } else { live > 0 };
        let counted = |(_, goes_on): &&Path| how == Meeting::All || *goes_on;
        for name in paths.iter().filter(counted).flat_map(|(names, _)| names) {
            if let Some(count) = self.counts.get_mut(name.index()) {
                *count += 1;
            }
        }
        for name in paths.iter().flat_map(|(names, _)| names) {
            if wanted.is_none_or(|wanted| self.counts.get(name.index()) == Some(&wanted)) {
                self.bind(*name);
            }
        }
        for name in paths.iter().flat_map(|(names, _)| names) {
            if let Some(count) = self.counts.get_mut(name.index()) {
                *count = 0;
            }
        }
    }

    fn bind(&mut self, binding: BindingId) {
        if let Some(bound) = self.bound.get_mut(binding.index())
            && !*bound
        {
            *bound = true;
            self.log.push(binding);
        }
    }

    fn node(&mut self, id: NodeId, node: &'a Node) {
        let (keep, goes_on) = (self.log.len(), self.goes_on);
        let open = |region: &RegionId| Todo::Open { region: *region, names: [None; 2], until: None };
        let aside = |region: &RegionId| [Todo::Close { keep, goes_on }, open(region)];
        match &node.kind {
            NodeKind::Call(call) => self.call(node, call),
            NodeKind::Let { binding, value } => {
                self.term(node, value);
                self.bind(*binding);
            }
            NodeKind::If { condition, then, otherwise } => {
                self.condition(node, condition);
                let how = if otherwise.is_some() { Meeting::One } else { Meeting::OneOrNone };
                let regions = std::iter::once(*then).chain(*otherwise);
                self.fork(how, regions.map(|region| (region, [None; 2])).collect());
            }
            NodeKind::Try { body, handlers } => {
                let handlers = handlers.iter().map(|handler| {
                    let binds = handler.binds;
                    (handler.body, [binds.map(|caught| caught.kind), binds.map(|caught| caught.text)])
                });
                self.fork(Meeting::One, std::iter::once((*body, [None; 2])).chain(handlers).collect());
            }
            NodeKind::Parallel { branches } => {
                self.fork(Meeting::All, branches.iter().map(|region| (*region, [None; 2])).collect());
            }
            NodeKind::Wait { condition, .. } => self.condition(node, condition),
            NodeKind::Delay { .. } => {}
            NodeKind::Finally { body, cleanup } => {
                self.todo.extend([Todo::Cleanup { region: *cleanup, keep, goes_on }, open(body)]);
            }
            NodeKind::Monitor { watches, body } => {
                self.todo.push(open(body));
                for watch in watches {
                    self.condition(node, &watch.condition);
                    match &watch.reaction {
                        Reaction::End { how, of, why } => {
                            why.iter().for_each(|why| self.term(node, why));
                            self.end(*how, *of);
                        }
                        // It may run at any moment of the body, or never.
                        Reaction::Resume { body, .. } => self.todo.extend(aside(body)),
                        Reaction::Pause { .. } | Reaction::Restart { .. } => {}
                    }
                }
            }
            NodeKind::Sequence { body, .. } => self.todo.push(open(body)),
            NodeKind::Repeat { body, until, .. } => {
                let until = until.is_some().then_some(id);
                self.todo.push(Todo::Open { region: *body, names: [None; 2], until });
            }
            NodeKind::Each { item, list, body, .. } => {
                self.term(node, list);
                let names = [Some(*item), None];
                self.todo.push(Todo::Close { keep, goes_on });
                self.todo.push(Todo::Open { region: *body, names, until: None });
            }
            NodeKind::Inline { body, .. } => {
                if let Some(inlined) = self.inlined.get_mut(id.index()) {
                    inlined.keep = keep;
                }
                self.todo.extend([Todo::Leave { keep, of: id }, open(body)]);
            }
            NodeKind::End { how, of, why } => {
                why.iter().for_each(|why| self.term(node, why));
                self.end(*how, *of);
                self.goes_on = false;
            }
        }
    }

    /// Walks the regions one by one, each as a path of its own.
    fn fork(&mut self, how: Meeting, regions: Vec<(RegionId, [Option<BindingId>; 2])>) {
        self.todo.push(Todo::Meet { how, goes_on: self.goes_on });
        for (region, names) in regions.into_iter().rev() {
            self.todo.extend([Todo::Path, Todo::Open { region, names, until: None }]);
        }
        self.todo.push(Todo::Fork);
    }

    /// Notes that an ending leads behind a sub-policy.
    fn end(&mut self, how: Ending, of: Option<NodeId>) {
        let inlined = of.and_then(|of| self.inlined.get_mut(of.index()));
        let Some(inlined) = inlined.filter(|_| how == Ending::Done && self.goes_on) else { return };
        match &mut inlined.done {
            Some(names) => names.retain(|name| self.bound.get(name.index()) == Some(&true)),
            None => inlined.done = Some(self.log.get(inlined.keep..).unwrap_or_default().to_vec()),
        }
    }

    fn call(&mut self, node: &'a Node, call: &'a CallNode) {
        call.args.iter().for_each(|arg| self.term(node, arg));
        for need in &call.needs {
            need.when.iter().for_each(|when| self.condition(node, when));
            self.condition(node, &need.condition);
        }
        let motion = call.motion.iter().flat_map(|motion| &motion.args);
        // A motion may speak of the result: it is asked for only where that is known.
        let known = |term: &&Term| !matches!(term, Term::Binding(id) if Some(*id) == call.binds);
        motion.filter(known).for_each(|arg| self.term(node, arg));
        for unsettled in &call.unsettles {
            // So may what it unsettles: before the step nothing is known of the result.
            let result = unsettled
                .fact
                .args
                .iter()
                .any(|arg| matches!(arg, FactArg::Term(Term::Binding(id)) if Some(*id) == call.binds));
            if !result {
                unsettled.when.iter().for_each(|when| self.condition(node, when));
                self.fact(node, &unsettled.fact);
            }
        }
        call.binds.into_iter().for_each(|binding| self.bind(binding));
        for effect in &call.effects {
            effect.when.iter().for_each(|when| self.condition(node, when));
            self.fact(node, &effect.fact);
        }
        let entities = call.lasts.iter().flat_map(|lifetime| &lifetime.entities);
        entities.for_each(|entity| self.term(node, entity));
    }

    fn fact(&mut self, node: &Node, fact: &'a Fact) {
        for arg in &fact.args {
            if let FactArg::Term(term) = arg {
                self.term(node, term);
            }
        }
    }

    fn condition(&mut self, node: &Node, condition: &'a Condition) {
        // A stack of its own: how deep it goes is checked elsewhere.
        let mut open = vec![condition];
        while let Some(condition) = open.pop() {
            match condition {
                Condition::Literal(_) => {}
                Condition::Fact(fact) => self.fact(node, fact),
                Condition::Compare(_, left, right) => {
                    self.term(node, left);
                    self.term(node, right);
                }
                Condition::Not(inner) => open.push(inner),
                Condition::All(parts) | Condition::AnyOf(parts) => open.extend(parts),
            }
        }
    }

    fn term(&mut self, node: &Node, term: &'a Term) {
        self.terms.push(term);
        while let Some(term) = self.terms.pop() {
            match term {
                Term::Literal(_) | Term::Each => {}
                Term::Binding(id) => {
                    if self.bound.get(id.index()) == Some(&false) {
                        let name = self.graph.bindings.get(id.index()).map(|binding| binding.name.clone());
                        self.findings.node(node, InvalidReason::Unbound(name.unwrap_or_default()));
                    }
                }
                Term::Field(of, _) | Term::Count(of) | Term::First(of) => self.terms.push(of),
                Term::Template(parts) => {
                    self.terms.extend(parts.iter().filter_map(|part| match part {
                        TextPart::Value(value, _) => Some(value),
                        TextPart::Literal(_) => None,
                    }));
                }
                Term::Measure(_, args) | Term::List(args) => self.terms.extend(args),
                Term::Arith(_, left, right) => self.terms.extend([&**left, &**right]),
            }
        }
    }
}
