//! Import of trees of BehaviorTree.CPP 4 as policies.
//!
//! The main tree becomes a policy without parameters, each other tree that it uses a policy of its name.
//! The steps have their places in the XML, so that a check of the policy reports there. A node that a
//! policy cannot say the same way is refused at its element: reactive fallbacks, scripts, preconditions,
//! loops without end.

mod condition;
mod handler;
mod leaf;
mod step;

use std::collections::BTreeMap;

use motet_robots::urdf::{XmlDialect, XmlDocument, XmlSpans};
use motet_syntax::ast::{Block, File, Item, MAX_NESTING, MAX_STEPS, Name, Policy, Step, StepKind};
use motet_syntax::{Diagnostic, FileId, Severity, Source, Span};
use roxmltree::Node;

use crate::errors::{NotInPolicy, WrongTree};
use crate::vocabulary::Vocabulary;

/// Reads the policies of a document of BehaviorTree.CPP 4; `None` if there is an error. The first policy
/// is that of the main tree. O(bytes).
///
/// ```
/// use motet_btcpp::{Vocabulary, import};
/// use motet_syntax::{FileId, Source, print};
///
/// let tree = r#"<root BTCPP_format="4"><BehaviorTree ID="rest"><Sleep msec="1500"/></BehaviorTree></root>"#;
/// let (file, found) = import(&Source::new("rest.xml", tree), FileId(0), &Vocabulary::default());
/// assert_eq!(found, []);
/// assert_eq!(print::text(&file.unwrap()), "policy rest {\n    wait 1.5 s\n}\n");
/// ```
#[must_use]
pub fn import(source: &Source, file: FileId, vocabulary: &Vocabulary) -> (Option<File>, Vec<Diagnostic>) {
    let document = match XmlDocument::parse(source, file, XmlDialect::BehaviorTree) {
        Ok(document) => document,
        Err(problem) => return (None, vec![*problem]),
    };
    let mut importer = Importer {
        spans: document.spans,
        vocabulary,
        found: Vec::new(),
        trees: BTreeMap::new(),
        wanted: Vec::new(),
        steps: 0,
    };
    let items = importer.document(document.root());
    let mut found = importer.found;
    found.sort_by_key(|said| said.span);
    let is_wrong = found.iter().any(|said| said.severity == Severity::Error);
    ((!is_wrong).then_some(File { items }), found)
}

/// Surroundings of a node.
#[derive(Clone, Copy)]
struct Context {
    /// True if a failure of the node is that of the whole tree.
    fails_tree: bool,
    /// Number of blocks around it.
    depth: usize,
}

impl Context {
    fn inside(self) -> Self {
        Self { depth: self.depth + 1, ..self }
    }

    /// Context of a node whose failure another one handles.
    fn handled(self) -> Self {
        Self { fails_tree: false, ..self.inside() }
    }
}

struct Importer<'v, 'a, 't> {
    spans: XmlSpans,
    vocabulary: &'v Vocabulary,
    found: Vec<Diagnostic>,
    trees: BTreeMap<&'a str, Node<'a, 't>>,
    /// Trees that are used, in the order in which they were found.
    wanted: Vec<&'a str>,
    /// Number of steps so far, with all copies.
    steps: usize,
}

impl<'a, 't> Importer<'_, 'a, 't> {
    fn document(&mut self, root: Node<'a, 't>) -> Vec<Item> {
        if root.tag_name().name() != "root" {
            let problem = format!("the root element is `<{}>`, not `<root>`", root.tag_name().name());
            self.wrong(root, problem);
            return Vec::new();
        }
        let version = root.attribute("BTCPP_format");
        if version != Some("4") {
            self.wrong(
                root,
                "`BTCPP_format` is not `4`: trees of other versions have other meanings".to_owned(),
            );
            return Vec::new();
        }
        for include in elements(root).filter(|node| node.tag_name().name() == "include") {
            self.refuse(include, "other files are not followed");
        }
        let trees: Vec<_> = elements(root).filter(|node| node.tag_name().name() == "BehaviorTree").collect();
        for tree in &trees {
            let Some(id) = tree.attribute("ID").filter(|id| !id.is_empty()) else {
                self.wrong(*tree, "`<BehaviorTree>` has no `ID`".to_owned());
                continue;
            };
            if self.trees.insert(id, *tree).is_some() {
                self.wrong(*tree, format!("there are two trees `{}`", id.escape_debug()));
            }
        }
        let main = root.attribute("main_tree_to_execute");
        let main = match (main, trees.as_slice()) {
            (Some(main), _) => self.trees.get_key_value(main).map(|(id, _)| *id),
            (None, [only]) => only.attribute("ID"),
            (None, _) => None,
        };
        let Some(main) = main else {
            self.wrong(root, "`main_tree_to_execute` names no tree of the file".to_owned());
            return Vec::new();
        };
        self.wanted.push(main);
        let mut items = Vec::new();
        while let Some(tree) = self.wanted.get(items.len()).and_then(|id| self.trees.get(id)).copied() {
            items.push(Item::Policy(self.policy(tree)));
        }
        items
    }

    fn policy(&mut self, tree: Node<'a, 't>) -> Policy {
        let (name, span) = self.spans.attribute(tree, "ID").unwrap_or_default();
        let name = Name { text: name.into(), span };
        let children: Vec<_> = elements(tree).collect();
        let steps = match children.as_slice() {
            [only] => self.node(*only, Context { fails_tree: true, depth: 1 }),
            _ => {
                self.wrong(tree, "a tree has one node at its root".to_owned());
                Vec::new()
            }
        };
        let span = self.span(tree);
        Policy {
            doc: "".into(),
            name,
            params: Vec::new(),
            result: None,
            robot: None,
            achieves: None,
            keeps: Vec::new(),
            body: Block::new(steps, span),
            cleanup: None,
            span,
        }
    }

    /// Range of a whole element.
    fn span(&self, node: Node<'_, '_>) -> Span {
        let tag = self.spans.tag(node);
        Span { end: tag.start + u32::try_from(node.range().len()).unwrap_or(u32::MAX), ..tag }
    }

    fn wrong(&mut self, node: Node<'_, '_>, problem: String) {
        self.found.push(WrongTree { span: self.spans.tag(node), problem }.into());
    }

    /// Reports a node that a policy cannot say.
    fn refuse(&mut self, node: Node<'_, '_>, reason: impl Into<String>) {
        let name =
            node.attribute("name").map(|name| format!(" `{}`", name.escape_debug())).unwrap_or_default();
        let part = format!("`<{}>`{name}", node.tag_name().name());
        self.found.push(NotInPolicy { span: self.spans.tag(node), part, reason: reason.into() }.into());
    }

    /// A step at an element, counted. `None` beyond the limits of a document.
    fn made(&mut self, node: Node<'_, '_>, context: Context, kind: StepKind) -> Option<Step> {
        self.steps += 1;
        if self.steps == MAX_STEPS + 1 {
            self.refuse(node, format!("the policy would have more than {MAX_STEPS} steps"));
        }
        if context.depth >= MAX_NESTING {
            self.found.push(motet_syntax::errors::too_deep(self.spans.tag(node), MAX_NESTING));
            return None;
        }
        (self.steps <= MAX_STEPS).then(|| Step { kind, span: self.span(node) })
    }

    fn block(&self, node: Node<'_, '_>, steps: Vec<Step>) -> Block {
        Block::new(steps, self.span(node))
    }
}

/// Child elements, in order.
fn elements<'a, 't>(node: Node<'a, 't>) -> impl Iterator<Item = Node<'a, 't>> {
    node.children().filter(Node::is_element)
}

/// Identifier of a node: that of its `ID`, in the explicit form, or else its tag.
fn id<'a>(node: Node<'a, '_>) -> &'a str {
    let tag = node.tag_name().name();
    let is_explicit = matches!(tag, "Action" | "Condition" | "Control" | "Decorator");
    node.attribute("ID").filter(|_| is_explicit).unwrap_or(tag)
}
