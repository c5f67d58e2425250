//! The manifest of the nodes that a tree uses, which Groot2 reads: `TreeNodesModel`.
//!
//! The contract of a node: an *action* does what its primitive does, and reports the kind of its failure
//! in `failure`. A *condition* observes what is not known, and succeeds only where the fact is known to
//! be what `is` says, or the comparison is known to hold; one such as `can_pick` where the needs of the
//! action hold. A condition without a new reading answers by the last one for half a second.

use std::collections::BTreeMap;

use motet_graph::{Fluent, Graph, Measure, Param, Primitive, Type};
use smol_str::SmolStr;

use super::call::cpp_type;
use crate::element::Element;
use crate::names::{ACCELERATION, FAILURE, IS, RESULT, SPEED, THAN};

/// Nodes in use, by name.
#[derive(Default)]
pub(super) struct Manifest {
    actions: BTreeMap<SmolStr, Element>,
    conditions: BTreeMap<SmolStr, Element>,
    /// Actions that have a port for a manner.
    mannered: BTreeMap<SmolStr, bool>,
}

impl Manifest {
    pub(super) fn add_action(&mut self, graph: &Graph, primitive: &Primitive, has_manner: bool) {
        let was = self.mannered.insert(primitive.name.clone(), has_manner).unwrap_or_default();
        self.mannered.insert(primitive.name.clone(), has_manner || was);
        let has_manner = has_manner || was;
        let named = |param: &Param| input(&param.name, &param.ty, &shown(graph, &param.ty));
        let mut ports: Vec<_> = primitive.params.iter().map(named).collect();
        if has_manner {
            let of = |name: &str, what: &str| {
                let about = format!("part of the greatest {what}, from 0 to 1");
                input(name, &Type::Number, &about).with("default", "1")
            };
            ports.extend([of(SPEED, "speed"), of(ACCELERATION, "acceleration")]);
        }
        if let Some(result) = &primitive.result {
            ports.push(output(RESULT, cpp_type(result), &shown(graph, result)));
        }
        ports.push(output(FAILURE, "std::string", "kind of the failure"));
        let element = Element::new("Action").with("ID", primitive.name.as_str()).around(ports);
        self.actions.insert(primitive.name.clone(), element);
    }

    pub(super) fn add_fluent(&mut self, graph: &Graph, fluent: &Fluent, node: &SmolStr, names: &[SmolStr]) {
        let mut ports: Vec<_> =
            names.iter().zip(&fluent.params).map(|(name, ty)| input(name, ty, &shown(graph, ty))).collect();
        let is = input(IS, &Type::Bool, "truth value for which the node succeeds, where it is known");
        ports.push(is.with("default", "true"));
        self.add_condition(node, ports);
    }

    pub(super) fn add_measure(
        &mut self,
        graph: &Graph,
        measure: &Measure,
        node: &SmolStr,
        names: &[SmolStr],
    ) {
        let mut ports: Vec<_> =
            names.iter().zip(&measure.params).map(|(name, ty)| input(name, ty, &shown(graph, ty))).collect();
        ports.push(input(IS, &Type::Text, "less, at_most, equal, unequal, at_least or more"));
        ports.push(input(THAN, &measure.result, &shown(graph, &measure.result)));
        self.add_condition(node, ports);
    }

    /// Adds the node that stands for the needs of an action.
    pub(super) fn add_need(&mut self, graph: &Graph, primitive: &Primitive, name: &str) {
        let named = |param: &Param| input(&param.name, &param.ty, &shown(graph, &param.ty));
        self.add_condition(&name.into(), primitive.params.iter().map(named).collect());
    }

    fn add_condition(&mut self, name: &SmolStr, ports: Vec<Element>) {
        let element = Element::new("Condition").with("ID", name.as_str()).around(ports);
        self.conditions.insert(name.clone(), element);
    }

    /// Names that two nodes of different kinds would share.
    pub(super) fn shared(&self) -> impl Iterator<Item = &SmolStr> {
        self.actions.keys().filter(|name| self.conditions.contains_key(*name))
    }

    pub(super) fn element(&self) -> Element {
        let nodes = self.actions.values().chain(self.conditions.values()).cloned();
        Element::new("TreeNodesModel").around(nodes)
    }
}

fn input(name: &str, ty: &Type, about: &str) -> Element {
    Element::new("input_port").with("name", name).with("type", cpp_type(ty)).saying(about)
}

fn output(name: &str, ty: &str, about: &str) -> Element {
    Element::new("output_port").with("name", name).with("type", ty).saying(about)
}

/// Type in the words of the language, with the unit of its number.
fn shown(graph: &Graph, ty: &Type) -> String {
    match ty {
        Type::Bool => "Bool".to_owned(),
        Type::Int => "Int".to_owned(),
        Type::Number => "Number".to_owned(),
        Type::Text => "Text".to_owned(),
        Type::Pose => "Pose: x;y;z;qx;qy;qz;qw in the frame map".to_owned(),
        Type::Quantity(name) => format!("{name} in SI units"),
        Type::Entity(kind) => {
            graph.kinds.get(kind.index()).map_or_else(String::new, |kind| kind.name.to_string())
        }
        Type::Case(name) => name.to_string(),
        Type::List(inner) => format!("list of {}, with ; between the elements", shown(graph, inner)),
    }
}
