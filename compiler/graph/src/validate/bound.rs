//! Definite assignment: every name is bound on every path before it is used.
//!
//! A given name is bound everywhere. Any other is bound by a call or a loop and holds to the end of the
//! region that binds it, so a walk in document order that forgets at the end of each region what was bound in
//! it knows at each node what is bound.

use super::{Findings, InvalidReason};
use crate::model::{
    BindingId, CallNode, Condition, Fact, FactArg, Graph, Node, NodeId, NodeKind, Reaction, RegionId, Term,
};

/// Entry of the stack of regions and nodes that are still to be walked.
enum Todo {
    /// A node, then those after it.
    Node(NodeId),
    /// A region; with the loop's item, and the loop whose test follows it.
    Open { region: RegionId, item: Option<BindingId>, until: Option<NodeId> },
    /// The test of a loop.
    Until(NodeId),
    /// The end of a region: only so many names stay bound.
    Close(usize),
}

pub(super) fn check(graph: &Graph, findings: &mut Findings) {
    let bound = graph.bindings.iter().map(|binding| binding.given).collect();
    let mut walk = Walk { graph, findings, bound, log: Vec::new(), todo: Vec::new(), terms: Vec::new() };
    walk.todo.push(Todo::Open { region: crate::model::ROOT, item: None, until: None });
    while let Some(todo) = walk.todo.pop() {
        walk.step(todo);
    }
}

struct Walk<'a> {
    graph: &'a Graph,
    findings: &'a mut Findings,
    bound: Vec<bool>,
    /// Bindings in the order in which they were bound.
    log: Vec<BindingId>,
    todo: Vec<Todo>,
    /// Parts of a term that are still to be looked at; empty between two terms.
    terms: Vec<&'a Term>,
}

impl<'a> Walk<'a> {
    fn step(&mut self, todo: Todo) {
        match todo {
            Todo::Open { region, item, until } => {
                self.todo.push(Todo::Close(self.log.len()));
                item.into_iter().for_each(|item| self.bind(item));
                self.todo.extend(until.map(Todo::Until));
                let entry = self.graph.regions.get(region.index()).and_then(|region| region.entry);
                self.todo.extend(entry.map(Todo::Node));
            }
            Todo::Close(keep) => {
                for binding in self.log.drain(keep.min(self.log.len())..) {
                    if let Some(bound) = self.bound.get_mut(binding.index()) {
                        *bound = false;
                    }
                }
            }
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

    fn bind(&mut self, binding: BindingId) {
        if let Some(bound) = self.bound.get_mut(binding.index())
            && !*bound
        {
            *bound = true;
            self.log.push(binding);
        }
    }

    fn node(&mut self, id: NodeId, node: &'a Node) {
        match &node.kind {
            NodeKind::Call(call) => self.call(node, call),
            NodeKind::If { condition, .. } | NodeKind::Wait { condition, .. } => {
                self.condition(node, condition)
            }
            NodeKind::Monitor { watches, .. } => {
                for watch in watches {
                    self.condition(node, &watch.condition);
                    if let Reaction::End { why: Some(why), .. } = &watch.reaction {
                        self.term(node, why);
                    }
                }
            }
            NodeKind::Each { list, .. } => self.term(node, list),
            NodeKind::End { why: Some(why), .. } => self.term(node, why),
            NodeKind::End { why: None, .. } | NodeKind::Repeat { .. } | NodeKind::Sequence { .. } => {}
            NodeKind::Inline { .. } | NodeKind::Try { .. } | NodeKind::Parallel { .. } => {}
        }
        let (item, until) = match &node.kind {
            NodeKind::Each { item, .. } => (Some(*item), None),
            NodeKind::Repeat { until: Some(_), .. } => (None, Some(id)),
            NodeKind::Repeat { until: None, .. } | NodeKind::Call(_) | NodeKind::Sequence { .. } => {
                (None, None)
            }
            NodeKind::Inline { .. } | NodeKind::If { .. } | NodeKind::Wait { .. } => (None, None),
            NodeKind::Monitor { .. } | NodeKind::Try { .. } | NodeKind::Parallel { .. } => (None, None),
            NodeKind::End { .. } => (None, None),
        };
        let regions = super::structure::owned(node).into_iter().rev();
        self.todo.extend(regions.map(|region| Todo::Open { region, item, until }));
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
    }

    fn fact(&mut self, node: &'a Node, fact: &'a Fact) {
        for arg in &fact.args {
            if let FactArg::Term(term) = arg {
                self.term(node, term);
            }
        }
    }

    fn condition(&mut self, node: &'a Node, condition: &'a Condition) {
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

    fn term(&mut self, node: &'a Node, term: &'a Term) {
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
                Term::Field(of, _) => self.terms.push(of),
                Term::Measure(_, args) | Term::List(args) => self.terms.extend(args),
                Term::Arith(_, left, right) => self.terms.extend([&**left, &**right]),
            }
        }
    }
}
