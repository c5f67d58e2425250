//! The entities that the engine has heard of, and of which kind they are.

use motet_graph::{Graph, KindId, Type, Value};
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

/// Entities in the order in which they were first heard of.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entities {
    list: Vec<(SmolStr, Option<KindId>)>,
    index: FxHashMap<SmolStr, u32>,
}

/// Whether an entity is of a kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum OfKind {
    /// It is.
    Surely,
    /// It was only heard of as something more general.
    Perhaps,
    /// It is not.
    No,
}

impl Entities {
    /// An entity was heard of as a member of a kind. The narrowest kind that it was heard of as is kept.
    pub(crate) fn hear(&mut self, graph: &Graph, id: &SmolStr, kind: Option<KindId>) {
        if let Some(known) = self.index.get(id) {
            if let Some((_, old)) = self.list.get_mut(*known as usize)
                && let Some(new) = kind
                && old.is_none_or(|old| is_kind(graph, new, old))
            {
                *old = Some(new);
            }
            return;
        }
        self.index.insert(id.clone(), self.list.len() as u32);
        self.list.push((id.clone(), kind));
    }

    /// All entities in a value of a type were heard of.
    pub(crate) fn hear_value(&mut self, graph: &Graph, value: &Value, ty: Option<&Type>) {
        match value {
            Value::Entity(id) => {
                let kind = if let Some(Type::Entity(kind)) = ty { Some(*kind) } else { None };
                self.hear(graph, id, kind);
            }
            Value::List(items) => {
                let inner = if let Some(Type::List(inner)) = ty { Some(&**inner) } else { None };
                for item in items {
                    self.hear_value(graph, item, inner);
                }
            }
            Value::Bool(_) | Value::Int(_) | Value::Number(_) => {}
            Value::Text(_) | Value::Case(_) | Value::Pose(_) => {}
        }
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// An entity, and whether it is of a kind.
    pub(crate) fn get(&self, graph: &Graph, index: usize, kind: KindId) -> Option<(SmolStr, OfKind)> {
        let (id, known) = self.list.get(index)?;
        let of_kind = match known {
            Some(known) if is_kind(graph, *known, kind) => OfKind::Surely,
            Some(known) if is_kind(graph, kind, *known) => OfKind::Perhaps,
            Some(_) => OfKind::No,
            // The root of the tree takes everything.
            None if graph.kinds.get(kind.index()).is_some_and(|kind| kind.parent.is_none()) => OfKind::Surely,
            None => OfKind::Perhaps,
        };
        Some((id.clone(), of_kind))
    }
}

/// Whether a kind is another or below it.
fn is_kind(graph: &Graph, kind: KindId, above: KindId) -> bool {
    let mut current = Some(kind);
    // Parents come before children, so this ends.
    while let Some(here) = current {
        if here == above {
            return true;
        }
        current = graph.kinds.get(here.index()).and_then(|kind| kind.parent).filter(|parent| *parent < here);
    }
    false
}
