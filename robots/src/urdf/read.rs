//! Reader of URDF, with diagnostics.

use motet_syntax::{Diagnostic, FileId, Severity, Source, Span};
use roxmltree::Node;
use rustc_hash::FxHashMap;

use super::diagnostics::{LeftoverXacro, NoLink, NotUrdf, TakenName, XmlDialect};
use super::document::{UrdfReader, XmlDocument, XmlSpans, children};
use super::element::{RawJoint, SpannedName};
use super::model::{Link, Urdf};
use super::surplus::surplus;
use super::tree;

/// Reads a URDF and returns it with its diagnostics; `None` if there is an error. O(bytes).
///
/// Joints may be fixed, revolute, continuous, prismatic or planar, and follow others by `<mimic>`; a floating
/// joint is held at its origin, with a warning. Position limits come from `<limit>`.
#[must_use]
pub fn read(source: &Source, file: FileId) -> (Option<Urdf>, Vec<Diagnostic>) {
    let document = match XmlDocument::parse(source, file, XmlDialect::Urdf) {
        Ok(document) => document,
        Err(problem) => return (None, vec![*problem]),
    };
    let (root, spans) = (document.root(), document.spans);
    if root.tag_name().name() != "robot" {
        let found = root.tag_name().name().to_owned();
        return (None, vec![NotUrdf { span: spans.tag(root), found }.into()]);
    }
    if let Some(left) = leftover(root, spans) {
        return (None, vec![left]);
    }
    let version = root.attribute("version").and_then(|version| version.trim().split_once('.'));
    let minor = version.and_then(|(_, minor)| minor.parse::<u32>().ok()).unwrap_or(0);
    let mut numbers = UrdfReader { spans, quaternions: minor >= 1, found: Vec::new() };
    let (links, link_names) = links(root, &mut numbers);
    let joints = joints(root, &mut numbers);
    let mut found = numbers.found;
    surplus(root, spans, &mut found);
    if links.is_empty() {
        found.push(NoLink { span: spans.tag(root) }.into());
    }
    // An omitted part has been reported; the hole in the tree is no second mistake.
    let whole =
        links.len() == children(root, "link").count() && joints.len() == children(root, "joint").count();
    let name = root.attribute("name").unwrap_or_default();
    let urdf = if whole { tree::build_tree(name, links, &link_names, joints, &mut found) } else { None };
    found.sort_by_key(|diagnostic| diagnostic.span);
    let wrong = found.iter().any(|diagnostic| diagnostic.severity == Severity::Error);
    (urdf.filter(|_| !wrong), found)
}

fn links<'a>(root: Node<'a, '_>, numbers: &mut UrdfReader) -> (Vec<Link>, Vec<SpannedName<'a>>) {
    let (mut links, mut names) = (Vec::new(), Vec::new());
    let mut taken = FxHashMap::default();
    for node in children(root, "link") {
        let Some(name) = numbers.spans.required(node, "name", &mut numbers.found) else { continue };
        let link = numbers.link(node, name.0);
        if is_new("link", name, &mut taken, &mut numbers.found) {
            links.push(link);
            names.push(name);
        }
    }
    (links, names)
}

fn joints<'a>(root: Node<'a, '_>, numbers: &mut UrdfReader) -> Vec<RawJoint<'a>> {
    let mut joints = Vec::new();
    let mut taken = FxHashMap::default();
    // A transmission has elements of this name inside too; only those directly under the robot are its
    // joints.
    for node in children(root, "joint") {
        let Some(name) = numbers.spans.required(node, "name", &mut numbers.found) else { continue };
        let joint = numbers.joint(node, name);
        if is_new("joint", name, &mut taken, &mut numbers.found) {
            joints.extend(joint);
        }
    }
    joints
}

fn is_new<'a>(
    what: &'static str,
    (name, span): SpannedName<'a>,
    taken: &mut FxHashMap<&'a str, Span>,
    found: &mut Vec<Diagnostic>,
) -> bool {
    if let Some(first) = taken.get(name).copied() {
        found.push(TakenName { span, what, name: name.to_owned(), first }.into());
        return false;
    }
    taken.insert(name, span);
    true
}

/// First macro that was not expanded: a xacro element, or `${…}` and `$(…)` in a link or a joint.
fn leftover(root: Node<'_, '_>, spans: XmlSpans) -> Option<Diagnostic> {
    let is_xacro = |node: &Node<'_, '_>| {
        node.tag_name().namespace().is_some_and(|namespace| namespace.ends_with("/xacro"))
    };
    let element = root.descendants().filter(Node::is_element).find(is_xacro).map(|node| {
        let text = format!("xacro:{}", node.tag_name().name());
        (spans.tag(node), text)
    });
    let in_value = || {
        let parts = children(root, "link").chain(children(root, "joint")).flat_map(|part| part.descendants());
        parts
            .filter(Node::is_element)
            .flat_map(|node| node.attributes().map(move |found| (node, found)))
            .find_map(|(node, attribute)| {
                let (value, span) = spans.attribute(node, attribute.name())?;
                (value.contains("${") || value.contains("$(")).then(|| (span, value.to_owned()))
            })
    };
    element.or_else(in_value).map(|(span, text)| LeftoverXacro { span, text }.into())
}
