//! Export of an execution graph as a tree of BehaviorTree.CPP 4.
//!
//! The tree calls the same actions in the same order as the engine, whatever fails, as long as its nodes keep
//! the contract of the manifest. What a tree cannot say is refused at its step:
//! pauses that keep the place of an interrupted step, restarts, cleanups that outlive a halt, lists that are
//! found in the run, and terms that only the engine evaluates.
//!
//! A failure of BehaviorTree.CPP has no kind, and nothing ends a tree from within. So the entry `failure`
//! of the blackboard holds the kind of the last failure, where a handler asks for it, and the entry
//! `ended` holds the ending of the policy: an ending is a failure that no handler catches.

mod call;
mod condition;
mod control;
mod manifest;
mod outcomes;

use std::collections::{BTreeMap, BTreeSet};

use motet_graph::draw::Names;
use motet_graph::{BindingId, Condition, Ending, Graph, Node, NodeId, NodeKind, ROOT, RegionId, Term, Value};
use motet_stdlib::lang::{builtin_failures, failures};
use motet_syntax::Diagnostic;
use motet_syntax::ast::Policy;
use motet_syntax::pointer::step_span;

use crate::element::{Element, is_xml_char};
use crate::errors::NotInTree;
use crate::names::{ENDED, FAILURE, is_added, is_entry};
use crate::vocabulary::Vocabulary;
use manifest::Manifest;

/// Writes the graph of a policy as a document of BehaviorTree.CPP 4, with a manifest of its nodes for
/// Groot2; or says at which steps of the policy that is not possible. O(nodes).
///
/// ```
/// use motet_graph::Graph;
/// use motet_syntax::{FileId, Source};
///
/// let source = Source::new("rest.motet", "policy rest { }");
/// let policy = motet_syntax::read(&source, FileId(0)).file.policies().next().cloned().unwrap();
/// let tree = motet_btcpp::export(&Graph::empty("rest", "hsr"), &policy, &Default::default()).unwrap();
/// assert!(tree.contains("<AlwaysSuccess/>"));
/// ```
pub fn export(graph: &Graph, policy: &Policy, vocabulary: &Vocabulary) -> Result<String, Vec<Diagnostic>> {
    let mut exporter = Exporter {
        graph,
        vocabulary,
        names: Names(graph),
        entries: entries(graph),
        manifest: Manifest::default(),
        endings: Vec::new(),
        caught: caught(graph),
        has_kinds: false,
        refused: Vec::new(),
    };
    let tree = exporter.tree();
    if exporter.refused.is_empty() {
        return Ok(tree.document());
    }
    let refused = exporter.refused.into_iter().map(|(path, part, reason)| {
        let mut diagnostic = Diagnostic::from(NotInTree { span: step_span(policy, &path), part, reason });
        diagnostic.path = path;
        diagnostic
    });
    Err(refused.collect())
}

/// Policy that ends where its last step does.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Ends {
    Whole,
    Inlined(NodeId),
}

/// Surroundings of a region.
#[derive(Clone, Copy)]
struct Context {
    /// Policy with which the region succeeds, since nothing of it runs behind the region.
    ends: Option<Ends>,
    /// True if a handler asks for the kind of its failure.
    needs_kind: bool,
}

struct Exporter<'g> {
    graph: &'g Graph,
    vocabulary: &'g Vocabulary,
    names: Names<'g>,
    /// Entries of the blackboard for the bindings.
    entries: Vec<String>,
    manifest: Manifest,
    /// Policies that steps end before their last step, which sets the entry `ended`: the whole, or an
    /// inlined one.
    endings: Vec<Option<NodeId>>,
    /// Bindings of caught failures.
    caught: BTreeSet<BindingId>,
    /// True if a step sets the entry `failure`.
    has_kinds: bool,
    /// Path of the step, the part that cannot be said, and the reason.
    refused: Vec<(String, String, String)>,
}

/// Bindings of the failures that handlers catch.
fn caught(graph: &Graph) -> BTreeSet<BindingId> {
    let handlers = graph.nodes.iter().filter_map(|node| match &node.kind {
        NodeKind::Try { handlers, .. } => Some(handlers),
        NodeKind::Call(_) | NodeKind::Let { .. } | NodeKind::Wait { .. } | NodeKind::Delay { .. } => None,
        NodeKind::Sequence { .. } | NodeKind::Inline { .. } | NodeKind::If { .. } => None,
        NodeKind::Finally { .. } | NodeKind::Monitor { .. } | NodeKind::Repeat { .. } => None,
        NodeKind::Each { .. } | NodeKind::Parallel { .. } | NodeKind::End { .. } => None,
    });
    handlers
        .flatten()
        .filter_map(|handler| handler.binds)
        .flat_map(|binds| [binds.kind, binds.text])
        .collect()
}

/// Names of the bindings as entries of the blackboard, all different.
fn entries(graph: &Graph) -> Vec<String> {
    let mut taken = BTreeMap::new();
    let plain = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let names = graph.bindings.iter().map(|binding| {
        let mut name: String = binding.name.chars().map(plain).collect();
        if !is_entry(&name) || is_added(&name) {
            name.insert_str(0, "the_");
        }
        let count = taken.entry(name.clone()).and_modify(|count| *count += 1).or_insert(0_u32);
        if *count > 0 { format!("{name}__{count}") } else { name }
    });
    names.collect()
}

impl Exporter<'_> {
    fn tree(&mut self) -> Element {
        let mut body = self.region(
            ROOT,
            Context { ends: self.graph.goal.is_empty().then_some(Ends::Whole), needs_kind: false },
        );
        let has_ending = !self.endings.is_empty();
        if has_ending {
            let done = Element::new("ScriptCondition").with("code", format!("{ENDED} == 'done'"));
            body = Element::new("Fallback").with("name", "endings").around([body, done]);
        }
        let mut steps = Vec::new();
        let mut start = Vec::new();
        if has_ending {
            start.push(format!("{ENDED} := ''"));
        }
        if self.has_kinds {
            start.push(format!("{FAILURE} := ''"));
        }
        if !start.is_empty() {
            steps.push(Element::new("Script").with("code", start.join("; ")));
        }
        steps.push(body);
        // The goal fails the run only where it is known to be false.
        for goal in &self.graph.goal {
            let refuted = self.condition("/achieves", goal, false);
            steps.push(Element::new("Inverter").with("name", "goal").around([refuted]));
        }
        let shared: Vec<_> = self.manifest.shared().cloned().collect();
        for name in shared {
            self.refuse("", format!("`{name}`"), "an action and a condition would have one name");
        }
        let policy = self.graph.policy.as_str();
        let tree = Element::new("BehaviorTree").with("ID", policy).around([sequence(steps)]);
        let root = Element::new("root").with("BTCPP_format", "4").with("main_tree_to_execute", policy);
        root.around([tree, self.manifest.element()])
    }

    fn refuse(&mut self, path: &str, part: impl Into<String>, reason: impl Into<String>) -> Element {
        self.refused.push((path.to_owned(), part.into(), reason.into()));
        Element::new("AlwaysFailure")
    }

    fn node(&self, id: NodeId) -> Option<&'_ Node> {
        self.graph.nodes.get(id.index())
    }

    /// Steps of a region, in order.
    fn region(&mut self, region: RegionId, context: Context) -> Element {
        sequence(self.steps(region, context))
    }

    fn steps(&mut self, region: RegionId, context: Context) -> Vec<Element> {
        let graph = self.graph;
        let mut next = graph.regions.get(region.index()).and_then(|region| region.entry);
        let mut steps = Vec::new();
        while let Some((id, node)) = next.and_then(|id| Some((id, graph.nodes.get(id.index())?))) {
            next = node.next;
            let context = Context { ends: context.ends.filter(|_| next.is_none()), ..context };
            steps.extend(self.step(id, node, context));
        }
        steps
    }

    /// Element of a step; `None` for a `done` where nothing is left to do.
    fn step(&mut self, id: NodeId, node: &Node, context: Context) -> Option<Element> {
        let path = node.path.as_str();
        let inner = Context { ends: None, ..context };
        Some(match &node.kind {
            NodeKind::Call(call) => self.call(id, path, call, context),
            NodeKind::Let { binding, value } => self.assignment(path, *binding, value),
            NodeKind::Sequence { name, body } => {
                self.name(path, "the name of the sequence", name);
                let steps = self.steps(*body, context);
                Element::new("Sequence").with("name", name.as_str()).around(non_empty(steps))
            }
            NodeKind::Inline { policy, body } => self.inlined(id, path, policy, *body, context),
            NodeKind::If { condition, then, otherwise } => {
                let test = self.condition(path, condition, true);
                let then = self.region(*then, context);
                let otherwise = otherwise
                    .map_or_else(|| Element::new("AlwaysSuccess"), |region| self.region(region, context));
                Element::new("IfThenElse").around([test, then, otherwise])
            }
            NodeKind::Wait { condition, within_secs } => self.wait(path, condition, *within_secs, context),
            NodeKind::Delay { secs } => {
                let msec = self.msec(path, *secs);
                Element::new("Sleep").with("msec", msec)
            }
            NodeKind::Finally { .. } => {
                self.refuse(path, "`finally`", "a node that is halted runs no further steps")
            }
            NodeKind::Monitor { watches, body } => {
                self.monitor(id, path, watches, *body, context, node.kind.deadline_secs())
            }
            NodeKind::Try { body, handlers } => self.handled(*body, handlers, context),
            NodeKind::Repeat { times, body, until } => {
                self.repeat(id, path, *times, *body, until.as_ref(), inner)
            }
            NodeKind::Each { item, list, at_most, body } => {
                self.each(path, *item, list, *at_most, *body, inner)
            }
            NodeKind::Parallel { branches } => {
                let branches: Vec<_> = branches.iter().map(|branch| self.region(*branch, inner)).collect();
                Element::new("Parallel")
                    .with("success_count", "-1")
                    .with("failure_count", "1")
                    .around(branches)
            }
            NodeKind::End { how: Ending::Done, of, .. }
                if context.ends == Some(of.map_or(Ends::Whole, Ends::Inlined)) =>
            {
                return None;
            }
            NodeKind::End { how, of, why } => self.ending(path, *how, *of, why.as_ref()),
        })
    }

    /// An ending: a failure that no handler catches. The name of the failing node is the reason.
    fn ending(&mut self, path: &str, how: Ending, of: Option<NodeId>, why: Option<&Term>) -> Element {
        let word = match how {
            Ending::Done => "done",
            Ending::Fail => "fail",
            Ending::Cannot => "cannot",
            Ending::Replan => "replan",
        };
        let is_whole = matches!(how, Ending::Cannot | Ending::Replan);
        let of = of.filter(|_| !is_whole);
        self.endings.push(of);
        let of = of.map_or_else(String::new, |of| format!(" {}", of.0));
        let script = Element::new("Script").with("code", format!("{ENDED} := '{word}{of}'"));
        let mut failing = Element::new("AlwaysFailure");
        match why {
            None => {}
            Some(Term::Literal(Value::Text(why))) => {
                self.name(path, "the reason", why);
                failing = failing.with("name", why.as_str());
            }
            Some(_) => {
                self.refuse(path, "a reason with values", "the name of a node is a fixed text");
            }
        }
        Element::new("Sequence").with("name", word).around([script, failing])
    }

    /// An inlined policy, which its own endings leave.
    fn inlined(&mut self, id: NodeId, path: &str, policy: &str, body: RegionId, context: Context) -> Element {
        self.name(path, "the name of the policy", policy);
        let before = self.endings.len();
        let steps = self.steps(body, Context { ends: Some(Ends::Inlined(id)), ..context });
        let body = Element::new("Sequence").with("name", policy).around(non_empty(steps));
        if !self.endings.iter().skip(before).any(|of| *of == Some(id)) {
            return body;
        }
        self.has_kinds = true;
        let is = |word: &str| {
            Element::new("ScriptCondition").with("code", format!("{ENDED} == '{word} {}'", id.0))
        };
        let script = |code: String| Element::new("Script").with("code", code);
        let done = script(format!("{ENDED} := ''"));
        let failed = script(format!("{ENDED} := ''; {FAILURE} := '{}'", failures::FAILED));
        let failed = sequence(vec![is("fail"), failed, Element::new("AlwaysFailure")]);
        let ending = Element::new("IfThenElse").around([is("done"), done, failed]);
        Element::new("Fallback").with("name", "endings").around([body, ending])
    }

    fn assignment(&mut self, path: &str, binding: BindingId, value: &Term) -> Element {
        match self.port(path, value) {
            Some(value) => {
                Element::new("SetBlackboard").with("value", value).with("output_key", self.entry(binding))
            }
            None => Element::new("AlwaysFailure"),
        }
    }

    fn wait(&mut self, path: &str, condition: &Condition, within_secs: f64, context: Context) -> Element {
        let test = self.condition(path, condition, true);
        let sleep = Element::new("Sleep").with("msec", crate::names::POLL_MSEC);
        let again = sequence(vec![sleep, Element::new("AlwaysFailure")]);
        let look = Element::new("Fallback").around([test, again]);
        let looks = Element::new("RetryUntilSuccessful").with("num_attempts", "-1").around([look]);
        let timeout = Element::new("Timeout").with("msec", self.msec(path, within_secs)).around([looks]);
        self.failing(timeout, builtin_failures::TIMEOUT, context)
    }

    /// The element, whose failure has a kind.
    fn failing(&mut self, element: Element, kind: &str, context: Context) -> Element {
        if !context.needs_kind {
            return element;
        }
        self.has_kinds = true;
        element.with("_onFailure", format!("{FAILURE} := '{kind}'"))
    }

    /// Entry of a binding.
    fn entry(&self, binding: BindingId) -> &str {
        self.entries.get(binding.index()).map_or("", String::as_str)
    }

    /// A time in milliseconds, at least one: BehaviorTree.CPP takes none for no limit.
    fn msec(&mut self, path: &str, secs: f64) -> String {
        let msec = (secs * 1e3).ceil().max(1.0);
        if msec > f64::from(u32::MAX) {
            self.refuse(path, format!("{secs} s"), "times are at most 4294967 s");
        }
        format!("{msec}")
    }

    /// Refuses a text that XML cannot hold.
    fn name(&mut self, path: &str, part: &str, text: &str) {
        if !text.chars().all(is_xml_char) {
            self.refuse(path, part, "XML has none of its control characters");
        }
    }
}

/// The elements one after the other.
fn sequence(mut steps: Vec<Element>) -> Element {
    match (steps.pop(), steps.is_empty()) {
        (None, _) => Element::new("AlwaysSuccess"),
        (Some(only), true) => only,
        (Some(last), false) => Element::new("Sequence").around(steps).around([last]),
    }
}

/// Children of a node that needs one.
fn non_empty(mut steps: Vec<Element>) -> Vec<Element> {
    if steps.is_empty() {
        steps.push(Element::new("AlwaysSuccess"));
    }
    steps
}
