//! Names of a library that a tree may use: its actions, facts and measures, with their ports.

use std::collections::{BTreeMap, BTreeSet};

use smol_str::{SmolStr, format_smolstr};

/// Names in force, as plain data.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Vocabulary {
    /// Primitives and policies.
    pub actions: BTreeMap<SmolStr, NodeSignature>,
    pub fluents: BTreeMap<SmolStr, NodeSignature>,
    pub measures: BTreeMap<SmolStr, NodeSignature>,
    pub entities: BTreeSet<SmolStr>,
}

impl Vocabulary {
    /// Name of the condition node of a fluent or a measure: its own, or with `is_` where an action has that.
    #[must_use]
    pub fn condition_node(&self, name: &SmolStr) -> SmolStr {
        if self.actions.contains_key(name) { format_smolstr!("is_{name}") } else { name.clone() }
    }

    /// Fluent or measure of a condition node, with its signature, and whether it is a measure.
    pub(crate) fn condition_of(&self, node: &str) -> Option<(&SmolStr, &NodeSignature, IsMeasure)> {
        let find = |name: &str| {
            let fluent = self.fluents.get_key_value(name).map(|(name, of)| (name, of, IsMeasure(false)));
            fluent.or_else(|| self.measures.get_key_value(name).map(|(name, of)| (name, of, IsMeasure(true))))
        };
        let own = find(node).filter(|(name, ..)| !self.actions.contains_key(*name));
        let prefixed = || node.strip_prefix("is_").and_then(find);
        own.or_else(|| prefixed().filter(|(name, ..)| self.actions.contains_key(*name)))
    }
}

/// Mark of a measure among conditions.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct IsMeasure(pub(crate) bool);

/// Parameters of an action, a fluent or a measure.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct NodeSignature {
    /// Parameters in the order of the declaration, with the types of their ports.
    pub params: Vec<(SmolStr, PortType)>,
    /// Type of the result of an action or of the reading of a measure.
    pub result: Option<PortType>,
}

/// Type of a port, as far as its text depends on it.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum PortType {
    Bool,
    /// A number in SI units.
    Number,
    /// Seven numbers: a position and a quaternion in the order x, y, z, w.
    Pose,
    /// A text, an entity or a case.
    Text,
    /// Elements with `;` between them.
    List(Box<PortType>),
}
