//! Elements of an XML document while it is written.

use std::borrow::Cow;

/// Element with its attributes in order.
#[derive(Clone, Debug)]
pub(crate) struct Element {
    tag: Cow<'static, str>,
    attributes: Vec<(String, String)>,
    children: Vec<Element>,
}

impl Element {
    pub(crate) fn new(tag: impl Into<Cow<'static, str>>) -> Self {
        Self { tag: tag.into(), attributes: Vec::new(), children: Vec::new() }
    }

    /// Checks the tag of an element.
    pub(crate) fn is(&self, tag: &str) -> bool {
        self.tag == tag
    }

    /// Adds an attribute.
    pub(crate) fn with(mut self, name: &str, value: impl Into<String>) -> Self {
        self.attributes.push((name.to_owned(), value.into()));
        self
    }

    /// Adds a child.
    pub(crate) fn child(mut self, child: Self) -> Self {
        self.children.push(child);
        self
    }

    /// Adds several children, in order.
    pub(crate) fn children(mut self, children: impl IntoIterator<Item = Self>) -> Self {
        self.children.extend(children);
        self
    }

    /// One element for a list that runs in order: itself where it is one, and a success where it is none.
    pub(crate) fn sequence(mut list: Vec<Self>) -> Self {
        match (list.pop(), list.is_empty()) {
            (None, _) => Self::new("AlwaysSuccess"),
            (Some(only), true) => only,
            (Some(last), false) => {
                list.push(last);
                Self::new("Sequence").children(list)
            }
        }
    }

    /// Levels of elements, with this one.
    pub(crate) fn depth(&self) -> usize {
        1 + self.children.iter().map(Self::depth).max().unwrap_or(0)
    }

    /// Writes the element as a part of a document, a child deeper than its parent.
    pub(crate) fn write(&self, level: usize, text: &mut String) {
        let indent = "  ".repeat(level);
        text.push_str(&format!("{indent}<{}", self.tag));
        for (name, value) in &self.attributes {
            text.push_str(&format!(" {name}=\"{}\"", escaped(value)));
        }
        if self.children.is_empty() {
            text.push_str("/>\n");
            return;
        }
        text.push_str(">\n");
        for child in &self.children {
            child.write(level + 1, text);
        }
        text.push_str(&format!("{indent}</{}>\n", self.tag));
    }
}

/// A text as the value of an attribute, so that a reader gets it back as it is.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for char in text.chars() {
        match char {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // Readers turn these into spaces where they stand as they are.
            '\n' | '\r' | '\t' => escaped.push_str(&format!("&#{};", char as u32)),
            char => escaped.push(char),
        }
    }
    escaped
}
