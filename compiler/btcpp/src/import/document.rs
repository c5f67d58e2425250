//! XML of behaviour trees, read within limits and with places.

use std::collections::BTreeMap;

use motet_syntax::xml::{CrowdedElement, crowded};
use motet_syntax::{FileId, Source, Span};
use roxmltree::{Document, Error, Node, ParsingOptions};

use crate::diagnostics::NotTree;

/// Greatest number of XML nodes of a document.
pub const MAX_XML_NODES: u32 = 200_000;

/// Greatest nesting of elements, as BehaviorTree.CPP has it.
const MAX_XML_DEPTH: u32 = 256;

/// Conversion of XML to places of the file.
#[derive(Clone, Copy)]
pub(super) struct Places {
    file: FileId,
    skipped: usize,
}

/// Reads a document. No entity is opened and no file is followed.
pub(super) fn parse(source: &Source, file: FileId) -> Result<(Document<'_>, Places), NotTree> {
    let text = source.text.trim_start();
    let places = Places { file, skipped: source.text.len() - text.len() };
    if let Some(CrowdedElement { at, what, limit }) = crowded(text) {
        let at = at + places.skipped;
        let problem = format!("there are more than {limit} {what}");
        return Err(NotTree { span: Span::new(file, at, at + 1), problem });
    }
    let options = ParsingOptions { allow_dtd: false, nodes_limit: MAX_XML_NODES, entity_resolver: None };
    match Document::parse_with_options(text, options) {
        Ok(document) => match too_deep(&document).map(|node| places.tag(node)) {
            None => Ok((document, places)),
            Some(span) => {
                let problem = format!("elements are nested more than {MAX_XML_DEPTH} deep");
                Err(NotTree { span, problem })
            }
        },
        Err(error) => {
            let at = places.offset(text, &error);
            let problem = match error {
                Error::NodesLimitReached => format!("there are more than {MAX_XML_NODES} XML nodes"),
                Error::DtdDetected => "a document type declaration is not taken".to_owned(),
                other => other.to_string(),
            };
            Err(NotTree { span: Span::new(file, at, at), problem })
        }
    }
}

/// The first element that is nested too deep, found without recursion.
fn too_deep<'a>(document: &'a Document<'_>) -> Option<Node<'a, 'a>> {
    let mut depths = BTreeMap::new();
    document.descendants().filter(Node::is_element).find(|node| {
        let outer = node.parent().and_then(|parent| depths.get(&parent.id().get_usize()).copied());
        let depth = outer.unwrap_or(0) + 1;
        depths.insert(node.id().get_usize(), depth);
        depth > MAX_XML_DEPTH
    })
}

impl Places {
    /// Place of a tag: `<` and its name.
    pub(super) fn tag(self, node: Node<'_, '_>) -> Span {
        let range = node.range();
        let text = node.document().input_text().get(range.clone()).unwrap_or_default();
        let length = text.find(|char: char| char.is_whitespace() || "/>".contains(char));
        let end = range.start + length.unwrap_or(text.len());
        Span::new(self.file, range.start + self.skipped, end + self.skipped)
    }

    /// Value of an attribute with its place.
    pub(super) fn attribute<'a>(self, node: Node<'a, '_>, name: &str) -> Option<(&'a str, Span)> {
        let attribute = node.attributes().find(|attribute| attribute.name() == name)?;
        let range = attribute.range_value();
        Some((attribute.value(), Span::new(self.file, range.start + self.skipped, range.end + self.skipped)))
    }

    /// Byte of a mistake, whose column counts characters.
    fn offset(self, text: &str, error: &Error) -> usize {
        if matches!(error, Error::NoRootNode | Error::UnclosedRootNode) {
            return self.skipped + text.len();
        }
        let (row, column) = (error.pos().row as usize, error.pos().col as usize);
        let before: usize = text.split_inclusive('\n').take(row.saturating_sub(1)).map(str::len).sum();
        let line = text.get(before..).unwrap_or_default();
        let inside: usize = line.chars().take(column.saturating_sub(1)).map(char::len_utf8).sum();
        self.skipped + before + inside
    }
}

/// Elements inside an element.
pub(super) fn elements<'a, 't>(node: Node<'a, 't>) -> Vec<Node<'a, 't>> {
    node.children().filter(Node::is_element).collect()
}

/// Name of a node's type: that of its tag, or its `ID` in the long form.
pub(super) fn kind<'a>(node: Node<'a, '_>) -> &'a str {
    let tag = node.tag_name().name();
    match tag {
        "Action" | "Condition" | "Control" | "Decorator" => node.attribute("ID").unwrap_or(tag),
        _ => tag,
    }
}
