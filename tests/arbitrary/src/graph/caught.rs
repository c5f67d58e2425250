//! Names for the failures that handlers catch.

use super::vocabulary::SAY;
use motet_graph::{Binding, BindingId, CaughtFailure, Graph, NodeKind, RegionId, Term, TextPart, Type};
use smol_str::{SmolStr, format_smolstr};

/// The graph with a name for the failure of each handler. Every `say` that is a step of the handler itself
/// says its kind and its text.
#[must_use]
pub fn with_named_failures(mut graph: Graph) -> Graph {
    let mut named: Vec<(RegionId, CaughtFailure)> = Vec::new();
    let Graph { nodes, bindings, .. } = &mut graph;
    for node in nodes.iter_mut() {
        let NodeKind::Try { handlers, .. } = &mut node.kind else { continue };
        for handler in handlers {
            let mut binding = |part: &str, ty: Type| {
                let id = BindingId(bindings.len() as u32);
                let name = format_smolstr!("{part}'{}", id.0);
                bindings.push(Binding { name, ty, given: false, among: Vec::new() });
                id
            };
            let kind = binding("kind", kinds());
            let caught = CaughtFailure { kind, text: binding("failure", Type::Text) };
            handler.binds = Some(caught);
            named.push((handler.body, caught));
        }
    }
    for node in nodes.iter_mut() {
        let NodeKind::Call(call) = &mut node.kind else { continue };
        let caught = named.iter().find(|(region, _)| *region == node.region);
        if let Some((_, CaughtFailure { kind, text })) = caught.filter(|_| call.primitive == SAY) {
            let parts = vec![
                TextPart::Value(Term::Binding(*kind), kinds()),
                TextPart::Literal(": ".into()),
                TextPart::Value(Term::Binding(*text), Type::Text),
            ];
            call.args = vec![Term::Template(parts)];
        }
    }
    graph
}

fn kinds() -> Type {
    Type::Case(SmolStr::new_static("FailureKind"))
}
