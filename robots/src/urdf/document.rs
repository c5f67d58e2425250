//! The XML under a robot description: parsed within limits, with the place of every element and attribute.
//!
//! The parser keeps no recursion and opens no entity; a depth limit guards whoever reads the file after us.

use motet_syntax::{Diagnostic, FileId, Source, Span};
use roxmltree::{Error, Node, ParsingOptions};

use super::errors::{LeftoverXacro, MissingPart, NotXml, TooMuch};

/// The most XML nodes (elements, texts, comments) of one description. The largest in use have some ten thousand.
const MAX_NODES: u32 = 200_000;
/// The deepest nesting; a URDF needs five levels, extensions some more.
const MAX_DEPTH: usize = 64;

/// What a document is meant to be.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum XmlDialect {
    /// A robot's links and joints.
    Urdf,
    /// What is said beside it.
    Srdf,
}

/// A parsed description.
pub(crate) struct XmlDocument<'t> {
    xml: roxmltree::Document<'t>,
    pub(crate) spans: XmlSpans,
}

/// From nodes to places in the file.
#[derive(Clone, Copy)]
pub(crate) struct XmlSpans {
    file: FileId,
    /// Bytes before the XML, which must start its file to be well-formed: a blanked byte order mark, empty lines.
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
        let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_NODES, entity_resolver: None };
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
            // `descendants` goes in document order, so the elements around this one are a prefix of those before it.
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

    /// The place of an element: `<` and its name.
    pub(crate) fn tag(self, node: Node<'_, '_>) -> Span {
        let start = node.range().start;
        let text = node.document().input_text().get(start..).unwrap_or_default();
        let end = text.find(|c: char| c.is_whitespace() || c == '/' || c == '>').unwrap_or(text.len());
        self.span(start..start + end)
    }

    /// An attribute's value and the value's place.
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

    /// That an element lacks a part.
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
                return TooMuch { span, what: "XML nodes", limit: MAX_NODES as usize }.into();
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

/// What kind of part an element lacks.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum XmlPart {
    /// `name="…"`
    Attribute,
    /// `<name …/>`
    Element,
}

/// Whether an element belongs to the same language as the one around it: a prefix says that it is somebody else's.
pub(crate) fn is_own(node: Node<'_, '_>, child: &Node<'_, '_>) -> bool {
    child.is_element() && child.tag_name().namespace() == node.tag_name().namespace()
}

/// The child elements with this name.
pub(crate) fn children<'a, 't>(node: Node<'a, 't>, name: &'static str) -> impl Iterator<Item = Node<'a, 't>> {
    node.children().filter(move |child| is_own(node, child) && child.tag_name().name() == name)
}

/// The first child element with this name.
pub(crate) fn child<'a, 't>(node: Node<'a, 't>, name: &'static str) -> Option<Node<'a, 't>> {
    children(node, name).next()
}
