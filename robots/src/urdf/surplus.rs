//! Check for unread parts of a URDF: repeated elements of which one counts, and misspelt names. Parts for
//! other tools are skipped silently.

use motet_syntax::{Diagnostic, suggest};
use roxmltree::Node;

use super::diagnostics::{Repeated, UnknownAttribute, UnknownElement};
use super::document::{XmlSpans, children, is_own};

/// Allowed content of an element.
struct ElementRule {
    name: &'static str,
    attributes: &'static [&'static str],
    /// True if other tools add attributes, so that an unknown one is no mistake unless it is close to a known
    /// one.
    is_open: bool,
    /// Elements that may occur once.
    once: &'static [&'static str],
    /// Elements that may occur any number of times.
    many: &'static [&'static str],
}

const KNOWN: [ElementRule; 17] = [
    open("robot", &["name", "version"], &[], &["link", "joint"]),
    open("link", &["name", "type"], &[], &["collision", "visual", "inertial"]),
    open("collision", &["name", "group"], &["origin", "geometry"], &[]),
    open("visual", &["name", "group"], &["origin", "geometry"], &[]),
    closed("geometry", &[], SHAPES),
    open("joint", &["name", "type"], &["parent", "child", "origin", "axis", "limit", "mimic"], &["dynamics"]),
    open("limit", &["lower", "upper", "effort", "velocity", "acceleration", "jerk"], &[], &[]),
    closed("parent", &["link"], &[]),
    closed("child", &["link"], &[]),
    closed("origin", &["xyz", "rpy", "quat_xyzw"], &[]),
    closed("axis", &["xyz"], &[]),
    closed("mimic", &["joint", "multiplier", "offset"], &[]),
    closed("box", &["size"], &[]),
    closed("cylinder", &["radius", "length"], &[]),
    closed("capsule", &["radius", "length"], &[]),
    closed("sphere", &["radius"], &[]),
    closed("mesh", &["filename", "scale"], &[]),
];

/// Elements of a geometry; other names are reported with the shapes.
const SHAPES: &[&str] = &super::model::UrdfShape::ELEMENTS;

/// Elements of other tools.
const FOREIGN: [&str; 19] = [
    "transmission",
    "gazebo",
    "ros2_control",
    "sensor",
    "material",
    "safety_controller",
    "calibration",
    "dynamics",
    "inertial",
    "visual",
    "verbose",
    "contact",
    "contact_coefficients",
    "self_collision_checking",
    "plugin",
    "property",
    "mujoco",
    "loop_joint",
    "hardwareInterface",
];

const fn open(
    name: &'static str,
    attributes: &'static [&'static str],
    once: &'static [&'static str],
    many: &'static [&'static str],
) -> ElementRule {
    ElementRule { name, attributes, is_open: true, once, many }
}

const fn closed(
    name: &'static str,
    attributes: &'static [&'static str],
    many: &'static [&'static str],
) -> ElementRule {
    ElementRule { name, attributes, is_open: false, once: &[], many }
}

/// Reports every unread part of a description's links and joints that belongs to no other tool. O(bytes).
pub(super) fn surplus(root: Node<'_, '_>, spans: XmlSpans, found: &mut Vec<Diagnostic>) {
    // A description has few levels, and unknown elements are not entered.
    let mut open = vec![root];
    while let Some(node) = open.pop() {
        let name = node.tag_name().name();
        let Some(known) = KNOWN.iter().find(|known| known.name == name) else { continue };
        attributes(node, known, spans, found);
        elements(node, known, spans, found);
        if known.name == "geometry" {
            shapes(node, spans, found);
        }
        // A joint within a transmission is no joint of the robot: only known elements are entered.
        let belongs = |child: &Node<'_, '_>| {
            let name = child.tag_name().name();
            is_own(node, child) && (known.once.contains(&name) || known.many.contains(&name))
        };
        open.extend(node.children().filter(belongs));
    }
}

fn attributes(node: Node<'_, '_>, known: &ElementRule, spans: XmlSpans, found: &mut Vec<Diagnostic>) {
    for attribute in node.attributes().filter(|attribute| attribute.namespace().is_none()) {
        let name = attribute.name();
        if known.attributes.contains(&name) {
            continue;
        }
        // Names of several words are other tools' own: `soft_lower`, `command_effort`.
        let near = suggest::closest(name, known.attributes.iter().copied()).filter(|_| !name.contains('_'));
        if known.is_open && near.is_none() {
            continue;
        }
        let (element, known) = (known.name, known.attributes);
        let span = spans.attribute(node, name).map_or(spans.tag(node), |(_, span)| span);
        let near = near.map(str::to_owned);
        found.push(UnknownAttribute { span, element, name: name.to_owned(), near, known }.into());
    }
}

fn elements(node: Node<'_, '_>, known: &ElementRule, spans: XmlSpans, found: &mut Vec<Diagnostic>) {
    for child in node.children().filter(|child| is_own(node, child)) {
        let name = child.tag_name().name();
        let is_known = known.once.contains(&name) || known.many.contains(&name) || FOREIGN.contains(&name);
        if !is_known && known.name != "geometry" {
            found.push(unknown(child, known.once.iter().chain(known.many).copied(), spans));
        }
    }
    for part in known.once {
        let mut all = children(node, part);
        let first = all.next();
        if let (Some(first), Some(second)) = (first, all.next()) {
            found.push(repeated(node, format!("`<{part}>`"), [first, second], spans));
        }
    }
}

/// An element that nothing reads.
pub(crate) fn unknown<'k>(
    node: Node<'_, '_>,
    known: impl Iterator<Item = &'k str>,
    spans: XmlSpans,
) -> Diagnostic {
    let name = node.tag_name().name().to_owned();
    let near = suggest::closest(&name, known).map(str::to_owned);
    UnknownElement { span: spans.tag(node), name, near }.into()
}

fn shapes(node: Node<'_, '_>, spans: XmlSpans, found: &mut Vec<Diagnostic>) {
    let mut all = node.children().filter(|child| is_own(node, child));
    if let (Some(first), Some(second)) = (all.next(), all.next()) {
        found.push(repeated(node, "shapes".to_owned(), [first, second], spans));
    }
}

fn repeated(
    node: Node<'_, '_>,
    part: String,
    [first, second]: [Node<'_, '_>; 2],
    spans: XmlSpans,
) -> Diagnostic {
    let element = node.tag_name().name().to_owned();
    let name = node.attribute("name").unwrap_or_default().to_owned();
    let (span, first) = (spans.tag(second), spans.tag(first));
    Repeated { span, element, name, part, first }.into()
}
