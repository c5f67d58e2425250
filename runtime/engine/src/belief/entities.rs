//! The entities that the engine has heard of, and of which kind they are.

use motet_graph::{Graph, KindId, Type, Value};
use motet_stdlib::lang;
use rustc_hash::FxHashMap;
use smol_str::SmolStr;

/// Entities in the order in which they were first heard of. Kinds are kept by name, so that they outlast
/// their graph.
#[derive(Clone, Debug, Default)]
pub(crate) struct Entities {
    /// Each with the place of its kind among `kinds`.
    list: Vec<(SmolStr, Option<u32>)>,
    index: FxHashMap<SmolStr, u32>,
    kinds: Vec<SmolStr>,
}

/// Of each kind of [`Entities`], and last of none: whether its members are of a certain kind.
pub(crate) struct Sorting(Vec<OfKind>);

/// Membership of an entity in a kind.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum OfKind {
    Surely,
    /// It was only heard of as something more general.
    Perhaps,
    /// It is not.
    No,
}

impl Entities {
    /// An entity was heard of as a member of a kind. The narrowest kind that it was heard of as is kept.
    pub(crate) fn hear(&mut self, graph: &Graph, id: &SmolStr, kind: Option<&str>) {
        let Some(known) = self.index.get(id).copied() else {
            self.index.insert(id.clone(), self.list.len() as u32);
            let kind = kind.map(|kind| self.kind(kind));
            self.list.push((id.clone(), kind));
            return;
        };
        let Some(new) = kind else { return };
        let old = self.list.get(known as usize).and_then(|(_, old)| *old);
        let old = old.and_then(|old| self.kinds.get(old as usize));
        let is_narrower = old.is_none_or(|old| match (find(graph, new), find(graph, old)) {
            (Some(new), Some(old)) => is_kind(graph, new, old),
            // A kind that the graph does not know says nothing in it.
            (Some(_), None) => true,
            (None, Some(_) | None) => false,
        });
        if is_narrower {
            let new = self.kind(new);
            if let Some((_, kind)) = self.list.get_mut(known as usize) {
                *kind = Some(new);
            }
        }
    }

    fn kind(&mut self, name: &str) -> u32 {
        let known = self.kinds.iter().position(|known| known == name);
        known.unwrap_or_else(|| {
            self.kinds.push(SmolStr::new(name));
            self.kinds.len() - 1
        }) as u32
    }

    /// All entities in a value of a type were heard of.
    pub(crate) fn hear_value(&mut self, graph: &Graph, value: &Value, ty: Option<&Type>) {
        match value {
            Value::Entity(id) => {
                let kind =
                    if let Some(Type::Entity(kind)) = ty { graph.kinds.get(kind.index()) } else { None };
                self.hear(graph, id, kind.map(|kind| kind.name.as_str()));
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

    /// Returns whether a value fits a type, also by the kinds of the entities in it: one that is known to be
    /// of another kind does not. An entity that nobody has heard of is new, and fits. The robot is of no
    /// narrower kind than the root, and an id is never empty.
    pub(crate) fn fits(&self, graph: &Graph, value: &Value, ty: &Type) -> bool {
        let is_foreign = |id: &SmolStr, wanted: KindId| {
            let known = self.index.get(id).and_then(|index| self.list.get(*index as usize));
            let kind = known.and_then(|(_, kind)| self.kinds.get((*kind)? as usize));
            let kind = kind.and_then(|kind| find(graph, kind));
            kind.is_some_and(|kind| !is_kind(graph, kind, wanted) && !is_kind(graph, wanted, kind))
        };
        match (value, ty) {
            (Value::Entity(id), Type::Entity(wanted)) => {
                let is_robot = id == lang::entities::ROBOT && of_none(graph, *wanted) != OfKind::Surely;
                !id.is_empty() && !is_robot && !is_foreign(id, *wanted)
            }
            (Value::List(items), Type::List(inner)) => items.iter().all(|item| self.fits(graph, item, inner)),
            (value, ty) => value.fits(ty),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// Sorts the known kinds by their relation to a kind of a graph.
    pub(crate) fn sorting(&self, graph: &Graph, kind: KindId) -> Sorting {
        let of_kind = |name: &SmolStr| match find(graph, name) {
            Some(known) if is_kind(graph, known, kind) => OfKind::Surely,
            Some(known) if is_kind(graph, kind, known) => OfKind::Perhaps,
            Some(_) => OfKind::No,
            None => of_none(graph, kind),
        };
        let mut sorts: Vec<OfKind> = self.kinds.iter().map(of_kind).collect();
        sorts.push(of_none(graph, kind));
        Sorting(sorts)
    }

    /// An entity, and whether it is of the kind of a sorting.
    pub(crate) fn get(&self, index: usize, sorting: &Sorting) -> Option<(SmolStr, OfKind)> {
        let (id, kind) = self.list.get(index)?;
        let place = kind.map_or(sorting.0.len().checked_sub(1)?, |kind| kind as usize);
        let of_kind = sorting.0.get(place).copied().unwrap_or(OfKind::Perhaps);
        // The robot is of the root kind and of no other.
        let is_robot = of_kind == OfKind::Perhaps && id == lang::entities::ROBOT;
        Some((id.clone(), if is_robot { OfKind::No } else { of_kind }))
    }

    /// All with the name of their kind where it is known.
    pub(crate) fn all(&self) -> impl Iterator<Item = (&SmolStr, Option<&str>)> + '_ {
        self.list
            .iter()
            .map(|(id, kind)| (id, kind.and_then(|kind| self.kinds.get(kind as usize)).map(SmolStr::as_str)))
    }

    /// All with the name of their kind; without those of unknown kind.
    pub(crate) fn named(&self) -> impl Iterator<Item = (SmolStr, SmolStr)> + '_ {
        let kind = |kind: &Option<u32>| self.kinds.get(kind.as_ref().copied()? as usize).cloned();
        self.list.iter().filter_map(move |(id, of)| Some((id.clone(), kind(of)?)))
    }
}

/// Membership of an entity without a known kind: the root of the hierarchy covers everything.
fn of_none(graph: &Graph, kind: KindId) -> OfKind {
    let is_root = graph.kinds.get(kind.index()).is_some_and(|kind| kind.parent.is_none());
    if is_root { OfKind::Surely } else { OfKind::Perhaps }
}

fn find(graph: &Graph, name: &str) -> Option<KindId> {
    graph.kinds.iter().position(|known| known.name == name).map(|index| KindId(index as u32))
}

/// True if a kind is another or below it.
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
