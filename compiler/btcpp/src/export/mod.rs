//! Graphs as behaviour trees: the steps as nodes of BehaviorTree.CPP, the calls and the conditions as leaves
//! that a host registers, and the list of these leaves with their ports.
//!
//! The tree comes from the graph, so every name is resolved and every argument is there. A tree keeps no
//! facts: a condition is observed when its leaf is ticked. What a tree has no node for is refused.

mod condition;
mod model;
mod place;
mod step;
mod value;

use motet_graph::{Graph, ROOT, RegionId};
use smol_str::SmolStr;
use thiserror::Error;

use crate::leaves::Leaves;
use crate::xml::Element;
use model::Models;
use place::Place;

/// Part of a policy that a behaviour tree has no node for.
#[derive(Error, Clone, PartialEq, Eq, Debug)]
#[error("a behaviour tree cannot say {what}, at `{path}`")]
pub struct NoNode {
    /// JSON Pointer to the step, as in [`motet_graph::Node::path`].
    pub path: SmolStr,
    /// Description of the part, with the reason.
    pub what: String,
}

/// Writes a valid graph as an XML document of BehaviorTree.CPP 4 with its `TreeNodesModel`. The leaves of its
/// library name the ports of conditions. The same graph gives the same text.
///
/// ```
/// let graph = motet_graph::Graph::empty("tidy_up", "hsr");
/// let text = motet_btcpp::export(&graph, &motet_btcpp::Leaves::default()).unwrap();
/// assert!(text.contains(r#"<BehaviorTree ID="tidy_up">"#));
/// ```
///
/// # Errors
///
/// All parts that a tree cannot say, in the order of the policy.
pub fn export(graph: &Graph, leaves: &Leaves) -> Result<String, Vec<NoNode>> {
    let names_failures = graph.nodes.iter().any(|node| match &node.kind {
        motet_graph::NodeKind::Try { handlers, .. } => handlers.iter().any(|handler| handler.on.is_some()),
        _ => false,
    });
    let mut writer = Writer {
        graph,
        leaves,
        models: Models::default(),
        trees: Vec::new(),
        refused: Vec::new(),
        entries: value::entries(graph),
        register: names_failures.then(|| crate::names::FAILURE.to_owned()),
        places: Vec::new(),
    };
    for given in graph.bindings.iter().filter(|binding| binding.given) {
        writer.refuse(&given.name, "a name that another run has bound");
    }
    let name = writer.tree_name(&graph.policy);
    let mut steps = Vec::new();
    steps.extend(writer.set_failure("timeout"));
    steps.extend(writer.steps(ROOT));
    steps.extend(writer.goal());
    let root = Element::sequence(steps);
    writer.finish(name, root)
}

/// Deepest level of blocks: below it an invalid graph could go round in circles.
const DEEPEST: usize = motet_graph::validate::MAX_DEPTH + 2;

/// Deepest nesting of nodes that BehaviorTree.CPP reads, but for the elements around a tree.
const DEEPEST_XML: usize = 250;

/// A document while it is written.
struct Writer<'g> {
    graph: &'g Graph,
    leaves: &'g Leaves,
    models: Models,
    /// Trees of sub-policies, with their names.
    trees: Vec<(String, Option<Element>)>,
    refused: Vec<NoNode>,
    /// Names of the bindings on the blackboard.
    entries: Vec<Option<String>>,
    /// Entry for the kind of the failure on its way, `timeout` where there is none; no entry where no handler
    /// names a kind.
    register: Option<String>,
    /// Steps around the one that is written, the outermost first.
    places: Vec<Place>,
}

impl Writer<'_> {
    /// Notes what cannot be said. The element stands where it would be, in a document that nobody gets.
    fn refuse(&mut self, path: &str, what: impl Into<String>) -> Element {
        self.refused.push(NoNode { path: path.into(), what: what.into() });
        Element::new("AlwaysFailure")
    }

    /// Steps of a region.
    fn steps(&mut self, region: RegionId) -> Vec<Element> {
        let mut steps = Vec::new();
        let mut at = self.graph.regions.get(region.index()).and_then(|region| region.entry);
        while let Some(id) = at {
            let Some(node) = self.graph.nodes.get(id.index()) else { break };
            if self.places.len() > DEEPEST {
                steps.push(self.refuse(&node.path, "blocks that are nested so deep"));
                break;
            }
            steps.extend(self.step(id, node));
            at = node.next.filter(|next| *next > id);
        }
        steps
    }

    fn region(&mut self, region: RegionId) -> Element {
        Element::sequence(self.steps(region))
    }

    /// Checks of the goal: each part fails the tree if it is known to be false.
    fn goal(&mut self) -> Vec<Element> {
        let graph = self.graph;
        let part = |part| Element::new("Inverter").child(self.condition(part, false, "/achieves"));
        let checks: Vec<Element> = graph.goal.iter().map(part).collect();
        if checks.is_empty() {
            return checks;
        }
        vec![Element::new("Sequence").with("name", crate::names::GOAL).children(checks)]
    }

    /// Sets the kind of the failure on its way, where one is kept.
    fn set_failure(&self, kind: &str) -> Option<Element> {
        self.register.as_ref().map(|register| set(kind, register))
    }

    /// Name of a new tree.
    fn tree_name(&mut self, policy: &SmolStr) -> String {
        let graph = self.graph;
        let is_taken = |name: &str| {
            self.trees.iter().any(|(tree, _)| tree == name)
                || graph.primitives.iter().any(|primitive| primitive.name == name)
                || crate::names::ENDINGS.contains(&name)
                || !crate::names::is_node_name(name)
        };
        let stem = motet_graph::python::identifier(policy);
        let mut names = std::iter::once(stem.clone()).chain((2_u64..).map(|n| format!("{stem}_{n}")));
        let name = names.find(|name| !is_taken(name)).unwrap_or(stem);
        self.trees.push((name.clone(), None));
        name
    }

    fn finish(mut self, main: String, root: Element) -> Result<String, Vec<NoNode>> {
        let models = std::mem::take(&mut self.models).element();
        let trees = self.trees.iter().filter_map(|(_, tree)| tree.as_ref());
        if trees.chain([&root]).any(|tree| tree.depth() > DEEPEST_XML) {
            let what = format!("nodes that are nested more than {DEEPEST_XML} deep");
            self.refuse("", what);
        }
        if !self.refused.is_empty() {
            return Err(self.refused);
        }
        let document = Element::new("root").with("BTCPP_format", "4").with("main_tree_to_execute", &main);
        let tree = |name: &str, root: Element| Element::new("BehaviorTree").with("ID", name).child(root);
        let others = self.trees.into_iter().filter_map(|(name, root)| Some(tree(&name, root?)));
        let document = document.child(tree(&main, root)).children(others).child(models);
        let mut text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
        document.write(0, &mut text);
        Ok(text)
    }
}

/// Writes an entry of the blackboard.
fn set(value: &str, entry: &str) -> Element {
    Element::new("SetBlackboard").with("value", value).with("output_key", entry)
}
