//! The greeting for a graph.

use super::protocol::{CalledPrimitive, Hello, VERSION};
use motet_graph::{Graph, Type};

impl Hello {
    /// The greeting before a graph is run.
    #[must_use]
    pub fn of(graph: &Graph) -> Self {
        let primitive = |primitive: &motet_graph::Primitive| CalledPrimitive {
            name: primitive.name.to_string(),
            result: primitive.result.as_ref().map(|ty| text(graph, ty)),
        };
        Self {
            protocol: VERSION,
            robot: graph.robot.to_string(),
            policy: graph.policy.to_string(),
            primitives: graph.primitives.iter().map(primitive).collect(),
        }
    }
}

/// A type as the language writes it.
fn text(graph: &Graph, ty: &Type) -> String {
    match ty {
        Type::Bool => "Bool".to_owned(),
        Type::Int => "Int".to_owned(),
        Type::Number => "Number".to_owned(),
        Type::Text => "Text".to_owned(),
        Type::Pose => "Pose".to_owned(),
        Type::Quantity(name) | Type::Case(name) => name.to_string(),
        Type::Entity(kind) => {
            graph.kinds.get(kind.index()).map_or_else(|| "Entity".to_owned(), |kind| kind.name.to_string())
        }
        Type::List(inner) => format!("List<{}>", text(graph, inner)),
    }
}
