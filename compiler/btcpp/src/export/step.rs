//! Steps as nodes.

use motet_graph::draw::Names;
use motet_graph::{
    BindingId, CallNode, Comparison, Condition, Ending, Handler, Node, NodeId, NodeKind, Primitive, Reaction,
    RegionId, Term, Type, Value, Verdict, Watch,
};

use super::model::{Leaf, Port};
use super::place::{Around, Place, left};
use super::value::milliseconds;
use super::{Writer, set};
use crate::import::NODE_FAILED;
use crate::names::{AS, FAILURE, FAILURE_IS, IS, MANNER, NEEDS, OF, THAN, VALUE};
use crate::xml::Element;

impl Writer<'_> {
    /// Nodes of a step, which run one after the other.
    pub(super) fn step(&mut self, id: NodeId, node: &Node) -> Vec<Element> {
        let path = node.path.as_str();
        let element = match &node.kind {
            NodeKind::Call(call) => self.call(call, path),
            NodeKind::Let { binding, value } => {
                let value = self.port(value, path);
                match self.entry(*binding) {
                    Some(entry) => set(&value, entry),
                    None => return Vec::new(),
                }
            }
            NodeKind::Sequence { name, body } => {
                let steps = self.inside(id, node, Around::Passes, |writer| writer.steps(*body));
                let steps = if steps.is_empty() { vec![Element::new("AlwaysSuccess")] } else { steps };
                Element::new("Sequence").with("name", name.as_str()).children(steps)
            }
            NodeKind::Inline { policy, body } if policy == NODE_FAILED && self.just_fails(*body) => {
                let mut steps: Vec<Element> = self.set_failure("failed").into_iter().collect();
                steps.push(Element::new("AlwaysFailure"));
                return steps;
            }
            NodeKind::Inline { policy, body } => {
                let name = self.tree_name(policy);
                let body = self.inside(id, node, Around::Passes, |writer| writer.region(*body));
                if let Some((_, tree)) = self.trees.iter_mut().find(|(tree, _)| *tree == name) {
                    *tree = Some(body);
                }
                Element::new("SubTree").with("ID", name).with("_autoremap", "true")
            }
            NodeKind::If { condition, then, otherwise } => {
                let condition = self.condition(condition, true, path);
                let then = self.inside(id, node, Around::Passes, |writer| writer.region(*then));
                let otherwise = match otherwise {
                    Some(otherwise) => {
                        self.inside(id, node, Around::Passes, |writer| writer.region(*otherwise))
                    }
                    None => Element::new("AlwaysSuccess"),
                };
                // A condition itself succeeds and fails so.
                match then.is("AlwaysSuccess") && otherwise.is("AlwaysFailure") {
                    true => condition,
                    false => Element::new("IfThenElse").children([condition, then, otherwise]),
                }
            }
            NodeKind::Wait { condition, within_secs } => {
                let condition = self.condition(condition, true, path);
                if condition.is("AlwaysSuccess") {
                    return vec![condition];
                }
                let Some(msec) = milliseconds(*within_secs) else {
                    return vec![self.refuse(path, "a deadline below a millisecond")];
                };
                let timer = Element::new("ForceFailure").child(Element::new("Sleep").with("msec", msec));
                Element::new("ReactiveFallback").children([condition, timer])
            }
            NodeKind::Delay { secs } => match milliseconds(*secs) {
                Some(msec) => Element::new("Sleep").with("msec", msec),
                None => return Vec::new(),
            },
            NodeKind::Finally { .. } => {
                self.refuse(path, "`finally`: a tree that halts a node does not wait for a cleanup")
            }
            NodeKind::Monitor { watches, body } => match node.kind.deadline_secs().map(milliseconds) {
                Some(Some(msec)) => {
                    let body = self.inside(id, node, Around::Passes, |writer| writer.region(*body));
                    Element::new("Timeout").with("msec", msec).child(body)
                }
                Some(None) => self.refuse(path, "a deadline below a millisecond"),
                None => self.monitor(id, node, watches, *body),
            },
            NodeKind::Try { body, handlers } => self.attempt(id, node, *body, handlers),
            NodeKind::Repeat { times, body, until } => {
                let body = self.inside(id, node, Around::Loops, |writer| writer.region(*body));
                match until {
                    None => Element::new("Repeat").with("num_cycles", times.to_string()).child(body),
                    Some(until) => return vec![self.until(id, *times, body, until, path)],
                }
            }
            NodeKind::Each { item, list, at_most, body } => {
                let body = self.inside(id, node, Around::Loops, |writer| writer.region(*body));
                return self.each(*item, list, *at_most, body, path);
            }
            NodeKind::Parallel { branches } => self.parallel(id, node, branches),
            NodeKind::End { how, of, why } => return self.ending(*how, *of, why.as_ref(), node),
        };
        vec![element]
    }

    /// Checks if a region fails and does nothing else.
    fn just_fails(&self, region: RegionId) -> bool {
        let entry = self.graph.regions.get(region.index()).and_then(|region| region.entry);
        let first = entry.and_then(|id| self.graph.nodes.get(id.index())).map(|node| &node.kind);
        matches!(first, Some(NodeKind::End { how: Ending::Fail, .. }))
    }

    fn inside<T>(
        &mut self,
        id: NodeId,
        node: &Node,
        around: Around,
        write: impl FnOnce(&mut Self) -> T,
    ) -> T {
        self.places.push(Place::new(id, node, around));
        let written = write(self);
        self.places.pop();
        written
    }

    fn call(&mut self, call: &CallNode, path: &str) -> Element {
        let graph = self.graph;
        let Some(primitive) = graph.primitives.get(call.primitive.index()) else {
            return self.refuse(path, "a primitive that the graph does not declare");
        };
        let mut leaf = Leaf::action(primitive.name.to_string());
        self.arguments(&mut leaf, primitive, call, path);
        if let Some(result) = &primitive.result {
            let port = Port::typed(AS, result).out();
            match call.binds.and_then(|binding| self.entry(binding)) {
                Some(entry) => leaf.give(port, format!("{{{entry}}}")),
                None => leaf.has(port),
            }
        }
        if let Some(manner) = call.manner {
            leaf.give(Port::text(MANNER), format!("{};{}", manner.speed, manner.acceleration));
        }
        self.reports(&mut leaf);
        let Some(msec) = milliseconds(call.deadline_secs) else {
            return self.refuse(path, "a deadline below a millisecond");
        };
        let leaf = self.leaf(leaf, path);
        let mut attempt = Vec::new();
        if call.retries > 0 {
            // What stopped the attempt before is no longer on its way.
            attempt.extend(self.set_failure("timeout"));
        }
        attempt.extend(self.guard(primitive, call, path));
        attempt.push(Element::new("Timeout").with("msec", msec).child(leaf));
        let attempt = Element::sequence(attempt);
        match call.retries {
            0 => attempt,
            retries => {
                let attempts = (u64::from(retries) + 1).to_string();
                Element::new("RetryUntilSuccessful").with("num_attempts", attempts).child(attempt)
            }
        }
    }

    /// Gives a leaf the arguments of a call.
    fn arguments(&mut self, leaf: &mut Leaf, primitive: &Primitive, call: &CallNode, path: &str) {
        for (param, arg) in primitive.params.iter().zip(&call.args) {
            let value = self.port(arg, path);
            leaf.give(Port::typed(&param.name, &param.ty), value);
        }
    }

    /// Lets a leaf report the kind of its failure, where one is kept.
    fn reports(&self, leaf: &mut Leaf) {
        if let Some(register) = &self.register {
            leaf.give(Port::text(FAILURE).out(), format!("{{{register}}}"));
        }
    }

    /// Condition that the needs of a call hold, if one of them is left to the run.
    fn guard(&mut self, primitive: &Primitive, call: &CallNode, path: &str) -> Option<Element> {
        call.needs.iter().find(|need| need.verdict == Verdict::Deferred)?;
        let mut leaf = Leaf::condition(format!("{NEEDS}{}", primitive.name));
        leaf.note(&format!("succeeds if all needs of `{}` are known to hold", primitive.name));
        self.arguments(&mut leaf, primitive, call, path);
        self.reports(&mut leaf);
        Some(self.leaf(leaf, path))
    }

    fn monitor(&mut self, id: NodeId, node: &Node, watches: &[Watch], body: RegionId) -> Element {
        let path = node.path.as_str();
        let body = self.inside(id, node, Around::Passes, |writer| writer.region(body));
        watches.iter().rev().fold(body, |body, watch| {
            let named = Names(self.graph).watch(watch);
            let (how, of, why) = match &watch.reaction {
                Reaction::End { how, of, why } => (*how, *of, why.as_ref()),
                Reaction::Pause { .. } => {
                    return self.refuse(path, format!("`{named}`: no node holds a running one"));
                }
                Reaction::Restart { .. } => {
                    let why = "a decorator that retries does so after every failure";
                    return self.refuse(path, format!("`{named}`: {why}"));
                }
                Reaction::Resume { .. } => {
                    return self.refuse(path, format!("`{named}`: no node interrupts another and goes on"));
                }
            };
            if watch.hold_secs > 0.0 {
                return self.refuse(path, format!("`{named}`: no node waits until a condition has lasted"));
            }
            // What is unknown fires too: a monitor fails safe.
            let absent = self.condition(&watch.condition, false, path);
            self.inside(id, node, Around::Passes, |writer| match how {
                Ending::Done if writer.can_end(of) => {
                    let fires = Element::new("Inverter").child(absent);
                    Element::new("ReactiveFallback").children([fires, body])
                }
                _ => {
                    let end = Element::sequence(writer.ending(how, of, why, node));
                    let check = Element::new("Fallback").children([absent, end]);
                    Element::new("ReactiveSequence").children([check, body])
                }
            })
        })
    }

    fn attempt(&mut self, id: NodeId, node: &Node, body: RegionId, handlers: &[Handler]) -> Element {
        if handlers.is_empty() {
            return self.inside(id, node, Around::Passes, |writer| writer.region(body));
        }
        let by_kind = handlers.first().is_some_and(|handler| handler.on.is_some());
        let body = self.inside(id, node, Around::Catches { by_kind }, |writer| writer.region(body));
        let mut otherwise = Element::new("AlwaysFailure");
        for handler in handlers.iter().rev() {
            if handler.binds.is_some() {
                otherwise = self.refuse(&node.path, "`catch … as`: a tree keeps no words of a failure");
                continue;
            }
            let steps = self.inside(id, node, Around::Passes, |writer| {
                let mut steps: Vec<Element> = writer.set_failure("timeout").into_iter().collect();
                steps.extend(writer.steps(handler.body));
                Element::sequence(steps)
            });
            otherwise = match &handler.on {
                None => steps,
                Some(on) => {
                    let kinds = on.iter().filter_map(|kind| self.graph.failures.get(kind.index()));
                    let kinds: Vec<String> = kinds.map(|kind| kind.to_string()).collect();
                    let mut test = Leaf::condition(FAILURE_IS.to_owned());
                    let register = self.register.clone().unwrap_or_default();
                    test.give(Port::text(OF), format!("{{{register}}}"));
                    test.give(Port::text("kinds"), kinds.join(";"));
                    let test = self.leaf(test, &node.path);
                    Element::new("IfThenElse").children([test, steps, otherwise])
                }
            };
        }
        Element::new("Fallback").children([body, otherwise])
    }

    /// A loop with a test. A failure of the body ends it, and so does a test that holds; an entry says which.
    fn until(&mut self, id: NodeId, times: u32, body: Element, until: &Condition, path: &str) -> Element {
        let broken = format!("broken_{}", id.0);
        let test = self.condition(until, true, path);
        let round = Element::new("IfThenElse").children([body, test, set("yes", &broken)]);
        let rounds =
            Element::new("RetryUntilSuccessful").with("num_attempts", times.to_string()).child(round);
        let rounds = self.or_exhausted(rounds);
        let mut is_whole = Leaf::condition(VALUE.to_owned());
        is_whole.give(Port::text(OF), format!("{{{broken}}}"));
        is_whole.give(Port::text(IS), "equal".to_owned());
        is_whole.give(Port::text(THAN), "no".to_owned());
        let is_whole = self.leaf(is_whole, path);
        Element::new("Sequence").with("name", "until").children([set("no", &broken), rounds, is_whole])
    }

    /// Names the failure of a bound, where one is kept.
    fn or_exhausted(&mut self, bounded: Element) -> Element {
        match self.set_failure("exhausted") {
            None => bounded,
            Some(set) => {
                let fails = Element::new("ForceFailure").child(set);
                Element::new("Fallback").children([bounded, fails])
            }
        }
    }

    fn each(
        &mut self,
        item: BindingId,
        list: &Term,
        at_most: u32,
        body: Element,
        path: &str,
    ) -> Vec<Element> {
        let ty = self.graph.bindings.get(item.index()).map(|binding| &binding.ty);
        let tag = match ty {
            Some(Type::Text | Type::Entity(_) | Type::Case(_)) => "LoopString",
            Some(Type::Int | Type::Number | Type::Quantity(_)) => "LoopDouble",
            Some(Type::Bool) => "LoopBool",
            Some(Type::Pose | Type::List(_)) | None => {
                return vec![
                    self.refuse(path, "`each` over poses or lists: no loop of a tree has such items"),
                ];
            }
        };
        let queue = self.port(list, path);
        let entry = self.entry(item).map(|entry| format!("{{{entry}}}")).unwrap_or_default();
        let rounds = Element::new(tag).with("queue", queue.as_str()).with("value", entry).child(body);
        let length = match list {
            Term::Literal(Value::List(items)) => Some(items.len()),
            Term::List(items) => Some(items.len()),
            _ => None,
        };
        match length {
            Some(length) if length > at_most as usize => {
                let fails = Element::new("AlwaysFailure");
                vec![self.or_exhausted(fails)]
            }
            Some(0) => Vec::new(),
            Some(_) => vec![rounds],
            None => {
                let bound = Term::Literal(Value::Int(at_most.into()));
                let fits = self.count(list, Comparison::AtMost, &bound, path);
                vec![self.or_exhausted(fits), rounds]
            }
        }
    }

    fn parallel(&mut self, id: NodeId, node: &Node, branches: &[RegionId]) -> Element {
        let catching = self.places.iter().rev().find_map(|place| match place.around {
            Around::Catches { by_kind } => Some(by_kind),
            Around::Passes | Around::Loops => None,
        });
        if catching == Some(true) {
            let what = "`parallel` in a `try` that asks for the kind of a failure: the branches run at once";
            return self.refuse(&node.path, what);
        }
        if branches.is_empty() {
            return Element::new("AlwaysSuccess");
        }
        let outer = self.register.clone();
        let branches: Vec<Element> = branches
            .iter()
            .map(|branch| {
                self.register = outer.as_ref().map(|_| format!("{FAILURE}_{}", branch.0));
                let mut steps: Vec<Element> = self.set_failure("timeout").into_iter().collect();
                steps.extend(self.inside(id, node, Around::Loops, |writer| writer.steps(*branch)));
                Element::sequence(steps)
            })
            .collect();
        self.register = outer;
        Element::new("Parallel").with("success_count", "-1").with("failure_count", "1").children(branches)
    }

    /// Checks if a success here is the success of what an ending ends.
    fn can_end(&self, of: Option<NodeId>) -> bool {
        left(&self.places, of).iter().all(|place| place.is_last && place.around != Around::Loops)
    }

    fn ending(&mut self, how: Ending, of: Option<NodeId>, why: Option<&Term>, node: &Node) -> Vec<Element> {
        let path = node.path.as_str();
        let name = match how {
            Ending::Done => {
                if node.next.is_none() && self.can_end(of) {
                    return Vec::new();
                }
                return vec![self.refuse(path, "`done` before the last step: no node ends those around it")];
            }
            Ending::Fail => "fail",
            Ending::Cannot => "cannot",
            Ending::Replan => "replan",
        };
        let catches = |place: &Place| matches!(place.around, Around::Catches { .. });
        if left(&self.places, of).iter().any(catches) {
            let what = format!("`{name}` in a `try`: a fallback would go on");
            return vec![self.refuse(path, what)];
        }
        let mut leaf = Leaf::action(name.to_owned());
        leaf.note("fails; the reason is for people");
        let port = Port::text("why").or("");
        match why {
            Some(why) => {
                let why = self.port(why, path);
                leaf.give(port, why);
            }
            None => leaf.has(port),
        }
        let mut steps: Vec<Element> = self.set_failure("failed").into_iter().collect();
        steps.push(self.leaf(leaf, path));
        steps
    }
}
