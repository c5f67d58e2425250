//! Leaves and their ports: what a host registers, and what Groot2 shows as the palette.

use std::collections::BTreeMap;

use motet_graph::Type;

use super::value::port_type;
use crate::xml::Element;

/// Leaf with the ports that its kind has and the values that it gives them.
pub(super) struct Leaf {
    pub(super) kind: &'static str,
    pub(super) id: String,
    pub(super) ports: Vec<Port>,
    pub(super) values: Vec<(String, String)>,
    pub(super) note: String,
}

/// Port of a leaf.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Port {
    pub(super) direction: &'static str,
    pub(super) name: String,
    /// Type in C++: an entry that a port without a type reads first could not be written as a text.
    pub(super) ty: String,
    pub(super) default: Option<&'static str>,
}

impl Port {
    pub(super) fn typed(name: &str, ty: &Type) -> Self {
        Self { direction: "input_port", name: name.to_owned(), ty: port_type(ty), default: None }
    }

    pub(super) fn text(name: &str) -> Self {
        Self::typed(name, &Type::Text)
    }

    pub(super) fn out(self) -> Self {
        Self { direction: "output_port", ..self }
    }

    pub(super) fn or(self, default: &'static str) -> Self {
        Self { default: Some(default), ..self }
    }

    fn element(&self) -> Element {
        let element = Element::new(self.direction).with("name", &self.name).with("type", &self.ty);
        match self.default {
            Some(default) => element.with("default", default),
            None => element,
        }
    }
}

impl Leaf {
    pub(super) fn action(id: String) -> Self {
        Self { kind: "Action", id, ports: Vec::new(), values: Vec::new(), note: String::new() }
    }

    pub(super) fn condition(id: String) -> Self {
        Self { kind: "Condition", ..Self::action(id) }
    }

    /// Adds a port without a value.
    pub(super) fn has(&mut self, port: Port) {
        self.ports.push(port);
    }

    /// Adds a port with its value.
    pub(super) fn give(&mut self, port: Port, value: String) {
        self.values.push((port.name.clone(), value));
        self.ports.push(port);
    }

    /// Says in words what a host does for the leaf.
    pub(super) fn note(&mut self, note: &str) {
        note.clone_into(&mut self.note);
    }
}

/// Leaves of a document by their names, with ports in order and a note.
#[derive(Default)]
pub(super) struct Models(pub(super) BTreeMap<String, (&'static str, Vec<Port>, String)>);

impl Models {
    /// The list of the leaves, and of the trees that a policy calls.
    pub(super) fn element(self) -> Element {
        let leaf = |(id, (kind, ports, note)): (String, (&'static str, Vec<Port>, String))| {
            let element = Element::new(kind).with("ID", id);
            let element = element.children(ports.iter().map(Port::element));
            if note.is_empty() {
                return element;
            }
            let field = Element::new("Metadata").with("note", note);
            element.child(Element::new("MetadataFields").child(field))
        };
        Element::new("TreeNodesModel").children(self.0.into_iter().map(leaf))
    }
}
