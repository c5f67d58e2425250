//! Behaviour trees as policies: nodes of BehaviorTree.CPP as steps, leaves as the calls and conditions of a
//! library. Every step carries its place in the XML, so that what a check finds is shown there.

mod condition;
mod document;
mod leaf;
mod loops;
mod scope;
mod step;
mod value;

pub use document::MAX_XML_NODES;

use std::collections::BTreeMap;

use motet_syntax::ast::{Block, Expr, File, Item, MAX_NESTING, Name, Policy, Step};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Span};
use roxmltree::Node;
use smol_str::SmolStr;

use crate::diagnostics::{NoEqual, NotTree, WrongLeaf};
use crate::leaves::Leaves;
use crate::names::GOAL;
use document::{Places, elements, kind};
use scope::Scope;

/// The most steps of an imported policy, with the copies of trees and of attempts.
pub const MAX_IMPORTED_STEPS: usize = 10_000;
/// Deepest nesting of nodes, of which each is at most one block or one condition deep.
const MAX_DEPTH: usize = MAX_NESTING - 4;
/// Sub-policy that fails as a node does, so that a handler can catch it.
pub(crate) const NODE_FAILED: &str = "node_failed";

/// Decorators that were around an action, as parts of its call.
#[derive(Clone, Default)]
pub(super) struct Around {
    pub(super) within: Option<Expr>,
    pub(super) retry: Option<Expr>,
}

/// Imports the main tree of a document as a policy for the library that has these leaves. `None` where there
/// is an error among the diagnostics.
///
/// ```
/// use motet_btcpp::{Leaves, import};
/// use motet_syntax::{FileId, Source, print};
///
/// let text = r#"<root BTCPP_format="4"><BehaviorTree ID="rest"><Sleep msec="500"/></BehaviorTree></root>"#;
/// let (file, diagnostics) = import(&Source::new("rest.xml", text), FileId(0), &Leaves::default());
/// assert_eq!(diagnostics, []);
/// assert_eq!(print::text(&file.unwrap()), "policy rest {\n    wait 0.5 s\n}\n");
/// ```
#[must_use]
pub fn import(source: &Source, file: FileId, leaves: &Leaves) -> (Option<File>, Vec<Diagnostic>) {
    let (document, places) = match document::parse(source, file) {
        Ok(parsed) => parsed,
        Err(mistake) => return (None, vec![mistake.into()]),
    };
    let root = document.root_element();
    let (trees, found) = (BTreeMap::new(), Vec::new());
    let mut reader = Reader { places, leaves, trees, found, steps: 0, helps: false, calls: 0 };
    let policy = reader.main(root);
    let is_refused = reader.found.iter().any(|found| found.severity == Severity::Error);
    let policy = policy.filter(|_| !is_refused);
    let imported = policy.map(|policy| {
        let helper = reader.helps.then(|| reader.helper(places.tag(root)));
        File { items: helper.into_iter().chain([policy]).map(Item::Policy).collect() }
    });
    (imported, reader.found)
}

/// Reader of one document.
struct Reader<'l, 'a, 't> {
    places: Places,
    leaves: &'l Leaves,
    /// Trees by their names.
    trees: BTreeMap<&'a str, Node<'a, 't>>,
    found: Vec<Diagnostic>,
    /// Number of steps so far.
    steps: usize,
    /// True once the sub-policy that fails is called.
    helps: bool,
    /// Number of trees called so far.
    calls: usize,
}

/// Surroundings of a node.
#[derive(Clone)]
struct Context {
    scope: Scope,
    depth: usize,
    /// True where a failure leads to a fallback.
    is_caught: bool,
    /// True where a success is that of the policy.
    is_last: bool,
    /// Names of the trees around.
    open: Vec<SmolStr>,
}

impl Context {
    fn inner(&self) -> Self {
        Self { depth: self.depth + 1, ..self.clone() }
    }

    fn not_last(&self) -> Self {
        Self { is_last: false, ..self.clone() }
    }
}

impl<'a, 't> Reader<'_, 'a, 't> {
    fn main(&mut self, root: Node<'a, 't>) -> Option<Policy> {
        let span = self.places.tag(root);
        if root.tag_name().name() != "root" || root.attribute("BTCPP_format") != Some("4") {
            let problem = "the document does not begin with `<root BTCPP_format=\"4\">`".to_owned();
            self.found.push(NotTree { span, problem }.into());
            return None;
        }
        for part in elements(root) {
            let span = self.places.tag(part);
            match (part.tag_name().name(), part.attribute("ID")) {
                ("BehaviorTree", id) => {
                    let id = id.unwrap_or("tree");
                    if self.trees.insert(id, part).is_some() {
                        let problem = format!("there are two trees `{id}`");
                        self.found.push(NotTree { span, problem }.into());
                    }
                }
                ("TreeNodesModel", _) => {}
                (other, _) => {
                    let help = "put all trees into one file".to_owned();
                    self.refuse(span, format!("`<{other}>` is not followed"), Some(help));
                }
            }
        }
        let named = root.attribute("main_tree_to_execute");
        let main = match named {
            None => self.trees.first_key_value().filter(|_| self.trees.len() == 1),
            Some(name) => self.trees.get_key_value(name),
        };
        let Some((&name, &tree)) = main else {
            let problem = match named {
                Some(name) => format!("there is no tree `{name}`"),
                None => "`main_tree_to_execute` does not say which tree is the main one".to_owned(),
            };
            self.found.push(NotTree { span, problem }.into());
            return None;
        };
        let span = self.places.tag(tree);
        let mut nodes = self.only(tree)?;
        let mut achieves = None;
        if kind(nodes) == "Sequence"
            && let Some(last) = elements(nodes).last()
            && kind(*last) == "Sequence"
            && last.attribute("name") == Some(GOAL)
        {
            achieves = Some(*last);
        } else if kind(nodes) == "Sequence" && nodes.attribute("name") == Some(GOAL) {
            achieves = Some(nodes);
        }
        let context = Context {
            scope: Scope::main(),
            depth: 0,
            is_caught: false,
            is_last: true,
            open: vec![name.into()],
        };
        let goal = achieves.and_then(|goal| self.goal(goal, &context));
        let steps = match achieves {
            Some(goal) if goal == nodes => Vec::new(),
            Some(_) => {
                let mut inner = elements(nodes);
                inner.pop();
                self.sequence(&inner, &context)
            }
            None => {
                nodes = self.only(tree)?;
                self.node(nodes, &context)
            }
        };
        let robot = Some(&self.leaves.robot).filter(|robot| !robot.is_empty());
        let robot = robot.map(|robot| Name { text: robot.clone(), span });
        Some(self.policy(name, span, steps, robot, goal))
    }

    fn goal(&mut self, checks: Node<'a, 't>, context: &Context) -> Option<Expr> {
        let parts: Vec<Expr> = elements(checks)
            .into_iter()
            .filter_map(|check| self.condition(check, &context.inner()))
            .collect();
        condition::all(parts, self.places.tag(checks))
    }

    fn policy(
        &self,
        name: &str,
        span: Span,
        steps: Vec<Step>,
        robot: Option<Name>,
        achieves: Option<Expr>,
    ) -> Policy {
        // A tree that does nothing is a policy that is done.
        let steps = if steps.is_empty() { vec![step::done(span)] } else { steps };
        Policy {
            doc: SmolStr::default(),
            name: Name { text: name.into(), span },
            params: Vec::new(),
            result: None,
            robot,
            achieves,
            keeps: Vec::new(),
            body: Block::new(steps, span),
            cleanup: None,
            span,
        }
    }

    fn helper(&self, span: Span) -> Policy {
        self.policy(NODE_FAILED, span, vec![step::fail("a node of the tree has failed", span)], None, None)
    }

    /// The only child of a tree or a decorator.
    fn only(&mut self, node: Node<'a, 't>) -> Option<Node<'a, 't>> {
        match elements(node).as_slice() {
            [only] => Some(*only),
            several => {
                let problem =
                    format!("`<{}>` has {} children, not one", node.tag_name().name(), several.len());
                self.found.push(NotTree { span: self.places.tag(node), problem }.into());
                None
            }
        }
    }

    fn refuse(&mut self, span: Span, what: String, help: Option<String>) {
        self.found.push(NoEqual { span, what, help }.into());
    }

    fn wrong(&mut self, span: Span, what: String, help: Option<String>) {
        self.found.push(WrongLeaf { span, what, help }.into());
    }

    /// Counts steps against the limit.
    fn count(&mut self, steps: usize, span: Span) -> bool {
        let before = self.steps;
        self.steps = self.steps.saturating_add(steps);
        if before <= MAX_IMPORTED_STEPS && self.steps > MAX_IMPORTED_STEPS {
            let what = format!("with its copies the policy has more than {MAX_IMPORTED_STEPS} steps");
            self.refuse(span, what, None);
        }
        self.steps <= MAX_IMPORTED_STEPS
    }
}
