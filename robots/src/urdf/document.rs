//! XML of a robot description: parsed within limits, with the span of every element and attribute, and the
//! numbers and poses in attributes.
//!
//! The parser does not recurse and opens no entity; a depth limit guards later readers of the file. Every
//! word of a vector must be a number: a reader that skips what it cannot parse accepts `"abc 1 2 3"` as a
//! vector.

use motet_syntax::xml::{CrowdedElement, crowded};
use motet_syntax::{Diagnostic, FileId, Source, Span};
use roxmltree::{Error, Node, ParsingOptions};

use super::diagnostics::{
    BadNumber, ImpossibleNumber, LeftoverXacro, MissingPart, NotXml, TooMuch, XmlDialect, XmlPart,
};
use super::model::Pose;

/// Greatest number of XML nodes (elements, texts, comments) of the description of a robot. The largest in use
/// have some ten thousand.
const MAX_NODES: u32 = 40_000;
/// Greatest number of XML nodes of the models of an SDF.
const MAX_SDF_NODES: u32 = 200_000;
/// Greatest nesting depth; a URDF needs five levels, extensions some more.
const MAX_DEPTH: usize = 64;

const fn max_nodes(dialect: XmlDialect) -> u32 {
    match dialect {
        XmlDialect::Urdf | XmlDialect::Srdf => MAX_NODES,
        XmlDialect::Sdf => MAX_SDF_NODES,
    }
}

/// Parsed XML document.
pub(crate) struct XmlDocument<'t> {
    xml: roxmltree::Document<'t>,
    pub(crate) spans: XmlSpans,
}

/// Conversion of nodes to spans.
#[derive(Clone, Copy)]
pub(crate) struct XmlSpans {
    file: FileId,
    /// Bytes before the XML, which must start its file to be well-formed: a blanked byte order mark, empty
    /// lines.
    skipped: usize,
}

impl<'t> XmlDocument<'t> {
    /// Parses the text. O(bytes).
    pub(crate) fn parse(
        source: &'t Source,
        file: FileId,
        dialect: XmlDialect,
    ) -> Result<Self, Box<Diagnostic>> {
        let text = source.text.trim_start();
        let spans = XmlSpans { file, skipped: source.text.len() - text.len() };
        if let Some(CrowdedElement { at, what, limit }) = crowded(text) {
            return Err(Box::new(TooMuch { span: spans.span(at..at + 1), what, limit }.into()));
        }
        let options =
            ParsingOptions { allow_dtd: false, nodes_limit: max_nodes(dialect), entity_resolver: None };
        let xml = match roxmltree::Document::parse_with_options(text, options) {
            Ok(xml) => xml,
            Err(problem) => return Err(Box::new(spans.not_xml(&problem, source, dialect))),
        };
        let document = Self { xml, spans };
        match document.too_deep() {
            Some(node) => {
                let span = spans.tag(node);
                Err(Box::new(TooMuch { span, what: "levels of elements", limit: MAX_DEPTH }.into()))
            }
            None => Ok(document),
        }
    }

    pub(crate) fn root(&self) -> Node<'_, 't> {
        self.xml.root_element()
    }

    fn too_deep(&self) -> Option<Node<'_, 't>> {
        let mut open: Vec<roxmltree::NodeId> = Vec::new();
        for node in self.xml.root_element().descendants().filter(Node::is_element) {
            // `descendants` goes in document order, so the elements around this one are a prefix of those
            // before it.
            while open.last().copied() != node.parent().map(|parent| parent.id()) && open.pop().is_some() {}
            open.push(node.id());
            if open.len() > MAX_DEPTH {
                return Some(node);
            }
        }
        None
    }
}

impl XmlSpans {
    fn span(self, range: std::ops::Range<usize>) -> Span {
        Span::new(self.file, range.start + self.skipped, range.end + self.skipped)
    }

    /// Span of an element: `<` and its name.
    pub(crate) fn tag(self, node: Node<'_, '_>) -> Span {
        let start = node.range().start;
        let text = node.document().input_text().get(start..).unwrap_or_default();
        let end = text.find(|c: char| c.is_whitespace() || c == '/' || c == '>').unwrap_or(text.len());
        self.span(start..start + end)
    }

    /// Value of an attribute and its span.
    pub(crate) fn attribute<'a>(self, node: Node<'a, '_>, name: &str) -> Option<(&'a str, Span)> {
        let attribute = node.attribute_node(name)?;
        Some((attribute.value(), self.span(attribute.range_value())))
    }

    /// An attribute that has to be there and not be empty.
    pub(crate) fn required<'a>(
        self,
        node: Node<'a, '_>,
        name: &'static str,
        found: &mut Vec<Diagnostic>,
    ) -> Option<(&'a str, Span)> {
        let attribute = self.attribute(node, name).filter(|(value, _)| !value.trim().is_empty());
        if attribute.is_none() {
            found.push(self.missing(node, name, XmlPart::Attribute));
        }
        attribute
    }

    /// Diagnostic for a missing part of an element.
    pub(crate) fn missing(self, node: Node<'_, '_>, part: &'static str, kind: XmlPart) -> Diagnostic {
        let name = node.attribute("name").unwrap_or_default().to_owned();
        let element = node.tag_name().name().to_owned();
        MissingPart { span: self.tag(node), element, name, part, kind }.into()
    }

    fn not_xml(self, problem: &Error, source: &Source, dialect: XmlDialect) -> Diagnostic {
        let at = match problem {
            Error::NoRootNode | Error::UnclosedRootNode => source.text.len(),
            other => self.offset(source, other.pos()),
        };
        let span = Span::new(self.file, at, at);
        let problem = match problem {
            Error::UnknownNamespace(prefix, _) if prefix == "xacro" => {
                return LeftoverXacro { span, text: "xacro:".to_owned() }.into();
            }
            Error::NodesLimitReached => {
                return TooMuch { span, what: "XML nodes", limit: max_nodes(dialect) as usize }.into();
            }
            Error::DtdDetected => "a document type declaration is not taken".to_owned(),
            other => other.to_string(),
        };
        NotXml { span, problem, dialect }.into()
    }

    /// The byte at a line and column from 1, where the column counts characters.
    fn offset(self, source: &Source, at: roxmltree::TextPos) -> usize {
        let text = source.text.get(self.skipped..).unwrap_or_default();
        let line = text.split_inclusive('\n').take(at.row.saturating_sub(1) as usize);
        let line: usize = line.map(str::len).sum();
        let rest = text.get(line..).unwrap_or_default();
        let column = rest.char_indices().nth(at.col.saturating_sub(1) as usize);
        self.skipped + line + column.map_or(0, |(byte, _)| byte)
    }
}

/// Checks whether a child belongs to the language of its parent: a prefix marks another one.
pub(crate) fn is_own(node: Node<'_, '_>, child: &Node<'_, '_>) -> bool {
    child.is_element() && child.tag_name().namespace() == node.tag_name().namespace()
}

/// Child elements with a name.
pub(crate) fn children<'a, 't>(node: Node<'a, 't>, name: &'static str) -> impl Iterator<Item = Node<'a, 't>> {
    node.children().filter(move |child| is_own(node, child) && child.tag_name().name() == name)
}

/// First child element with a name.
pub(crate) fn child<'a, 't>(node: Node<'a, 't>, name: &'static str) -> Option<Node<'a, 't>> {
    children(node, name).next()
}

/// Greatest length or offset of a robot, in m or rad.
const GREATEST: f64 = 1e6;

/// Reads numbers and collects diagnostics.
pub(super) struct UrdfReader {
    pub(super) spans: XmlSpans,
    /// True if `<origin>` may have `quat_xyzw`, as since URDF 1.1.
    pub(super) quaternions: bool,
    pub(super) found: Vec<Diagnostic>,
}

impl UrdfReader {
    /// Reads exactly `N` finite numbers; `None` if the attribute is missing or wrong.
    fn vector<const N: usize>(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<([f64; N], Span)> {
        let (text, span) = self.spans.attribute(node, key)?;
        let Some(values) = numbers::<N>(text) else {
            let wanted = match N {
                1 => "one number",
                3 => "three numbers",
                _ => "four numbers",
            };
            self.found.push(BadNumber { span, key, text: text.to_owned(), wanted }.into());
            return None;
        };
        for actual in values {
            let wanted = match actual {
                _ if !actual.is_finite() => "a finite number",
                _ if actual.abs() > GREATEST => "at most a million",
                _ => continue,
            };
            self.found.push(ImpossibleNumber { span, key, actual, wanted }.into());
            return None;
        }
        Some((values, span))
    }

    /// Reads three numbers; `default` if they are missing or wrong.
    pub(super) fn triple(&mut self, node: Node<'_, '_>, key: &'static str, default: [f64; 3]) -> [f64; 3] {
        self.vector::<3>(node, key).map_or(default, |(values, _)| values)
    }

    /// Reads one number; `None` if it is missing or wrong.
    pub(super) fn scalar(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<f64> {
        self.vector::<1>(node, key).map(|([value], _)| value)
    }

    /// Reads one limit of a joint, which may exceed any length: "unlimited" is often `1e16`.
    pub(super) fn limit(&mut self, node: Node<'_, '_>, key: &'static str) -> Option<(f64, Span)> {
        let (text, span) = self.spans.attribute(node, key)?;
        match text.trim().parse::<f64>() {
            Ok(value) if value.is_finite() => Some((value, span)),
            Ok(actual) => {
                self.found.push(ImpossibleNumber { span, key, actual, wanted: "a finite number" }.into());
                None
            }
            Err(_) => {
                let mistake = BadNumber { span, key, text: text.to_owned(), wanted: "one number" };
                self.found.push(mistake.into());
                None
            }
        }
    }

    /// Reads required lengths, none negative.
    pub(super) fn lengths<const N: usize>(
        &mut self,
        node: Node<'_, '_>,
        key: &'static str,
    ) -> Option<[f64; N]> {
        self.spans.required(node, key, &mut self.found)?;
        let (values, span) = self.vector::<N>(node, key)?;
        if let Some(actual) = values.into_iter().find(|value| *value < 0.0) {
            self.found.push(ImpossibleNumber { span, key, actual, wanted: "zero or more" }.into());
            return None;
        }
        Some(values)
    }

    /// Reads factors, none zero; ones if they are missing or wrong.
    pub(super) fn factors(&mut self, node: Node<'_, '_>, key: &'static str) -> [f64; 3] {
        let Some((values, span)) = self.vector::<3>(node, key) else { return [1.0; 3] };
        if values.contains(&0.0) {
            let mistake = ImpossibleNumber { span, key, actual: 0.0, wanted: "different from zero" };
            self.found.push(mistake.into());
            return [1.0; 3];
        }
        values
    }

    /// Reads the child element `origin`; the identity without one.
    pub(super) fn origin(&mut self, node: Node<'_, '_>) -> Pose {
        let Some(origin) = child(node, "origin") else { return Pose::IDENTITY };
        let xyz = self.triple(origin, "xyz", [0.0; 3]);
        let turned = if self.quaternions { self.vector::<4>(origin, "quat_xyzw") } else { None };
        let quaternion_xyzw = match turned {
            Some((values, span)) => self.unit(values, span),
            None => from_rpy(self.triple(origin, "rpy", [0.0; 3])),
        };
        Pose { xyz, quaternion_xyzw }
    }

    fn unit(&mut self, values: [f64; 4], span: Span) -> [f64; 4] {
        let norm = values.iter().map(|value| value * value).sum::<f64>().sqrt();
        if (norm - 1.0).abs() > 1e-3 {
            let key = "quat_xyzw";
            self.found.push(ImpossibleNumber { span, key, actual: norm, wanted: "of length 1" }.into());
            return Pose::IDENTITY.quaternion_xyzw;
        }
        values.map(|value| value / norm)
    }
}

/// Exactly `N` numbers, with white space between them.
pub(crate) fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let words: Option<Vec<f64>> = text.split_whitespace().map(|word| word.parse().ok()).collect();
    <[f64; N]>::try_from(words?).ok()
}

/// Rotation from roll about x, then pitch about y, then yaw about z, about fixed axes, in rad, as a unit
/// quaternion x, y, z, w.
pub(crate) fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> [f64; 4] {
    let ((sr, cr), (sp, cp), (sy, cy)) =
        (libm::sincos(roll / 2.0), libm::sincos(pitch / 2.0), libm::sincos(yaw / 2.0));
    [
        sr * cp * cy - cr * sp * sy,
        cr * sp * cy + sr * cp * sy,
        cr * cp * sy - sr * sp * cy,
        cr * cp * cy + sr * sp * sy,
    ]
}
