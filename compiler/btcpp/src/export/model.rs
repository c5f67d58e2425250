//! Leaves and their ports: what a host registers, and what Groot2 shows as the palette.

use std::collections::BTreeMap;

use motet_graph::Type;

use super::Writer;
use super::value::port_type;
use crate::names::{is_node_name, is_port_name};
use crate::xml::Element;

/// Leaf with the ports that its kind has and the values that it gives them.
pub(super) struct Leaf {
    kind: &'static str,
    id: String,
    ports: Vec<Port>,
    values: Vec<(String, String)>,
    note: String,
}

/// Port of a leaf.
#[derive(Clone, PartialEq, Eq, Debug)]
pub(super) struct Port {
    direction: &'static str,
    name: String,
    /// Type in C++: an entry that a port without a type reads first could not be written as a text.
    ty: String,
    default: Option<&'static str>,
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
pub(super) struct Models(BTreeMap<String, (&'static str, Vec<Port>, String)>);

impl Writer<'_> {
    /// Writes a leaf and adds it to the models.
    pub(super) fn leaf(&mut self, leaf: Leaf, path: &str) -> Element {
        if !is_node_name(&leaf.id) {
            return self.refuse(path, format!("`{}`, which is no name for a node", leaf.id));
        }
        let wrong = leaf.ports.iter().find(|port| !is_port_name(&port.name));
        if let Some(port) = wrong {
            return self
                .refuse(path, format!("`{}` of `{}`, which is no name for a port", port.name, leaf.id));
        }
        let (kind, ports, _) =
            self.models.0.entry(leaf.id.clone()).or_insert_with(|| (leaf.kind, Vec::new(), leaf.note));
        let is_other = *kind != leaf.kind;
        let mut clash = None;
        for port in leaf.ports {
            match ports.iter().find(|known| known.name == port.name) {
                None => ports.push(port),
                Some(known) if *known == port => {}
                Some(_) => clash = Some(port.name),
            }
        }
        if is_other || clash.is_some() {
            let what = format!("`{}`, because two different leaves would have this name", leaf.id);
            return self.refuse(path, what);
        }
        // A verifier of BehaviorTree.CPP does not know the long form inside a reactive node.
        let element = Element::new(leaf.id);
        leaf.values.into_iter().fold(element, |element, (name, value)| element.with(&name, value))
    }
}

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
